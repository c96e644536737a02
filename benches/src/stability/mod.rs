//! Every implementation of a look on inputs that are hard: whether results stay finite and monotone, and how far they lie apart.
//!
//! Cards are tried with the feature `gpu` only.

mod cases;
mod gpu;
mod hard_inputs;
mod implementations;
mod law;
mod measure;
mod page;
#[cfg(test)]
mod tests;

pub use gpu::Card;
pub use implementations::Kind;
pub use measure::{Quantity, Row, STEPS, Worst, rows};
pub use page::Contents;
