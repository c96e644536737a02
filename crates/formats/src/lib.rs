//! Text and binary forms in which tables travel to other programs.

pub(crate) mod clf;
pub(crate) mod cube;
pub(crate) mod hald;
pub(crate) mod ktx2;
pub(crate) mod picture;
pub(crate) mod spi3d;
pub(crate) mod strip;
mod text;
