//! The simulation a second time, as plainly as it can be written: sums over wavelengths, straight from the data sheets. It
//! shares the sheets' curves with the library, and none of what the switches turn.

use onelight::film::{DyeDensity, LogExposure, PerLayer, SpectralSensitivity, Tail};
use onelight::spectra::nalgebra::{Matrix3, Vector3};
use onelight::spectra::{Kelvin, Observer, SpectralShape, planck_radiance};
use onelight::{DisplayLinear, FilmProcess, Reference, Stock, Wratten, stock};

pub(crate) type Curve = Box<dyn Fn(f64) -> f64>;

/// What an 18 % grey card becomes.
#[derive(Clone, Copy)]
pub(crate) enum Grey {
    Sheet,
    Density(f64),
}

pub(crate) struct Oracle {
    pub(crate) film: Stock,
    pub(crate) print: Option<Stock>,
    /// Light of scene (1, 0, 0), (0, 1, 0), (0, 0, 1) at 380..780 nm.
    pub(crate) lights: [Vec<f64>; 3],
    /// Amount of dye over log10 exposure, by layer.
    pub(crate) film_dye: [Curve; 3],
    pub(crate) print_dye: Option<[Curve; 3]>,
    pub(crate) grey: Grey,
    /// Longest wavelength in the printer.
    pub(crate) last_nm: usize,
    pub(crate) filters: Vec<Wratten>,
    pub(crate) separations: bool,
    pub(crate) beam_density: [f64; 3],
    /// Edge of the heat glass in nm.
    pub(crate) glass: Option<f64>,
    pub(crate) held_tail: bool,
    /// Corrections of the printer's lights; as many as it takes if `None`.
    pub(crate) iterations: Option<usize>,
    pub(crate) points: [f64; 3],
    /// Relative power at 380..780 nm, and whether the eye takes it for white.
    pub(crate) projector: Vec<f64>,
    pub(crate) adapted: bool,
    pub(crate) stops: f64,
}

pub(crate) fn visible() -> impl Iterator<Item = f64> {
    (380..=780).map(f64::from)
}

/// Trapezoid rule at 1 nm.
fn integral(values: impl Iterator<Item = f64>) -> f64 {
    let values: Vec<f64> = values.collect();
    values.iter().sum::<f64>() - 0.5 * (values[0] + values[values.len() - 1])
}

pub(crate) fn planck(kelvin: f64) -> Vec<f64> {
    let kelvin = Kelvin::new(kelvin).unwrap();
    visible().map(|nm| planck_radiance(kelvin, nm) / planck_radiance(kelvin, 560.0)).collect()
}

fn xyz(light: &[f64]) -> Vector3<f64> {
    let functions = Observer::cie_1931().matching_functions();
    Vector3::from_fn(|k, _| integral(functions[k].values().iter().zip(light).map(|(f, l)| f * l)))
}

/// XYZ to linear RGB with sRGB's primaries, `white` being (1, 1, 1).
fn rgb_from_xyz(white: &Vector3<f64>) -> Matrix3<f64> {
    let primary = |x: f64, y: f64| Vector3::new(x, y, 1.0 - x - y);
    let primaries = Matrix3::from_columns(&[primary(0.64, 0.33), primary(0.30, 0.60), primary(0.15, 0.06)]);
    let strength = primaries.try_inverse().unwrap() * (white / white.y);
    (primaries * Matrix3::from_diagonal(&strength)).try_inverse().unwrap()
}

pub(crate) fn layers<T>(of: PerLayer<T>) -> [T; 3] {
    of.to_array()
}

impl Oracle {
    /// The default process of a camera film; the dyes are those of `reference`.
    pub(crate) fn of(process: &FilmProcess, reference: &Reference) -> Self {
        let curve = |curve: &onelight::film::AmountCurve| -> Curve {
            let curve = curve.clone();
            Box::new(move |h| curve.amount(LogExposure(h)).0)
        };
        let basis = onelight::spectra::Basis::new(process.reconstruction).unwrap();
        let light = |k: usize| {
            let mut rgb = [0.0; 3];
            rgb[k] = 1.0;
            basis.spectrum(rgb).values().to_vec()
        };
        Self {
            film: stock(process.camera.id()).unwrap(),
            print: process.print.as_ref().map(|print| stock(print.film.id()).unwrap()),
            lights: [light(0), light(1), light(2)],
            film_dye: layers(reference.camera_curves()).map(curve),
            print_dye: reference.print_curves().map(|curves| layers(curves).map(curve)),
            grey: Grey::Density(0.7),
            last_nm: 1000,
            filters: Wratten::ALL.to_vec(),
            separations: true,
            beam_density: [0.5, 0.55, 0.9],
            glass: Some(725.0),
            held_tail: false,
            iterations: None,
            points: [0.0; 3],
            projector: planck(6500.0),
            adapted: true,
            stops: 0.0,
        }
    }

    /// A colour through all stages: scene-linear to display-linear. `Err` holds printer lights that cannot be.
    pub(crate) fn compile(&self) -> Result<impl Fn([f64; 3]) -> DisplayLinear + '_, Vector3<f64>> {
        let own = self.film.mid_grey().map_or(0.0, |h| h.0);
        let normal = match (&self.print, self.grey) {
            (None, Grey::Density(d)) => solve(&self.film_dye, self.neutral(&self.film, d)),
            _ => [own; 3],
        };
        let over = self.stops * 2f64.log10();
        let k = self.exposure_matrix(normal.map(|h| 10f64.powf(h + over)));
        let lights = match (&self.print, &self.print_dye) {
            (Some(print), Some(dye)) => {
                let target = match self.grey {
                    Grey::Density(d) => solve(dye, self.neutral(print, d)),
                    Grey::Sheet => {
                        let aim = layers(print.aim().unwrap().status_a);
                        std::array::from_fn(|j| layers(print.characteristic())[j].log_exposure(aim[j]).unwrap().0)
                    }
                };
                let amounts = std::array::from_fn(|i| self.film_dye[i](normal[i] + over));
                Some(self.calibrate(print, amounts, target.map(|h| 10f64.powf(h)))?)
            }
            _ => None,
        };
        let printed = lights.map(|lights| self.printed(lights));
        let shown = self.shown(self.print.as_ref().unwrap_or(&self.film));
        Ok(move |rgb: [f64; 3]| {
            let e = k * Vector3::from(rgb);
            let mut amounts: [f64; 3] = std::array::from_fn(|i| self.film_dye[i](e[i].max(1e-12).log10()));
            if let (Some(printed), Some(dye)) = (&printed, &self.print_dye) {
                let exposure = printed(amounts);
                amounts = std::array::from_fn(|j| dye[j](exposure[j].max(1e-12).log10()));
            }
            shown(amounts)
        })
    }

    /// Layer i over light k, each row such that 18 % grey gives `grey`.
    fn exposure_matrix(&self, grey: [f64; 3]) -> Matrix3<f64> {
        let sensitivity = layers(self.film.sensitivity());
        let raw = Matrix3::from_fn(|i, k| {
            let light = self.lights[k].iter().zip(visible());
            integral(light.map(|(l, nm)| l * 10f64.powf(sensitivity[i].log10_at(nm, Tail::LogLinear))))
        });
        Matrix3::from_fn(|i, k| raw[(i, k)] * grey[i] / (0.18 * raw.row(i).sum()))
    }

    fn printer_nm(&self) -> impl Iterator<Item = f64> + use<> {
        (400..=self.last_nm).map(|nm| nm as f64)
    }

    fn beam(&self, k: usize) -> Vec<f64> {
        let shape = SpectralShape::new(400, 1000, 1).unwrap();
        let separation = [Wratten::No70, Wratten::No99, Wratten::No98][k];
        let held = |filter: &&Wratten| **filter == Wratten::No2B || self.separations && **filter == separation;
        let filters: Vec<_> = self.filters.iter().filter(held).map(|f| f.density(shape).unwrap()).collect();
        let tungsten = Kelvin::new(3200.0).unwrap();
        self.printer_nm()
            .map(|nm| {
                let density: f64 = self.beam_density[k] + filters.iter().map(|f| f.at(nm).unwrap()).sum::<f64>();
                let glass = self.glass.map_or(1.0, |edge| 0.001 + 0.899 / (1.0 + ((nm - edge) / 8.0).exp()));
                planck_radiance(tungsten, nm) / planck_radiance(tungsten, 560.0) * 10f64.powf(-density) * glass
            })
            .collect()
    }

    fn print_sensitivity(&self, layer: usize, curve: &SpectralSensitivity, nm: f64) -> f64 {
        let at = if layer == 0 && self.held_tail { nm.min(*curve.range_nm().end()) } else { nm };
        10f64.powf(curve.log10_at(at, Tail::LogLinear))
    }

    /// Exposure of print layer j by beam k through a negative.
    fn response(&self, print: &Stock, amounts: [f64; 3]) -> Matrix3<f64> {
        let (dyes, base) = (layers(self.film.dyes()), self.film.d_min().unwrap());
        let layer = layers(print.sensitivity());
        let beams = [self.beam(0), self.beam(1), self.beam(2)];
        Matrix3::from_fn(|j, k| {
            if !self.separations && j != k {
                return 0.0;
            }
            integral(beams[k].iter().zip(self.printer_nm()).map(|(beam, nm)| {
                let density = base.at(nm) + (0..3).map(|i| dyes[i].at(nm) * amounts[i]).sum::<f64>();
                beam * 10f64.powf(-density) * self.print_sensitivity(j, layer[j], nm)
            }))
        })
    }

    fn calibrate(&self, print: &Stock, amounts: [f64; 3], target: [f64; 3]) -> Result<Vector3<f64>, Vector3<f64>> {
        let (m, t) = (self.response(print, amounts), Vector3::from(target));
        let mut g = Vector3::repeat((0..3).map(|k| t[k] / m[(k, k)]).product::<f64>().cbrt());
        match self.iterations {
            Some(count) => {
                for _ in 0..count {
                    let e = m * g;
                    g = Vector3::from_fn(|k, _| g[k] + (t[k] - e[k]) / m[(k, k)]);
                }
            }
            None => g = m.try_inverse().unwrap() * t,
        }
        if g.min() <= 0.0 {
            return Err(g);
        }
        Ok(Vector3::from_fn(|k, _| g[k] * 10f64.powf(0.025 * self.points[k])))
    }

    fn printed(&self, lights: Vector3<f64>) -> impl Fn([f64; 3]) -> [f64; 3] + use<> {
        let print = self.print.as_ref().unwrap();
        let (dyes, base, layer) = (layers(self.film.dyes()), self.film.d_min().unwrap(), layers(print.sensitivity()));
        let beams = [self.beam(0), self.beam(1), self.beam(2)];
        let last = self.last_nm - 400;
        let rows: Vec<([f64; 3], [f64; 3])> = (0..)
            .zip(self.printer_nm())
            .map(|(i, nm): (usize, f64)| {
                let end = if i == 0 || i == last { 0.5 } else { 1.0 };
                let weight = |j: usize| {
                    let of = |k: usize| if self.separations || j == k { lights[k] * beams[k][i] } else { 0.0 };
                    let light = of(0) + of(1) + of(2);
                    end * light * 10f64.powf(-base.at(nm)) * self.print_sensitivity(j, layer[j], nm)
                };
                (dyes.map(|dye| dye.at(nm)), [weight(0), weight(1), weight(2)])
            })
            .collect();
        move |amounts| through(&rows, amounts)
    }

    fn shown(&self, film: &Stock) -> impl Fn([f64; 3]) -> DisplayLinear + use<> {
        let rows = self.screen_rows(layers(film.dyes()));
        let lamp = xyz(&self.projector);
        let to_rgb = rgb_from_xyz(&if self.adapted { lamp } else { xyz(&planck(6500.0)) }) / lamp.y;
        move |amounts| DisplayLinear((to_rgb * Vector3::from(through(&rows, amounts))).into())
    }

    fn screen_rows(&self, dyes: [&DyeDensity; 3]) -> Vec<([f64; 3], [f64; 3])> {
        let functions = Observer::cie_1931().matching_functions();
        let row = |i: usize, nm: f64| {
            let end = if i == 0 || i == 400 { 0.5 } else { 1.0 };
            let weight = |k: usize| end * self.projector[i] * functions[k].values()[i];
            (dyes.map(|dye| dye.at(nm)), [weight(0), weight(1), weight(2)])
        };
        visible().enumerate().map(|(i, nm)| row(i, nm)).collect()
    }

    /// Amounts of a film's dyes that look like the bare lamp behind `density`.
    fn neutral(&self, film: &Stock, density: f64) -> [f64; 3] {
        let rows = self.screen_rows(layers(film.dyes()));
        let target = xyz(&self.projector) * 10f64.powf(-density);
        let light = |a: &Vector3<f64>| Vector3::from(through(&rows, (*a).into())).component_div(&target).map(f64::ln);
        let mut a = Vector3::repeat(density);
        for _ in 0..50 {
            let slope = Matrix3::from_fn(|i, k| {
                let step = Vector3::from_fn(|n, _| if n == k { 1e-5 } else { 0.0 });
                (light(&(a + step))[i] - light(&(a - step))[i]) / 2e-5
            });
            a -= slope.try_inverse().unwrap() * light(&a);
        }
        a.into()
    }
}

/// Weights times 10^-(dyes . amounts), summed.
fn through(rows: &[([f64; 3], [f64; 3])], amounts: [f64; 3]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (dyes, weights) in rows {
        let density: f64 = (0..3).map(|i| dyes[i] * amounts[i]).sum();
        let passed = 10f64.powf(-density);
        (0..3).for_each(|j| sum[j] += weights[j] * passed);
    }
    sum
}

/// Where monotone curves have the values `amounts`, by halving.
fn solve(curves: &[Curve; 3], amounts: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| {
        let (mut low, mut high) = (-8.0, 8.0);
        let rises = curves[i](high) > curves[i](low);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if (curves[i](middle) < amounts[i]) == rises { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    })
}
