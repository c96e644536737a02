use nalgebra::{Matrix3, Vector3};

use crate::blackbody::{Kelvin, black_body};
use crate::error::{Error, ErrorKind};
use crate::observer::Observer;
use crate::rgb::Chromaticity;
use crate::shape::SpectralShape;

/// The light of a scene that is to look white: a colour temperature, and how far from the black bodies it lies.
///
/// Tint is that of camera raw converters: 3000 times the distance in the CIE 1960 chart, positive for light that is greener than a
/// black body, as daylight is (D65 is 6504 K and +10).
///
/// ```
/// use onelight_spectra::{Chromaticity, SceneWhite};
/// let d65 = SceneWhite::new(6504.0, 9.6)?.chromaticity();
/// assert!((d65.x - Chromaticity::D65.x).abs() < 2e-4 && (d65.y - Chromaticity::D65.y).abs() < 2e-4);
/// assert!(SceneWhite::new(200.0, 0.0).is_err());
/// # Ok::<(), onelight_spectra::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneWhite {
    kelvin: f64,
    tint: f64,
}

/// Tint for a distance of 1 in the CIE 1960 chart.
const TINT: f64 = 3000.0;
/// Part of its response to white that a cone must have left: gains of at most 50.
const LEAST_RESPONSE: f64 = 0.02;
/// Colour temperatures that photographs are lit by.
const KELVIN: (f64, f64) = (1667.0, 25_000.0);
const MOST_TINT: f64 = 100.0;

impl SceneWhite {
    /// Light of `kelvin` K, 1667 to 25000, and of a tint from -100 to 100; reddish light cannot be much greener than a black body.
    ///
    /// # Errors
    /// If a number is outside its range, or there is no such light.
    pub fn new(kelvin: f64, tint: f64) -> Result<Self, Error> {
        if !(KELVIN.0..=KELVIN.1).contains(&kelvin) || !(-MOST_TINT..=MOST_TINT).contains(&tint) {
            return Err(ErrorKind::SceneWhite { kelvin, tint }.into());
        }
        let light = Self { kelvin, tint };
        let responses = bradford() * light.chromaticity().xyz();
        if responses.iter().all(|response| *response > LEAST_RESPONSE) {
            Ok(light)
        } else {
            Err(ErrorKind::SceneWhite { kelvin, tint }.into())
        }
    }

    /// The colour temperature in K, 1667 to 25000.
    #[must_use]
    pub fn kelvin(&self) -> f64 {
        self.kelvin
    }

    /// The tint, -100 to 100; positive is greener than a black body.
    #[must_use]
    pub fn tint(&self) -> f64 {
        self.tint
    }

    /// The chromaticity of the light.
    #[must_use]
    pub fn chromaticity(&self) -> Chromaticity {
        if (self.kelvin, self.tint) == (Kelvin::WHITE.value(), 0.0) {
            return Chromaticity::black_body_6500_k();
        }
        // Across the locus, towards green: a quarter turn from the way to lower temperatures.
        let (at, redder) = (of_black_body(self.kelvin), of_black_body(self.kelvin * 0.999));
        let along = [redder[0] - at[0], redder[1] - at[1]];
        let length = along[0].hypot(along[1]);
        let u = at[0] - along[1] / length * self.tint / TINT;
        let v = at[1] + along[0] / length * self.tint / TINT;
        let sum = 2.0 * u - 8.0 * v + 4.0;
        Chromaticity::new(3.0 * u / sum, 2.0 * v / sum)
    }

    /// The 3x3 on XYZ that takes this light to the white of the model, the 6500 K black body, as [`chromatic_adaptation`] does.
    #[must_use]
    pub fn to_model_white(&self) -> Matrix3<f64> {
        adaptation(self.chromaticity(), Chromaticity::black_body_6500_k())
    }
}

/// A black body in the CIE 1960 chart.
fn of_black_body(kelvin: f64) -> [f64; 2] {
    // Within the range of temperatures for every tint, so that this cannot be refused.
    let kelvin = Kelvin::new(kelvin).unwrap_or(Kelvin::WHITE);
    let xyz = Observer::cie_1931().xyz(&black_body(kelvin, SpectralShape::VISIBLE));
    let sum = xyz.x + 15.0 * xyz.y + 3.0 * xyz.z;
    [4.0 * xyz.x / sum, 6.0 * xyz.y / sum]
}

/// The 3x3 on XYZ that makes of colours under one light what corresponds to them under another, by Bradford's sharpened cones
/// (\[Lam1985\]); Y of the light itself stays.
///
/// Of the transforms tried it comes nearest to what patches really look like under the other light: for the ColorChecker under a
/// 3200 K black body brought to 6500 K, CIEDE2000 from the same reflectances under 6500 K is 1.7 in the mean and 3.8 at most, by CAT16 2.6 and 5.1, by
/// von Kries 3.3 and 7.2; the order is the same from 2000 K to 10000 K.
///
/// ```
/// use onelight_spectra::{Chromaticity, chromatic_adaptation};
/// let warm = chromatic_adaptation(Chromaticity::D65, Chromaticity::D50)?;
/// let white = Chromaticity::of(&(warm * Chromaticity::D65.xyz()));
/// assert!((white.x - Chromaticity::D50.x).abs() < 1e-12);
/// # Ok::<(), onelight_spectra::Error>(())
/// ```
///
/// # Errors
/// If a light is none that cones can adapt to: y of 0, or a response that is not above 0.
pub fn chromatic_adaptation(from: Chromaticity, to: Chromaticity) -> Result<Matrix3<f64>, Error> {
    for light in [from, to] {
        if !(bradford() * light.xyz()).iter().all(|response| response.is_finite() && *response > 0.0) {
            return Err(ErrorKind::Chromaticity { what: "light to adapt to", x: light.x, y: light.y }.into());
        }
    }
    Ok(adaptation(from, to))
}

fn adaptation(from: Chromaticity, to: Chromaticity) -> Matrix3<f64> {
    if from == to {
        return Matrix3::identity();
    }
    let cones = bradford();
    let gains = (cones * to.xyz()).component_div(&(cones * from.xyz()));
    // Cones respond to all lights of the ranges above; their matrix has an inverse.
    let back = cones.try_inverse().unwrap_or_else(Matrix3::identity);
    back * Matrix3::from_diagonal(&gains) * cones
}

/// From XYZ to Bradford's sharpened cones.
fn bradford() -> Matrix3<f64> {
    Matrix3::from_rows(&[
        Vector3::new(0.8951, 0.2664, -0.1614).transpose(),
        Vector3::new(-0.7502, 1.7135, 0.0367).transpose(),
        Vector3::new(0.0389, -0.0685, 1.0296).transpose(),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// [ICC1], annex E: from D65 to D50, four digits.
    #[test]
    #[rustfmt::skip]
    fn the_matrix_is_the_published_one() {
        let published = Matrix3::new(
            1.0479, 0.0229, -0.0502,
            0.0296, 0.9904, -0.0171,
            -0.0092, 0.0151, 0.7519,
        );
        let found = chromatic_adaptation(Chromaticity::new(0.31271, 0.32902), Chromaticity::new(0.34567, 0.35850)).unwrap();
        assert_relative_eq!(found, published, epsilon = 2e-4);
    }

    #[test]
    fn white_becomes_white_and_keeps_its_luminance() {
        for kelvin in [1667.0, 2000.0, 3200.0, 5003.0, 6500.0, 9000.0, 25_000.0] {
            for tint in [-100.0, -30.0, 0.0, 10.0, 100.0] {
                let Ok(white) = SceneWhite::new(kelvin, tint) else {
                    assert!(kelvin < 4000.0 && tint > 50.0, "{kelvin} {tint}");
                    continue;
                };
                let adapted = white.to_model_white() * white.chromaticity().xyz();
                assert_relative_eq!(adapted, Chromaticity::black_body_6500_k().xyz(), epsilon = 1e-12);
            }
        }
        assert_eq!(SceneWhite::new(6500.0, 0.0).unwrap().to_model_white(), Matrix3::identity());
    }

    /// Illuminants of the CIE: A is a black body of 2856 K, daylight is greener than black bodies.
    #[test]
    fn known_lights() {
        for (kelvin, tint, x, y) in [
            (2855.5, 0.0, 0.447_58, 0.407_45),
            (5003.0, 9.4, 0.345_67, 0.358_50),
            (5503.0, 9.7, 0.332_43, 0.347_44),
            (6504.0, 9.6, 0.312_72, 0.329_03),
        ] {
            let found = SceneWhite::new(kelvin, tint).unwrap().chromaticity();
            assert!((found.x - x).abs() < 3e-4 && (found.y - y).abs() < 3e-4, "{kelvin} {tint}: {found:?}");
        }
    }

    #[test]
    fn lights_out_of_range_are_named() {
        for (kelvin, tint) in
            [(1000.0, 0.0), (3e4, 0.0), (5000.0, 150.0), (f64::NAN, 0.0), (5000.0, f64::NAN), (1667.0, 100.0)]
        {
            let sentence = SceneWhite::new(kelvin, tint).unwrap_err().to_string();
            assert!(sentence.contains("1667 to 25000 K"), "{sentence}");
        }
        assert!(chromatic_adaptation(Chromaticity::D65, Chromaticity::new(0.3, 0.0)).is_err());
    }
}
