//! The onelight runner, `cargo xtask`: flags, file names, progress and exit status. The only crate that opens paths.

mod atomic_file;
mod command;
mod effects;
mod exposure;
mod finish;
mod folders;
mod look;
mod own_stock;
mod picture_file;
mod preview;
mod progress;
#[cfg_attr(feature = "gpu", allow(dead_code, reason = "a build with all measurements runs no other"))]
mod rebuild;
mod scene_colours;
mod small_picture;
mod switches;
mod words;

use std::io::{self, Write as _};
use std::process::ExitCode;

use anyhow::Result;
use clap::{Parser, Subcommand};

// The picture writers know the module by this name until they are a crate.
use finish::{Report, print};

/// Film simulation for HDR pictures.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Bake a look into the LUTs that programs load, with a certificate and a preview
    Bake(command::bake::Arguments),
    /// Say how far every baked form lies from the exact film
    Certify(command::certify::Arguments),
    /// Develop a picture: scene-linear EXR (or TIFF, PNG) in, film out
    Develop(command::develop::Arguments),
    /// Measure every form: speed against error as a page with plots and tables
    Report(command::report::Arguments),
    /// Say how every form behaves on hard inputs: finite, monotone, steps, rounding; target/onelight/stability.md
    Stability(command::stability::Arguments),
    /// Time the forms on a graphics card beside a plain copy: target/onelight/gpu.json
    GpuBench(command::gpu_bench::Arguments),
    /// Hold looks against measurements of real film: docs/measured.md and a page with plots
    Fidelity(command::fidelity::Arguments),
    /// List the stocks, or show one with a plot of its curves
    Stocks(command::stocks::Arguments),
    /// Render the fixture scene, and measure what going through RGB costs
    Fixtures(command::fixtures::Arguments),
    /// Turn lux, lumen and kelvin into W/m^2 RGB, and say what a camera makes of it
    Light(command::light::Arguments),
    /// Put the looks and switches of the talk side by side, and a look of your own beside the films: contact sheets and a page
    Compare(command::compare::Arguments),
    /// Build the darkroom, a page for the browser to see a picture on every film: target/onelight/darkroom
    Darkroom(command::darkroom::Arguments),
    /// Check the layers of the workspace against ARCHITECTURE.md
    Tidy(command::tidy::Arguments),
}

/// Runs what the command line asks for; 2 where it failed, with one sentence on the standard error.
pub fn main() -> ExitCode {
    onelight_picture::silence_panics_while_reading();
    let printed = run(Arguments::parse().command).and_then(|report| print(&report));
    let Err(error) = printed else { return ExitCode::SUCCESS };
    if let Some(failed) = error.downcast_ref::<rebuild::FailedElsewhere>() {
        return ExitCode::from(failed.code());
    }
    // Where even this cannot be written, only the status is left to tell.
    let _ = writeln!(io::stderr(), "error: {error:#}{}", hint(&error));
    ExitCode::from(2)
}

/// Where a name that does not exist is looked up.
fn hint(error: &anyhow::Error) -> &'static str {
    let unknown = |cause: &onelight::Error| cause.is_unknown_stock();
    let found = error.chain().any(|cause| cause.downcast_ref().is_some_and(unknown));
    if found { " (`cargo xtask stocks` lists all)" } else { "" }
}

fn run(command: Command) -> Result<Report> {
    match command {
        Command::Bake(arguments) => command::bake::run(&arguments),
        Command::Certify(arguments) => command::certify::run(&arguments),
        Command::Develop(arguments) => command::develop::run(&arguments),
        Command::Report(arguments) => command::report::run(&arguments),
        Command::Stability(arguments) => command::stability::run(&arguments),
        Command::GpuBench(arguments) => command::gpu_bench::run(&arguments),
        Command::Fidelity(arguments) => command::fidelity::run(&arguments),
        Command::Stocks(arguments) => command::stocks::run(&arguments),
        Command::Fixtures(arguments) => command::fixtures::run(&arguments),
        Command::Light(arguments) => command::light::run(&arguments),
        Command::Compare(arguments) => command::compare::run(&arguments),
        Command::Darkroom(arguments) => command::darkroom::run(&arguments),
        Command::Tidy(arguments) => command::tidy::run(&arguments),
    }
}
