//! `fidelity`: looks held against measurements of real film.

#[cfg(feature = "measure")]
mod measured;

use std::path::PathBuf;

use clap::Args;

#[cfg(not(feature = "measure"))]
pub(crate) use crate::rebuild::measured as run;
#[cfg(feature = "measure")]
pub(crate) use measured::run;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Folder to write measured.md and fidelity.html to [default: docs and target/onelight]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}
