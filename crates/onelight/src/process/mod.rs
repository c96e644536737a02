//! Descriptions of looks: one struct for each kind, none with a field that means nothing to it.

mod approach;
mod effects;
mod film;
mod first;
mod print_alone;
mod spaces;
mod stock_ref;
mod tone;

use onelight_printing::Aim;

pub use approach::Approach;
pub use effects::{EffectChoice, Effects};
pub use film::{FilmProcess, InterImageChoice, Printing};
pub(crate) use film::{check_exposure, check_lights};
pub use first::{FirstControls, FirstProcess};
pub use print_alone::PrintAlone;
pub use spaces::ColourSpaces;
pub use stock_ref::{DEFAULT_CAMERA, DEFAULT_PRINT, DEFAULT_SILVER_PRINT, OwnSheet, StockRef, usual_print};
pub(crate) use stock_ref::{NO_CAMERA, SCAN, default_print};
pub use tone::{ToneMapping, ToneProcess};

use crate::error::Error;
use crate::word::Word as _;

/// One look, described. [`Process::compile`] makes a film work, [`Process::look`] any of them.
///
/// ```
/// use onelight::{Aim, FilmProcess, Process};
/// let look = Process::from(FilmProcess { aim: Aim::Sheet, ..FilmProcess::for_camera("kodak-portra-400")? });
/// let saved = look.to_toml();
/// assert_eq!(Process::from_toml("look.toml", &saved)?, look);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Process {
    /// The simulation of film: spectrum, exposure, dye, print, projection.
    Film(FilmProcess),
    /// A print of a scanned negative: the simulation without a camera film.
    Print(PrintAlone),
    /// The talk's first approach: tone curves and matrices.
    First(FirstProcess),
    /// A tone mapping without film, to compare with.
    Tone(ToneProcess),
}

impl Default for Process {
    /// The simulation of [`DEFAULT_CAMERA`] printed on [`DEFAULT_PRINT`].
    fn default() -> Self {
        Self::Film(FilmProcess::default())
    }
}

impl From<FilmProcess> for Process {
    fn from(film: FilmProcess) -> Self {
        Self::Film(film)
    }
}

impl From<PrintAlone> for Process {
    fn from(print: PrintAlone) -> Self {
        Self::Print(print)
    }
}

impl From<FirstProcess> for Process {
    fn from(first: FirstProcess) -> Self {
        Self::First(first)
    }
}

impl From<ToneProcess> for Process {
    fn from(tone: ToneProcess) -> Self {
        Self::Tone(tone)
    }
}

impl Process {
    /// The usual process for a built-in camera film: negatives on [`DEFAULT_PRINT`], reversal film as it is.
    ///
    /// # Errors
    /// If no stock has this id, or it is a print film.
    pub fn for_camera(camera: &str) -> Result<Self, Error> {
        FilmProcess::for_camera(camera).map(Self::Film)
    }

    /// A short name made of the ids: `kodak-5207_kodak-2383`, `kodak-5207_scan`, `fuji-velvia-50`, `kodak-5207_kodak-2383_first`, `cineon_kodak-2383`,
    /// `reinhard`.
    #[must_use]
    pub fn name(&self) -> String {
        let films = |camera: &StockRef| match self.print() {
            Some(print) => format!("{camera}_{print}"),
            None if self.is_scanned() => format!("{camera}_{SCAN}"),
            None => camera.to_string(),
        };
        match self {
            Self::Film(film) => films(&film.camera),
            Self::Print(print) => format!("cineon_{}", print.film),
            Self::First(first) => format!("{}_first", films(&first.camera)),
            Self::Tone(tone) => tone.mapping.approach().word().to_owned(),
        }
    }

    /// The kind of process, as the key `approach` names it.
    #[must_use]
    pub fn approach(&self) -> Approach {
        match self {
            Self::Film(_) | Self::Print(_) => Approach::Second,
            Self::First(_) => Approach::First,
            Self::Tone(tone) => tone.mapping.approach(),
        }
    }

    /// The film in the camera; tone mappings and prints of scans have none.
    #[must_use]
    pub fn camera(&self) -> Option<&StockRef> {
        match self {
            Self::Film(film) => Some(&film.camera),
            Self::First(first) => Some(&first.camera),
            Self::Print(_) | Self::Tone(_) => None,
        }
    }

    /// Whether the negative is scanned and inverted, not printed.
    #[must_use]
    pub fn is_scanned(&self) -> bool {
        matches!(self, Self::Film(film) if film.scan.is_some())
    }

    /// The film that a negative is printed on.
    #[must_use]
    pub fn print(&self) -> Option<&StockRef> {
        match self {
            Self::Film(film) => film.print.as_ref().map(|print| &print.film),
            Self::Print(print) => Some(&print.film),
            Self::First(first) => first.print.as_ref(),
            Self::Tone(_) => None,
        }
    }

    /// What an 18 % grey card becomes; all but the simulation keep it neutral.
    #[must_use]
    pub fn aim(&self) -> Aim {
        match self {
            Self::Film(film) => film.aim,
            Self::Print(print) => print.aim,
            Self::First(_) | Self::Tone(_) => Aim::Neutral,
        }
    }

    /// The RGB that comes in and goes out.
    #[must_use]
    pub fn spaces(&self) -> &ColourSpaces {
        match self {
            Self::Film(film) => &film.spaces,
            Self::Print(print) => &print.spaces,
            Self::First(first) => &first.spaces,
            Self::Tone(tone) => &tone.spaces,
        }
    }

    /// The RGB that comes in and goes out, to change it.
    pub fn spaces_mut(&mut self) -> &mut ColourSpaces {
        match self {
            Self::Film(film) => &mut film.spaces,
            Self::Print(print) => &mut print.spaces,
            Self::First(first) => &mut first.spaces,
            Self::Tone(tone) => &mut tone.spaces,
        }
    }
}
