//! `stability`: every implementation of a look, on inputs that are hard.

#[cfg(feature = "measure")]
mod measured;

use std::path::PathBuf;

use clap::Args;

use crate::look::LookArguments;
#[cfg(not(feature = "measure"))]
pub(crate) use crate::rebuild::measured as run;
#[cfg(feature = "measure")]
pub(crate) use measured::run;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    look: LookArguments,
    /// Every camera film as it is shown and on everything it is printed on; without it, and where no film is named, the ten of the README
    #[arg(long, conflicts_with_all = ["camera", "print", "aim"])]
    all: bool,
    /// Folder to write stability.md and stability.json to [default: target/onelight]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}
