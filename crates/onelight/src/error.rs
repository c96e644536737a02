use std::fmt;

/// What went wrong: one sentence that says what, where, what was found and what was expected.
#[derive(Debug, Clone, PartialEq)]
pub struct Error(Kind);

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Kind {
    Spectra(onelight_spectra::Error),
    Film(onelight_film::Error),
    Printing(onelight_printing::Error),
    Look { file: String, line: usize, problem: String },
    Word { what: &'static str, found: String, expected: String },
    UnknownStock { found: String, nearest: String },
    Contradiction(String),
}

impl Error {
    /// Whether no stock has the id that was asked for; the message names the nearest.
    #[must_use]
    pub fn is_unknown_stock(&self) -> bool {
        matches!(self.0, Kind::UnknownStock { .. })
    }

    /// Whether the film cannot be brought to its aim.
    #[must_use]
    pub fn is_unreachable_aim(&self) -> bool {
        matches!(&self.0, Kind::Printing(error) if error.is_unreachable_aim())
    }

    /// Whether the parts of the process contradict each other, as a print for a reversal film does.
    #[must_use]
    pub fn is_contradiction(&self) -> bool {
        matches!(&self.0, Kind::Contradiction(_)) || matches!(&self.0, Kind::Printing(error) if error.is_wrong_kind())
    }

    /// Whether a description could not be read: an unknown key or word, a wrong version, no TOML.
    #[must_use]
    pub fn is_look(&self) -> bool {
        matches!(self.0, Kind::Look { .. } | Kind::Word { .. })
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

impl From<onelight_film::Error> for Error {
    fn from(error: onelight_film::Error) -> Self {
        Self(Kind::Film(error))
    }
}

impl From<onelight_printing::Error> for Error {
    fn from(error: onelight_printing::Error) -> Self {
        Self(Kind::Printing(error))
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Kind::Spectra(error) => error.fmt(f),
            Kind::Film(error) => error.fmt(f),
            Kind::Printing(error) => error.fmt(f),
            Kind::Look { file, line, problem } => write!(f, "{file}:{line}: {problem}"),
            Kind::Word { what, found, expected } => write!(f, "{what}: found {found:?}, expected {expected}"),
            Kind::UnknownStock { found, nearest } => {
                write!(f, "no stock is called {found:?}; the nearest is {nearest} (`cargo xtask stocks` lists all)")
            }
            Kind::Contradiction(sentence) => f.write_str(sentence),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.0 {
            Kind::Spectra(error) => Some(error),
            Kind::Film(error) => Some(error),
            Kind::Printing(error) => Some(error),
            _ => None,
        }
    }
}
