//! What a command says when it is done.

use std::io::{self, ErrorKind, Write as _};

use anyhow::{Result, anyhow};

/// The result of a command: text for people, or one JSON object for scripts.
pub(crate) struct Report {
    pub(crate) text: String,
    pub(crate) json: serde_json::Value,
    pub(crate) as_json: bool,
}

/// Writes a result to the standard output; a reader that has had enough (`| head`) is no error.
pub(crate) fn print(report: &Report) -> Result<()> {
    let mut out = io::stdout().lock();
    let written = if report.as_json { writeln!(out, "{:#}", report.json) } else { write!(out, "{}", report.text) };
    match written.and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(anyhow!("the result cannot be written to the standard output: {error}"))
        }
        _ => Ok(()),
    }
}
