//! The files in which looks travel: read and written as text or bytes, within limits.
//!
//! | Files | Read and written by | Feature |
//! |---|---|---|
//! | `.cube` of Adobe and Resolve | [`CubeFile`] | `cube` |
//! | Common LUT Format, `.clf` | [`ClfProcess`] | `clf` |
//! | `.3dl` of Lustre and Flame, `.vlt` of Panasonic's cameras | [`lut_3dl`], [`vlt`] (written only) | `cube` |
//! | `.spi3d` | [`spi3d`] | `spi3d` |
//! | OpenColorIO configuration with looks as views | [`OcioConfig`] (written only) | `ocio` |
//! | Hald CLUT, a PNG for photo editors | [`hald`] | `pictures` |
//! | strip, a PNG for game engines | [`strip`] | `pictures` |
//! | KTX2, a 3D texture | [`ktx2`] (written only) | `ktx2` |
//! | JSON of a direct form | [`direct_json`] | `direct-json` |
//!
//! All features are on by default. An engine that loads `look.direct.json` alone depends on this crate with
//! `default-features = false, features = ["direct-json"]`, and compiles neither XML nor PNG.
//!
//! # One way to read and write
//!
//! A file that holds a table or a form and nothing else is read and written by functions of its module; one that holds more (a
//! title, several operations) is a type with methods of the same names.
//!
//! - `read` takes a reader, to its end; `parse` takes text; both check all they return, so that what was read can be applied.
//! - `write` takes a writer first, and writes in blocks: the writer needs no buffer.
//! - Comments are lines of text, without the mark that a format puts before them. Control characters become spaces.
//!
//! ```
//! # #[cfg(all(feature = "cube", feature = "ktx2"))] {
//! use onelight_formats::{CubeFile, ktx2};
//! use onelight_lut::Interpolation;
//!
//! let file = CubeFile::parse("LUT_3D_SIZE 2\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n0.5 0.5 0.5\n")?;
//! assert_eq!(file.apply([1.0, 1.0, 1.0], Interpolation::Tetrahedral), [0.5; 3]);
//!
//! let mut texture = Vec::new();
//! if let Some(table) = file.lut3d() {
//!     ktx2::write(&mut texture, table, ["from a .cube"])?;
//! }
//! assert!(!texture.is_empty());
//! # }
//! # Ok::<(), onelight_formats::Error>(())
//! ```
//!
//! # Limits
//!
//! A size in a header is a claim: memory is taken as numbers come, and each reader states the most bytes, lines and entries that
//! it takes. What is refused is refused with an [`Error`] in one sentence. Numbers that are not finite are refused everywhere.
//!
//! # Out of scope
//!
//! Paths (readers and writers are passed in), pictures that hold no table, and colour science: what the numbers of a table
//! mean is the caller's affair. Tables and forms themselves, and how they are applied to pixels, are `onelight-lut`.

#![cfg_attr(docsrs, feature(doc_cfg))]
#![cfg_attr(
    not(all(
        feature = "cube",
        feature = "clf",
        feature = "spi3d",
        feature = "ocio",
        feature = "pictures",
        feature = "ktx2",
        feature = "dctl",
        feature = "direct-json"
    )),
    allow(dead_code, reason = "pieces that a family of files left out has in common with others")
)]

#[cfg(feature = "clf")]
mod clf;
#[cfg(feature = "cube")]
mod cube;
#[cfg(feature = "dctl")]
pub mod dctl;
#[cfg(feature = "direct-json")]
pub mod direct_json;
mod error;
#[cfg(feature = "pictures")]
pub mod hald;
#[cfg(feature = "ktx2")]
pub mod ktx2;
#[cfg(feature = "cube")]
pub mod lut_3dl;
mod node_order;
#[cfg(feature = "ocio")]
mod ocio;
#[cfg(feature = "pictures")]
mod picture;
#[cfg(feature = "spi3d")]
pub mod spi3d;
#[cfg(feature = "pictures")]
pub mod strip;
mod text;
#[cfg(feature = "cube")]
pub mod vlt;

#[cfg(feature = "clf")]
pub use clf::ClfProcess;
#[cfg(feature = "cube")]
pub use cube::CubeFile;
pub use error::Error;
#[cfg(feature = "ocio")]
pub use ocio::{OcioConfig, OcioSpace, OcioView};
#[cfg(feature = "pictures")]
pub use picture::PngDepth;
#[cfg(feature = "pictures")]
pub use strip::StripGreen;

/// The Rust of README.md, which the documentation tests compile and run.
#[cfg(all(doctest, feature = "cube", feature = "direct-json"))]
#[doc = include_str!("../README.md")]
pub struct ReadmeDoctests;
