//! One module for each command: its arguments, `run`, and the report it gives.

pub(crate) mod bake;
pub(crate) mod certify;
pub(crate) mod compare;
pub(crate) mod darkroom;
pub(crate) mod develop;
pub(crate) mod fidelity;
pub(crate) mod fixtures;
pub(crate) mod gpu_bench;
pub(crate) mod light;
pub(crate) mod report;
pub(crate) mod stability;
pub(crate) mod stocks;
pub(crate) mod tidy;
