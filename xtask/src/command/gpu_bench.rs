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
pub(crate) fn run(_: &Arguments) -> Result<Report> {
    crate::rebuild::run_with("gpu")
}
