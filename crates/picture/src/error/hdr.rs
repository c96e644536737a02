use std::fmt;

use super::class::Class;

/// What a Radiance picture has wrong, or is not read.
#[derive(Debug)]
pub(crate) enum HdrProblem {
    /// A line of the header without an end.
    Header,
    Format {
        found: String,
    },
    Resolution {
        found: String,
    },
    /// A scan line whose runs do not fit its width.
    ScanLine {
        row: usize,
    },
}

impl HdrProblem {
    pub(super) fn class(&self) -> Class {
        match self {
            Self::Format { .. } => Class::Unsupported,
            _ => Class::Damaged,
        }
    }
}

impl fmt::Display for HdrProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Header => f.write_str("the Radiance picture's header has no end (is it truncated?)"),
            Self::Format { found } => {
                write!(f, "the Radiance picture's format is `{found}`, expected 32-bit_rle_rgbe or 32-bit_rle_xyze")
            }
            Self::Resolution { found } => {
                write!(f, "the Radiance picture's size is `{found}`, expected one such as `-Y 1080 +X 1920`")
            }
            Self::ScanLine { row } => {
                write!(f, "scan line {} of the Radiance picture has runs that do not fit its width", row + 1)
            }
        }
    }
}
