use nalgebra::{Matrix3, Matrix3x4, Vector3, Vector4};
use onelight_printing::NEUTRAL_DENSITY;
use onelight_spectra::{Kelvin, TransferCurve, lamp_rgb_w_per_m2};

use crate::error::Error;
use crate::process::FirstControls;

/// The post-colour controls as one matrix on display-coded RGB and 1: colour temperature, then saturation, contrast,
/// brightness (\[Gotanda2010\], first approach).
///
/// ```
/// use onelight::{FirstControls, PostColour};
/// let grey = PostColour::new(&FirstControls { saturation: 0.0, ..Default::default() })?.apply([0.7, 0.5, 0.2]);
/// assert!((grey[0] - grey[2]).abs() < 1e-12);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PostColour(Matrix3x4<f64>);

/// Luma of the display's coded values (\[IEC61966-2-1\] primaries).
const LUMA: [f64; 3] = [0.2126, 0.7152, 0.0722];
/// From a factor of light to one of code, about.
const DISPLAY_GAMMA: f64 = 2.2;

impl PostColour {
    /// The controls as a matrix.
    ///
    /// # Errors
    /// If a control is out of its range.
    pub fn new(controls: &FirstControls) -> Result<Self, Error> {
        let within = |what, found: f64, low: f64, high: f64| {
            if (low..=high).contains(&found) { Ok(found) } else { Err(Error::setting(what, found, low, high)) }
        };
        let contrast = within("first.contrast", controls.contrast, 0.0, 4.0)?;
        let brightness = within("first.brightness", controls.brightness, -1.0, 1.0)?;
        let temperature = within("first.temperature", controls.temperature, 2000.0, 20_000.0)?;
        let saturation = within("first.saturation", controls.saturation, 0.0, 4.0)?;
        let lamp = |kelvin: Kelvin| lamp_rgb_w_per_m2(kelvin, 1.0).map(Vector3::from);
        let gain = lamp(Kelvin::new(temperature)?)?.component_div(&lamp(Kelvin::WHITE)?);
        let gain = gain.map(|v| v.max(0.0).powf(1.0 / DISPLAY_GAMMA));
        let grey = Matrix3::from_fn(|_, k| LUMA[k]);
        let matrix = contrast * (Matrix3::identity() * saturation + grey * (1.0 - saturation));
        let matrix = matrix * Matrix3::from_diagonal(&gain);
        let pivot = TransferCurve::Srgb.encode(10f64.powf(-NEUTRAL_DENSITY));
        let offset = Vector3::repeat(pivot * (1.0 - contrast) + brightness);
        Ok(Self(Matrix3x4::from_columns(&[matrix.column(0), matrix.column(1), matrix.column(2), offset.column(0)])))
    }

    /// Display-coded RGB, changed; not clipped.
    #[must_use]
    pub fn apply(&self, coded: [f64; 3]) -> [f64; 3] {
        (self.0 * Vector4::new(coded[0], coded[1], coded[2], 1.0)).into()
    }

    /// The matrix; its last column is added.
    #[must_use]
    pub fn matrix(&self) -> &Matrix3x4<f64> {
        &self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(change: impl FnOnce(&mut FirstControls)) -> PostColour {
        let mut controls = FirstControls::default();
        change(&mut controls);
        PostColour::new(&controls).unwrap()
    }

    const COLOUR: [f64; 3] = [0.7, 0.5, 0.2];

    #[test]
    fn each_control_does_what_its_name_says() {
        let same = with(|_| {}).apply(COLOUR);
        assert!(same.iter().zip(COLOUR).all(|(a, b)| (a - b).abs() < 1e-12), "{same:?}");
        let luma = |rgb: [f64; 3]| rgb.iter().zip(LUMA).map(|(v, w)| v * w).sum::<f64>();
        let spread = |rgb: [f64; 3]| rgb[0] - rgb[2];
        let dull = with(|c| c.saturation = 0.5).apply(COLOUR);
        assert!((luma(dull) - luma(COLOUR)).abs() < 1e-12 && (spread(dull) - 0.25).abs() < 1e-12);
        let grey = with(|c| c.saturation = 0.0).apply(COLOUR);
        assert!(spread(grey).abs() < 1e-12);
        let pivot = TransferCurve::Srgb.encode(10f64.powf(-0.7));
        let hard = with(|c| c.contrast = 2.0);
        assert!((hard.apply([pivot; 3])[0] - pivot).abs() < 1e-12 && hard.apply([0.9; 3])[0] > 0.9);
        assert!((with(|c| c.brightness = 0.1).apply(COLOUR)[1] - 0.6).abs() < 1e-12);
        let warm = with(|c| c.temperature = 3200.0).apply([0.5; 3]);
        assert!(warm[0] > warm[1] && warm[1] > warm[2] && warm[2] > 0.0, "{warm:?}");
        let cold = with(|c| c.temperature = 12_000.0).apply([0.5; 3]);
        assert!(cold[0] < cold[2], "{cold:?}");
    }

    #[test]
    fn numbers_out_of_range_are_named() {
        let message = |change: fn(&mut FirstControls)| {
            let mut controls = FirstControls::default();
            change(&mut controls);
            PostColour::new(&controls).unwrap_err().to_string()
        };
        assert_eq!(message(|c| c.contrast = 9.0), "first.contrast: found 9, expected 0 to 4");
        assert_eq!(message(|c| c.brightness = f64::NAN), "first.brightness: found NaN, expected -1 to 1");
        assert_eq!(message(|c| c.temperature = 100.0), "first.temperature: found 100, expected 2000 to 20000");
        assert_eq!(message(|c| c.saturation = -1.0), "first.saturation: found -1, expected 0 to 4");
    }
}
