//! What a look is made of, and its description as text.

mod films;
mod toml_text;

use onelight_film::{DyeModel, Matching, PerLayer, StockKind, Tail};
use onelight_printing::{
    Aim, Calibration, Filters, HeatGlass, Infrared, NEUTRAL_DENSITY, Printer, PrinterLight, Projector,
};
use onelight_spectra::{Reconstruction, TransferCurve};
use serde::{Deserialize, Serialize};

pub(crate) use films::{Films, useful};
pub use toml_text::FormatVersion;

use crate::approach::{Approach, FirstControls, Look, no_film};
use crate::error::{Error, Kind};
use crate::reference::Reference;
use crate::stocks::{cut, stock};
use crate::word::{self, Word as _, WorkingSpace};

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
    /// The simulation, the talk's first approach, or a tone mapping to compare with.
    #[serde(with = "word::text")]
    pub approach: Approach,
    /// Id of the film in the camera: a negative or a reversal film.
    pub camera: String,
    /// Id of the film that a negative is printed on; `None` (`"none"` in text) for reversal film.
    #[serde(with = "toml_text::print")]
    pub print: Option<String>,
    /// What an 18 % grey card becomes.
    #[serde(with = "word::text")]
    pub aim: Aim,
    /// Equivalent neutral density of a grey card in neutral aim, 0.05 to 3. 0.3 more is a stop darker.
    pub neutral_density: f64,
    /// Stops that the camera film is exposed over its normal exposure, -10 to 10. The printer is set for the grey card so
    /// exposed, as a lab does: grey stays, shadows and highlights move along the film's curves (5207 on 2383 dE 3.6 in the
    /// mean for -3, 0.2 for +1, 0.7 for +3). Reversal film has no print to correct it: the picture is brighter.
    pub overexposure: f64,
    /// How densities become amounts of dye.
    #[serde(with = "word::text")]
    pub dyes: DyeModel,
    /// How exposures meet the characteristic curves.
    #[serde(with = "word::text")]
    pub matching: Matching,
    /// How a spectrum is made for an RGB value.
    #[serde(with = "word::text")]
    pub reconstruction: Reconstruction,
    /// Three separated beams in the printer, or a white one.
    #[serde(with = "word::text")]
    pub light: PrinterLight,
    /// The gelatin filters in the printer.
    #[serde(with = "toml_text::filters")]
    pub filters: Filters,
    /// Neutral density in the printer's red, green and blue beam, 0 to 4.
    pub beam_density: [f64; 3],
    /// How the printer's lights are found: `"exact"`, or the talk's iterations (`"0"` to `"30"`).
    #[serde(with = "toml_text::calibration")]
    pub calibration: Calibration,
    /// Printer points by which red, green and blue light are moved once they are found, -50 to 50
    /// ([`onelight_printing::POINT_LOG_EXPOSURE`] each): the lab's colour correction. One point of all three on 2383 is dE 1.9
    /// in the mean.
    pub points: [f64; 3],
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
    /// What a hand changes in the first approach.
    pub first: FirstControls,
}

impl Default for Process {
    fn default() -> Self {
        Self {
            version: FormatVersion,
            approach: Approach::default(),
            camera: DEFAULT_CAMERA.to_owned(),
            print: Some(DEFAULT_PRINT.to_owned()),
            aim: Aim::default(),
            neutral_density: NEUTRAL_DENSITY,
            overexposure: 0.0,
            dyes: DyeModel::default(),
            matching: Matching::default(),
            reconstruction: Reconstruction::default(),
            light: PrinterLight::default(),
            filters: Filters::default(),
            beam_density: Printer::default().beam_density.to_array(),
            calibration: Calibration::default(),
            points: [0.0; 3],
            infrared: Infrared::default(),
            glass: HeatGlass::default(),
            red_tail: Tail::default(),
            projector: Projector::default(),
            input_space: WorkingSpace::default(),
            output_space: WorkingSpace::default(),
            output_coding: TransferCurve::default(),
            first: FirstControls::default(),
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

    /// What `calibration` is for a word: `exact`, or a number of iterations.
    ///
    /// # Errors
    /// If it is neither.
    pub fn parse_calibration(word: &str) -> Result<Calibration, Error> {
        let count = || word.parse().ok().filter(|count| *count <= 30).map(Calibration::Iterations);
        let found = if word == "exact" { Some(Calibration::Exact) } else { count() };
        found.ok_or_else(|| {
            let expected = "exact, or 0 to 30 iterations".to_owned();
            Kind::Word { what: "calibration", found: cut(word), expected }.into()
        })
    }

    /// A short name made of the ids: `kodak-5207_kodak-2383`, `fuji-velvia-50`, `kodak-5207_kodak-2383_first`, `reinhard`.
    #[must_use]
    pub fn name(&self) -> String {
        let films = match &self.print {
            Some(print) => format!("{}_{print}", self.camera),
            None => self.camera.clone(),
        };
        match self.approach {
            Approach::Second => films,
            Approach::First => format!("{films}_first"),
            Approach::Reinhard | Approach::ReinhardLuminance | Approach::Clip => self.approach.word().to_owned(),
        }
    }

    /// The printer's settings by themselves.
    #[must_use]
    pub fn printer(&self) -> Printer {
        Printer {
            light: self.light,
            filters: self.filters,
            beam_density: PerLayer::from(self.beam_density),
            infrared: self.infrared,
            glass: self.glass,
            red_tail: self.red_tail,
        }
    }

    /// The exact simulation: float64 at 1 nm.
    ///
    /// # Errors
    /// If a stock is unknown, the parts contradict each other, a sheet lacks what is asked of it, the aim cannot be reached, or
    /// the approach is not the second ([`Process::look`] takes any).
    pub fn compile(&self) -> Result<Reference, Error> {
        match self.approach {
            Approach::Second => Reference::new(self),
            other => Err(no_film(other.word())),
        }
    }

    /// The process at work, whatever its approach.
    ///
    /// # Errors
    /// As [`Process::compile`], but for the approach.
    pub fn look(&self) -> Result<Look, Error> {
        Look::new(self)
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
