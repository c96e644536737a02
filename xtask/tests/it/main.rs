//! The runner as a user meets it, and the programs that load what it writes. One binary: every test runs the built program.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails loudly")]

mod bake;
mod big_pictures;
mod clients;
mod command_line;
mod corpora;
mod damaged;
mod effects;
#[cfg(target_os = "linux")]
mod hostile;
mod looks;
mod pictures;
mod program;
mod report;
mod sequences;
