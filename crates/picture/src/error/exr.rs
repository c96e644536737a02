use std::fmt;

use super::class::Class;
use crate::decoder_message::one_line;

/// What an OpenEXR file has wrong, or is not read.
#[derive(Debug)]
pub(crate) enum ExrProblem {
    HeaderUnreadable(String),
    HeaderWrong(String),
    /// Columns left and right, rows top and bottom, as the header has them.
    EmptyWindow {
        what: &'static str,
        columns: [i32; 2],
        rows: [i32; 2],
    },
    DeepData,
    Channels {
        found: String,
    },
    /// Layers of which none is the picture.
    NoBeauty {
        found: String,
    },
    NoLayer {
        asked: String,
        found: String,
    },
    NoPart {
        asked: String,
        found: String,
    },
    Compression {
        found: String,
    },
    Subsampled {
        channel: String,
        step: [usize; 2],
    },
    TileSide {
        found: [usize; 2],
        max: u64,
    },
    TableEndsEarly {
        count: usize,
    },
    /// A block, counted from 1, and what is wrong with it.
    Block {
        number: usize,
        count: usize,
        problem: BlockProblem,
    },
    Pixels(PixelProblem),
}

/// What is wrong with a block where it lies in the file.
#[derive(Debug)]
pub(crate) enum BlockProblem {
    Missing,
    BeyondEnd,
    CutOff,
    Misplaced,
    Size { found: i64, max: i64 },
}

/// What is wrong with a block that is unpacked.
#[derive(Debug)]
pub(crate) enum PixelProblem {
    /// What the decoder says of it, cut and on one line.
    Decoder(String),
    DwaTooShort {
        bytes: usize,
    },
    DwaClaim {
        what: &'static str,
        claimed: u64,
        max: u64,
    },
}

/// The compressions that are read, for messages.
const COMPRESSIONS: &str = "none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA or DWAB";

impl ExrProblem {
    pub(super) fn class(&self) -> Class {
        match self {
            Self::DeepData
            | Self::Channels { .. }
            | Self::NoBeauty { .. }
            | Self::NoLayer { .. }
            | Self::NoPart { .. }
            | Self::Subsampled { .. }
            | Self::Compression { .. } => Class::Unsupported,
            Self::TileSide { .. } => Class::Limit,
            _ => Class::Damaged,
        }
    }
}

impl fmt::Display for ExrProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::HeaderUnreadable(detail) => write!(f, "the OpenEXR header cannot be read: {detail}"),
            Self::HeaderWrong(detail) => write!(f, "the OpenEXR header is wrong: {detail}"),
            Self::EmptyWindow { what, columns: [left, right], rows: [top, bottom] } => {
                write!(f, "{what} is empty: from column {left} to {right} and row {top} to {bottom}")
            }
            Self::DeepData => f.write_str("the file holds deep data, expected a flat picture (flatten it first)"),
            Self::Channels { found } => {
                write!(
                    f,
                    "found the channels {found}, expected R, G and B, or X, Y and Z, or Y, RY and BY, or Y, or a single one"
                )
            }
            Self::NoBeauty { found } => write!(
                f,
                "found {found}, none of which is called a finished picture, expected R, G and B without a layer name or \
                 a layer to be chosen"
            ),
            Self::NoLayer { asked, found } => {
                write!(f, "there is no layer `{asked}` that makes a picture, found {found}")
            }
            Self::NoPart { asked, found } => write!(f, "there is no part {asked}, found the parts {found}"),
            Self::Compression { found } => write!(f, "found {found} compression, expected {COMPRESSIONS}"),
            Self::Subsampled { channel, step: [x, y] } => write!(
                f,
                "the channel `{channel}` is subsampled {x} x {y}, expected a sample at every pixel (RY and BY: or at every other)"
            ),
            Self::TileSide { found: [width, height], max } => {
                write!(f, "a tile is {width} x {height} pixels, expected sides up to {max}")
            }
            Self::TableEndsEarly { count } => {
                write!(f, "the file ends within its table of {count} blocks (is it truncated?)")
            }
            Self::Block { number, count, problem } => write!(f, "block {number} of {count} {problem}"),
            Self::Pixels(problem) => write!(f, "the pixels are damaged: {problem}"),
        }
    }
}

impl fmt::Display for BlockProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Missing => f.write_str("is missing (the file was not finished)"),
            Self::BeyondEnd => f.write_str("lies beyond the end of the file (is it truncated?)"),
            Self::CutOff => f.write_str("is cut off by the end of the file (is it truncated?)"),
            Self::Misplaced => f.write_str("is not where the table of blocks puts it (the file is damaged)"),
            Self::Size { found, max } => write!(f, "has {found} bytes, expected 1 to {max} (the file is damaged)"),
        }
    }
}

impl fmt::Display for PixelProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Decoder(detail) => f.write_str(detail),
            Self::DwaTooShort { bytes } => write!(f, "a DWA block of {bytes} bytes is too short"),
            Self::DwaClaim { what, claimed, max } => {
                write!(f, "a DWA block claims {claimed} {what}, expected up to {max}")
            }
        }
    }
}

/// The `exr` crate's message made part of a sentence.
pub(crate) fn message(error: &::exr::error::Error) -> String {
    use ::exr::error::Error;
    let message = match error {
        Error::NotSupported(what) => format!("not supported: {what}"),
        Error::Invalid(what) if what == "reference to missing bytes" => {
            "the file ends too early (is it truncated?)".to_owned()
        }
        Error::Invalid(what) if what.starts_with("missing or invalid") => what.to_string(),
        Error::Invalid(what) => format!("invalid {}", what.replace("(invalid: ", "(")),
        other => other.to_string(),
    };
    one_line(&message)
}
