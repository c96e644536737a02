//! `darkroom`: the page in the browser, built by a program of its own, so that who bakes a look compiles nothing of it.

use std::process::Command;

use anyhow::{Context, Result, bail};
use clap::Args;

use crate::{Report, folders};

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Serve it at http://127.0.0.1:8127 when it is built
    #[arg(long)]
    serve: bool,
    /// Serve it at this port, 0 for any that is free
    #[arg(long, value_name = "NUMBER")]
    port: Option<u16>,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut darkroom = Command::new(cargo);
    darkroom.args(["run", "--release", "--quiet", "--package", "darkroom", "--"]);
    darkroom.args(arguments.serve.then_some("--serve"));
    darkroom.args(arguments.port.map(|port| ["--port".to_owned(), port.to_string()]).into_iter().flatten());
    let status = darkroom.current_dir(folders::workspace()?).status();
    let status = status.context("cargo cannot be run to build the darkroom")?;
    if !status.success() {
        bail!("darkroom: found {status}, expected success");
    }
    Ok(Report { text: String::new(), json: serde_json::Value::Null, as_json: false })
}
