use nalgebra::{Matrix3, Vector3};
use onelight_film::{DyeAmount, Dyes, PerLayer};
use onelight_spectra::quantity::Power;
use onelight_spectra::{
    Chromaticity, DisplayLinear, Illuminant, Kelvin, Observer, RgbSpace, SpectralDistribution, SpectralShape,
    black_body, illuminant, xenon_lamp,
};

use crate::error::{Error, ErrorKind};
use crate::spectral_row::{SpectralRow, transmitted};

/// The light that a print or a reversal film is seen by. docs/talk.md says how far pictures differ by them.
///
/// ```
/// use onelight_printing::Projector;
/// assert_eq!(Projector::default(), Projector::Display);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Projector {
    /// The 6500 K black body: what a display shows as white. Looks take [`Projector::ViewingBooth`] for it where the picture is on
    /// paper.
    #[default]
    Display,
    /// A theatre's 5500 K; the eye takes the bare lamp for white.
    Theatre,
    /// A theatre's 5500 K seen next to a 6500 K display: everything looks warm.
    TheatreUnadapted,
    /// A theatre's xenon lamp as measured, lines and all; the eye takes the bare lamp for white.
    Xenon,
    /// Daylight of 5000 K (D50), in which prints on paper are judged (\[ISO3664\]); the eye takes a perfect white in it for white.
    ViewingBooth,
}

/// What a viewer takes for white. Clear film is not neutral: a viewer adapts to it.
///
/// ```
/// use onelight_printing::White;
/// assert_eq!(White::default(), White::Film);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum White {
    /// The film at its lowest densities in the projector's light, a print unexposed, a reversal film fully exposed: the display's
    /// (1, 1, 1). Media-relative colorimetry, as \[ICC1\] has it: XYZ is scaled.
    #[default]
    Film,
    /// The bare lamp: clear film is as coloured and as dark as it is (\[Gotanda2010\]).
    Lamp,
}

impl Projector {
    fn lamp(self, shape: SpectralShape) -> SpectralDistribution<Power> {
        match self {
            Self::Display => black_body(Kelvin::WHITE, shape),
            Self::Theatre | Self::TheatreUnadapted => black_body(Kelvin::THEATRE, shape),
            Self::Xenon => xenon_lamp(shape),
            Self::ViewingBooth => illuminant(Illuminant::D50, shape),
        }
    }
}

/// A film on the screen: steps 6 and 7 of \[Gotanda2010\]. Amounts of dye to spectrum, XYZ (Y of the bare lamp is 1) and
/// display-linear RGB, which may be negative outside the display's gamut.
///
/// ```
/// use onelight_film::{DyeAmount, PerLayer, SheetText, Stock};
/// use onelight_printing::{Projection, Projector};
/// use onelight_spectra::{RgbSpace, SpectralShape};
/// # fn read(id: &str) -> Result<Stock, Box<dyn std::error::Error>> {
/// #     let f = onelight_stocks::find(id).ok_or("no such stock")?;
/// #     Ok(Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #         characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?)
/// # }
/// let print = read("kodak-2383")?;
/// let projection = Projection::new(print.dyes_on(SpectralShape::VISIBLE)?, Projector::Display, &RgbSpace::SRGB)?;
/// // The dyes that look grey at density 0.7, and what the display shows of them.
/// let grey = projection.neutral_amounts(0.7, print.id())?;
/// assert!(projection.rgb(grey).iter().all(|v| (v - 10f64.powf(-0.7)).abs() < 1e-9));
/// let red = projection.rgb(PerLayer { red: DyeAmount(0.0), ..grey });
/// assert!(red[0] > 3.0 * red[1], "without its cyan it is red: {red:?}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Projection {
    dyes: Dyes,
    lamp: SpectralDistribution<Power>,
    /// What counts as white: the bare lamp, or clear film.
    white_xyz: Vector3<f64>,
    to_rgb: Matrix3<f64>,
    rows: Vec<SpectralRow>,
}

/// Newton's method ends when the relative error of the light is this small.
const TOLERANCE: f64 = 1e-13;
const MAX_ITERATIONS: usize = 60;

impl Projection {
    /// A film with these dyes (on 380..780 nm by 1 nm) shown on a display with the primaries of `output`; its white is what
    /// the projector's light looks like.
    ///
    /// # Errors
    /// If the dyes are on another grid, or `output` is not a space.
    pub fn new(dyes: Dyes, projector: Projector, output: &RgbSpace) -> Result<Self, Error> {
        let shape = SpectralShape::VISIBLE;
        if dyes.shape() != shape {
            return Err(ErrorKind::Grid { found: dyes.shape() }.into());
        }
        let observer = Observer::cie_1931();
        let lamp = projector.lamp(shape);
        let unscaled = observer.xyz(&lamp);
        let lamp = lamp.scaled(1.0 / unscaled.y);
        let lamp_xyz = unscaled / unscaled.y;
        let white = match projector {
            Projector::Display | Projector::Theatre | Projector::Xenon | Projector::ViewingBooth => {
                Chromaticity::of(&lamp_xyz)
            }
            Projector::TheatreUnadapted => Chromaticity::black_body_6500_k(),
        };
        let to_rgb = output.with_white(white).from_xyz()?;
        let [x, y, z] = observer.matching_functions();
        let [c, m, yellow] = dyes.dyes().map(SpectralDistribution::values).to_array();
        let rows = shape.trapezoid_weights_nm().enumerate().map(|(i, nm)| {
            let light = nm * lamp.values()[i];
            SpectralRow {
                dyes: [c[i], m[i], yellow[i]],
                base: dyes.d_min().map_or(0.0, |d| d.values()[i]),
                weights: [x, y, z].map(|f| light * f.values()[i]),
            }
        });
        let rows = rows.collect();
        Ok(Self { dyes, lamp, white_xyz: lamp_xyz, to_rgb, rows })
    }

    /// The same projection seen by who takes the film with these amounts of dye for white, as [`White::Film`] does clear film: it
    /// becomes what the bare lamp was, display (1, 1, 1) or, for an unadapted projector, the colour of its lamp.
    #[must_use]
    pub fn adapted_to(self, amounts: PerLayer<DyeAmount>) -> Self {
        let white_xyz = Vector3::from(self.xyz(amounts));
        // Back to the lamp's white, then to the new one.
        let to_rgb = self.to_rgb * Matrix3::from_diagonal(&self.white_xyz.component_div(&white_xyz));
        Self { white_xyz, to_rgb, ..self }
    }

    /// The light that leaves the film.
    #[must_use]
    pub fn spectrum(&self, amounts: PerLayer<DyeAmount>) -> SpectralDistribution<Power> {
        self.lamp.through(&self.dyes.density(amounts).transmittance())
    }

    /// Tristimulus values; Y of the bare lamp is 1.
    #[must_use]
    pub fn xyz(&self, amounts: PerLayer<DyeAmount>) -> [f64; 3] {
        transmitted(&self.rows, amounts.map(|a| a.0).to_array())
    }

    /// Wavelength by wavelength, by 1 nm: the sums are the tristimulus values.
    #[must_use]
    pub fn rows(&self) -> &[SpectralRow] {
        &self.rows
    }

    /// Display-linear RGB of tristimulus values.
    #[must_use]
    pub fn rgb_of(&self, xyz: [f64; 3]) -> DisplayLinear {
        DisplayLinear((self.to_rgb * Vector3::from(xyz)).into())
    }

    /// The matrix from tristimulus values to display-linear RGB.
    #[must_use]
    pub fn rgb_from_xyz(&self) -> &Matrix3<f64> {
        &self.to_rgb
    }

    /// Display-linear RGB; the white is (1, 1, 1) unless the projector is unadapted.
    #[must_use]
    pub fn rgb(&self, amounts: PerLayer<DyeAmount>) -> DisplayLinear {
        self.rgb_of(self.xyz(amounts))
    }

    /// Amounts that look like the white behind a grey filter of `density`; `stock` is named if there are none.
    ///
    /// # Errors
    /// If no amounts of the dyes give that light.
    pub fn neutral_amounts(&self, density: f64, stock: &str) -> Result<PerLayer<DyeAmount>, Error> {
        let target = self.white_xyz * 10f64.powf(-density);
        let [c, m, y] = self.dyes.dyes().to_array();
        if c == m && m == y {
            return self.amounts_of_silver(target, density, stock);
        }
        let mut amounts = Vector3::repeat(density);
        for _ in 0..MAX_ITERATIONS {
            let (xyz, slope) = self.xyz_and_slope(amounts);
            let miss = xyz - target;
            if miss.amax() < TOLERANCE * target.amax() {
                return Ok(PerLayer::from([amounts.x, amounts.y, amounts.z]).map(DyeAmount));
            }
            let Some(step) = slope.lu().solve(&miss) else { break };
            amounts -= step * (0.5 / step.amax()).min(1.0);
        }
        Err(ErrorKind::NoAmounts { stock: stock.to_owned(), density }.into())
    }

    /// As [`Projection::neutral_amounts`] for a picture in silver: the same in all three thirds, found by its luminance.
    fn amounts_of_silver(&self, target: Vector3<f64>, density: f64, stock: &str) -> Result<PerLayer<DyeAmount>, Error> {
        let mut amount = density;
        for _ in 0..MAX_ITERATIONS {
            let (xyz, slope) = self.xyz_and_slope(Vector3::repeat(amount));
            let miss = xyz - target;
            if miss.amax() < TOLERANCE * target.amax() {
                return Ok(PerLayer::all(DyeAmount(amount)));
            }
            let step = miss.y / slope.row(1).sum();
            if !step.is_finite() {
                break;
            }
            amount -= step.clamp(-0.5, 0.5);
        }
        Err(ErrorKind::NoAmounts { stock: stock.to_owned(), density }.into())
    }

    fn xyz_and_slope(&self, amounts: Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let (mut xyz, mut slope) = (Vector3::zeros(), Matrix3::zeros());
        for SpectralRow { dyes, base, weights } in &self.rows {
            let dyes = Vector3::from(*dyes);
            let light = Vector3::from(*weights) * 10f64.powf(-(base + dyes.dot(&amounts)));
            xyz += light;
            slope -= std::f64::consts::LN_10 * light * dyes.transpose();
        }
        (xyz, slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_film_taken_for_white_becomes_white() {
        let dyes = ["cyan", "magenta", "yellow"].map(|dye| {
            let peak = match dye {
                "cyan" => 650.0,
                "magenta" => 550.0,
                _ => 450.0,
            };
            SpectralDistribution::from_fn(SpectralShape::VISIBLE, |nm| (-((nm - peak) / 60.0f64).powi(2)).exp())
                .unwrap()
        });
        let clear = PerLayer { red: DyeAmount(0.03), green: DyeAmount(0.05), blue: DyeAmount(0.12) };
        for projector in [Projector::Display, Projector::Theatre, Projector::TheatreUnadapted, Projector::Xenon] {
            let dyes = Dyes::new(PerLayer::from(dyes.clone()), None).unwrap();
            let lamp = Projection::new(dyes, projector, &RgbSpace::SRGB).unwrap();
            let bare = lamp.rgb_of(lamp.white_xyz.into());
            let film = lamp.clone().adapted_to(clear);
            assert!(film.rgb(clear).iter().zip(*bare).all(|(v, bare)| (v - bare).abs() < 1e-12), "{projector:?}");
            // Adapted twice is adapted to the last.
            let grey = PerLayer::all(DyeAmount(0.4));
            let again = lamp.adapted_to(grey).adapted_to(clear);
            assert!(again.rgb(grey).iter().zip(*film.rgb(grey)).all(|(a, b)| (a - b).abs() < 1e-12));
            let neutral = film.rgb(film.neutral_amounts(0.7, "a film").unwrap());
            assert!(neutral.iter().zip(*bare).all(|(v, bare)| (v / bare - 10f64.powf(-0.7)).abs() < 1e-9));
        }
    }

    #[test]
    fn dyes_on_another_grid_are_refused() {
        let dyes = |shape| {
            let dye = SpectralDistribution::from_fn(shape, |nm| nm / 1000.0).unwrap();
            Dyes::new(PerLayer::all(dye), None).unwrap()
        };
        let new = |shape| Projection::new(dyes(shape), Projector::Display, &RgbSpace::SRGB);
        let error = new(SpectralShape::by_1_nm::<400, 1000>()).unwrap_err();
        assert_eq!(
            error.to_string(),
            "dyes of a film to be projected: found them on 400..1000 nm by 1, expected 380..780 nm by 1"
        );
        assert!(new(SpectralShape::VISIBLE).is_ok());
    }
}
