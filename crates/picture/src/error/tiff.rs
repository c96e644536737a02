use std::fmt;

use super::class::Class;

/// What a TIFF has wrong, or is not read.
#[derive(Debug)]
pub(crate) enum TiffProblem {
    CameraRaw {
        what: &'static str,
    },
    NoPages,
    DirectoryBeyondEnd {
        at: u64,
        length: u64,
    },
    Entries {
        count: u64,
    },
    /// More numbers than any picture needs.
    Tag {
        tag: u16,
        count: u64,
        max: u64,
    },
    TagBeyondEnd {
        tag: u16,
        count: u64,
    },
    TagKind {
        tag: u16,
        kind: u16,
    },
    TagMissing {
        tag: u16,
    },
    Colours {
        found: String,
    },
    Compression {
        found: String,
    },
    Predictor {
        found: u64,
    },
    Bits {
        found: u64,
    },
    MixedSamples,
    SampleFormat,
    PaletteBits {
        found: u8,
    },
    Palette {
        found: usize,
        expected: usize,
    },
    Samples {
        found: u64,
        expected: usize,
        max: u64,
    },
    ChunkSize {
        found: [u64; 2],
        max: u64,
    },
    ChunkCount {
        found: u64,
        expected: u64,
    },
    ChunkBytes {
        found: usize,
        expected: usize,
    },
    PackedBytes {
        found: u64,
        max: u64,
    },
    Damaged(String),
}

impl TiffProblem {
    pub(super) fn class(&self) -> Class {
        match self {
            Self::CameraRaw { .. }
            | Self::Colours { .. }
            | Self::Compression { .. }
            | Self::Predictor { .. }
            | Self::Bits { .. }
            | Self::MixedSamples
            | Self::SampleFormat
            | Self::PaletteBits { .. } => Class::Unsupported,
            Self::Tag { .. } | Self::Entries { .. } | Self::PackedBytes { .. } => Class::Limit,
            _ => Class::Damaged,
        }
    }
}

impl fmt::Display for TiffProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::CameraRaw { what } => write!(
                f,
                "found {what}, which holds what a sensor saw and not a picture: expected what a raw converter makes of it \
                 (darktable or RawTherapee, exported as linear Rec.2020 float TIFF or as OpenEXR)"
            ),
            Self::NoPages => f.write_str("the TIFF has no picture"),
            Self::DirectoryBeyondEnd { at, length } => write!(
                f,
                "the TIFF's directory should lie at byte {at}, beyond the end of a file of {length} bytes (is it truncated?)"
            ),
            Self::Entries { count } => {
                write!(
                    f,
                    "the TIFF's directory claims {count} tags, expected at most 65535, and no more than the file holds"
                )
            }
            Self::Tag { tag, count, max } => {
                write!(f, "the TIFF's tag {tag} claims {count} numbers, expected at most {max}")
            }
            Self::TagBeyondEnd { tag, count } => write!(
                f,
                "the {count} numbers of the TIFF's tag {tag} lie beyond the end of the file (is it truncated?)"
            ),
            Self::TagKind { tag, kind } => {
                write!(f, "the TIFF's tag {tag} is of the type {kind}, expected unsigned integers")
            }
            Self::TagMissing { tag } => write!(f, "the TIFF's tag {tag} is missing, without which no picture is read"),
            Self::Colours { found } => {
                write!(f, "the TIFF's pixels are {found}, expected grey, palette or RGB, with or without alpha")
            }
            Self::Compression { found } => {
                write!(f, "the TIFF's compression is {found}, expected none, LZW, Deflate, PackBits or Zstandard")
            }
            Self::Predictor { found } => write!(
                f,
                "the TIFF's predictor is {found}, expected 1, 2 for samples of 8 bits or more, or 3 for floating point"
            ),
            Self::Bits { found } => {
                write!(
                    f,
                    "the TIFF has {found} bits a sample, expected 1, 2, 4, 8, 16 or 32, or floats of 16, 32 or 64"
                )
            }
            Self::MixedSamples => f.write_str("the TIFF's samples are of several kinds, expected one kind for all"),
            Self::SampleFormat => f.write_str(
                "the TIFF's samples are signed integers or of no known kind, expected unsigned or floating point",
            ),
            Self::PaletteBits { found } => {
                write!(f, "the TIFF's palette has numbers of {found} bits, expected whole numbers of 1 to 8 bits")
            }
            Self::Palette { found, expected } => {
                write!(f, "the TIFF's palette has {found} values, expected {expected}")
            }
            Self::Samples { found, expected, max } => {
                write!(f, "the TIFF has {found} samples a pixel, expected {expected} to {max}")
            }
            Self::ChunkSize { found: [width, height], max } => write!(
                f,
                "the TIFF's strips or tiles are {width} x {height} pixels, expected at least 1 x 1 and sides up to {max}"
            ),
            Self::ChunkCount { found, expected } => {
                write!(f, "the TIFF has {found} strips or tiles, expected {expected}")
            }
            Self::ChunkBytes { found, expected } => {
                write!(f, "a strip or tile of the TIFF unpacks to {found} bytes, expected {expected}")
            }
            Self::PackedBytes { found, max } => write!(
                f,
                "a strip or tile of the TIFF has {} MiB packed, expected up to {} MiB",
                found.div_ceil(1 << 20),
                max >> 20
            ),
            Self::Damaged(detail) => write!(f, "the TIFF is damaged: {detail}"),
        }
    }
}
