//! Pictures as they lie in memory, and applying a form to them.

mod half_bits;
mod map;
mod raw;
mod run;
mod sample;
mod transfer;
mod vectors;
mod view;

pub use map::PixelMap;
pub(crate) use run::map_colours;
pub use sample::Sample;
pub use vectors::Vectors;
pub use view::{Channels, Pixels, PixelsMut};
