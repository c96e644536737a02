//! Looks held against measurements of real film and against published figures: docs/measured.md and a page with plots.

mod absolute;
mod causes;
mod chart;
mod greys;
mod negative;
mod page;
mod plot;
mod printer;
mod reversal;
mod surface;
mod ways;
mod words;

pub use page::{Page, measure};
