//! `gpu-bench`: the forms on a graphics card, in a build that knows graphics cards.

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
    use std::fmt::Write as _;

    use crate::atomic_file::write_atomically;
    use crate::folders;

    let folder = match &arguments.out {
        Some(folder) => folders::make(folder)?,
        None => folders::output("")?,
    };
    let found = onelight_benches::gpu::measure(arguments.software)?;
    let json = found.json();
    let path = folder.join("gpu.json");
    write_atomically(&path, |file| Ok(serde_json::to_writer_pretty(file, &json)?))?;
    let mut text = found.text();
    let _ = writeln!(text, "{}", folders::shown(&path));
    if let Some(fault) = found.fault() {
        anyhow::bail!("{text}{fault}");
    }
    Ok(Report { text, json, as_json: arguments.json })
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
