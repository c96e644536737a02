//! The inter-image effect: a developing layer holds back the development of its neighbours.

mod effect;
mod strength;

pub use effect::InterImageEffect;
pub use strength::{InterImage, InterImageOrigin};
