use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::{Args, ValueEnum};
use onelight::spectra::Chromaticity;
use onelight::spectra::nalgebra::{Matrix3, Vector3};
use onelight::{Process, Reference, TransferCurve, Word};
use rayon::prelude::*;
use serde_json::json;

use crate::compiled::{self, Compiled, Recipe};
use crate::look::{LookArguments, words};
use crate::picture::{
    self, Bits, Chromaticities, Coding, ColourTag, Limits, Picture, Samples, Source, write_exr, write_png,
};
use crate::progress::{Clock, bar};
use crate::{Report, folders, scene_colours};

/// A picture whose log average lies further from mid grey, in stops, is worth a word.
const FAR_STOPS: f64 = 4.0;
/// What the log average of a picture should be.
const MID_GREY: f64 = 0.18;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Scene-linear picture: EXR, or 16-bit or float TIFF or PNG
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// Developed picture: .png (display-coded) or .exr (linear, display-referred, not clipped)
    #[arg(value_name = "OUT")]
    output: PathBuf,
    #[command(flatten)]
    look: LookArguments,
    /// Exposure in stops, or auto: the log average of the picture comes to 0.18
    #[arg(long, default_value = "0", value_name = "STOPS|auto", allow_hyphen_values = true)]
    ev: Exposure,
    /// How the film is computed
    #[arg(long, default_value = "reference")]
    form: Form,
    /// Transfer curve of a TIFF or PNG that comes in [default: srgb for integers, linear for floats]
    #[arg(long, value_parser = words::<TransferCurve>())]
    input_coding: Option<TransferCurve>,
    /// Bits of a PNG that goes out [default: 8]
    #[arg(long, value_parser = ["8", "16"], value_name = "8|16")]
    bits: Option<String>,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}

/// How a picture is exposed before it meets the film.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Exposure {
    Stops(f64),
    Auto,
}

impl std::str::FromStr for Exposure {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.parse::<f64>() {
            _ if text == "auto" => Ok(Self::Auto),
            Ok(stops) if (-60.0..=60.0).contains(&stops) => Ok(Self::Stops(stops)),
            _ => Err("expected a number of stops from -60 to 60, or auto".to_owned()),
        }
    }
}

/// How the film is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Form {
    /// Exact: every pixel through the spectra, in float64
    Reference,
    /// A 33^3 table with a log2 shaper, as `bake` writes it
    Plain,
    /// A 32^3 table whose axes are the film's curves, as `bake --form structured` writes it
    Structured,
    /// No table: curves and a few exponentials, as `bake --form direct` writes them
    Direct,
}

/// What the output's name asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Target {
    Png,
    Exr,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    let mut clock = Clock::default();
    let target = target(&arguments.output)?;
    if same_file(&arguments.input, &arguments.output) {
        bail!(
            "{}: the output would replace the picture it is made from, expected another name",
            arguments.output.display()
        );
    }
    let mut process = arguments.look.process()?;
    let mut notes = Vec::new();
    if target == Target::Exr && arguments.bits.is_some() {
        notes.push("an EXR holds 32-bit floats: --bits is not used".to_owned());
    }
    if target == Target::Exr && process.output_coding != TransferCurve::Linear {
        notes.push(format!("an EXR holds linear light: not coded by {}", process.output_coding.word()));
        process.output_coding = TransferCurve::Linear;
    }
    let film = clock.time("compile", || process.compile())?;
    let mut picture = clock.time("read", || picture::read(&arguments.input, &Limits::default()))?;
    notes.append(&mut picture.notes);
    let to_input = to_input_space(&picture, &process, arguments, &mut notes)?;
    let ev = clock.time("prepare", || prepare(&mut picture, arguments, &process, &to_input, &mut notes))?;
    clock.time("develop", || develop(&mut picture, &film, &process, arguments.form, &mut notes))?;
    let size = match target {
        Target::Png => picture.windows.display_size,
        Target::Exr => [picture.width, picture.height],
    };
    clock.time("write", || write(&arguments.output, target, picture, &process, arguments))?;
    let mut text = String::new();
    let output = folders::shown(&arguments.output);
    let _ = writeln!(text, "{output}   {}x{}, {}, {ev:+.2} EV", size[0], size[1], process.name());
    for note in &notes {
        let _ = writeln!(text, "  note: {note}");
    }
    let _ = writeln!(text, "time: {}", clock.sentence());
    let json = json!({
        "process": process,
        "input": arguments.input.display().to_string(),
        "output": output,
        "size": size,
        "ev": ev,
        "notes": notes,
        "seconds": clock.json(),
    });
    Ok(Report { text, json, as_json: arguments.json })
}

fn same_file(a: &Path, b: &Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

fn target(path: &Path) -> Result<Target> {
    match path.extension().map(|e| e.to_string_lossy().to_lowercase()).as_deref() {
        Some("png") => Ok(Target::Png),
        Some("exr") => Ok(Target::Exr),
        _ => bail!("{}: the output's name ends in neither .png nor .exr, expected one of them", path.display()),
    }
}

/// From the picture's own primaries to those the process takes.
fn to_input_space(
    picture: &Picture,
    process: &Process,
    arguments: &Arguments,
    notes: &mut Vec<String>,
) -> Result<Matrix3<f64>> {
    if picture.primaries.is_some() && arguments.look.names_input_space() {
        notes.push(format!("the file's own chromaticities give way to --input-space {}", process.input_space.word()));
        return Ok(Matrix3::identity());
    }
    let matrix = scene_colours::to_input_space(picture, process);
    Ok(matrix.with_context(|| arguments.input.display().to_string())?.unwrap_or_else(Matrix3::identity))
}

/// Decodes, converts and exposes the picture; the exposure in stops.
fn prepare(
    picture: &mut Picture,
    arguments: &Arguments,
    process: &Process,
    to_input: &Matrix3<f64>,
    notes: &mut Vec<String>,
) -> Result<f64> {
    let coding = match (arguments.input_coding, picture.source) {
        (Some(_), Source::Exr) => {
            notes.push("an EXR holds linear light: --input-coding is not used".to_owned());
            TransferCurve::Linear
        }
        (Some(coding), _) => coding,
        (None, Source::Exr | Source::Tiff { samples: Samples::Float, .. }) => TransferCurve::Linear,
        (None, Source::Png { .. } | Source::Tiff { samples: Samples::Integer, .. }) => {
            notes.push("the picture's integers are taken for sRGB-coded (--input-coding says otherwise)".to_owned());
            TransferCurve::Srgb
        }
    };
    if coding != TransferCurve::Linear {
        picture.rgb.par_iter_mut().for_each(|rgb| *rgb = rgb.map(|v| coding.decode(f64::from(v)) as f32));
    }
    let hard = picture.rgb.par_iter().filter(|rgb| rgb.iter().any(|v| !v.is_finite())).count();
    if hard > 0 {
        notes.push(format!(
            "{hard} pixels hold NaN or infinity: NaN counts as 0, infinity as {:e}",
            onelight::SCENE_MAX
        ));
    }
    let average = log_average(picture, to_input, process)?;
    let off = average.map(|average| (average / MID_GREY).log2());
    let ev = match (arguments.ev, off) {
        (Exposure::Stops(stops), _) => stops,
        (Exposure::Auto, Some(off)) => -off,
        (Exposure::Auto, None) => {
            notes.push("the picture holds no light to expose for: --ev auto leaves it as it is".to_owned());
            0.0
        }
    };
    if let Some(left) = off.map(|off| off + ev)
        && left.abs() > FAR_STOPS
    {
        let side = if left < 0.0 { "under" } else { "over" };
        notes.push(format!(
            "the picture lies {:.1} stops {side} mid grey; --ev auto would use --ev {:+.1}",
            left.abs(),
            ev - left
        ));
    }
    let scale = ev.exp2();
    if *to_input != Matrix3::identity() || scale != 1.0 {
        // NaN and infinity stay in their channels: only the film says what they mean.
        let matrix = to_input * scale;
        picture.rgb.par_iter_mut().for_each(|rgb| {
            *rgb = if *to_input == Matrix3::identity() {
                rgb.map(|v| (f64::from(v) * scale) as f32)
            } else {
                (matrix * Vector3::from(finite(*rgb))).data.0[0].map(|v| v as f32)
            }
        });
    }
    Ok(ev)
}

/// What a channel counts as before it is mixed with others.
fn finite(rgb: [f32; 3]) -> [f64; 3] {
    let limit = onelight::SCENE_MAX;
    rgb.map(|v| if v.is_nan() { 0.0 } else { f64::from(v).clamp(-limit, limit) })
}

/// Geometric mean of the luminance of the pixels that have any and are not fully transparent; `None` if none has.
fn log_average(picture: &Picture, to_input: &Matrix3<f64>, process: &Process) -> Result<Option<f64>> {
    let to_xyz = process.input_space.space().with_white(Chromaticity::black_body_6500_k()).to_xyz()?;
    let weights = (to_xyz * to_input).row(1).transpose();
    let covered = |i: usize| picture.alpha.as_ref().is_none_or(|alpha| alpha[i] != 0.0);
    let luminance = |rgb: &[f32; 3]| weights.dot(&Vector3::from(rgb.map(f64::from)));
    let pixels = picture.rgb.par_iter().enumerate().filter(|(i, _)| covered(*i));
    let logs: Vec<f64> =
        pixels.map(|(_, rgb)| luminance(rgb)).filter(|y| *y > 0.0 && y.is_finite()).map(f64::log2).collect();
    // Summed in order: the result does not depend on the number of threads.
    Ok((!logs.is_empty()).then(|| (logs.iter().sum::<f64>() / logs.len() as f64).exp2()))
}

/// Scene-linear to display-coded, in place.
fn develop(
    picture: &mut Picture,
    film: &Reference,
    process: &Process,
    form: Form,
    notes: &mut Vec<String>,
) -> Result<()> {
    let recipe = match form {
        Form::Reference => {
            let progress = bar("developing", picture.rgb.len() as u64);
            let width = picture.width;
            picture.rgb.par_chunks_mut(width).for_each(|row| {
                for rgb in row.iter_mut() {
                    *rgb = film.develop(rgb.map(f64::from)).map(|v| v as f32);
                }
                progress.inc(width as u64);
            });
            progress.finish_and_clear();
            return Ok(());
        }
        Form::Plain => Recipe::usual(compiled::Form::Plain),
        Form::Structured => Recipe::usual(compiled::Form::Structured),
        Form::Direct => Recipe::usual(compiled::Form::Direct),
    };
    let table = Compiled::new(film, process, &recipe, None)?;
    if let Some(max) = table.max() {
        let beyond = picture.rgb.par_iter().filter(|rgb| rgb.iter().any(|v| f64::from(*v) > max)).count();
        if beyond > 0 {
            notes.push(format!(
                "{beyond} pixels are brighter than {max:.1}, where the plain table ends (--form structured has no end)"
            ));
        }
    }
    table.apply_to_slice(&mut picture.rgb);
    Ok(())
}

fn write(path: &Path, target: Target, mut picture: Picture, process: &Process, arguments: &Arguments) -> Result<()> {
    let space = process.output_space.space();
    let xy = |c: Chromaticity| [c.x as f32, c.y as f32];
    let [red, green, blue] = space.primaries.map(xy);
    let primaries = Chromaticities { red, green, blue, white: xy(space.white) };
    let look = process.to_toml();
    let software = format!("onelight {}", env!("CARGO_PKG_VERSION"));
    match target {
        Target::Exr => {
            picture.primaries = Some(primaries);
            write_exr(path, &picture, &[("Software", &software), ("onelight look", &look)])
        }
        Target::Png => {
            let bits = if arguments.bits.as_deref() == Some("16") { Bits::Sixteen } else { Bits::Eight };
            let coding = match process.output_coding {
                TransferCurve::Srgb => Coding::Srgb,
                TransferCurve::Gamma24 => Coding::Gamma24,
                TransferCurve::Linear => Coding::Linear,
            };
            let texts = [("Software", software.as_str()), ("onelight look", look.as_str())];
            write_png(path, &picture.into_display()?, bits, Some(&ColourTag { coding, primaries }), &texts)
        }
    }
}
