//! `tidy`: the rules of ARCHITECTURE.md, checked by a program of its own, so that who bakes a look compiles no parser of Rust.

use std::process::Command;

use anyhow::{Context, Result, bail};
use clap::Args;

use crate::{Report, folders};

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut tidy = Command::new(cargo);
    tidy.args(["run", "--quiet", "--package", "tidy", "--"]);
    tidy.args(arguments.json.then_some("--json"));
    let status = tidy.current_dir(folders::workspace()?).status().context("cargo cannot be run to build tidy")?;
    if !status.success() {
        bail!("tidy: found {status}, expected success");
    }
    Ok(Report { text: String::new(), json: serde_json::Value::Null, as_json: false })
}
