use std::fmt;

use super::class::Class;

/// What a TIFF has wrong, or is not read.
#[derive(Debug)]
pub(crate) enum TiffProblem {
    Colours {
        found: String,
    },
    Bits {
        found: u8,
    },
    SampleFormat,
    TiledPlanes,
    Planes {
        found: usize,
        expected: usize,
    },
    ChunkSize {
        found: [u32; 2],
    },
    /// More strips or tiles than can be counted.
    Chunks,
    SampleCount {
        found: usize,
        size: [usize; 2],
        channels: usize,
    },
    Tag {
        tag: u64,
        count: u64,
        max: u64,
    },
    /// The decoder's own limits, which the picture's size sets.
    Memory,
    Damaged(String),
    Unreadable(String),
}

impl TiffProblem {
    pub(super) fn class(&self) -> Class {
        match self {
            Self::Colours { .. } | Self::Bits { .. } | Self::SampleFormat | Self::TiledPlanes => Class::Unsupported,
            Self::Chunks | Self::Memory | Self::Tag { .. } => Class::Limit,
            _ => Class::Damaged,
        }
    }
}

impl fmt::Display for TiffProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Colours { found } => {
                write!(f, "the TIFF's pixels are {found}, expected grey or RGB, with or without alpha")
            }
            Self::Bits { found } => {
                write!(f, "the TIFF has {found} bits a sample, expected 8, 16 or 32, or floating point")
            }
            Self::SampleFormat => {
                f.write_str("the TIFF's samples are signed or 64-bit integers, expected unsigned or floating point")
            }
            Self::TiledPlanes => {
                f.write_str("the TIFF keeps its channels apart and in tiles, expected tiles of whole pixels, or strips")
            }
            Self::Planes { found, expected } => {
                write!(f, "the TIFF gives its samples in {found} planes, expected {expected} channels")
            }
            Self::ChunkSize { found: [width, height] } => {
                write!(f, "the TIFF's strips or tiles are {width} x {height} pixels, expected at least 1 x 1")
            }
            Self::Chunks => f.write_str("the TIFF has more strips or tiles than can be counted in 32 bits"),
            Self::SampleCount { found, size: [width, height], channels } => write!(
                f,
                "the TIFF gives {found} samples for {width} x {height} pixels of {channels} channels in a strip or tile"
            ),
            Self::Tag { tag, count, max } => write!(
                f,
                "the TIFF's tag {tag} claims {count} numbers, expected at most {max}, and no more than the file holds"
            ),
            Self::Memory => f.write_str("the TIFF asks for more memory than its size explains"),
            Self::Damaged(detail) => write!(f, "the TIFF is damaged: {detail}"),
            Self::Unreadable(detail) => write!(f, "the TIFF cannot be read: {detail}"),
        }
    }
}
