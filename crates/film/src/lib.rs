//! Photographic film as its data sheet describes it: from light to dye.
//!
//! - [`Stock`]: a film, read from the text of its data sheet
//! - [`ExposureMatrix`]: scene RGB to the exposure of the three layers; [`Camera`], [`FrameBufferScale`]: physical units
//! - [`CharacteristicCurve`]: density over log exposure; [`Densitometry`]: status M and A
//! - [`InterImageEffect`]: layers that hold back each other's development
//! - [`DyeModel`]: characteristic curves to amounts of dye; [`Dyes`]: amounts to spectral density
//! - [`ModulationTransfer`], [`Granularity`]: what a sheet says of sharpness and grain
//! - [`NumberTable`]: the comma-separated tables of a data sheet, with errors that name the line
//!
//! ```
//! use onelight_film::{DyeModel, ExposureMatrix, LogExposure, Matching, PerLayer, SheetText, Stock};
//! use onelight_spectra::{Basis, MID_GREY, Reconstruction, SpectralShape};
//!
//! let files = onelight_stocks::find("kodak-5207").ok_or("no such stock")?;
//! let stock = Stock::parse(&SheetText {
//!     id: files.id,
//!     stock_toml: files.stock_toml,
//!     sensitivity_csv: files.sensitivity_csv,
//!     characteristic_csv: files.characteristic_csv,
//!     dye_density_csv: files.dye_density_csv,
//! })?;
//!
//! // A grey card, exposed: the layers, the dye they make, the light that passes.
//! let mid_grey = PerLayer::all(stock.mid_grey()?);
//! let basis = Basis::new(Reconstruction::Smooth)?;
//! let exposure = ExposureMatrix::new(&stock, &basis, Matching::Grey, mid_grey)?.expose([MID_GREY; 3]);
//! let curves = DyeModel::Wedge.amounts(&stock, mid_grey)?;
//! let amounts = curves.as_ref().zip_map(exposure, |curve, e| curve.amount(LogExposure::of(e)));
//! let film = stock.dyes_on(SpectralShape::VISIBLE)?.density(amounts).transmittance();
//! let read = stock.densitometry().density(&film);
//! assert!((read.red.0 - 0.89).abs() < 0.05, "status M red of a grey card, {read:?}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Out of scope
//! Printers and projectors, look-up tables, displays; pictures: `onelight-spatial` applies sharpness and grain. Keys in square brackets are resolved in REFERENCES.md
//! at the top of the repository.

mod amounts;
mod curve;
mod densitometry;
mod dye;
mod dye_densitometer;
mod error;
mod exposure;
mod granularity;
mod inter_image;
mod layer;
mod metering;
mod modulation_transfer;
mod printable;
mod quantity;
mod sensitivity;
mod stock;
mod table;
mod tail;

pub use amounts::{DyeModel, PrintCurves};
pub use curve::{AmountCurve, CharacteristicCurve, Direction};
pub use densitometry::Densitometry;
pub use dye::{DyeDensity, Dyes};
pub use dye_densitometer::DyeDensitometer;
pub use error::Error;
pub use exposure::{Camera, ExposureMatrix, FrameBufferScale, Matching, WideGamut};
pub use granularity::Granularity;
pub use inter_image::{InterImage, InterImageEffect, InterImageOrigin};
pub use layer::{LAYER_NAMES, PerLayer};
pub use modulation_transfer::ModulationTransfer;
pub use onelight_spectra::MID_GREY;
pub use printable::printable;
pub use quantity::{Density, DyeAmount, EXPOSURE_FLOOR, LogExposure};
pub use sensitivity::{SensitivityPeak, SpectralSensitivity, Tail};
pub use stock::{
    AimDensities, ExposureAxis, Figures, FilmSize, Image, MidGrey, Normalisation, Origin, SheetText, Stock, StockKind,
    Uncertainty,
};
pub use table::{MAX_COLUMNS, MAX_ROWS, NumberTable};

/// The examples of README.md, compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
