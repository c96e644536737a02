//! What went wrong, in one sentence.

mod class;
#[cfg(feature = "exr")]
mod exr;
#[cfg(feature = "hdr")]
mod hdr;
#[cfg(feature = "jpeg")]
mod jpeg;
mod limit;
#[cfg(feature = "png")]
mod png;
mod tiff;
mod write;

use std::{error, fmt, io};

use self::class::Class;
#[cfg(feature = "exr")]
pub(crate) use self::exr::{BlockProblem, ExrProblem, PixelProblem, message as exr_message};
#[cfg(feature = "hdr")]
pub(crate) use self::hdr::HdrProblem;
#[cfg(feature = "jpeg")]
pub(crate) use self::jpeg::JpegProblem;
#[cfg(feature = "png")]
pub(crate) use self::png::PngProblem;
pub(crate) use self::{limit::LimitProblem, tiff::TiffProblem, write::WriteProblem};

/// Why a picture cannot be read or written.
///
/// The message is one sentence on one line: what, where, what was found and what was expected. An error of reading begins
/// with the name that [`open`](crate::open) was given. What it repeats of a file or of a decoder's message is cut short
/// and holds no control characters.
///
/// The predicates tell the kinds apart; each error is of one kind.
///
/// ```
/// use std::io::Cursor;
///
/// use onelight_picture::{Limits, open};
///
/// let error = open(Cursor::new(b"GIF89a and so on"), "cat.exr", Limits::default()).unwrap_err();
/// assert!(error.is_unsupported());
/// assert!(error.to_string().starts_with("cat.exr: found a GIF picture by its first bytes, expected "));
///
/// let error = open(Cursor::new(b"II\x2a\0"), "cat.tif", Limits::default()).unwrap_err();
/// assert!(error.is_damaged());
/// assert_eq!(error.to_string(), "cat.tif: the file ends too early (is it truncated?)");
/// ```
#[derive(Debug)]
pub struct Error {
    /// What the caller calls the file; nothing where there is no such name.
    name: String,
    kind: Box<Kind>,
}

impl Error {
    /// Whether the picture goes over [`Limits`](crate::Limits), or takes more memory than there is. Higher limits may help.
    pub fn is_limit(&self) -> bool {
        self.class() == Class::Limit
    }

    /// The field of [`Limits`](crate::Limits) that the picture goes over, where one of them is what refuses it.
    ///
    /// ```
    /// # use std::io::Cursor;
    /// use onelight_picture::{Limits, open};
    /// # use onelight_picture::{Picture, Source};
    /// # let mut file = Cursor::new(Vec::new());
    /// # Picture::opaque(3, 2, vec![[0.5; 3]; 6], Source::Exr).write_exr(&mut file, &[])?;
    ///
    /// let error = open(file, "a.exr", Limits { max_pixels: 5, ..Limits::default() }).unwrap_err();
    /// assert_eq!(error.limit_field(), Some("max_pixels"));
    /// # Ok::<(), onelight_picture::Error>(())
    /// ```
    pub fn limit_field(&self) -> Option<&'static str> {
        match &*self.kind {
            Kind::Limit(LimitProblem::Pixels { .. }) => Some("max_pixels"),
            Kind::Limit(LimitProblem::Side { .. }) => Some("max_side"),
            Kind::Limit(LimitProblem::Bytes { .. }) => Some("max_bytes"),
            _ => None,
        }
    }

    /// Whether the file is of a format, or uses a feature of its format, that this crate does not read.
    pub fn is_unsupported(&self) -> bool {
        self.class() == Class::Unsupported
    }

    /// Whether the file is damaged, cut short, empty, or contradicts itself.
    pub fn is_damaged(&self) -> bool {
        self.class() == Class::Damaged
    }

    /// Whether the picture, the bands or the texts given to a writer fit neither each other nor the format.
    pub fn is_unwritable(&self) -> bool {
        self.class() == Class::Unwritable
    }

    /// Whether the reader or the writer itself failed: a disk that is full, a connection that broke off.
    pub fn is_io(&self) -> bool {
        self.class() == Class::Io
    }

    /// The same error, of the file that the caller calls `name`.
    pub(crate) fn named(self, name: &str) -> Self {
        Self { name: name.to_owned(), ..self }
    }

    fn class(&self) -> Class {
        match &*self.kind {
            Kind::Io(_) => Class::Io,
            Kind::Empty { .. } | Kind::EndsEarly | Kind::DecoderPanicked => Class::Damaged,
            Kind::Format { .. } => Class::Unsupported,
            Kind::Limit(problem) => problem.class(),
            #[cfg(feature = "exr")]
            Kind::Exr(problem) => problem.class(),
            #[cfg(feature = "png")]
            Kind::Png(problem) => problem.class(),
            #[cfg(feature = "hdr")]
            Kind::Hdr(problem) => problem.class(),
            #[cfg(feature = "jpeg")]
            Kind::Jpeg(problem) => problem.class(),
            Kind::Tiff(problem) => problem.class(),
            Kind::Write(problem) => problem.class(),
        }
    }
}

/// The reasons behind an [`Error`].
#[derive(Debug)]
pub(crate) enum Kind {
    /// The reader failed: a device, a network or a pipe, not the file's content.
    Io(io::Error),
    /// There is not one byte.
    Empty {
        expected: String,
    },
    EndsEarly,
    Format {
        found: &'static str,
        expected: String,
    },
    DecoderPanicked,
    Limit(LimitProblem),
    #[cfg(feature = "exr")]
    Exr(ExrProblem),
    #[cfg(feature = "png")]
    Png(PngProblem),
    #[cfg(feature = "hdr")]
    Hdr(HdrProblem),
    #[cfg(feature = "jpeg")]
    Jpeg(JpegProblem),
    /// EXIF is a TIFF too.
    Tiff(TiffProblem),
    Write(WriteProblem),
}

impl From<Kind> for Error {
    fn from(kind: Kind) -> Self {
        Self { name: String::new(), kind: Box::new(kind) }
    }
}

/// An error of reading; one of writing is another kind, `WriteProblem::Io`.
impl From<io::Error> for Error {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::UnexpectedEof => Kind::EndsEarly,
            _ => Kind::Io(error),
        }
        .into()
    }
}

impl From<LimitProblem> for Error {
    fn from(problem: LimitProblem) -> Self {
        Kind::Limit(problem).into()
    }
}

#[cfg(feature = "exr")]
impl From<ExrProblem> for Error {
    fn from(problem: ExrProblem) -> Self {
        Kind::Exr(problem).into()
    }
}

#[cfg(feature = "png")]
impl From<PngProblem> for Error {
    fn from(problem: PngProblem) -> Self {
        Kind::Png(problem).into()
    }
}

#[cfg(feature = "hdr")]
impl From<HdrProblem> for Error {
    fn from(problem: HdrProblem) -> Self {
        Kind::Hdr(problem).into()
    }
}

#[cfg(feature = "jpeg")]
impl From<JpegProblem> for Error {
    fn from(problem: JpegProblem) -> Self {
        Kind::Jpeg(problem).into()
    }
}

impl From<TiffProblem> for Error {
    fn from(problem: TiffProblem) -> Self {
        Kind::Tiff(problem).into()
    }
}

impl From<WriteProblem> for Error {
    fn from(problem: WriteProblem) -> Self {
        Kind::Write(problem).into()
    }
}

impl error::Error for Error {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        match &*self.kind {
            // The message holds the cause already: said once, however the chain is printed.
            Kind::Io(error) | Kind::Write(WriteProblem::Io(error)) => error.source(),
            _ => None,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.name.is_empty() {
            write!(f, "{}: ", self.name)?;
        }
        match &*self.kind {
            Kind::Io(error) => write!(f, "cannot be read: {error}"),
            Kind::Empty { expected } => write!(f, "the file is empty, expected {expected}"),
            Kind::EndsEarly => f.write_str("the file ends too early (is it truncated?)"),
            Kind::Format { found, expected } => write!(f, "found {found} by its first bytes, expected {expected}"),
            Kind::DecoderPanicked => {
                f.write_str("the data are damaged, or of a kind that the decoder cannot take (it gave up)")
            }
            Kind::Limit(problem) => problem.fmt(f),
            #[cfg(feature = "exr")]
            Kind::Exr(problem) => problem.fmt(f),
            #[cfg(feature = "png")]
            Kind::Png(problem) => problem.fmt(f),
            #[cfg(feature = "hdr")]
            Kind::Hdr(problem) => problem.fmt(f),
            #[cfg(feature = "jpeg")]
            Kind::Jpeg(problem) => problem.fmt(f),
            Kind::Tiff(problem) => problem.fmt(f),
            Kind::Write(problem) => problem.fmt(f),
        }
    }
}
