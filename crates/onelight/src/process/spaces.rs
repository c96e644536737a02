use nalgebra::{Matrix3, Vector3};
use onelight_spectra::{
    Chromaticity, DisplayCoding, DisplayDifference, HDR_WHITE_CD_M2, RgbSpace, SceneWhite, TransferCurve,
};

use crate::error::{Error, ErrorKind};
use crate::word::{Word as _, WorkingSpace};

/// The RGB that comes in, the light it is of, and the RGB that goes out, the same for every kind of process.
///
/// ```
/// use onelight::{ColourSpaces, FilmProcess, WorkingSpace};
/// let spaces = ColourSpaces { input_space: WorkingSpace::AcesCg, ..Default::default() };
/// let film = FilmProcess { spaces, ..Default::default() }.compile()?;
/// assert_eq!(film.spaces().input_space, WorkingSpace::AcesCg);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
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
    /// Luminance of the display's (1, 1, 1) in cd/m^2, which PQ (1 to 10000) and HLG (1 to 1000) ask for; with [`White::Film`] it is that of
    /// clear film.
    ///
    /// [`White::Film`]: crate::White::Film
    pub white_luminance: f64,
}

impl Default for ColourSpaces {
    fn default() -> Self {
        Self {
            ev: 0.0,
            scene_white: None,
            input_space: WorkingSpace::default(),
            output_space: WorkingSpace::default(),
            output_coding: TransferCurve::default(),
            white_luminance: HDR_WHITE_CD_M2,
        }
    }
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

    /// How the output is coded.
    #[must_use]
    pub fn display_coding(&self) -> DisplayCoding {
        let usual = DisplayCoding::default();
        // The built-in spaces have a luminance.
        let luminance = self.luminance().map_or(usual.luminance, Into::into);
        DisplayCoding { curve: self.output_coding, white_cd_m2: self.white_luminance, luminance }
    }

    /// Whether exposure and white are within their ranges, and the primaries are among those of the coding.
    pub(crate) fn check(&self) -> Result<(), Error> {
        if !(-20.0..=20.0).contains(&self.ev) {
            return Err(Error::setting("ev", self.ev, -20.0, 20.0));
        }
        let (curve, space, white) = (self.output_coding.word(), self.output_space, self.white_luminance);
        let refuse = |sentence: String| Err(ErrorKind::Contradiction(sentence).into());
        let most = match self.output_coding {
            TransferCurve::Pq => 10_000.0,
            TransferCurve::Hlg => 1000.0,
            _ if white != HDR_WHITE_CD_M2 => {
                return refuse(format!(
                    "output_coding {curve} is relative to white: white_luminance changes nothing, expected output_coding pq or hlg"
                ));
            }
            _ => return Ok(()),
        };
        if !(1.0..=most).contains(&white) {
            return Err(Error::setting("white_luminance", white, 1.0, most));
        }
        if matches!(space, WorkingSpace::Rec2020 | WorkingSpace::P3) {
            return Ok(());
        }
        refuse(format!(
            "output_coding {curve} is of a wide display, expected output_space rec2020 or p3 instead of {}",
            space.word()
        ))
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
