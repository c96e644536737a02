//! From light to the exposure of each layer: step 4 of \[Gotanda2010\].

mod camera;
mod matching;
mod wide_gamut;

pub use camera::{Camera, FrameBufferScale};
pub use matching::{ExposureMatrix, Matching};
pub use wide_gamut::WideGamut;
