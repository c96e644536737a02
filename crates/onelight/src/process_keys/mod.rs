//! A process as `look.toml` and the command line have it: a flat list of keys.

mod convert;
mod keys;
mod read;
mod version;
mod word_lists;

pub(crate) use convert::no_films;
pub use keys::{ProcessKeys, SheetKeys};
pub use version::FormatVersion;
