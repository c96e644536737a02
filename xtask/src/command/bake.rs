use std::fmt::Write as _;
use std::io::Write as _;
use std::path::PathBuf;

use anyhow::Result;
use clap::{Args, ValueEnum};
use onelight::{Process, Reference};
use onelight_lut::{CubeFile, Deviation, Interpolation, PlainLut, SceneSampler, Shaper, bake, deviation};
use serde_json::json;

use crate::look::LookArguments;
use crate::progress::{Clock, bar};
use crate::whole::write_whole;
use crate::{Report, folders, preview};

/// Colours that a bake measures itself on.
const SAMPLES: usize = 1 << 14;
/// The range of those colours, and of the table, in stops about mid grey.
const STOPS: (f64, f64) = (-10.0, 6.0);

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    look: LookArguments,
    /// Nodes along each side of the table
    #[arg(long, default_value_t = 33, value_name = "N", value_parser = clap::value_parser!(u16).range(2..=129))]
    size: u16,
    /// How scene light becomes a coordinate of the table
    #[arg(long, default_value = "log2")]
    shaper: ShaperChoice,
    /// Folder to write to (target/onelight/ and the films' names if left out)
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}

/// The shapers that `bake` knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ShaperChoice {
    /// log2 with an offset fitted to the look, 0 to +6 stops over mid grey
    Log2,
    /// The talk's: log2(u + 0.191406), 0 to 4
    Gotanda,
}

/// A baked look: the table and how the time went.
pub(crate) struct Baked {
    pub(crate) lut: PlainLut,
    pub(crate) shaper: Shaper,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    let mut clock = Clock::default();
    let process = arguments.look.process()?;
    let film = clock.time("compile", || process.compile())?;
    let size = usize::from(arguments.size);
    let Baked { lut, shaper } = clock.time("bake", || plain(&film, size, arguments.shaper))?;
    let (cube, text) = clock.time("cube", || cube_text(&process, &lut))?;
    let measured = clock.time("measure", || measure(&film, &cube))?;
    let folder = match &arguments.out {
        Some(folder) => folders::make(folder)?,
        None => folders::output(&process.name())?,
    };
    let files = [folder.join("look.cube"), folder.join("look.toml"), folder.join("preview.png")];
    clock.time("write", || {
        write_whole(&files[0], |file| Ok(file.write_all(&text)?))?;
        write_whole(&files[1], |file| Ok(file.write_all(process.to_toml().as_bytes())?))
    })?;
    clock.time("preview", || preview::write(&files[2], &process, &lut))?;
    Ok(report(arguments, &process, &shaper, &measured, &files, &clock))
}

/// Bakes the plain form: scene-linear RGB to display-coded RGB.
pub(crate) fn plain(film: &Reference, size: usize, choice: ShaperChoice) -> Result<Baked> {
    let shaper = match choice {
        ShaperChoice::Gotanda => Shaper::gotanda(),
        ShaperChoice::Log2 => fitted_shaper(film)?,
    };
    let progress = bar("baking", size.pow(3) as u64);
    let table = bake(size, &shaper, |rgb| film.develop(rgb), |done| progress.set_position(done as u64))?;
    progress.finish_and_clear();
    Ok(Baked { lut: PlainLut::new(shaper, table, Interpolation::Tetrahedral), shaper })
}

/// The offset whose table comes nearest to the film, by golden section on small tables.
fn fitted_shaper(film: &Reference) -> Result<Shaper> {
    /// Side of the trial tables: small, but with the error pattern of a full one.
    const TRIAL_SIZE: usize = 12;
    const TRIAL_SAMPLES: usize = 1 << 10;
    /// log2 of the smallest and largest offset.
    const OFFSETS: (f64, f64) = (-11.0, -2.0);
    const STEPS: usize = 8;
    let samples: Vec<[f64; 3]> = samples(TRIAL_SAMPLES)?;
    let difference = film.difference()?;
    let exact: Vec<[f64; 3]> = developed(film, &samples);
    let indices: Vec<[f64; 3]> = (0..samples.len()).map(|i| [i as f64, 0.0, 0.0]).collect();
    let at = |offset: f64| -> Result<f64> {
        let shaper = shaper(offset)?;
        let lut = bake(TRIAL_SIZE, &shaper, |rgb| film.develop(rgb), |_| {})?;
        let lut = PlainLut::new(shaper, lut, Interpolation::Tetrahedral);
        let candidate = |[i, _, _]: [f64; 3]| {
            let coded = lut.apply(samples[i as usize].map(|v| v as f32));
            coded.map(|v| film.coding().decode(f64::from(v)))
        };
        let measure = |a: &[f64; 3], b: &[f64; 3]| difference.between(*a, *b);
        Ok(deviation(&indices, |[i, _, _]| exact[i as usize], candidate, measure)?.mean)
    };
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    let (mut low, mut high) = OFFSETS;
    let (mut a, mut b) = (high - ratio * (high - low), low + ratio * (high - low));
    let (mut error_a, mut error_b) = (at(a)?, at(b)?);
    for _ in 0..STEPS {
        if error_a <= error_b {
            (high, b, error_b) = (b, a, error_a);
            a = high - ratio * (high - low);
            error_a = at(a)?;
        } else {
            (low, a, error_a) = (a, b, error_b);
            b = low + ratio * (high - low);
            error_b = at(b)?;
        }
    }
    shaper(0.5 * (low + high))
}

/// log2 with an offset of `2^exponent`, over the range of [`STOPS`].
fn shaper(exponent: f64) -> Result<Shaper> {
    Ok(Shaper::log2(exponent.exp2(), SceneSampler::MID_GREY * STOPS.1.exp2())?)
}

fn developed(film: &Reference, samples: &[[f64; 3]]) -> Vec<[f64; 3]> {
    use rayon::prelude::*;
    samples.par_iter().map(|&rgb| film.develop_linear(rgb)).collect()
}

fn samples(count: usize) -> Result<Vec<[f64; 3]>> {
    Ok(SceneSampler::new(STOPS.0..=STOPS.1)?.take(count).collect())
}

/// The cube as text, and what reading that text gives.
fn cube_text(process: &Process, lut: &PlainLut) -> Result<(CubeFile, Vec<u8>)> {
    let comments = [
        format!("onelight {}: {}", env!("CARGO_PKG_VERSION"), process.name()),
        format!(
            "input: scene-linear {}, 18 % grey at 0.18; output: display {}, {} coding",
            onelight::Word::word(process.input_space),
            onelight::Word::word(process.output_space),
            onelight::Word::word(process.output_coding)
        ),
    ];
    let cube = CubeFile::from_plain(lut, CubeFile::SHAPER_POINTS)?.with_title(&process.name()).with_comments(comments);
    let mut text = Vec::new();
    cube.write(&mut text)?;
    let cube = CubeFile::read(&text[..])?;
    Ok((cube, text))
}

/// How far the file's own numbers lie from the film.
fn measure(film: &Reference, cube: &CubeFile) -> Result<Deviation> {
    let difference = film.difference()?;
    let decoded = |rgb: [f64; 3]| {
        let coded = cube.apply(rgb.map(|v| v as f32), Interpolation::Tetrahedral);
        coded.map(|v| film.coding().decode(f64::from(v)))
    };
    let between = |a: &[f64; 3], b: &[f64; 3]| difference.between(*a, *b);
    Ok(deviation(&samples(SAMPLES)?, |rgb| film.develop_linear(rgb), decoded, between)?)
}

fn report(
    arguments: &Arguments,
    process: &Process,
    shaper: &Shaper,
    measured: &Deviation,
    files: &[PathBuf; 3],
    clock: &Clock,
) -> Report {
    let Deviation { mean, p95, p99, max, worst, .. } = measured;
    let shown: Vec<String> = files.iter().map(|file| folders::shown(file)).collect();
    let mut text = String::new();
    let size = arguments.size;
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{}, {} aim", process.name(), onelight::Word::word(process.aim));
    let _ = writeln!(text, "  {}   {size}^3, {}, scene light 0 to {:.2}", shown[0], described(shaper), shaper.max());
    let _ = writeln!(text, "  {}", shown[1]);
    let _ = writeln!(text, "  {}", shown[2]);
    let _ = writeln!(
        text,
        "deviation of look.cube from the film (CIEDE2000, {SAMPLES} colours, {} to {:+} stops, any saturation):\n  \
         mean {mean:.3}, p95 {p95:.3}, p99 {p99:.3}, max {max:.3} at scene RGB {:.5}, {:.5}, {:.5}",
        STOPS.0, STOPS.1, worst[0], worst[1], worst[2]
    );
    let _ = writeln!(text, "time: {}", clock.sentence());
    let json = json!({
        "process": process,
        "size": size,
        "shaper": { "kind": described(shaper), "max": shaper.max() },
        "deviation": { "unit": "CIEDE2000", "count": measured.count, "mean": mean, "p95": p95, "p99": p99, "max": max, "worst": worst },
        "files": shown,
        "seconds": clock.json(),
    });
    Report { text, json, as_json: arguments.json }
}

fn described(shaper: &Shaper) -> String {
    match shaper.kind() {
        onelight_lut::ShaperKind::Log2Offset { offset, .. } => format!("log2(u + {offset:.5})"),
        _ => "shaper".to_owned(),
    }
}
