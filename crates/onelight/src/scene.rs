use nalgebra::{Matrix3, Vector3};
use onelight_spectra::RgbSpace;
pub use onelight_spectra::SCENE_MAX;
pub(crate) use onelight_spectra::{MID_GREY, finite};

use crate::error::{Error, ErrorKind};
use crate::process::ColourSpaces;

/// Scene light on its way to a film: from the input's primaries to sRGB's, exposed and balanced, hard values cleaned.
#[derive(Debug, Clone)]
pub(crate) struct SceneInput {
    to_srgb: Matrix3<f64>,
    from_srgb: Matrix3<f64>,
}

impl SceneInput {
    pub(crate) fn new(spaces: &ColourSpaces) -> Result<Self, Error> {
        spaces.check()?;
        let to_srgb = spaces.scene_to(&RgbSpace::SRGB)?;
        let input = spaces.input_space;
        let flat =
            || ErrorKind::Contradiction(format!("the primaries of {input:?} are on one line, expected three colours"));
        let from_srgb = to_srgb.try_inverse().ok_or_else(flat)?;
        Ok(Self { to_srgb, from_srgb })
    }

    /// sRGB primaries, within ±[`SCENE_MAX`]: NaN counts as 0.
    pub(crate) fn light(&self, rgb: [f64; 3]) -> [f64; 3] {
        let srgb = self.to_srgb * Vector3::from(rgb.map(finite));
        [srgb.x, srgb.y, srgb.z].map(|v| v.clamp(-SCENE_MAX, SCENE_MAX))
    }

    /// [`SceneInput::light`] with what is negative as 0.
    pub(crate) fn clean(&self, rgb: [f64; 3]) -> [f64; 3] {
        self.light(rgb).map(|v| v.max(0.0))
    }

    pub(crate) fn to_srgb(&self) -> &Matrix3<f64> {
        &self.to_srgb
    }

    /// The input's primaries of a colour in sRGB's.
    pub(crate) fn input_of_srgb(&self, rgb: [f64; 3]) -> [f64; 3] {
        multiply(&self.from_srgb, rgb)
    }
}

/// A matrix times a colour.
pub(crate) fn multiply(matrix: &Matrix3<f64>, rgb: [f64; 3]) -> [f64; 3] {
    (matrix * Vector3::from(rgb)).into()
}
