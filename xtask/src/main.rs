//! The onelight runner: `cargo xtask bake`, `develop`, `stocks`, `fixtures`. The only crate that touches files.

mod command;
mod folders;
mod look;
mod picture;
mod plot;
mod preview;
mod progress;
mod scene;
mod truth;
mod whole;

use std::process::ExitCode;

use anyhow::Result;
use clap::{Parser, Subcommand};

/// Film simulation for HDR pictures.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask", version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Bake a look into a LUT: look.cube, look.toml and a preview
    Bake(command::bake::Arguments),
    /// Develop a picture: scene-linear EXR (or TIFF, PNG) in, film out
    Develop(command::develop::Arguments),
    /// List the stocks, or show one with a plot of its curves
    Stocks(command::stocks::Arguments),
    /// Render the fixture scene, and measure what going through RGB costs
    Fixtures(command::fixtures::Arguments),
    /// Check the layers of the workspace against ARCHITECTURE.md
    Tidy(command::tidy::Arguments),
}

/// What a command says when it is done: text for people, or one JSON object for scripts.
struct Report {
    text: String,
    json: serde_json::Value,
    as_json: bool,
}

fn main() -> ExitCode {
    match run(Arguments::parse().command) {
        Ok(report) if report.as_json => println!("{:#}", report.json),
        Ok(report) => print!("{}", report.text),
        Err(error) => {
            eprintln!("error: {error:#}");
            return ExitCode::from(2);
        }
    }
    ExitCode::SUCCESS
}

fn run(command: Command) -> Result<Report> {
    match command {
        Command::Bake(arguments) => command::bake::run(&arguments),
        Command::Develop(arguments) => command::develop::run(&arguments),
        Command::Stocks(arguments) => command::stocks::run(&arguments),
        Command::Fixtures(arguments) => command::fixtures::run(&arguments),
        Command::Tidy(arguments) => command::tidy::run(&arguments),
    }
}
