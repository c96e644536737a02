//! A look from a data sheet of one's own: `cargo run --example own_stock [FOLDER]`.

use onelight::{Films, Process, SheetText, Stock, stock};
use std::{env, fs, path::PathBuf};

fn run() -> Result<(), Box<dyn std::error::Error>> {
    let usual = || concat!(env!("CARGO_MANIFEST_DIR"), "/examples/data/pushed-5207").into();
    let folder = env::args_os().nth(1).map_or_else(usual, PathBuf::from);
    let text = |name| fs::read_to_string(folder.join(name)).map_err(|e| format!("{}/{name}: {e}", folder.display()));
    let camera = Stock::parse(&SheetText {
        id: &folder.file_name().unwrap_or_default().to_string_lossy(),
        stock_toml: &text("stock.toml")?,
        sensitivity_csv: &text("sensitivity.csv")?,
        characteristic_csv: &text("characteristic.csv")?,
        dye_density_csv: &text("dye_density.csv")?,
    })?;
    let mine = Process::default().compile_with(&Films { camera, print: Some(stock("kodak-2383")?) })?;
    for stops in -4..=4 {
        println!("{stops:>+3} stops: {:.3?}", mine.develop([0.18 * f64::from(stops).exp2(); 3]));
    }
    Ok(())
}

fn main() {
    if let Err(error) = run() {
        eprintln!("error: {error}");
        std::process::exit(1);
    }
}
