use nalgebra::{Matrix3, Vector3};
use palette::color_difference::Ciede2000;
use palette::{Lab, white_point::D65};

use crate::display_linear::DisplayLinear;
use crate::error::Error;
use crate::rgb::RgbSpace;

/// Colour difference between two pictures on one display: linear RGB clipped to [0, 1], CIELAB under the display's own
/// white, CIEDE2000 (\[CIE142\]).
///
/// ```
/// use onelight_spectra::{DisplayDifference, DisplayLinear, RgbSpace};
/// let difference = DisplayDifference::new(&RgbSpace::SRGB)?;
/// let grey = |value| DisplayLinear([value; 3]);
/// assert_eq!(difference.between(grey(0.2), grey(0.2)), 0.0);
/// assert_eq!(difference.between(grey(7.0), grey(1.0)), 0.0, "both clip to white");
/// # Ok::<(), onelight_spectra::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct DisplayDifference {
    /// Linear RGB to XYZ, each row divided by the white.
    relative: Matrix3<f64>,
}

impl DisplayDifference {
    /// For a display with these primaries and white.
    ///
    /// # Errors
    /// If the space is not one ([`RgbSpace::to_xyz`]).
    pub fn new(display: &RgbSpace) -> Result<Self, Error> {
        let to_xyz = display.to_xyz()?;
        let white = to_xyz * Vector3::repeat(1.0);
        Ok(Self { relative: Matrix3::from_diagonal(&white.map(|w| 1.0 / w)) * to_xyz })
    }

    /// CIELAB of a display-linear RGB, clipped to [0, 1]; NaN counts as 0.
    #[must_use]
    pub fn lab(&self, rgb: DisplayLinear) -> [f64; 3] {
        let clipped = rgb.map(|v| if v.is_nan() { 0.0 } else { v.clamp(0.0, 1.0) });
        let xyz = self.relative * Vector3::from(clipped);
        let [fx, fy, fz] = [lab_root(xyz.x), lab_root(xyz.y), lab_root(xyz.z)];
        [116.0 * fy - 16.0, 500.0 * (fx - fy), 200.0 * (fy - fz)]
    }

    /// CIEDE2000 between two display-linear colours; [`TransferCurve::decode_rgb`](crate::TransferCurve::decode_rgb) makes one of
    /// coded RGB.
    #[must_use]
    pub fn between(&self, a: DisplayLinear, b: DisplayLinear) -> f64 {
        ciede2000(self.lab(a), self.lab(b))
    }
}

/// CIEDE2000 between two CIELAB colours under one white, all weights 1 (\[CIE142\], \[Sharma2005\]). 1 is about what an eye just sees side by side.
///
/// ```
/// let difference = onelight_spectra::ciede2000([50.0, 2.5, 0.0], [73.0, 25.0, -18.0]);
/// assert!((difference - 27.1492).abs() < 5e-5, "a pair of [Sharma2005]: {difference}");
/// ```
#[must_use]
pub fn ciede2000(a: [f64; 3], b: [f64; 3]) -> f64 {
    let lab = |[l, a, b]: [f64; 3]| Lab::<D65, f64>::new(l, a, b);
    lab(a).difference(lab(b))
}

/// The root of CIELAB with its straight foot (\[CIE015\]).
fn lab_root(t: f64) -> f64 {
    const FOOT: f64 = 6.0 / 29.0;
    if t > FOOT * FOOT * FOOT { t.cbrt() } else { t / (3.0 * FOOT * FOOT) + 4.0 / 29.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn sharmas_hard_pairs() {
        // [Sharma2005], table 1: hue wrap-around, the neutral axis, large and tiny differences.
        let pairs = [
            ([50.0, 2.6772, -79.7751], [50.0, 0.0, -82.7485], 2.0425),
            ([50.0, 3.1571, -77.2803], [50.0, 0.0, -82.7485], 2.8615),
            ([50.0, 0.0, 0.0], [50.0, -1.0, 2.0], 2.3669),
            ([50.0, 2.49, -0.001], [50.0, -2.49, 0.0009], 7.1792),
            ([50.0, 2.49, -0.001], [50.0, -2.49, 0.0011], 7.2195),
            ([50.0, -0.001, 2.49], [50.0, 0.0009, -2.49], 4.8045),
            ([50.0, -0.001, 2.49], [50.0, 0.0011, -2.49], 4.7461),
            ([50.0, 2.5, 0.0], [73.0, 25.0, -18.0], 27.1492),
            ([50.0, 2.5, 0.0], [58.0, 24.0, 15.0], 19.4535),
            ([60.2574, -34.0099, 36.2677], [60.4626, -34.1751, 39.4387], 1.2644),
            ([22.7233, 20.0904, -46.694], [23.0331, 14.973, -42.5619], 2.0373),
            ([2.0776, 0.0795, -1.135], [0.9033, -0.0636, -0.5514], 0.9082),
        ];
        for (a, b, published) in pairs {
            assert_relative_eq!(ciede2000(a, b), published, epsilon = 5.1e-5);
            assert_relative_eq!(ciede2000(b, a), published, epsilon = 5.1e-5);
        }
    }

    #[test]
    fn greys_have_no_chroma_and_hard_values_clip() {
        let difference = DisplayDifference::new(&RgbSpace::DISPLAY_P3).unwrap();
        for grey in [0.0, 1e-4, 0.18, 1.0] {
            let [_, a, b] = difference.lab(DisplayLinear([grey; 3]));
            assert!(a.abs() < 1e-10 && b.abs() < 1e-10);
        }
        let lab = |rgb| difference.lab(DisplayLinear(rgb));
        assert_eq!(lab([f64::NAN, -1.0, 0.0]), lab([0.0; 3]));
        assert_eq!(lab([f64::INFINITY; 3]), lab([1.0; 3]));
    }
}
