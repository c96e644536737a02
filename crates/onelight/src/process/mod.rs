//! What a look is made of, and its description as text.

mod toml_text;

use onelight_film::{DyeModel, Matching, StockKind, Tail};
use onelight_printing::{Aim, HeatGlass, Infrared, Printer, Projector};
use onelight_spectra::{Reconstruction, TransferCurve};
use serde::{Deserialize, Serialize};

pub use toml_text::FormatVersion;

use crate::error::{Error, Kind};
use crate::reference::Reference;
use crate::stocks::stock;
use crate::word::{self, WorkingSpace};

/// The camera film of a process that names none: what \[Gotanda2010\] calls K-negative.
pub const DEFAULT_CAMERA: &str = "kodak-5207";
/// The print film of a negative that names none.
pub const DEFAULT_PRINT: &str = "kodak-2383";

/// One look: films, lights, and the RGB spaces at both ends. A description; [`Process::compile`] makes it work.
///
/// ```
/// use onelight::{Aim, Process};
/// let look = Process { aim: Aim::Sheet, ..Process::for_camera("kodak-portra-400")? };
/// let saved = look.to_toml();
/// assert_eq!(Process::from_toml("look.toml", &saved)?, look);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Process {
    /// The version of this description's format.
    pub version: FormatVersion,
    /// Id of the film in the camera: a negative or a reversal film.
    pub camera: String,
    /// Id of the film that a negative is printed on; `None` (`"none"` in text) for reversal film.
    #[serde(with = "toml_text::print")]
    pub print: Option<String>,
    /// What an 18 % grey card becomes.
    #[serde(with = "word::text")]
    pub aim: Aim,
    /// How densities become amounts of dye.
    #[serde(with = "word::text")]
    pub dyes: DyeModel,
    /// How exposures meet the characteristic curves.
    #[serde(with = "word::text")]
    pub matching: Matching,
    /// How a spectrum is made for an RGB value.
    #[serde(with = "word::text")]
    pub reconstruction: Reconstruction,
    /// Whether infrared takes part in printing.
    #[serde(with = "word::text")]
    pub infrared: Infrared,
    /// The heat glass of the printer.
    #[serde(with = "word::text")]
    pub glass: HeatGlass,
    /// How the print's red layer goes on beyond its sheet.
    #[serde(with = "word::text")]
    pub red_tail: Tail,
    /// The light that the film is seen by.
    #[serde(with = "word::text")]
    pub projector: Projector,
    /// Primaries of the scene-linear RGB that comes in.
    #[serde(with = "word::text")]
    pub input_space: WorkingSpace,
    /// Primaries of the display RGB that goes out.
    #[serde(with = "word::text")]
    pub output_space: WorkingSpace,
    /// Transfer curve of the display RGB that goes out.
    #[serde(with = "word::text")]
    pub output_coding: TransferCurve,
}

impl Default for Process {
    fn default() -> Self {
        Self {
            version: FormatVersion,
            camera: DEFAULT_CAMERA.to_owned(),
            print: Some(DEFAULT_PRINT.to_owned()),
            aim: Aim::default(),
            dyes: DyeModel::default(),
            matching: Matching::default(),
            reconstruction: Reconstruction::default(),
            infrared: Infrared::default(),
            glass: HeatGlass::default(),
            red_tail: Tail::default(),
            projector: Projector::default(),
            input_space: WorkingSpace::default(),
            output_space: WorkingSpace::default(),
            output_coding: TransferCurve::default(),
        }
    }
}

impl Process {
    /// The usual process for a camera film: negatives on [`DEFAULT_PRINT`], reversal film as it is.
    ///
    /// # Errors
    /// If no stock has this id, or it is a print film.
    pub fn for_camera(camera: &str) -> Result<Self, Error> {
        let process = Self { camera: camera.to_owned(), ..Self::default() };
        Ok(Self { print: default_print(camera)?, ..process })
    }

    /// What `print` is for a word: the id of a film, or `None` for `none`.
    ///
    /// # Errors
    /// If the word is `none` in capitals.
    pub fn parse_print(word: &str) -> Result<Option<String>, Error> {
        match word {
            "none" => Ok(None),
            _ if word.eq_ignore_ascii_case("none") => {
                let expected = "the id of a print film, or none (did you mean \"none\"?)".to_owned();
                Err(Kind::Word { what: "print", found: word.to_owned(), expected }.into())
            }
            _ => Ok(Some(word.to_owned())),
        }
    }

    /// A short name made of the ids: `kodak-5207_kodak-2383`, `fuji-velvia-50`.
    #[must_use]
    pub fn name(&self) -> String {
        match &self.print {
            Some(print) => format!("{}_{print}", self.camera),
            None => self.camera.clone(),
        }
    }

    /// The printer's settings by themselves.
    #[must_use]
    pub fn printer(&self) -> Printer {
        Printer { infrared: self.infrared, glass: self.glass, red_tail: self.red_tail }
    }

    /// The exact simulation: float64 at 1 nm.
    ///
    /// # Errors
    /// If a stock is unknown, the parts contradict each other, a sheet lacks what is asked of it, or the aim cannot be
    /// reached.
    pub fn compile(&self) -> Result<Reference, Error> {
        Reference::new(self)
    }
}

/// The print film that goes with a camera film unless another is named.
fn default_print(camera: &str) -> Result<Option<String>, Error> {
    match stock(camera)?.kind() {
        StockKind::Negative => Ok(Some(DEFAULT_PRINT.to_owned())),
        StockKind::Reversal => Ok(None),
        StockKind::Print => Err(Error::print_film_in_camera(camera)),
    }
}
