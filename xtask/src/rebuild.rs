//! Commands that need a build with a feature of this package: they run again in it.

use std::fmt;
use std::process::{Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use anyhow::{Context, Result};

use crate::{Report, folders};

/// A build that takes longer than this is announced.
const PATIENCE: Duration = Duration::from_secs(1);

/// Another build ran the command and failed; it has said why.
#[derive(Debug)]
pub(crate) struct FailedElsewhere(ExitStatus);

impl FailedElsewhere {
    /// The status that it ended with, for this program to end with too.
    pub(crate) fn code(&self) -> u8 {
        self.0.code().and_then(|code| u8::try_from(code).ok()).unwrap_or(2)
    }
}

impl fmt::Display for FailedElsewhere {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the build with the measurements: found {}, expected success", self.0)
    }
}

impl std::error::Error for FailedElsewhere {}

/// Runs the same command line again in a release build of xtask with a feature, which is made where it is not there yet.
///
/// # Errors
/// If it cannot be built; [`FailedElsewhere`] if the command fails.
pub(crate) fn run_with(feature: &str) -> Result<Report> {
    let cargo = |verb| -> Result<Command> {
        let mut cargo = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
        // The user's folder stays the current one, so that file names mean what they meant.
        cargo.args([verb, "--release", "--quiet", "--package", "xtask", "--features", feature, "--manifest-path"]);
        cargo.arg(folders::workspace()?.join("Cargo.toml"));
        Ok(cargo)
    };
    let built = announced(&mut cargo("build")?, feature)?;
    anyhow::ensure!(built.success(), "xtask with the feature {feature}: found {built}, expected that cargo builds it");
    let ended = cargo("run")?.arg("--").args(std::env::args_os().skip(1)).status().context("cargo cannot be run")?;
    if !ended.success() {
        return Err(FailedElsewhere(ended).into());
    }
    Ok(Report { text: String::new(), json: serde_json::Value::Null, as_json: false })
}

/// Runs this command again in a build with the measurements, whatever its arguments: that build reads them anew.
#[cfg(not(feature = "measure"))]
pub(crate) fn measured<A>(_: &A) -> Result<Report> {
    run_with("measure")
}

/// Waits for a build; one that is not there already takes long enough to be said.
fn announced(build: &mut Command, feature: &str) -> Result<ExitStatus> {
    let mut build = build.stdin(Stdio::null()).spawn().context("cargo cannot be run")?;
    let start = Instant::now();
    while start.elapsed() < PATIENCE {
        if let Some(ended) = build.try_wait()? {
            return Ok(ended);
        }
        sleep(Duration::from_millis(20));
    }
    eprintln!("building xtask with the feature {feature}, which this command needs: about a minute, once");
    Ok(build.wait()?)
}
