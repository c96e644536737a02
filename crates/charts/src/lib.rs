//! Pictures about films: the curves of a data sheet as SVG, contact sheets with captions and maps of differences as PNG.
//!
//! - [`stock_plot`]: sensitivity, characteristic curves and dyes of a stock
//! - [`contact_sheet`]: pictures side by side, each under two lines of captions
//! - [`difference_map`]: colour differences, pixel by pixel, as colours
//! - [`mean_p95_max`]: what a caption says of differences
//! - [`sheet_page`]: contact sheets with their figures as one HTML page
//! - [`paste`] and [`caption`]: for sheets of another layout
//!
//! Pictures go in as display-coded sRGB, 0 to 1.

mod contact_sheet;
mod error;
mod sheet;
mod sheet_page;
mod stock_plot;

pub use contact_sheet::{TILE_WIDTH, Tile, contact_sheet, difference_map, mean_p95_max};
pub use error::Error;
pub use sheet::{BACKGROUND, caption, paste};
pub use sheet_page::{SheetRow, SheetSection, sheet_page};
pub use stock_plot::stock_plot;

/// The example of README.md, compiled and run with the tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
