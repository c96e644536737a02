//! A look from a data sheet of one's own, as a researcher tries a measured curve: `cargo run --example own_stock [FOLDER]`.

use std::{env, fs, path::PathBuf, process::ExitCode};

use onelight::{Films, Process, SheetText, Stock, stock};

fn run() -> Result<(), Box<dyn std::error::Error>> {
    let usual = || concat!(env!("CARGO_MANIFEST_DIR"), "/examples/data/pushed-5207").into();
    let folder = env::args_os().nth(1).map_or_else(usual, PathBuf::from);
    let text =
        |name: &str| fs::read_to_string(folder.join(name)).map_err(|e| format!("{}/{name}: {e}", folder.display()));
    let camera = Stock::parse(&SheetText {
        id: &folder.file_name().unwrap_or_default().to_string_lossy(),
        stock_toml: &text("stock.toml")?,
        sensitivity_csv: &text("sensitivity.csv")?,
        characteristic_csv: &text("characteristic.csv")?,
        dye_density_csv: &text("dye_density.csv")?,
    })?;
    let mine = Process::default().compile_with(&Films { camera, print: Some(stock("kodak-2383")?) })?;
    let usual = Process::default().compile()?;
    println!("stops   {:<24}{}", mine.name(), usual.name());
    for stops in -4..=4 {
        let grey = [0.18 * f64::from(stops).exp2(); 3];
        println!("{stops:>+5}   {:<24.3}{:.3}", mine.develop(grey)[1], usual.develop(grey)[1]);
    }
    Ok(())
}

fn main() -> ExitCode {
    let failed = |error| eprintln!("error: {error}");
    run().map_err(failed).map_or(ExitCode::FAILURE, |()| ExitCode::SUCCESS)
}
