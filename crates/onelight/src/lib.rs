//! Film simulation for HDR pictures: a [`Process`] names a camera film, a print film and the lights between them;
//! [`Reference`] is that look, exact.
//!
//! ```
//! // A scene-linear colour on Kodak 5207, printed on 2383 and shown on an sRGB display.
//! let film = onelight::Process::default().compile()?;
//! let display = film.develop([2.0, 0.5, 0.1]);
//! assert!(display[0] > display[1] && display[1] > display[2]);
//!
//! // Where it comes from: exposure, dye, light.
//! let stages = film.stages([2.0, 0.5, 0.1]);
//! assert!(stages.amounts.red.0 > stages.amounts.blue.0);
//! # Ok::<(), onelight::Error>(())
//! ```
//!
//! # Out of scope
//! Files (all text comes in as `&str`), grain and halation. Keys in square brackets are resolved in REFERENCES.md at the top
//! of the repository.

mod bake;
mod direct;
mod error;
mod process;
mod reference;
mod stocks;
mod structured;
mod word;

pub use direct::{DirectSettings, Nodes};
pub use error::Error;
pub use onelight_film as film;
pub use onelight_film::{DyeModel, Matching, Stock, StockKind, Tail};
#[cfg(feature = "gpu")]
pub use onelight_gpu as gpu;
pub use onelight_lut as lut;
pub use onelight_printing as printing;
pub use onelight_printing::{Aim, HeatGlass, Infrared, Projector};
pub use onelight_spectra as spectra;
pub use onelight_spectra::{Reconstruction, TransferCurve};
pub use process::{DEFAULT_CAMERA, DEFAULT_PRINT, FormatVersion, Process};
pub use reference::{Reference, SCENE_MAX, Stages};
pub use stocks::{stock, stock_ids};
pub use structured::{Entries, StructuredSettings, TableCoding};
pub use word::{Word, WorkingSpace};
