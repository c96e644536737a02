//! Builds the darkroom, a page of static files, and serves it: what `cargo xtask darkroom` runs.

mod build;
mod glsl;
mod looks;
mod serve;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Result, bail};

/// Prints where the page is and how large; 2 and one sentence where something failed.
fn main() -> ExitCode {
    match run(std::env::args().skip(1)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(2)
        }
    }
}

fn run(mut arguments: impl Iterator<Item = String>) -> Result<()> {
    let mut port = None;
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--serve" => port = Some(serve::PORT),
            "--port" => {
                let number = arguments.next();
                let found = number.as_deref().unwrap_or("nothing");
                port = match found.parse::<u16>() {
                    Ok(number) => Some(number),
                    Err(_) => bail!("--port: found {found}, expected a number from 0 to 65535"),
                };
            }
            other => bail!("{other}: is no option, expected --serve or --port NUMBER"),
        }
    }
    let top = workspace();
    let folder = top.join("target/onelight/darkroom");
    println!("{}", build::build(&top, &folder)?);
    match port {
        Some(port) => serve::serve(&folder, port),
        None => Ok(()),
    }
}

/// The top of the workspace, two folders above this package.
fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap_or(Path::new(".")).to_path_buf()
}
