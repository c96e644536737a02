use std::{error, fmt, io};

/// What went wrong in this crate: a parameter, a table or a file that cannot be used.
///
/// The message is one sentence that says what, where, what was found and what was expected.
///
/// ```
/// let error = onelight_lut::Lut3d::identity(1).unwrap_err();
/// assert_eq!(error.to_string(), "size of the 3D LUT: found 1, expected 2 to 256");
/// ```
#[derive(Debug)]
pub struct Error(Box<Kind>);

impl Error {
    /// Whether reading or writing itself failed; the message ends with the cause.
    pub fn is_io(&self) -> bool {
        matches!(*self.0, Kind::Io(_))
    }

    /// Whether the text of a file is at fault; [`Error::line`] says where.
    pub fn is_text(&self) -> bool {
        matches!(*self.0, Kind::Text { .. })
    }

    /// Whether a picture that should hold a table is at fault.
    pub fn is_picture(&self) -> bool {
        matches!(*self.0, Kind::Picture { .. })
    }

    /// The line of the file, counted from 1, where the fault was noticed.
    pub fn line(&self) -> Option<usize> {
        match *self.0 {
            Kind::Text { line, .. } => Some(line),
            _ => None,
        }
    }

    pub(crate) fn text(line: usize, problem: TextProblem) -> Self {
        Kind::Text { line, problem }.into()
    }
}

/// The reasons behind an [`Error`].
#[derive(Debug)]
pub(crate) enum Kind {
    Parameter { what: &'static str, found: f64, expected: &'static str },
    Size { what: &'static str, found: usize, min: usize, max: usize },
    EntryCount { size: usize, found: usize, expected: usize },
    Entry1d { index: usize, found: [f32; 3] },
    Entry3d { node: [usize; 3], found: [f32; 3] },
    BakedNode { node: [usize; 3], linear: [f64; 3], found: [f32; 3] },
    Domain { min: [f32; 3], max: [f32; 3] },
    DomainsDiffer { what: &'static str, min: [f32; 3], max: [f32; 3] },
    NoSamples,
    Difference { index: usize, sample: [f64; 3], found: f64 },
    DifferenceCount { found: usize, expected: usize },
    Text { line: usize, problem: TextProblem },
    TextBytes { max: u64 },
    PixelLayout { width: usize, height: usize, channels: usize, stride: usize, len: usize },
    PictureSizes { from: [usize; 2], to: [usize; 2] },
    Half { node: [usize; 3], found: [f32; 3] },
    Picture { what: &'static str, found: String, expected: &'static str },
    Io(io::Error),
}

/// What a line of a text file has wrong.
#[derive(Debug)]
pub(crate) enum TextProblem {
    UnknownKeyword { found: String },
    RepeatedKeyword { keyword: &'static str },
    KeywordAfterData { keyword: &'static str },
    NumberCount { what: &'static str, found: usize, expected: usize },
    NotANumber { what: &'static str, found: String },
    NotFinite { what: &'static str, found: String },
    Size { keyword: &'static str, found: String, min: usize, max: usize },
    DataBeforeSize,
    TooManyDataLines { expected: usize },
    Truncated { found: usize, expected: usize },
    NoTable,
    Domain { what: &'static str, min: [f32; 3], max: [f32; 3] },
    Misplaced { keyword: &'static str, expected: &'static str },
    LineTooLong { max: usize },
    TooManyOtherLines { max: usize },
    TooManyCommentBytes { max: usize },
    Unexpected { what: &'static str, found: String, expected: &'static str },
    TooMany { what: &'static str, max: usize },
}

impl From<Kind> for Error {
    fn from(kind: Kind) -> Self {
        Self(Box::new(kind))
    }
}

impl From<io::Error> for Error {
    fn from(error: io::Error) -> Self {
        Kind::Io(error).into()
    }
}

impl error::Error for Error {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        match &*self.0 {
            // The message holds the cause already: said once, however the chain is printed.
            Kind::Io(error) => error.source(),
            _ => None,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &*self.0 {
            Kind::Parameter { what, found, expected } => write!(f, "{what}: found {found}, expected {expected}"),
            Kind::Size { what, found, min, max } => {
                write!(f, "size of the {what}: found {found}, expected {min} to {max}")
            }
            Kind::EntryCount { size, found, expected } => {
                write!(f, "entries of a 3D LUT of size {size}: found {found}, expected {expected}")
            }
            Kind::Entry1d { index, found } => {
                write!(f, "entry {index} of a 1D LUT: found {found:?}, expected numbers within ±1e38")
            }
            Kind::Entry3d { node, found } => {
                write!(f, "entry of a 3D LUT at node {node:?}: found {found:?}, expected numbers within ±1e38")
            }
            Kind::PixelLayout { width, height, channels, stride, len } => write!(
                f,
                "picture of {width}x{height} pixels, {channels} samples each, rows {stride} samples apart: found {len} samples, expected at least as many as that takes, and rows no longer than their distance"
            ),
            Kind::PictureSizes { from, to } => write!(
                f,
                "size of the picture to write: found {}x{}, expected {}x{} as in the one to read",
                to[0], to[1], from[0], from[1]
            ),
            Kind::BakedNode { node, linear, found } => write!(
                f,
                "baked function at node {node:?}, linear {linear:?}: found {found:?}, expected numbers finite in f32"
            ),
            Kind::Domain { min, max } => write!(
                f,
                "domain of a table: found {min:?} to {max:?}, expected finite ends with the second above the first"
            ),
            Kind::DomainsDiffer { what, min, max } => write!(
                f,
                "domain of the {what} in a .cube file with two tables: found {min:?} to {max:?}, expected one range for all channels"
            ),
            Kind::NoSamples => f.write_str("samples of a deviation: found none, expected at least one"),
            Kind::Difference { index, sample, found } => {
                write!(f, "difference at sample {index}, {sample:?}: found {found}, expected a finite number")
            }
            Kind::DifferenceCount { found, expected } => {
                write!(f, "differences of a deviation: found {found}, expected {expected}, one for each sample")
            }
            Kind::Text { line, problem } => write!(f, "line {line}: {problem}"),
            Kind::TextBytes { max } => {
                write!(f, "text of a LUT file: found more than {max} bytes, expected at most {max}")
            }
            Kind::Half { node, found } => {
                write!(
                    f,
                    "entry of a 3D LUT at node {node:?}: found {found:?}, expected numbers within ±65504 for a half"
                )
            }
            Kind::Picture { what, found, expected } => write!(f, "{what}: found {found}, expected {expected}"),
            Kind::Io(error) => write!(f, "reading or writing a LUT file: {error}"),
        }
    }
}

impl fmt::Display for TextProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownKeyword { found } => write!(
                f,
                "keyword: found {found:?}, expected TITLE, LUT_1D_SIZE, LUT_3D_SIZE, LUT_1D_INPUT_RANGE, LUT_3D_INPUT_RANGE, DOMAIN_MIN or DOMAIN_MAX"
            ),
            Self::RepeatedKeyword { keyword } => {
                write!(f, "found {keyword} again, expected it once")
            }
            Self::KeywordAfterData { keyword } => {
                write!(f, "found {keyword} after the first data line, expected numbers")
            }
            Self::NumberCount { what, found, expected } => {
                write!(f, "numbers in {what}: found {found}, expected {expected}")
            }
            Self::NotANumber { what, found } => {
                write!(f, "{what}: found {found:?}, expected a number")
            }
            Self::NotFinite { what, found } => {
                write!(f, "{what}: found {found:?}, expected a number finite in f32")
            }
            Self::Size { keyword, found, min, max } => {
                write!(f, "{keyword}: found {found:?}, expected a whole number from {min} to {max}")
            }
            Self::DataBeforeSize => f.write_str("found a data line, expected LUT_1D_SIZE or LUT_3D_SIZE before it"),
            Self::TooManyDataLines { expected } => {
                write!(f, "found another data line, expected {expected} and no more")
            }
            Self::Truncated { found, expected } => {
                write!(f, "end of the file: found {found} data lines, expected {expected}")
            }
            Self::NoTable => f.write_str("end of the file: found no table, expected LUT_1D_SIZE or LUT_3D_SIZE"),
            Self::Domain { what, min, max } => {
                write!(f, "{what}: found {min:?} to {max:?}, expected finite ends with the second above the first")
            }
            Self::Misplaced { keyword, expected } => {
                write!(f, "found {keyword}, expected {expected}")
            }
            Self::LineTooLong { max } => write!(f, "length: found more than {max} bytes, expected at most {max}"),
            Self::TooManyOtherLines { max } => {
                write!(f, "lines without data: found more than {max}, expected at most {max}")
            }
            Self::TooManyCommentBytes { max } => {
                write!(f, "comments: found more than {max} bytes, expected at most {max}")
            }
            Self::Unexpected { what, found, expected } => write!(f, "{what}: found {found}, expected {expected}"),
            Self::TooMany { what, max } => write!(f, "{what}: found more than {max}, expected at most {max}"),
        }
    }
}
