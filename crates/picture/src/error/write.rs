use std::{fmt, io};

use super::class::Class;

/// Why a picture cannot be written.
#[derive(Debug)]
pub(crate) enum WriteProblem {
    /// Width or height is 0.
    NoPixels {
        size: [usize; 2],
    },
    /// A window that the format has no numbers for.
    TooLarge {
        size: [usize; 2],
        format: &'static str,
    },
    /// Rows that are not those that come next.
    Rows {
        colours: usize,
        top: usize,
        size: [usize; 2],
        next: usize,
    },
    /// The picture ended before its last row.
    RowsMissing {
        size: [usize; 2],
        rows: usize,
    },
    /// Coverage, which the format has not.
    Alpha {
        format: &'static str,
    },
    NotLatin1 {
        key: String,
    },
    KeyLength {
        bytes: usize,
    },
    ThirdText {
        key: String,
    },
    /// The writer of the format asked for no rows.
    NotFilled,
    /// What the format's encoder says.
    Encoder(String),
    Io(io::Error),
}

impl WriteProblem {
    pub(super) fn class(&self) -> Class {
        match self {
            Self::Io(_) => Class::Io,
            _ => Class::Unwritable,
        }
    }
}

impl fmt::Display for WriteProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoPixels { size: [width, height] } => {
                write!(f, "a picture of {width} x {height} pixels cannot be written")
            }
            Self::TooLarge { size: [width, height], format } => {
                write!(f, "a picture of {width} x {height} pixels is too large for {format}")
            }
            Self::Rows { colours, top, size: [width, height], next } => write!(
                f,
                "{colours} colours from row {top} of a picture of {width} x {height} pixels cannot be written after row {next}"
            ),
            Self::RowsMissing { size: [width, height], rows } => {
                write!(f, "a picture of {width} x {height} pixels with {rows} rows cannot be written")
            }
            Self::Alpha { format } => write!(f, "a picture with alpha cannot be written as {format}"),
            Self::NotLatin1 { key } => {
                write!(f, "the text `{key}` cannot be written, as it has characters beyond Latin-1")
            }
            Self::KeyLength { bytes } => write!(f, "a text's key has {bytes} bytes, expected 1 to 255"),
            Self::ThirdText { key } => write!(
                f,
                "the text `{key}` cannot be written, as it is the third beside `Software`, expected two at most"
            ),
            Self::NotFilled => f.write_str("the picture was not written"),
            Self::Encoder(detail) => write!(f, "cannot be written: {detail}"),
            Self::Io(error) => write!(f, "cannot be written: {error}"),
        }
    }
}
