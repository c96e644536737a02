//! Every file against its own laws, against independent readers, and cut and changed until it must be refused.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails loudly")]

mod clf;
mod codes;
mod corpus;
mod cube;
mod dctl;
mod direct_json;
mod hald;
mod ktx2;
mod ocio;
mod spi3d;
mod strip;
mod tables;
