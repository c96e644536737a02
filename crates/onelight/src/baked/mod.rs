//! Looks in forms that are fast to apply: recipes, and what is baked by them.
//!
//! ```
//! use onelight::baked::Recipe;
//! let look = onelight::Process::default().look()?;
//! let baked = look.baked(&Recipe::cube(17))?;
//! let (exact, fast) = (look.develop([0.5, 0.2, 0.1]), baked.apply([0.5, 0.2, 0.1]));
//! assert!((exact[0] - f64::from(fast[0])).abs() < 0.01);
//! # Ok::<(), onelight::Error>(())
//! ```

mod chart;
mod coordinate;
#[cfg(feature = "formats")]
mod files;
mod form;
mod labels;
#[cfg(feature = "formats")]
mod ocio;
mod recipe;
mod shaper_fit;
mod smallest;
#[cfg(feature = "formats")]
mod target;

pub use chart::Chart;
pub use coordinate::Coordinate;
#[cfg(feature = "formats")]
pub use files::{AsWritten, BakedFile, FileFormat};
pub use form::{Baked, BakedForm};
#[cfg(feature = "formats")]
pub use ocio::ocio_config;
pub use recipe::{EntryRange, Form, Recipe, ShaperChoice};
pub use smallest::smallest_under;
#[cfg(feature = "formats")]
pub use target::{Target, TargetTable};
