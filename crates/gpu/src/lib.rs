//! Film looks on the GPU, inside the user's own frame: [`FilmPass`] develops a texture by a form of `onelight-lut`.
//!
//! ```no_run
//! # use onelight_gpu::wgpu;
//! # fn frame(
//! #     device: &wgpu::Device, queue: &wgpu::Queue, encoder: &mut wgpu::CommandEncoder,
//! #     hdr: &wgpu::TextureView, display: &wgpu::TextureView,
//! #     look: &onelight_lut::StructuredLut, other: &onelight_lut::StructuredLut,
//! # ) -> Result<(), onelight_gpu::Error> {
//! use onelight_gpu::FilmPass;
//!
//! // Once, with the device of the frame.
//! let film = FilmPass::new(device, queue, look, wgpu::TextureFormat::Rgba8Unorm)?;
//! // In every frame, with the frame's own encoder.
//! film.encode(encoder, hdr, display)?;
//! // Another stock: an upload, no pipeline, no wait.
//! film.upload(queue, other)?;
//! # Ok(())
//! # }
//! ```
//!
//! - [`FilmPass::encode`] writes a texture, [`FilmPass::draw`] into a render pass of the user's;
//! - [`wgsl`] and [`BoundLook`] are the same for a shader of the user's: `onelight_develop(rgb)`; with [`LookBytes`] also
//!   without wgpu, or with another version of it;
//! - `SpatialPass` (with the feature `spatial`) is a [`FilmPass`] with sharpness, halation and grain;
//! - [`TableBake`] fills the table of a plain form from a direct form, on the GPU;
//! - `Headless` (with the feature `native`) opens a device without a window and reads back what it made.
//!
//! The device, the queue and the submission are the user's. No backend is chosen here: the program enables one of
//! wgpu's (`wgpu = { version = "30", features = ["vulkan"] }`), or the feature `native` of this crate.
//!
//! # What is the same as on the CPU
//! Functions of the shaders name their twins. Into 32-bit floats, with the table in 32-bit floats and [`Fetch::Texels`],
//! the result lies within 1e-5 of the CPU's wherever the driver's `exp2` and `log2` are as exact as WGSL demands; see
//! below. Hard inputs have the same results: NaN counts as 0, infinities as ±1e30, negative scene light as 0. Alpha goes
//! through; in it NaN becomes 0, and what lies beyond ±1e30 becomes that.
//!
//! # Out of scope
//! Windows, surfaces, and the user's own device. Pictures of more than [`MAX_SIDE`] pixels a side.

mod bake;
mod bound;
mod bytes;
mod check;
mod error;
mod form;
#[cfg(feature = "native")]
mod headless;
#[cfg(test)]
mod layout;
mod pass;
mod pipeline;
mod settings;
mod shader;
#[cfg(feature = "spatial")]
mod spatial;
mod target;
#[cfg(test)]
mod translation;
mod uniform;

pub use bake::TableBake;
pub use bound::BoundLook;
pub use bytes::{CURVE_ROWS, CurveBytes, LookBytes, MAX_POINTS, TableBytes};
pub use check::MAX_SIDE;
pub use error::Error;
pub use form::{Form, FormKind};
#[cfg(feature = "native")]
pub use headless::{Headless, HeadlessSettings};
pub use pass::FilmPass;
pub use settings::{Bindings, Fetch, LookSettings};
pub use shader::wgsl;
#[cfg(feature = "spatial")]
pub use spatial::SpatialPass;
pub use uniform::MAX_TERMS;
pub use wgpu;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
