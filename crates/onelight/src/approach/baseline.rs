use nalgebra::{Matrix3, Vector3};
use onelight_spectra::{Chromaticity, DisplayDifference, RgbSpace, TransferCurve, finite};

use super::Approach;
use crate::error::Error;
use crate::process::{Process, useful};
use crate::scene::SCENE_MAX;

/// Tone mapping without film: what the looks are compared with.
#[derive(Debug, Clone)]
pub struct Baseline {
    approach: Approach,
    to_output: Matrix3<f64>,
    luminance: Vector3<f64>,
    coding: TransferCurve,
    output: RgbSpace,
}

impl Baseline {
    pub(crate) fn new(process: &Process) -> Result<Self, Error> {
        useful(process)?;
        let white = Chromaticity::black_body_6500_k();
        let output = process.output_space.space();
        Ok(Self {
            approach: process.approach,
            to_output: process.input_space.space().to_about(&output, white)?,
            luminance: output.with_white(white).to_xyz()?.row(1).transpose(),
            coding: process.output_coding,
            output,
        })
    }

    /// Scene-linear RGB to display-linear RGB, 0 to 1 but for luminance tone mapping, which leaves saturated colours above 1.
    /// NaN counts as 0, each channel is held to ±[`SCENE_MAX`], and what is negative in the output's primaries counts as 0.
    #[must_use]
    pub fn develop_linear(&self, rgb: [f64; 3]) -> [f64; 3] {
        let light = (self.to_output * Vector3::from(rgb.map(finite))).map(|v| v.clamp(0.0, SCENE_MAX));
        match self.approach {
            Approach::Reinhard => light.map(reinhard),
            Approach::ReinhardLuminance => light / (1.0 + self.luminance.dot(&light)),
            Approach::Clip | Approach::First | Approach::Second => light.map(|v| v.min(1.0)),
        }
        .data
        .0[0]
    }

    /// Which it is.
    #[must_use]
    pub fn approach(&self) -> Approach {
        self.approach
    }

    pub(super) fn coding(&self) -> TransferCurve {
        self.coding
    }

    pub(super) fn difference(&self) -> Result<DisplayDifference, Error> {
        Ok(DisplayDifference::new(&self.output)?)
    }
}

fn reinhard(v: f64) -> f64 {
    v / (1.0 + v)
}
