use std::fmt;

/// What keeps something from being measured, as one sentence.
#[derive(Debug)]
pub struct Error(Kind);

#[derive(Debug)]
enum Kind {
    Look(onelight::Error),
    Said(String),
}

pub(crate) type Result<T> = std::result::Result<T, Error>;

impl Error {
    /// An error in words of its own: what, where, what was found and what was expected.
    ///
    /// ```
    /// assert_eq!(onelight_benches::Error::new("no card").to_string(), "no card");
    /// ```
    pub fn new(sentence: impl Into<String>) -> Self {
        Self(Kind::Said(sentence.into()))
    }

    /// The same, said of something: `of: ...`.
    pub(crate) fn of(what: &str, error: impl fmt::Display) -> Self {
        Self::new(format!("{what}: {error}"))
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Kind::Look(error) => error.fmt(f),
            Kind::Said(sentence) => f.write_str(sentence),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.0 {
            Kind::Look(error) => error.source(),
            Kind::Said(_) => None,
        }
    }
}

impl From<onelight::Error> for Error {
    fn from(error: onelight::Error) -> Self {
        Self(Kind::Look(error))
    }
}

impl From<onelight::lut::Error> for Error {
    fn from(error: onelight::lut::Error) -> Self {
        onelight::Error::from(error).into()
    }
}

impl From<onelight::film::Error> for Error {
    fn from(error: onelight::film::Error) -> Self {
        onelight::Error::from(error).into()
    }
}

impl From<onelight::spatial::Error> for Error {
    fn from(error: onelight::spatial::Error) -> Self {
        onelight::Error::from(error).into()
    }
}

impl From<onelight::spectra::Error> for Error {
    fn from(error: onelight::spectra::Error) -> Self {
        onelight::Error::from(error).into()
    }
}

#[cfg(feature = "gpu")]
impl From<onelight_gpu::Error> for Error {
    fn from(error: onelight_gpu::Error) -> Self {
        Self::new(error.to_string())
    }
}
