use std::fmt;

/// What went wrong in this crate: one sentence that says what, where, what was found and what was expected.
///
/// ```
/// let error = "super9".parse::<onelight_spatial::FilmFormat>().unwrap_err();
/// assert!(error.to_string().contains("found \"super9\", expected super35"), "{error}");
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Error(ErrorKind);

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ErrorKind {
    Film(onelight_film::Error),
    Format { found: String, expected: String },
    Range { what: &'static str, found: f64, low: f64, high: f64, unit: &'static str },
    ModulationTransfer { stock: String, layer: &'static str, problem: String },
    Granularity { stock: String, problem: String },
    Planes { what: &'static str, found: String, expected: String },
}

impl Error {
    /// Whether the film's sheet does not have the figures, or has them in a form that cannot be used.
    #[must_use]
    pub fn is_not_published(&self) -> bool {
        match &self.0 {
            ErrorKind::Film(error) => error.is_not_published(),
            ErrorKind::ModulationTransfer { .. } | ErrorKind::Granularity { .. } => true,
            _ => false,
        }
    }

    /// A number outside what is allowed.
    pub(crate) fn range(what: &'static str, found: f64, [low, high]: [f64; 2], unit: &'static str) -> Self {
        ErrorKind::Range { what, found, low, high, unit }.into()
    }
}

impl From<ErrorKind> for Error {
    fn from(kind: ErrorKind) -> Self {
        Self(kind)
    }
}

impl From<onelight_film::Error> for Error {
    fn from(error: onelight_film::Error) -> Self {
        Self(ErrorKind::Film(error))
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            ErrorKind::Film(error) => error.fmt(f),
            ErrorKind::Format { found, expected } => {
                write!(f, "film format: found \"{found}\", expected {expected}, or a width such as 24.9mm")
            }
            ErrorKind::Range { what, found, low, high, unit } => {
                write!(f, "{what}: found {found}{unit}, expected {low} to {high}{unit}")
            }
            ErrorKind::ModulationTransfer { stock, layer, problem } => {
                write!(f, "{stock}: modulation transfer of the {layer} layer: {problem}")
            }
            ErrorKind::Granularity { stock, problem } => write!(f, "{stock}: granularity: {problem}"),
            ErrorKind::Planes { what, found, expected } => write!(f, "{what}: found {found}, expected {expected}"),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.0 {
            // Its sentence is this error's own: only what lies behind it is new.
            ErrorKind::Film(error) => error.source(),
            _ => None,
        }
    }
}
