use std::fmt;

use super::class::Class;

/// What costs more than it may, or claims to.
#[derive(Debug)]
pub(crate) enum LimitProblem {
    /// Neither width nor height may be 0.
    Empty {
        what: &'static str,
        size: [u64; 2],
    },
    Side {
        what: &'static str,
        size: [u64; 2],
        max: u64,
    },
    Pixels {
        what: &'static str,
        size: [u64; 2],
        max: u64,
    },
    Bytes {
        what: &'static str,
        size: [u64; 2],
        bytes: u64,
        max: u64,
    },
    Display {
        display: [u64; 2],
        data: [u64; 2],
        max_times: u64,
        max_pixels: u64,
    },
    /// More samples than a file so long can hold.
    Claim {
        size: [u64; 2],
        samples: u64,
        length: u64,
    },
    /// The system has no more memory.
    Memory {
        bytes: usize,
    },
}

impl LimitProblem {
    pub(super) fn class(&self) -> Class {
        match self {
            Self::Empty { .. } | Self::Claim { .. } => Class::Damaged,
            _ => Class::Limit,
        }
    }
}

impl fmt::Display for LimitProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Empty { what, size: [width, height] } => {
                write!(f, "{what} is {width} x {height} pixels, expected at least 1 x 1")
            }
            Self::Side { what, size: [width, height], max } => {
                write!(f, "{what} is {width} x {height} pixels, expected sides up to {max}")
            }
            Self::Pixels { what, size: [width, height], max } => {
                write!(f, "{what} is {width} x {height} pixels, expected up to {max} pixels")
            }
            Self::Bytes { what, size: [width, height], bytes, max } => write!(
                f,
                "{what} of {width} x {height} pixels takes {} MiB of memory at once, expected up to {} MiB",
                bytes.div_ceil(1 << 20),
                max >> 20
            ),
            Self::Display { display, data, max_times, max_pixels } => write!(
                f,
                "the display window is {} x {} pixels for a data window of {} x {}, expected at most {max_times} times \
                 as many, or {max_pixels} pixels",
                display[0], display[1], data[0], data[1]
            ),
            Self::Claim { size: [width, height], samples, length } => write!(
                f,
                "the header claims {width} x {height} pixels ({samples} bytes of samples), which a file of {length} bytes \
                 cannot hold (is it truncated?)"
            ),
            Self::Memory { bytes } => write!(f, "there is no memory for {} MiB of pixels", bytes >> 20),
        }
    }
}
