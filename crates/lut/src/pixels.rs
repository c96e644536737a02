//! Pictures as they lie in memory, and applying a form to them.

mod map;
mod sample;
mod view;

pub use map::PixelMap;
pub use sample::Sample;
pub use view::{Channels, Pixels, PixelsMut};
