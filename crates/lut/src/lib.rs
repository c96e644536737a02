//! Look-up tables as bare numbers: a map `[f32; 3] -> [f32; 3]`, baked once and applied to every pixel.
//!
//! - [`Shaper`] turns a scene-linear value in `[0, max]` into a table coordinate in `[0, 1]` and back;
//! - [`Lut3d`] and [`Lut1d`] are the tables, [`Interpolation`] how a 3D table is read between its nodes;
//! - [`bake()`] fills a [`Lut3d`] from any closure, [`PlainLut`] applies it to pixels;
//! - [`deviation()`] measures one map against another under a difference given as a closure,
//!   over colours such as those of [`SceneSampler`];
//! - [`certify`] looks for everything a map may get wrong, and [`Certificate`] says it.
//!
//! What the three numbers of an entry mean (display code values, densities, anything else) is the caller's
//! affair: entries come out as they went in.
//!
//! Arithmetic is `f64` until a table is filled and `f32` from then on. Constructors check their input; after
//! that nothing fails. An input that is NaN reads as 0, one outside a table's domain reads as the nearest end.
//!
//! ```
//! use onelight_lut::{bake, Interpolation, PlainLut, Shaper};
//!
//! // A toy tone curve; a real look would come from a film simulation.
//! let look = |rgb: [f64; 3]| rgb.map(|u| u / (u + 0.18));
//!
//! let shaper = Shaper::log2(0.02, 4.0)?;
//! let table = bake(17, &shaper, look, |_nodes_done| {})?;
//! let lut = PlainLut::new(shaper, table, Interpolation::Tetrahedral);
//! assert!((lut.apply([0.18; 3])[0] - 0.5).abs() < 2e-3);
//! # Ok::<(), onelight_lut::Error>(())
//! ```
//!
//! # Out of scope
//!
//! Colour science (what a difference between two colours is arrives as a closure), images, files (`onelight-formats` reads and
//! writes those of tables), and applying a table on a GPU.

/// The README's Rust blocks are compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod bake;
mod certificate;
mod coding;
mod deviation;
mod domain;
mod error;
mod exponential_sum;
mod fit;
mod form;
mod interpolate;
mod kernel;
mod log2_exp2;
mod lut1d;
mod lut3d;
mod number;
mod padded;
mod pixels;
mod scene_light;
mod scene_sampler;
mod shaper;
mod split_mix64;
mod storage;

pub use bake::{bake, bake_coordinates, bake_form};
pub use certificate::{
    Band, Certificate, ColourSet, Fall, Folds, HueSteps, Maps, NeutralAxis, Samples, SamplingLaw, Search, SetDeviation,
    certify,
};
pub use coding::{CodingStandard, PowerCoding};
pub use deviation::{Deviation, deviation};
pub use domain::Domain;
pub use error::Error;
pub use exponential_sum::{ExponentialSum, ExponentialTerm};
pub use fit::{FitSample, FitSettings, fit};
pub use form::develop::{Coupling, Develop};
pub use form::direct::{DirectForm, DirectParts, DirectPrint};
pub use form::expose::{Expose, NegativeLight};
pub use form::plain::PlainLut;
pub use form::structured::{Decode, Mix, StructuredLut, StructuredParts};
pub use interpolate::Interpolation;
pub use lut1d::Lut1d;
pub use lut3d::Lut3d;
pub use pixels::{Channels, PixelMap, Pixels, PixelsMut, Sample, SimdLevel, StagedMap};
pub use scene_light::{IDENTITY, LOG_FLOOR, Rows, SCENE_MAX, finite};
pub use scene_sampler::SceneSampler;
pub use shaper::{Shaper, ShaperKind, texel_centre};
pub use split_mix64::SplitMix64;
pub use storage::Storage;
