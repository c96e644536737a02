use std::fmt;

use super::class::Class;

/// What a JPEG has wrong, or is not read.
#[derive(Debug)]
pub(crate) enum JpegProblem {
    /// Bytes of the file, which is held whole.
    Length {
        found: u64,
        max: u64,
    },
    NoFrame,
    Cmyk,
    Components,
    Bits {
        found: u8,
    },
    Process {
        found: &'static str,
    },
    /// What the decoder says of it.
    Damaged(String),
}

impl JpegProblem {
    pub(super) fn class(&self) -> Class {
        match self {
            Self::Length { .. } => Class::Limit,
            Self::Cmyk | Self::Components | Self::Bits { .. } | Self::Process { .. } => Class::Unsupported,
            Self::NoFrame | Self::Damaged(_) => Class::Damaged,
        }
    }
}

impl fmt::Display for JpegProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length { found, max } => {
                write!(f, "the JPEG has {} MiB, expected up to {} MiB", found.div_ceil(1 << 20), max >> 20)
            }
            Self::NoFrame => f.write_str("the JPEG has no picture"),
            Self::Cmyk => f.write_str(
                "the JPEG is of CMYK inks, expected grey or RGB (convert it in a program that knows its inks)",
            ),
            Self::Components => f.write_str("the JPEG has channels of no known kind, expected grey or RGB"),
            Self::Bits { found } => write!(f, "the JPEG has {found} bits a sample, expected 8"),
            Self::Process { found } => {
                write!(f, "the JPEG is {found}, expected baseline or progressive with Huffman codes")
            }
            Self::Damaged(detail) => write!(f, "the JPEG is damaged: {detail}"),
        }
    }
}
