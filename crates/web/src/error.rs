use std::fmt;

/// What went wrong, as one sentence for the page to show.
///
/// ```
/// let error = onelight_web::Keys::from_toml("version = 2\ncamera = \"kodak-5270\"").unwrap_err();
/// assert!(error.to_string().contains("kodak-5270"));
/// ```
#[derive(Debug)]
pub struct Error(Kind);

#[derive(Debug)]
enum Kind {
    Look(onelight::Error),
    Picture(onelight_picture::Error),
    Formats(onelight::formats::Error),
    Lut(onelight::lut::Error),
    Gpu(onelight::gpu::Error),
    Spectra(onelight::spectra::Error),
    Spatial(onelight::spatial::Error),
    Json(serde_json::Error),
    Samples { found: usize, expected: usize },
    Format(String),
    Packed(&'static str),
    WithoutFilm,
}

impl Error {
    /// A buffer of pixels that holds another number of samples than it should.
    pub(crate) fn samples(found: usize, expected: usize) -> Self {
        Self(Kind::Samples { found, expected })
    }

    /// An approach without film, which the page does not have.
    pub(crate) fn without_film() -> Self {
        Self(Kind::WithoutFilm)
    }

    /// Bytes that are no packed look.
    pub(crate) fn packed(problem: &'static str) -> Self {
        Self(Kind::Packed(problem))
    }

    /// A kind of picture that is not written.
    pub(crate) fn format(word: &str) -> Self {
        Self(Kind::Format(word.chars().take(40).collect()))
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Kind::Look(error) => error.fmt(f),
            Kind::Picture(error) => error.fmt(f),
            Kind::Formats(error) => error.fmt(f),
            Kind::Lut(error) => error.fmt(f),
            Kind::Gpu(error) => error.fmt(f),
            Kind::Spectra(error) => error.fmt(f),
            Kind::Spatial(error) => error.fmt(f),
            Kind::Json(error) => write!(f, "the page's own message cannot be read: {error}"),
            Kind::Samples { found, expected } => write!(f, "pixels: found {found} samples, expected {expected}"),
            Kind::Packed(problem) => write!(f, "a packed look: {problem}"),
            Kind::WithoutFilm => f.write_str(
                "the look is no simulation of film, expected approach second with a camera film: the command line has the others",
            ),
            Kind::Format(word) => {
                write!(f, "{word:?} is no kind of picture, expected png8, png16, tiff16, exr or jpeg")
            }
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.0 {
            Kind::Look(error) => error.source(),
            Kind::Picture(error) => error.source(),
            Kind::Formats(error) => error.source(),
            Kind::Lut(error) => error.source(),
            Kind::Gpu(error) => error.source(),
            Kind::Spectra(error) => error.source(),
            Kind::Spatial(error) => error.source(),
            Kind::Json(error) => error.source(),
            Kind::Samples { .. } | Kind::Format(_) | Kind::Packed(_) | Kind::WithoutFilm => None,
        }
    }
}

macro_rules! from {
    ($($error:ty => $kind:ident),*) => {
        $(impl From<$error> for Error {
            fn from(error: $error) -> Self {
                Self(Kind::$kind(error))
            }
        })*
    };
}

from! {
    onelight::Error => Look,
    onelight_picture::Error => Picture,
    onelight::formats::Error => Formats,
    onelight::lut::Error => Lut,
    onelight::gpu::Error => Gpu,
    onelight::spectra::Error => Spectra,
    onelight::spatial::Error => Spatial,
    serde_json::Error => Json
}
