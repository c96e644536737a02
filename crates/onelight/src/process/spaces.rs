use nalgebra::Vector3;
use onelight_spectra::{Chromaticity, DisplayDifference, RgbSpace, TransferCurve};

use crate::error::Error;
use crate::word::WorkingSpace;

/// The RGB that comes in and the RGB that goes out, the same for every kind of process.
///
/// ```
/// use onelight::{ColourSpaces, FilmProcess, WorkingSpace};
/// let spaces = ColourSpaces { input_space: WorkingSpace::AcesCg, ..Default::default() };
/// let film = FilmProcess { spaces, ..Default::default() }.compile()?;
/// assert_eq!(film.spaces().input_space, WorkingSpace::AcesCg);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct ColourSpaces {
    /// Primaries of the scene-linear RGB that comes in.
    pub input_space: WorkingSpace,
    /// Primaries of the display RGB that goes out.
    pub output_space: WorkingSpace,
    /// Transfer curve of the display RGB that goes out.
    pub output_coding: TransferCurve,
}

impl ColourSpaces {
    /// CIEDE2000 between display-linear colours of the output.
    pub(crate) fn difference(&self) -> Result<DisplayDifference, Error> {
        Ok(DisplayDifference::new(&self.output_space.space())?)
    }

    /// Weights of the output's red, green and blue light in its luminance, by the white of the output's standard.
    pub(crate) fn luminance(&self) -> Result<Vector3<f64>, Error> {
        Ok(self.output_space.space().to_xyz()?.row(1).transpose())
    }

    /// The output's primaries about the white of the scene.
    pub(crate) fn output_about_scene_white(&self) -> RgbSpace {
        self.output_space.space().with_white(Chromaticity::black_body_6500_k())
    }
}
