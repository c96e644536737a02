use nalgebra::{Matrix3, Vector3};
use onelight_spectra::DisplayLinear;

use crate::about::About;
use crate::error::Error;
use crate::process::{Process, ToneMapping, ToneProcess};
use crate::scene::{SCENE_MAX, finite};

/// A tone mapping without film at work: what looks are compared with.
///
/// ```
/// use onelight::{Look, Process, ToneProcess};
/// let Look::Tone(reinhard) = Process::from(ToneProcess::default()).look()? else { return Ok(()) };
/// assert_eq!(reinhard.develop_linear([1.0, 0.0, 3.0]).map(|v| (v * 100.0).round()), [50.0, 0.0, 75.0]);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct ToneMapped {
    mapping: ToneMapping,
    to_output: Matrix3<f64>,
    luminance: Vector3<f64>,
    about: About,
}

impl ToneMapped {
    pub(crate) fn new(process: &ToneProcess) -> Result<Self, Error> {
        let spaces = &process.spaces;
        spaces.check()?;
        Ok(Self {
            mapping: process.mapping,
            to_output: spaces.scene_to(&spaces.output_space.space())?,
            luminance: spaces.output_about_scene_white().to_xyz()?.row(1).transpose(),
            about: About::new(&Process::Tone(*process)),
        })
    }

    /// Scene-linear RGB to display-linear RGB, 0 to 1 but for luminance tone mapping, which leaves saturated colours above 1.
    /// NaN counts as 0, each channel is held to ±[`SCENE_MAX`], and what is negative in the output's primaries counts as 0.
    #[must_use]
    pub fn develop_linear(&self, rgb: [f64; 3]) -> DisplayLinear {
        let light = (self.to_output * Vector3::from(rgb.map(finite))).map(|v| v.clamp(0.0, SCENE_MAX));
        let shown = match self.mapping {
            ToneMapping::Reinhard => light.map(reinhard),
            ToneMapping::ReinhardLuminance => light / (1.0 + self.luminance.dot(&light)),
            ToneMapping::Clip => light.map(|v| v.min(1.0)),
        };
        DisplayLinear(shown.into())
    }

    /// The tone mapping that this is.
    #[must_use]
    pub fn mapping(&self) -> ToneMapping {
        self.mapping
    }

    pub(super) fn about(&self) -> &About {
        &self.about
    }
}

fn reinhard(v: f64) -> f64 {
    v / (1.0 + v)
}
