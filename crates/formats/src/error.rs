use std::{error, fmt, io};

/// What went wrong in this crate: a file that cannot be read, or a table that a file cannot hold.
///
/// The message is one sentence that says what, where, what was found and what was expected. Words of a file are repeated in
/// it only in part and without control characters, so that it stays one line.
///
/// ```
/// # #[cfg(feature = "cube")] {
/// use onelight_formats::CubeFile;
///
/// let error = CubeFile::parse("LUT_1D_SIZE 2\n0 0 0\n1 one 1\n").unwrap_err();
/// assert!(error.is_text());
/// assert_eq!(error.line(), Some(3));
/// assert_eq!(error.to_string(), "line 3: a data line: found \"one\", expected a number");
/// # }
/// ```
#[derive(Debug)]
pub struct Error(Box<ErrorKind>);

impl Error {
    /// Whether reading or writing itself failed; the message ends with the cause.
    pub fn is_io(&self) -> bool {
        matches!(*self.0, ErrorKind::Io(_))
    }

    /// Whether the text of a file is at fault; [`Error::line`] says where, unless the whole text is of another kind.
    pub fn is_text(&self) -> bool {
        matches!(*self.0, ErrorKind::Text { .. } | ErrorKind::Key { .. })
    }

    /// Whether a picture that should hold a table is at fault.
    pub fn is_picture(&self) -> bool {
        matches!(*self.0, ErrorKind::Picture { .. })
    }

    /// Whether a file is larger than is read.
    pub fn is_too_large(&self) -> bool {
        matches!(*self.0, ErrorKind::TextBytes { .. })
    }

    /// Whether numbers are at fault that the file's text may hold and a table or a form may not, or the file's kind may not:
    /// entries beyond ±1e38, a size without a Hald, a value that is infinite as a half.
    pub fn is_table(&self) -> bool {
        match *self.0 {
            ErrorKind::Table { .. }
            | ErrorKind::DomainsDiffer { .. }
            | ErrorKind::HaldSize { .. }
            | ErrorKind::VltSize { .. }
            | ErrorKind::Shaper { .. }
            | ErrorKind::Half { .. } => true,
            ErrorKind::Text { .. }
            | ErrorKind::Key { .. }
            | ErrorKind::TextBytes { .. }
            | ErrorKind::CommentBytes { .. }
            | ErrorKind::Picture { .. } => false,
            ErrorKind::Io(_) => false,
        }
    }

    /// The line of the file, counted from 1, where the fault was noticed.
    pub fn line(&self) -> Option<usize> {
        match *self.0 {
            ErrorKind::Text { line, .. } => Some(line),
            _ => None,
        }
    }

    pub(crate) fn text(line: usize, problem: TextProblem) -> Self {
        ErrorKind::Text { line, problem }.into()
    }
}

/// The reasons behind an [`Error`].
#[derive(Debug)]
pub(crate) enum ErrorKind {
    /// What a table or a form refused; `part` of the file is named where there are several.
    Table {
        part: Option<&'static str>,
        error: onelight_lut::Error,
    },
    DomainsDiffer {
        what: &'static str,
        min: [f32; 3],
        max: [f32; 3],
    },
    HaldSize {
        found: usize,
    },
    VltSize {
        found: usize,
    },
    Shaper {
        found: onelight_lut::ShaperKind,
    },
    Half {
        node: [usize; 3],
        found: [f32; 3],
    },
    Text {
        line: usize,
        problem: TextProblem,
    },
    /// A key of a file that names another kind of file.
    Key {
        what: &'static str,
        found: String,
        expected: &'static str,
    },
    TextBytes {
        max: u64,
    },
    CommentBytes {
        found: usize,
        max: usize,
    },
    Picture {
        what: &'static str,
        found: String,
        expected: &'static str,
    },
    Io(io::Error),
}

/// What a line of a text file has wrong.
#[derive(Debug)]
pub(crate) enum TextProblem {
    UnknownKeyword {
        found: String,
    },
    RepeatedKeyword {
        keyword: &'static str,
    },
    KeywordAfterData {
        keyword: &'static str,
    },
    NumberCount {
        what: &'static str,
        found: usize,
        expected: usize,
    },
    NotANumber {
        what: &'static str,
        found: String,
    },
    NotFinite {
        what: &'static str,
        found: String,
    },
    Size {
        keyword: &'static str,
        found: String,
        min: usize,
        max: usize,
    },
    DataBeforeSize,
    TooManyDataLines {
        expected: usize,
    },
    Truncated {
        found: usize,
        expected: usize,
    },
    NoTable,
    Domain {
        what: &'static str,
        min: [f32; 3],
        max: [f32; 3],
    },
    Misplaced {
        keyword: &'static str,
        expected: &'static str,
    },
    LineTooLong {
        max: usize,
    },
    TooManyOtherLines {
        max: usize,
    },
    TooManyCommentBytes {
        max: usize,
    },
    Unexpected {
        what: &'static str,
        found: String,
        expected: &'static str,
    },
    TooMany {
        what: &'static str,
        max: usize,
    },
    /// What the JSON reader says.
    Json {
        found: String,
    },
    /// Numbers that the text may hold and a table may not.
    Table(onelight_lut::Error),
}

impl From<ErrorKind> for Error {
    fn from(kind: ErrorKind) -> Self {
        Self(Box::new(kind))
    }
}

impl From<onelight_lut::Error> for Error {
    fn from(error: onelight_lut::Error) -> Self {
        ErrorKind::Table { part: None, error }.into()
    }
}

impl From<io::Error> for Error {
    fn from(error: io::Error) -> Self {
        ErrorKind::Io(error).into()
    }
}

impl error::Error for Error {
    fn source(&self) -> Option<&(dyn error::Error + 'static)> {
        // The message holds the cause already: said once, however the chain is printed.
        match &*self.0 {
            ErrorKind::Io(error) => error.source(),
            ErrorKind::Table { error, .. } => error.source(),
            _ => None,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &*self.0 {
            ErrorKind::Table { part: Some(part), error } => write!(f, "{part}: {error}"),
            ErrorKind::Table { part: None, error } => write!(f, "{error}"),
            ErrorKind::DomainsDiffer { what, min, max } => write!(
                f,
                "domain of the {what} in a .cube file with two tables: found {min:?} to {max:?}, expected one range for all channels"
            ),
            ErrorKind::VltSize { found } => {
                write!(f, "size of a table for a .vlt: found {found}, expected 17, the only one that cameras read")
            }
            ErrorKind::HaldSize { found } => write!(
                f,
                "size of a table for a Hald CLUT: found {found}, expected the square of a level from 2 to 16, such as 25, 36, 49 or 64"
            ),
            ErrorKind::Shaper { found } => {
                write!(f, "shaper of a plain LUT: found {found:?}, expected a logarithm with an offset")
            }
            ErrorKind::Half { node, found } => write!(
                f,
                "entry of a 3D LUT at node {node:?}: found {found:?}, expected numbers within ±65504 for a half"
            ),
            ErrorKind::Text { line, problem } => write!(f, "line {line}: {problem}"),
            ErrorKind::TextBytes { max } => {
                write!(f, "text of a LUT file: found more than {max} bytes, expected at most {max}")
            }
            ErrorKind::CommentBytes { found, max } => {
                write!(f, "bytes of comments: found {found}, expected at most {max}")
            }
            ErrorKind::Picture { what, found, expected } | ErrorKind::Key { what, found, expected } => {
                write!(f, "{what}: found {found}, expected {expected}")
            }
            ErrorKind::Io(error) => write!(f, "reading or writing a LUT file: {error}"),
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
            Self::Json { found } => {
                write!(f, "JSON: {found}; expected a file of \"onelight direct form\" version 1")
            }
            Self::Table(error) => write!(f, "{error}"),
        }
    }
}
