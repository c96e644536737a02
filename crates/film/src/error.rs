use std::fmt;

use onelight_spectra::SpectralShape;

/// What went wrong in this crate: one sentence that says what, where, what was found and what was expected.
///
/// ```
/// let error = onelight_film::NumberTable::parse("mine/sensitivity.csv", "wavelength_nm,red\n400,high\n").unwrap_err();
/// assert_eq!(error.to_string(), "mine/sensitivity.csv:2: red: found \"high\", expected a number or nothing");
/// assert!(error.is_data_sheet());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Error(ErrorKind);

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ErrorKind {
    Spectra(onelight_spectra::Error),
    Sheet { file: String, line: u64, problem: String },
    Stock { id: String, problem: String },
    Camera { what: &'static str, found: f64, expected: &'static str },
    InterImage { what: &'static str, found: f64, max: f64 },
    InterImageWord { found: String },
    Unmixing { stock: String, offset: f64 },
    Grids { found: SpectralShape, expected: SpectralShape },
}

impl Error {
    /// Whether a data sheet could not be read; the message names file and line.
    #[must_use]
    pub fn is_data_sheet(&self) -> bool {
        matches!(self.0, ErrorKind::Sheet { .. })
    }

    /// Whether the stock does not say what was asked of it (a criterion, an aim, a mid grey).
    #[must_use]
    pub fn is_not_published(&self) -> bool {
        matches!(self.0, ErrorKind::Stock { .. })
    }

    pub(crate) fn stock(id: &str, problem: impl Into<String>) -> Self {
        ErrorKind::Stock { id: id.to_owned(), problem: problem.into() }.into()
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

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            ErrorKind::Spectra(error) => error.fmt(f),
            ErrorKind::Sheet { file, line, problem } => write!(f, "{file}:{line}: {problem}"),
            ErrorKind::Stock { id, problem } => write!(f, "{id}: {problem}"),
            ErrorKind::Camera { what, found, expected } => write!(f, "{what}: found {found}, expected {expected}"),
            ErrorKind::InterImage { what, found, max } => write!(
                f,
                "inter-image effect, {what}: found {found}, expected 0 to {max} log10 exposure for a unit of density"
            ),
            ErrorKind::InterImageWord { found } => write!(
                f,
                "inter-image effect: found \"{found}\", expected none, negative, reversal, or two numbers such as 0.6,0.06"
            ),
            ErrorKind::Grids { found, expected } => {
                let [found, expected] =
                    [found, expected].map(|s| format!("{}..{} nm by {}", s.first_nm(), s.last_nm(), s.step_nm()));
                write!(f, "dyes and base of a film: found {found} beside {expected}, expected one grid")
            }
            ErrorKind::Unmixing { stock, offset } => write!(
                f,
                "{stock}: no dye amounts give the densities of the characteristic curves at log exposure {offset:+.2} from mid grey"
            ),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.0 {
            // Its sentence is this error's own: only what lies behind it is new.
            ErrorKind::Spectra(error) => error.source(),
            _ => None,
        }
    }
}
