//! Text and binary forms in which tables travel to other programs.

pub(crate) mod cube;
