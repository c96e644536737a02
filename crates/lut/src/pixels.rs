//! Pictures as they lie in memory, and applying a form to them.

mod half_bits;
mod map;
mod raw;
mod run;
mod sample;
mod samples;
mod simd_level;
mod staged;
mod transfer;
mod view;

pub use map::PixelMap;
pub use sample::Sample;
pub use simd_level::SimdLevel;
pub use staged::StagedMap;
pub use view::{Channels, Pixels, PixelsMut};
