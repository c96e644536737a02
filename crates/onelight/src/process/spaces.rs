use nalgebra::{Matrix3, Vector3};
use onelight_spectra::{Chromaticity, DisplayDifference, RgbSpace, SceneWhite, TransferCurve};

use crate::error::Error;
use crate::word::WorkingSpace;

/// The RGB that comes in, the light it is of, and the RGB that goes out, the same for every kind of process.
///
/// ```
/// use onelight::{ColourSpaces, FilmProcess, WorkingSpace};
/// let spaces = ColourSpaces { input_space: WorkingSpace::AcesCg, ..Default::default() };
/// let film = FilmProcess { spaces, ..Default::default() }.compile()?;
/// assert_eq!(film.spaces().input_space, WorkingSpace::AcesCg);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ColourSpaces {
    /// Stops by which the scene is made brighter before everything else, -20 to 20.
    pub ev: f64,
    /// The light that is to become neutral, as by a filter on the lens or a camera's white balance; `None` leaves (1, 1, 1) white.
    ///
    /// ```
    /// use onelight::{ColourSpaces, FilmProcess};
    /// use onelight::spectra::SceneWhite;
    /// let spaces = ColourSpaces { scene_white: Some(SceneWhite::new(3200.0, 0.0)?), ..Default::default() };
    /// let film = FilmProcess { spaces, ..Default::default() }.compile()?;
    /// // A grey card under tungsten light.
    /// let card = spaces.white_rgb()?.map(|v| 0.18 * v);
    /// let shown = film.develop(card);
    /// assert!(card[0] > 2.0 * card[2] && (shown[0] - shown[2]).abs() < 1e-9);
    /// # Ok::<(), onelight::Error>(())
    /// ```
    pub scene_white: Option<SceneWhite>,
    /// Primaries of the scene-linear RGB that comes in.
    pub input_space: WorkingSpace,
    /// Primaries of the display RGB that goes out.
    pub output_space: WorkingSpace,
    /// Transfer curve of the display RGB that goes out.
    pub output_coding: TransferCurve,
}

impl ColourSpaces {
    /// Scene-linear RGB of the input space that becomes (1, 1, 1) before the film but for [`ColourSpaces::ev`]: light of
    /// [`ColourSpaces::scene_white`] with luminance 1.
    ///
    /// # Errors
    /// None for the built-in spaces.
    pub fn white_rgb(&self) -> Result<[f64; 3], Error> {
        let white = Chromaticity::black_body_6500_k();
        let light = self.scene_white.map_or(white, |white| white.chromaticity());
        let own = self.input_space.space().with_white(white);
        Ok(if light == white { [1.0; 3] } else { (own.from_xyz()? * light.xyz()).into() })
    }

    /// From scene-linear RGB of the input space to `target` about the white of the model, exposed and balanced.
    pub(crate) fn scene_to(&self, target: &RgbSpace) -> Result<Matrix3<f64>, Error> {
        let (white, own) = (Chromaticity::black_body_6500_k(), self.input_space.space());
        let matrix = match self.scene_white {
            None => own.to_about(target, white)?,
            Some(light) => {
                target.with_white(white).from_xyz()? * light.to_model_white() * own.with_white(white).to_xyz()?
            }
        };
        Ok(matrix * self.ev.exp2())
    }

    /// Whether the exposure is within its range.
    pub(crate) fn check(&self) -> Result<(), Error> {
        if (-20.0..=20.0).contains(&self.ev) { Ok(()) } else { Err(Error::setting("ev", self.ev, -20.0, 20.0)) }
    }

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
