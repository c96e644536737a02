//! Laws of the effects, on the films that have the figures.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails loudly")]

mod auto;
mod bands;
mod film;
mod grain;
mod halation;
mod hard_inputs;
mod microdensitometer;
mod mtf;
mod uniform;
