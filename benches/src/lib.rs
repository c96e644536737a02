//! What the benchmarks measure on: pictures such as a camera gives, and one look in every form.
//!
//! `cargo bench` runs them all in a few minutes, `cargo bench --bench apply` one file of them. `peers/` runs other programs
//! beside ours.

mod look;
mod picture;
mod pool;

pub use look::{Forms, NEGATIVE, PLAIN_SIZE, PROCESSES, REVERSAL, SHAPER, film, plain, shaper};
pub use picture::{FULL_HD, Size, ULTRA_HD, coded, natural};
pub use pool::{Threads, pool};
