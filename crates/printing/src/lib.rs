//! From negative to screen: the virtual printer and the projector of \[Gotanda2010\].
//!
//! - [`Printer`], [`Wratten`], [`HeatGlass`]: the light that prints
//! - [`Duplication`]: a negative over a print film; [`PrinterLights`] by exact solution or by the talk's iteration
//! - [`Aim`]: what a grey card should become
//! - [`Projection`]: dye to spectrum, XYZ and display-linear RGB
//! - [`Scan`]: a negative that is scanned and inverted, in place of a print
//!
//! ```
//! use onelight_film::{DyeModel, PerLayer, SheetText, Stock};
//! use onelight_printing::{
//!     Aim, Duplication, EquivalentNeutralDensity, Printer, Projection, Projector, print_mid_grey, print_target,
//! };
//! use onelight_spectra::{RgbSpace, SpectralShape};
//! # fn read(id: &str) -> Result<Stock, Box<dyn std::error::Error>> {
//! #     let f = onelight_stocks::find(id).ok_or("no such stock")?;
//! #     Ok(Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
//! #         characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?)
//! # }
//! let (negative, print) = (read("kodak-5207")?, read("kodak-2383")?);
//! let camera = DyeModel::Wedge.amounts(&negative, PerLayer::all(negative.mid_grey()?))?;
//! let print_curves = DyeModel::Wedge.amounts(&print, print_mid_grey(&print)?)?;
//! let projection = Projection::new(print.dyes_on(SpectralShape::VISIBLE)?, Projector::Display, &RgbSpace::SRGB)?;
//!
//! // Set the printer's lights so that a grey card comes out grey.
//! let mid_grey = negative.mid_grey()?;
//! let grey = camera.as_ref().map(|curve| curve.amount(mid_grey));
//! let target = print_target(Aim::Neutral, EquivalentNeutralDensity::default(), &print, print_curves.as_ref(), &projection)?;
//! let printer = Duplication::new(&negative, &print, Printer::default())?;
//! let printer = printer.lit(printer.calibrate(grey, target)?);
//! let dye = print_curves.as_ref().zip_map(printer.expose(grey), |curve, h| curve.amount(h));
//! assert!(projection.rgb(dye).iter().all(|v| (v - 10f64.powf(-0.7)).abs() < 1e-9));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Out of scope
//! Look-up tables, stocks by name, optical effects of printing (flare, sharpness), projection screens and flare.
//! Keys in square brackets are resolved in REFERENCES.md at the top of the repository.

mod aim;
mod duplication;
mod error;
mod filter;
mod printer;
mod projection;
mod scan;
mod spectral_row;

pub use aim::{Aim, EquivalentNeutralDensity, NEUTRAL_DENSITY, print_mid_grey, print_target, reversal_target};
pub use duplication::{Calibration, Duplication, LitDuplication};
pub use error::Error;
pub use filter::{HeatGlass, Wratten};
pub use printer::{Filters, Infrared, POINT_LOG_EXPOSURE, Printer, PrinterLight, PrinterLights};
pub use projection::{Projection, Projector, White};
pub use scan::{Scan, ScanRule};
pub use spectral_row::SpectralRow;

/// The examples of README.md, compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
