//! The figures of the talk, side by side.

#[cfg(feature = "measure")]
mod measured;

use std::path::PathBuf;

use clap::Args;

use crate::command::develop::exposure::Exposure;
use crate::look::LookArguments;
#[cfg(not(feature = "measure"))]
pub(crate) use crate::rebuild::measured as run;
#[cfg(feature = "measure")]
pub(crate) use measured::run;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    look: LookArguments,
    /// Scene-linear pictures to show the looks on, besides the fixture scene and the ColorChecker
    #[arg(value_name = "EXR")]
    pictures: Vec<PathBuf>,
    /// Exposure of these pictures in stops, or auto: the log average comes to 0.18
    #[arg(long, default_value = "0", value_name = "STOPS|auto", allow_hyphen_values = true)]
    ev: Exposure,
    /// Sheets to make, comma-separated [default: all]
    #[arg(long, value_delimiter = ',', value_name = "NAMES")]
    sheets: Vec<String>,
    /// Folder for the sheets and index.html [default: target/onelight/compare]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}
