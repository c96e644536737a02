//! The forms on a graphics card: time beside a plain copy, and difference from the film.

mod card;
mod copy;
mod difference;
mod measure;
mod pictures;
mod summary;

pub use summary::{Summary, measure};
