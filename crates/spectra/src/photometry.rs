use std::sync::OnceLock;

use crate::blackbody::{Kelvin, black_body};
use crate::error::Error;
use crate::observer::Observer;
use crate::rgb::{Chromaticity, RgbSpace};
use crate::shape::SpectralShape;

/// Lumens in a watt at 555 nm: the SI's luminous efficacy K_cd.
pub const LUMENS_PER_WATT_555_NM: f64 = 683.0;

/// Luminous efficacy of the 6500 K black body between 380 and 780 nm in lm/W.
///
/// ```
/// assert!((onelight_spectra::white_lumens_per_watt() - 195.6).abs() < 0.05);
/// ```
#[must_use]
pub fn white_lumens_per_watt() -> f64 {
    static EFFICACY: OnceLock<f64> = OnceLock::new();
    *EFFICACY.get_or_init(|| {
        let white = black_body(Kelvin::WHITE, SpectralShape::VISIBLE);
        LUMENS_PER_WATT_555_NM * Observer::cie_1931().xyz(&white).y / white.integral()
    })
}

/// Illuminance in lux to irradiance in W/m^2 of 6500 K light between 380 and 780 nm; the same factor takes lumen to W.
///
/// ```
/// use onelight_spectra::lux_to_w_per_m2;
/// assert!((lux_to_w_per_m2(1000.0) - 5.112).abs() < 5e-4);
/// ```
#[must_use]
pub fn lux_to_w_per_m2(lux: f64) -> f64 {
    lux / white_lumens_per_watt()
}

/// Luminous flux in lumen to radiant flux in W of 6500 K light between 380 and 780 nm.
///
/// ```
/// assert!((onelight_spectra::lumen_to_w(800.0) - 4.09).abs() < 0.005);
/// ```
#[must_use]
pub fn lumen_to_w(lumen: f64) -> f64 {
    lux_to_w_per_m2(lumen)
}

/// RGB of a lamp with the colour of a black body: sRGB primaries about the 6500 K white, such that (1, 1, 1) is 1 W/m^2
/// of that white (\[Gotanda2010\], step 1).
///
/// ```
/// use onelight_spectra::{Kelvin, lamp_rgb_w_per_m2};
/// let tungsten = lamp_rgb_w_per_m2(Kelvin::TUNGSTEN, 1000.0)?;
/// assert!((tungsten[0] - 8.230).abs() < 1e-3 && (tungsten[2] - 1.610).abs() < 1e-3);
/// # Ok::<(), onelight_spectra::Error>(())
/// ```
///
/// # Errors
/// None for the built-in white; the signature is that of the RGB space.
pub fn lamp_rgb_w_per_m2(temperature: Kelvin, lux: f64) -> Result<[f64; 3], Error> {
    let space = RgbSpace::SRGB.with_white(Chromaticity::black_body_6500_k());
    let xyz = Observer::cie_1931().xyz(&black_body(temperature, SpectralShape::VISIBLE));
    Ok((space.from_xyz()? * (xyz / xyz.y) * lux_to_w_per_m2(lux)).into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use nalgebra::Vector3;

    #[test]
    fn lamps_match_the_figures_of_the_model() {
        // Computed independently in float64 at 1 nm; three decimals.
        let lamps = [
            (6500.0, [5.112, 5.112, 5.112]),
            (3200.0, [8.230, 4.500, 1.610]),
            (2000.0, [12.348, 3.362, 0.101]),
            (10_000.0, [4.272, 5.169, 7.065]),
        ];
        for (kelvin, expected) in lamps {
            let rgb = lamp_rgb_w_per_m2(Kelvin::new(kelvin).unwrap(), 1000.0).unwrap();
            assert_relative_eq!(rgb[..], expected[..], epsilon = 6e-4);
        }
        assert_relative_eq!(white_lumens_per_watt(), 195.6265, epsilon = 1e-3);
    }

    #[test]
    fn luminance_does_not_depend_on_colour() {
        let y = RgbSpace::SRGB.with_white(Chromaticity::black_body_6500_k()).to_xyz().unwrap();
        for kelvin in [1500.0, 3200.0, 5500.0, 20_000.0] {
            let rgb = lamp_rgb_w_per_m2(Kelvin::new(kelvin).unwrap(), 300.0).unwrap();
            assert_relative_eq!((y * Vector3::from(rgb)).y, lux_to_w_per_m2(300.0), max_relative = 1e-12);
        }
    }
}
