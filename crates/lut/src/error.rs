use std::{error, fmt};

/// What went wrong in this crate: a parameter, a table or pixels that cannot be used.
///
/// The message is one sentence that says what, where, what was found and what was expected.
///
/// ```
/// let error = onelight_lut::Lut3d::identity(1).unwrap_err();
/// assert_eq!(error.to_string(), "size of the 3D LUT: found 1, expected 2 to 256");
/// ```
#[derive(Debug)]
pub struct Error(Box<ErrorKind>);

/// The reasons behind an [`Error`].
#[derive(Debug)]
pub(crate) enum ErrorKind {
    Parameter { what: &'static str, found: f64, expected: &'static str },
    Size { what: &'static str, found: usize, min: usize, max: usize },
    EntryCount { size: usize, found: usize, expected: usize },
    Entry1d { index: usize, found: [f32; 3] },
    Entry3d { node: [usize; 3], found: [f32; 3] },
    BakedNode { node: [usize; 3], linear: [f64; 3], found: [f32; 3] },
    Domain { min: [f32; 3], max: [f32; 3] },
    NoSamples,
    Difference { index: usize, sample: [f64; 3], found: f64 },
    DifferenceCount { found: usize, expected: usize },
    PixelLayout { width: usize, height: usize, channels: usize, stride: usize, len: usize },
    PictureSizes { from: [usize; 2], to: [usize; 2] },
}

impl From<ErrorKind> for Error {
    fn from(kind: ErrorKind) -> Self {
        Self(Box::new(kind))
    }
}

impl error::Error for Error {}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &*self.0 {
            ErrorKind::Parameter { what, found, expected } => write!(f, "{what}: found {found}, expected {expected}"),
            ErrorKind::Size { what, found, min, max } => {
                write!(f, "size of the {what}: found {found}, expected {min} to {max}")
            }
            ErrorKind::EntryCount { size, found, expected } => {
                write!(f, "entries of a 3D LUT of size {size}: found {found}, expected {expected}")
            }
            ErrorKind::Entry1d { index, found } => {
                write!(f, "entry {index} of a 1D LUT: found {found:?}, expected numbers within ±1e38")
            }
            ErrorKind::Entry3d { node, found } => {
                write!(f, "entry of a 3D LUT at node {node:?}: found {found:?}, expected numbers within ±1e38")
            }
            ErrorKind::PixelLayout { width, height, channels, stride, len } => write!(
                f,
                "picture of {width}x{height} pixels, {channels} samples each, rows {stride} samples apart: found {len} samples, expected at least as many as that takes, and rows no longer than their distance"
            ),
            ErrorKind::PictureSizes { from, to } => write!(
                f,
                "size of the picture to write: found {}x{}, expected {}x{} as in the one to read",
                to[0], to[1], from[0], from[1]
            ),
            ErrorKind::BakedNode { node, linear, found } => write!(
                f,
                "baked function at node {node:?}, linear {linear:?}: found {found:?}, expected numbers finite in f32"
            ),
            ErrorKind::Domain { min, max } => write!(
                f,
                "domain of a table: found {min:?} to {max:?}, expected finite ends with the second above the first"
            ),
            ErrorKind::NoSamples => f.write_str("samples of a deviation: found none, expected at least one"),
            ErrorKind::Difference { index, sample, found } => {
                write!(f, "difference at sample {index}, {sample:?}: found {found}, expected a finite number")
            }
            ErrorKind::DifferenceCount { found, expected } => {
                write!(f, "differences of a deviation: found {found}, expected {expected}, one for each sample")
            }
        }
    }
}
