//! A printer whose parts can be exchanged one by one, to see what each does to colours.

use onelight::film::{AmountCurve, LogExposure, NumberTable, PerLayer, Tail};
use onelight::printing::Projection;
use onelight::spectra::nalgebra::{Matrix3, Vector3};
use onelight::spectra::{Pchip, RgbSpace, SpectralDistribution, SpectralShape};
use onelight::{DisplayLinear, FilmProcess, Reference, Stock, White, stock};

use crate::error::{Error, Result};

/// Where the light of a printer with dichroic mirrors is least, between its blue, green and red third, in nm: the minima of the
/// Academy's printer light.
const DICHROIC_EDGES_NM: [f64; 2] = [490.0, 598.0];

/// The light that prints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Beams {
    /// The look's own: tungsten light through Wratten filters.
    Wratten,
    /// The Academy's printer light, parted in three.
    Dichroic,
    /// Tungsten light of one wavelength each, where each layer of the print is most sensitive.
    Lines,
}

/// Which beams a layer of the print sees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Overlap {
    /// All three, as its sensitivity has it.
    AsItIs,
    /// Its own alone.
    None,
}

/// Which dyes of the negative hold back a layer's light.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NegativeDyes {
    /// All three, as their spectra have it.
    AsTheyAre,
    /// Its own alone, as strongly as on the neutral scale: a mask that were perfect.
    Apart,
}

/// Which dyes of the print darken a primary of the display.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PrintDyes {
    /// All three, as their spectra have it.
    AsTheyAre,
    /// Its own alone, as strongly as on the neutral scale.
    Apart,
}

/// The parts of a printer and of what it prints that are exchanged.
#[derive(Debug, Clone, Copy)]
pub(super) struct Parts {
    pub(super) beams: Beams,
    pub(super) overlap: Overlap,
    pub(super) negative: NegativeDyes,
    pub(super) print: PrintDyes,
}

/// The look as it is.
pub(super) const USUAL: Parts = Parts {
    beams: Beams::Wratten,
    overlap: Overlap::AsItIs,
    negative: NegativeDyes::AsTheyAre,
    print: PrintDyes::AsTheyAre,
};

/// A negative, its print and the printer between them, calibrated for a grey card.
pub(super) struct Printed {
    reference: Reference,
    parts: Parts,
    curves: PerLayer<AmountCurve>,
    projection: Projection,
    /// By wavelength: the negative's dyes and base, the light that exposes each layer of the print.
    rows: Vec<([f64; 3], f64, [f64; 3])>,
    /// Along the neutral scale: offset from the grey card, dyes of the negative, what is displayed.
    scale: Vec<Grey>,
}

struct Grey {
    amounts: [f64; 3],
    print: [f64; 3],
    shown: DisplayLinear,
}

impl Printed {
    pub(super) fn new(process: &FilmProcess, parts: Parts) -> Result<Self> {
        let reference = process.compile()?;
        let printing =
            process.print.as_ref().ok_or_else(|| Error::new("a look without a print, expected a negative"))?;
        let (negative, print) = (stock(process.camera.id())?, stock(printing.film.id())?);
        let printer = printing.printer();
        let shape = printer.shape();
        let tails = PerLayer { red: printing.red_tail, green: Tail::LogLinear, blue: Tail::LogLinear };
        let layers =
            print.sensitivity().zip_map(tails, |s, tail| (s, tail)).try_map(|(s, tail), _| s.on(shape, tail))?;
        let own = printer.beams().map_err(|error| Error::of("the printer", error))?;
        let beams = match parts.beams {
            Beams::Wratten => own.as_ref().map(|beam| beam.values().to_vec()).to_array(),
            Beams::Dichroic => dichroic(shape)?,
            Beams::Lines => lines(shape, &print),
        };
        let nm: Vec<f64> = shape.trapezoid_weights_nm().collect();
        let layers = layers.as_ref().map(SpectralDistribution::values).to_array();
        let light = |j: usize, k: usize, i: usize| match parts.overlap {
            Overlap::None if j != k => 0.0,
            _ => nm[i] * layers[j][i] * beams[k][i],
        };
        let dyes = negative.dyes_on(shape)?;
        let [c, m, y] = dyes.dyes().map(SpectralDistribution::values).to_array();
        let base = |i: usize| dyes.d_min().map_or(0.0, |d| d.values()[i]);
        let grey = reference.camera_curves().zip_map(reference.mid_grey(), AmountCurve::amount).map(|a| a.0).to_array();
        let through = |i: usize| 10f64.powf(-(base(i) + c[i] * grey[0] + m[i] * grey[1] + y[i] * grey[2]));
        let response: Matrix3<f64> = Matrix3::from_fn(|j, k| (0..nm.len()).map(|i| light(j, k, i) * through(i)).sum());
        let target = reference.print_target().ok_or_else(|| Error::new("a print without a target"))?;
        let target = Vector3::from(target.map(LogExposure::exposure).to_array());
        let lights = response.lu().solve(&target).filter(|g| g.iter().all(|v| *v > 0.0));
        let lights = lights.ok_or_else(|| Error::new("these beams cannot print a grey card as it is aimed at"))?;
        let rows = (0..nm.len()).map(|i| {
            let exposed = std::array::from_fn(|j| (0..3).map(|k| lights[k] * light(j, k, i)).sum());
            ([c[i], m[i], y[i]], base(i), exposed)
        });
        let curves = reference.print_curves().ok_or_else(|| Error::new("a look without a print, expected one"))?;
        let curves = curves.map(AmountCurve::clone);
        let projection = projection(process, &print, curves.as_ref())?;
        let mut printed = Self { rows: rows.collect(), curves, projection, reference, parts, scale: Vec::new() };
        printed.scale = (-900..=900).map(|i| printed.grey(f64::from(i) / 200.0)).collect();
        Ok(printed)
    }

    pub(super) fn reference(&self) -> &Reference {
        &self.reference
    }

    fn grey(&self, offset: f64) -> Grey {
        let h = self.reference.mid_grey().map(|h| LogExposure(h.0 + offset));
        let amounts = self.reference.camera_curves().zip_map(h, AmountCurve::amount).map(|a| a.0).to_array();
        let print = self.exposed(amounts);
        Grey { amounts, print, shown: self.shown(print) }
    }

    /// Log exposures of the print behind these amounts of dye.
    fn exposed(&self, amounts: [f64; 3]) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for (dyes, base, light) in &self.rows {
            let held: f64 = dyes.iter().zip(amounts).map(|(dye, a)| dye * a).sum();
            let through = 10f64.powf(-(base + held));
            sums.iter_mut().zip(light).for_each(|(sum, light)| *sum += light * through);
        }
        sums.map(f64::log10)
    }

    /// What a print exposed so shows.
    fn shown(&self, print: [f64; 3]) -> DisplayLinear {
        let dyes = self.curves.as_ref().zip_map(PerLayer::from(print), |curve, h| curve.amount(LogExposure(h)));
        self.projection.rgb(dyes)
    }

    /// What an exposure of the camera film becomes.
    pub(super) fn develop(&self, exposure: PerLayer<f64>) -> DisplayLinear {
        let effective = self.reference.inter_image().effective(exposure.map(LogExposure::of));
        let amounts = self.reference.camera_curves().zip_map(effective, AmountCurve::amount);
        let amounts = amounts.map(|a| a.0).to_array();
        let print = match self.parts.negative {
            NegativeDyes::AsTheyAre => self.exposed(amounts),
            NegativeDyes::Apart => std::array::from_fn(|i| self.read(amounts[i], |g| g.amounts[i], |g| g.print[i])),
        };
        match self.parts.print {
            PrintDyes::AsTheyAre => self.shown(print),
            PrintDyes::Apart => {
                DisplayLinear(std::array::from_fn(|i| self.read(print[i], |g| g.print[i], |g| g.shown[i])))
            }
        }
    }

    /// The value of the grey that has another value, both along the neutral scale; its ends are held.
    fn read(&self, wanted: f64, from: impl Fn(&Grey) -> f64, to: impl Fn(&Grey) -> f64) -> f64 {
        let first_falls = from(&self.scale[0]) > from(&self.scale[self.scale.len() - 1]);
        let along = |grey: &Grey| if first_falls { -from(grey) } else { from(grey) };
        let wanted = if first_falls { -wanted } else { wanted };
        let after = self.scale.partition_point(|grey| along(grey) < wanted).clamp(1, self.scale.len() - 1);
        let (a, b) = (&self.scale[after - 1], &self.scale[after]);
        let width = along(b) - along(a);
        let part = if width > 0.0 { ((wanted - along(a)) / width).clamp(0.0, 1.0) } else { 0.0 };
        to(a) + (to(b) - to(a)) * part
    }
}

/// The print on the screen, for the white that the look takes.
fn projection(process: &FilmProcess, print: &Stock, curves: PerLayer<&AmountCurve>) -> Result<Projection> {
    let dyes = print.dyes_on(SpectralShape::VISIBLE)?;
    let lamp =
        Projection::new(dyes, process.projector, &RgbSpace::SRGB).map_err(|error| Error::of("the projector", error))?;
    Ok(match process.white {
        White::Lamp => lamp,
        White::Film => lamp.adapted_to(curves.map(|curve| *curve.amount_range().start())),
    })
}

/// The Academy's printer light between its minima, red, green, blue; nothing beyond its table.
fn dichroic(shape: SpectralShape) -> Result<[Vec<f64>; 3]> {
    let table = NumberTable::parse("academy_printer_light.csv", include_str!("../../data/academy_printer_light.csv"))?;
    let points = table.points("wavelength_nm", "relative_power")?;
    let ends = points.x[0]..=points.x[points.x.len() - 1];
    let light = Pchip::new(points.x, points.y)?;
    let [blue_end, green_end] = DICHROIC_EDGES_NM;
    let thirds = [green_end..f64::INFINITY, blue_end..green_end, 0.0..blue_end];
    Ok(thirds.map(|third| {
        let at = |nm: f64| if third.contains(&nm) && ends.contains(&nm) { light.at(nm).max(0.0) } else { 0.0 };
        shape.wavelengths_nm().map(at).collect()
    }))
}

/// A beam of one wavelength for each layer: that of its highest sensitivity within the grid.
fn lines(shape: SpectralShape, print: &Stock) -> [Vec<f64>; 3] {
    print.sensitivity().to_array().map(|layer| {
        let peak = layer.peak().wavelength_nm.max(shape.first_nm());
        shape.wavelengths_nm().map(|nm| f64::from(u8::from((nm - peak).abs() <= 0.5))).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The same film by other code: what is exchanged is exchanged in the look that is baked.
    #[test]
    fn with_its_usual_parts_it_is_the_look() {
        let process = FilmProcess::default();
        let printed = Printed::new(&process, USUAL).unwrap();
        for rgb in [[0.18; 3], [0.05, 0.2, 0.6], [2.0, 0.5, 0.01]] {
            let exposure = printed.reference().exposure_matrix().expose(rgb);
            let (found, exact) = (printed.develop(exposure), printed.reference().develop_linear(rgb));
            assert!(found.iter().zip(*exact).all(|(a, b)| (a - b).abs() < 1e-9), "{rgb:?}: {found:?} {exact:?}");
        }
    }

    /// On the neutral scale all dyes are there together: keeping them apart changes nothing there.
    #[test]
    fn layers_kept_apart_leave_greys() {
        let apart = Parts { negative: NegativeDyes::Apart, print: PrintDyes::Apart, ..USUAL };
        let printed = Printed::new(&FilmProcess::default(), apart).unwrap();
        for grey in [0.02, 0.18, 0.9] {
            let exposure = printed.reference().exposure_matrix().expose([grey; 3]);
            let (found, exact) = (printed.develop(exposure), printed.reference().develop_linear([grey; 3]));
            assert!(found.iter().zip(*exact).all(|(a, b)| (a - b).abs() < 1e-3), "{grey}: {found:?} {exact:?}");
        }
    }
}
