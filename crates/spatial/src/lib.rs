//! What film does to a picture rather than to a colour: sharpness, adjacency, halation and grain, from data sheets.
//!
//! - [`FilmFormat`], [`Pitch`], [`Frame`]: how large the picture is on the film, and where it lies; nothing here has a radius in pixels
//! - [`Sharpness`]: scatter of light and adjacency of development, from the sheet's modulation transfer ([`MtfFit`])
//! - [`Halation`]: light that returns from the back of the base
//! - [`Grain`]: from the sheet's granularity ([`AmountGranularity`])
//! - [`SpatialStage`]: applies them to planes of exposures, in bands of rows; [`StageRun`] does it while a picture is read; [`Development`] and [`Finish`] are what comes between and after
//! - [`FirstPass`]: what must be known of a whole picture before its first row can be finished
//! - [`grain_decision`], [`SharpnessProbe`], [`HalationProbe`]: whether an effect can be seen in a picture, and why ([`Decision`])
//! - [`CONSTANTS`]: every number that is on no sheet of the film, with its origin
//!
//! ```
//! use onelight_film::{SheetText, Stock};
//! use onelight_spatial::{AmountGranularity, FilmFormat, Frame, Grain, GrainSettings, Planes, Sharpness, SpatialStage};
//!
//! let files = onelight_stocks::find("kodak-5219").ok_or("no such stock")?;
//! let stock = Stock::parse(&SheetText {
//!     id: files.id,
//!     stock_toml: files.stock_toml,
//!     sensitivity_csv: files.sensitivity_csv,
//!     characteristic_csv: files.characteristic_csv,
//!     dye_density_csv: files.dye_density_csv,
//! })?
//! .with_figures(files.mtf_csv, files.granularity_csv)?;
//!
//! let frame = Frame::new([256, 128], FilmFormat::Super16.pitch(2048, 1.0)?)?;
//! let grain = Grain::new(AmountGranularity::of_stock(&stock)?, frame.pitch(), GrainSettings::default())?;
//! let stage = SpatialStage::new(frame).with_sharpness(&Sharpness::of_stock(&stock)?).with_grain(grain)?;
//!
//! // A toy curve; a real one comes from the film.
//! let curve = |exposure: [f32; 3]| exposure.map(|e| 0.4 * (e / 0.01 + 1.0).log10());
//! let exposures = Planes::new(256, 0..128)?;
//! let amounts = stage.amounts(&exposures, None, 0..128, &curve)?;
//! assert_eq!(amounts.rows(), 0..128);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Out of scope
//! Colour: exposures and amounts come from and go to other crates. Print films' own sharpness and grain, lenses, dust, weave. Keys in square
//! brackets are resolved in REFERENCES.md at the top of the repository.

mod auto;
mod blur;
mod cells;
mod chain;
mod constant;
mod error;
mod first_pass;
mod format;
mod frame;
mod grain;
mod halation;
mod least_squares;
mod mtf;
mod numbers;
mod operator;
mod planes;
mod run;
mod sharpness;
mod stage;
mod strip;
mod taps;

pub use auto::{Decision, Effect, HalationProbe, SharpnessProbe, Verdict, grain_decision};
pub use chain::{Development, Finish};
pub use constant::{
    ANTIHALATION_DENSITY, CLOUD_RADIUS, CONSTANTS, Constant, ConstantOrigin, POLYESTER_INDEX, POLYESTER_THICKNESS,
    PRINT_BLUR, RETURNED_TO_BLUE, RETURNED_TO_GREEN, RETURNED_TO_RED, TRIACETATE_INDEX, TRIACETATE_THICKNESS,
};
pub use error::Error;
pub use first_pass::{FirstPass, FirstPassResult};
pub use format::{FilmFormat, Millimetres, Pitch};
pub use frame::Frame;
pub use grain::{AmountGranularity, Grain, GrainNumbers, GrainSettings};
pub use halation::{Antihalation, FilmBase, Halation, HalationCells, HalationSettings, HaloField};
pub use mtf::MtfFit;
pub use numbers::{AdjacencyNumbers, HalationNumbers, ScatterNumbers, StageNumbers};
pub use operator::AxisMap;
pub use planes::Planes;
pub use run::StageRun;
pub use sharpness::Sharpness;
pub use stage::{SpatialStage, StageBuffers};
pub use taps::Taps;

/// The examples of README.md, compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
