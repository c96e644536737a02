//! The compiled forms: what stands between a scene-linear pixel and the baked numbers.

pub(crate) mod develop;
pub(crate) mod direct;
pub(crate) mod expose;
pub(crate) mod plain;
pub(crate) mod structured;
