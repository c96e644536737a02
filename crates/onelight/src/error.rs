use std::fmt;

use onelight_film::StockKind;

/// Most names that a message lists.
const NAMES_LISTED: usize = 8;

/// What went wrong: one sentence that says what, where, what was found and what was expected.
///
/// ```
/// let error = onelight::Process::for_camera("kodak-5270").unwrap_err();
/// assert!(error.is_unknown_stock() && error.to_string().contains("the nearest is kodak-5"));
/// ```
#[derive(Debug)]
pub struct Error(ErrorKind);

#[derive(Debug)]
pub(crate) enum ErrorKind {
    Spectra(onelight_spectra::Error),
    Film(onelight_film::Error),
    Printing(onelight_printing::Error),
    Spatial(onelight_spatial::Error),
    Lut(onelight_lut::Error),
    #[cfg(feature = "formats")]
    Formats(onelight_formats::Error),
    Look {
        file: String,
        line: usize,
        problem: String,
    },
    Word {
        what: &'static str,
        found: String,
        expected: String,
    },
    Unreachable(String),
    Setting {
        what: String,
        found: f64,
        expected: String,
    },
    UnknownStock {
        found: String,
        nearest: Option<&'static str>,
    },
    SeveralStocks {
        found: String,
        fits: Vec<String>,
    },
    Contradiction(String),
}

impl Error {
    /// Whether no stock has the id that was asked for; the message names the nearest if there is a near one, and all that a part of a
    /// name fits.
    #[must_use]
    pub fn is_unknown_stock(&self) -> bool {
        matches!(self.0, ErrorKind::UnknownStock { .. } | ErrorKind::SeveralStocks { .. })
    }

    /// Whether the film cannot be brought to its aim.
    #[must_use]
    pub fn is_unreachable_aim(&self) -> bool {
        matches!(&self.0, ErrorKind::Unreachable(_))
            || matches!(&self.0, ErrorKind::Printing(error) if error.is_unreachable_aim())
    }

    /// Whether the parts of the process contradict each other, as a print for a reversal film does.
    #[must_use]
    pub fn is_contradiction(&self) -> bool {
        matches!(&self.0, ErrorKind::Contradiction(_))
            || matches!(&self.0, ErrorKind::Printing(error) if error.is_wrong_kind())
    }

    /// Whether a number lay outside its range.
    #[must_use]
    pub fn is_setting(&self) -> bool {
        matches!(self.0, ErrorKind::Setting { .. })
    }

    /// Whether a film's sheet does not have what was asked for: modulation transfer for sharpness, granularity for grain.
    #[must_use]
    pub fn is_not_published(&self) -> bool {
        match &self.0 {
            ErrorKind::Film(error) => error.is_not_published(),
            ErrorKind::Spatial(error) => error.is_not_published(),
            _ => false,
        }
    }

    pub(crate) fn setting(what: &str, found: f64, low: f64, high: f64) -> Self {
        ErrorKind::Setting { what: what.to_owned(), found, expected: format!("{low} to {high}") }.into()
    }

    /// Something to print on where a camera film belongs.
    pub(crate) fn not_for_a_camera(id: &str, kind: StockKind) -> Self {
        let sentence = format!("{id} is a {}, expected a negative or reversal film in the camera", kind.name());
        ErrorKind::Contradiction(sentence).into()
    }

    /// Whether a description could not be read: an unknown key or word, a wrong version, no TOML.
    #[must_use]
    pub fn is_look(&self) -> bool {
        matches!(self.0, ErrorKind::Look { .. } | ErrorKind::Word { .. })
    }
}

impl From<ErrorKind> for Error {
    fn from(kind: ErrorKind) -> Self {
        Self(kind)
    }
}

impl From<onelight_spectra::Error> for Error {
    fn from(error: onelight_spectra::Error) -> Self {
        Self(ErrorKind::Spectra(error))
    }
}

impl From<onelight_film::Error> for Error {
    fn from(error: onelight_film::Error) -> Self {
        Self(ErrorKind::Film(error))
    }
}

impl From<onelight_printing::Error> for Error {
    fn from(error: onelight_printing::Error) -> Self {
        Self(ErrorKind::Printing(error))
    }
}

impl From<onelight_spatial::Error> for Error {
    fn from(error: onelight_spatial::Error) -> Self {
        Self(ErrorKind::Spatial(error))
    }
}

impl From<onelight_lut::Error> for Error {
    fn from(error: onelight_lut::Error) -> Self {
        Self(ErrorKind::Lut(error))
    }
}

#[cfg(feature = "formats")]
impl From<onelight_formats::Error> for Error {
    fn from(error: onelight_formats::Error) -> Self {
        Self(ErrorKind::Formats(error))
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            ErrorKind::Spectra(error) => error.fmt(f),
            ErrorKind::Film(error) => error.fmt(f),
            ErrorKind::Printing(error) => error.fmt(f),
            ErrorKind::Spatial(error) => error.fmt(f),
            ErrorKind::Lut(error) => error.fmt(f),
            #[cfg(feature = "formats")]
            ErrorKind::Formats(error) => error.fmt(f),
            ErrorKind::Look { file, line, problem } => write!(f, "{file}:{line}: {problem}"),
            ErrorKind::Word { what, found, expected } => write!(f, "{what}: found {found:?}, expected {expected}"),
            ErrorKind::Setting { what, found, expected } => write!(f, "{what}: found {found}, expected {expected}"),
            ErrorKind::UnknownStock { found, nearest: Some(nearest) } => {
                write!(f, "no stock is called {found:?}; the nearest is {nearest}")
            }
            ErrorKind::UnknownStock { found, nearest: None } => {
                write!(f, "no stock is called {found:?}, expected a maker and a number, such as kodak-5207")
            }
            ErrorKind::SeveralStocks { found, fits } => {
                write!(f, "{found:?} fits {}, expected more of one of these names", listed(fits))
            }
            ErrorKind::Contradiction(sentence) | ErrorKind::Unreachable(sentence) => f.write_str(sentence),
        }
    }
}

/// Names between commas, the last after an "and"; of many no more than a message should hold.
fn listed(names: &[String]) -> String {
    match names {
        [names @ .., last] if names.len() < NAMES_LISTED => format!("{} and {last}", names.join(", ")),
        _ => format!("{} and {} more", names[..NAMES_LISTED].join(", "), names.len() - NAMES_LISTED),
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.0 {
            // Their sentences are this error's own: only what lies behind them is new.
            ErrorKind::Spectra(error) => error.source(),
            ErrorKind::Film(error) => error.source(),
            ErrorKind::Printing(error) => error.source(),
            ErrorKind::Spatial(error) => error.source(),
            ErrorKind::Lut(error) => error.source(),
            #[cfg(feature = "formats")]
            ErrorKind::Formats(error) => error.source(),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;
    use std::error::Error as _;

    use super::*;

    #[test]
    fn an_error_printed_with_its_causes_says_nothing_twice() {
        let spectra = || onelight_spectra::Kelvin::new(-1.0).unwrap_err();
        let film = || onelight_film::Error::from(spectra());
        let errors = [
            Error::from(spectra()),
            film().into(),
            onelight_printing::Error::from(spectra()).into(),
            onelight_printing::Error::from(film()).into(),
            onelight_spatial::Error::from(film()).into(),
            onelight_lut::Shaper::log2(-1.0, 1.0).unwrap_err().into(),
        ];
        for error in errors {
            let mut sentence = error.to_string();
            let mut cause = error.source();
            while let Some(error) = cause {
                sentence = format!("{sentence}: {error}");
                cause = error.source();
            }
            let clauses: Vec<&str> = sentence.split(": ").collect();
            assert_eq!(clauses.iter().collect::<HashSet<_>>().len(), clauses.len(), "{sentence}");
        }
    }
}
