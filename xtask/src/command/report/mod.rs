//! `report`: the speed of every form against its error, and what its parts cost, as one page.

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
    /// Fewer forms, fewer colours and a smaller picture: seconds instead of minutes, and rough figures
    #[arg(long)]
    quick: bool,
    /// Folder to write to [default: target/onelight/report]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write the plot that the README shows too, to docs/images/speed-error.svg
    #[arg(long, conflicts_with = "quick")]
    commit: bool,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}
