//! An engine loads the numbers of a look and maps a frame of half floats: `... --example apply_direct_json -- look.direct.json`.

use std::{error::Error, fs::File, process::ExitCode};

use half::f16;
use onelight_formats::direct_json;
use onelight_lut::{Channels, PixelMap, PixelsMut};

const LOOK: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/direct/kodak-5207_kodak-2383.direct.json");

fn main() -> ExitCode {
    let path = std::env::args().nth(1).unwrap_or_else(|| LOOK.to_owned());
    match grey_through(&path) {
        Ok(grey) => println!("mid grey becomes {grey:.3?}"),
        Err(error) => {
            eprintln!("{path}: {error}");
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

fn grey_through(path: &str) -> Result<[f16; 4], Box<dyn Error>> {
    let look = direct_json::read(File::open(path)?)?;
    let mut frame = [0.18, 0.18, 0.18, 1.0].map(f16::from_f32).repeat(1920 * 1080);
    look.map_in_place(&mut PixelsMut::new(&mut frame, Channels::Rgba, [1920, 1080])?);
    Ok([frame[0], frame[1], frame[2], frame[3]])
}
