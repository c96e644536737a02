use nalgebra::{Matrix3, Vector3};
pub use onelight_spectra::SCENE_MAX;
use onelight_spectra::{Chromaticity, RgbSpace, finite};

use crate::error::Error;
use crate::process::Process;

/// Scene light on its way to a film: from the input's primaries to sRGB's, hard values cleaned.
#[derive(Debug, Clone)]
pub(crate) struct SceneInput {
    to_srgb: Matrix3<f64>,
}

impl SceneInput {
    pub(crate) fn new(process: &Process) -> Result<Self, Error> {
        let white = Chromaticity::black_body_6500_k();
        Ok(Self { to_srgb: process.input_space.space().to_about(&RgbSpace::SRGB, white)? })
    }

    /// sRGB primaries, 0 to [`SCENE_MAX`]: NaN counts as 0.
    pub(crate) fn clean(&self, rgb: [f64; 3]) -> [f64; 3] {
        <[f64; 3]>::from(self.to_srgb * Vector3::from(rgb.map(finite))).map(|v| v.clamp(0.0, SCENE_MAX))
    }

    pub(crate) fn to_srgb(&self) -> &Matrix3<f64> {
        &self.to_srgb
    }
}
