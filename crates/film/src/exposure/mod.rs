//! From light to the exposure of each layer: step 4 of \[Gotanda2010\].

mod camera;
mod matching;

/// Scene value of mid grey.
const MID_GREY: f64 = 0.18;
/// Exposure in lux s that a metered mid grey gets, times the exposure index.
const METERED_LUX_S: f64 = 8.1;

pub use camera::{Camera, FrameBufferScale};
pub use matching::{ExposureMatrix, Matching};
