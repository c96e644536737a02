//! The forms on a graphics card: time beside a plain copy, and difference from the film.

#[cfg(feature = "gpu")]
mod card;
#[cfg(feature = "gpu")]
mod copy;
#[cfg(feature = "gpu")]
mod difference;
#[cfg(feature = "gpu")]
mod measure;
#[cfg(feature = "gpu")]
mod pictures;
#[cfg(feature = "gpu")]
mod report;

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;

use crate::Report;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Folder to write gpu.json to [default: target/onelight]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Run on a software adapter, a few passes at 1080p: shows that it works, not how fast it is
    #[arg(long)]
    software: bool,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}

#[cfg(feature = "gpu")]
pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    report::run(arguments)
}

/// Runs this command again in a build that knows graphics cards.
#[cfg(not(feature = "gpu"))]
pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    use std::process::Command;

    use anyhow::{Context, bail};

    use crate::folders;

    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut again = Command::new(cargo);
    again.args(["run", "--release", "--quiet", "--package", "xtask", "--features", "gpu", "--", "gpu-bench"]);
    if let Some(folder) = &arguments.out {
        again.arg("--out").arg(std::path::absolute(folder)?);
    }
    again.args(arguments.software.then_some("--software"));
    again.args(arguments.json.then_some("--json"));
    let status =
        again.current_dir(folders::workspace()?).status().context("cargo cannot be run to build for the GPU")?;
    if !status.success() {
        bail!("gpu-bench in the build with the feature gpu: found {status}, expected success");
    }
    Ok(Report { text: String::new(), json: serde_json::Value::Null, as_json: false })
}
