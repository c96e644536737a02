//! What is measured of the looks and their forms: speed, error, behaviour on hard inputs, time on a graphics card; and pictures such as
//! a camera gives to measure on.
//!
//! `cargo bench` runs the benchmarks in a few minutes, `cargo bench --bench apply` one file of them. `peers/` runs other programs
//! beside ours. The modules are what `cargo xtask report`, `stability`, `gpu-bench`, `fidelity`, `certify --buffers`, `stocks --fidelity` and
//! `stocks --certify` print
//! and write; they return values and text, and write nothing.

pub mod buffers;
mod calendar;
pub mod certified_pairs;
mod described_look;
pub mod effect_decisions;
mod error;
pub mod fidelity;
mod form;
#[cfg(feature = "gpu")]
pub mod gpu;
mod look;
mod picture;
mod pool;
mod progress;
pub mod report;
pub mod sheet_fidelity;
pub mod stability;

pub use described_look::DescribedLook;
pub use error::Error;
pub use form::Form;
pub use look::{Forms, NEGATIVE, PLAIN_SIZE, PROCESSES, REVERSAL, SHAPER, film, plain, shaper};
pub use picture::{FULL_HD, Size, ULTRA_HD, coded, natural};
pub use pool::{Threads, pool};
pub use progress::{OnProgress, Progress};
