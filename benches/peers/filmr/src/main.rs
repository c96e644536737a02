//! filmr's side of `peers/run.py`: does one command per line of the standard input and answers each with one line, `ok` and
//! numbers, or `error` and a sentence. Times are nanoseconds, taken around the work alone.
//!
//! | command | does | answers |
//! |---|---|---|
//! | `threads N` | holds the program to that many | |
//! | `read FOLDER WIDTH HEIGHT` | loads the float32 RGBA picture and codes it as sRGB of 8 bits, which filmr takes | |
//! | `apply RUNS` | the picture through filmr's Kodak Portra 400, all that a setting can turn off turned off | time of each run |

use std::error::Error;
use std::io::{BufRead, Write, stdin, stdout};
use std::time::Instant;

use filmr::presets::kodak::KODAK_PORTRA_400;
use filmr::{SimulationConfig, WhiteBalanceMode, process_image};
use image::RgbImage;

type Answer = Result<Vec<f64>, Box<dyn Error>>;

fn main() -> Result<(), Box<dyn Error>> {
    let mut picture = RgbImage::default();
    for line in stdin().lock().lines() {
        let line = line?;
        let answer = match obey(&mut picture, &line.split_whitespace().collect::<Vec<_>>()) {
            Ok(numbers) => numbers.iter().fold("ok".to_owned(), |text, v| format!("{text} {v}")),
            Err(error) => format!("error {line:?}: {error}"),
        };
        let mut out = stdout().lock();
        writeln!(out, "{answer}")?;
        out.flush()?;
    }
    Ok(())
}

fn obey(picture: &mut RgbImage, words: &[&str]) -> Answer {
    match *words {
        ["threads", count] => {
            rayon::ThreadPoolBuilder::new().num_threads(count.parse()?).build_global()?;
            Ok(Vec::new())
        }
        ["read", folder, width, height] => {
            let bytes = std::fs::read(format!("{folder}/picture.f32"))?;
            let samples = bytes.as_chunks::<4>().0.iter().map(|b| f32::from_le_bytes(*b));
            let coded = samples.enumerate().filter(|(i, _)| i % 4 < 3).map(|(_, v)| srgb(v)).collect();
            *picture = RgbImage::from_raw(width.parse()?, height.parse()?, coded).ok_or("another size of picture")?;
            Ok(Vec::new())
        }
        ["apply", runs] => {
            let film = KODAK_PORTRA_400();
            let config = SimulationConfig {
                enable_grain: false,
                white_balance_mode: WhiteBalanceMode::Off,
                motion_blur_amount: 0.0,
                ..SimulationConfig::default()
            };
            let times = (0..runs.parse()?).map(|_: usize| {
                let begin = Instant::now();
                std::hint::black_box(process_image(picture, &film, &config));
                begin.elapsed().as_nanos() as f64
            });
            Ok(times.collect())
        }
        _ => Err("no such command".into()),
    }
}

/// Scene-linear light as a code of sRGB.
fn srgb(linear: f32) -> u8 {
    let v = linear.clamp(0.0, 1.0);
    let coded = if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 };
    (255.0 * coded).round() as u8
}
