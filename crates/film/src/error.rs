use std::fmt;

use onelight_spectra::SpectralShape;

/// What went wrong in this crate: one sentence that says what, where, what was found and what was expected.
#[derive(Debug, Clone, PartialEq)]
pub struct Error(Kind);

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Kind {
    Spectra(onelight_spectra::Error),
    Sheet { file: String, line: usize, problem: String },
    Stock { id: String, problem: String },
    Camera { what: &'static str, found: f64, expected: &'static str },
    InterImage { what: &'static str, found: f64 },
    InterImageWord { found: String },
    Unmixing { stock: String, offset: f64 },
    Grids { found: SpectralShape, expected: SpectralShape },
}

impl Error {
    /// Whether a data sheet could not be read; the message names file and line.
    #[must_use]
    pub fn is_data_sheet(&self) -> bool {
        match &self.0 {
            Kind::Sheet { .. } => true,
            Kind::Spectra(error) => error.is_table(),
            _ => false,
        }
    }

    /// Whether the stock does not say what was asked of it (a criterion, an aim, a mid grey).
    #[must_use]
    pub fn is_not_published(&self) -> bool {
        matches!(self.0, Kind::Stock { .. })
    }

    pub(crate) fn stock(id: &str, problem: impl Into<String>) -> Self {
        Kind::Stock { id: id.to_owned(), problem: problem.into() }.into()
    }
}

impl From<Kind> for Error {
    fn from(kind: Kind) -> Self {
        Self(kind)
    }
}

impl From<onelight_spectra::Error> for Error {
    fn from(error: onelight_spectra::Error) -> Self {
        Self(Kind::Spectra(error))
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Kind::Spectra(error) => error.fmt(f),
            Kind::Sheet { file, line, problem } => write!(f, "{file}:{line}: {problem}"),
            Kind::Stock { id, problem } => write!(f, "{id}: {problem}"),
            Kind::Camera { what, found, expected } => write!(f, "{what}: found {found}, expected {expected}"),
            Kind::InterImage { what, found } => write!(
                f,
                "inter-image effect, {what}: found {found}, expected 0 to {} log10 exposure for a unit of density",
                crate::InterImage::MAX
            ),
            Kind::InterImageWord { found } => write!(
                f,
                "inter-image effect: found \"{found}\", expected none, negative, reversal, or two numbers such as 0.6,0.06"
            ),
            Kind::Grids { found, expected } => {
                let [found, expected] =
                    [found, expected].map(|s| format!("{}..{} nm by {}", s.first_nm(), s.last_nm(), s.step_nm()));
                write!(f, "dyes and base of a film: found {found} beside {expected}, expected one grid")
            }
            Kind::Unmixing { stock, offset } => write!(
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
            Kind::Spectra(error) => error.source(),
            _ => None,
        }
    }
}
