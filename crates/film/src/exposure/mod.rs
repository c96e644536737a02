//! From light to the exposure of each layer: step 4 of \[Gotanda2010\].

mod camera;
mod matching;

pub use camera::{Camera, FrameBufferScale};
pub use matching::{ExposureMatrix, Matching};
