//! The shaders against their twins on whatever adapter there is, and their translations.
//!
//! `ONELIGHT_REQUIRE_GPU=llvmpipe` makes it an error if no adapter's name holds that word (in any case of letters);
//! empty or `1`, if there is none at all. Without the variable, a missing adapter skips these tests.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails loudly")]

mod adapter;
mod bake;
mod filtered;
mod formats;
mod hard_inputs;
mod looks;
mod parity;
mod picture;
mod refusals;
mod refused_textures;
mod sizes;
mod spatial;
mod upload;
