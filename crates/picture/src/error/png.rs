use std::fmt;

use super::class::Class;

/// What a PNG has wrong.
#[derive(Debug)]
pub(crate) enum PngProblem {
    PaletteMissing,
    /// A row or the picture has more bytes than can be counted.
    TooLarge,
    FewerRows,
    /// Texts and profiles beside the pixels.
    Chunks {
        max: usize,
    },
    /// What the decoder says of it, if it says anything.
    Damaged(Option<String>),
}

impl PngProblem {
    pub(super) fn class(&self) -> Class {
        match self {
            Self::TooLarge | Self::Chunks { .. } => Class::Limit,
            Self::PaletteMissing | Self::FewerRows | Self::Damaged(_) => Class::Damaged,
        }
    }
}

impl fmt::Display for PngProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::PaletteMissing => f.write_str("the PNG's palette is missing"),
            Self::TooLarge => f.write_str("the PNG is too large"),
            Self::FewerRows => f.write_str("the PNG has fewer rows than its header says"),
            Self::Chunks { max } => write!(f, "the PNG's chunks need more than {} MiB", max >> 20),
            Self::Damaged(None) => f.write_str("the PNG is damaged"),
            Self::Damaged(Some(detail)) => write!(f, "the PNG is damaged: {detail}"),
        }
    }
}
