use std::fmt::Write as _;

use anyhow::{Result, bail};
use clap::Args;
use onelight::baked::{Form, Recipe, ShaperChoice};
use onelight::certify::{Certifier, MeanAndMax, in_words, to_six_stops};
use onelight::lut::{Certificate, SamplingLaw, Search, Storage};
use onelight::{Aim, Entries, Nodes, Process, ProcessKeys, TableCoding, Word, WorkingSpace};
use serde_json::{Value, json};

use crate::Report;
use crate::look::{ChosenLook, LookArguments};
use crate::progress::{Clock, bar};
#[cfg(not(feature = "measure"))]
use crate::rebuild::measured as buffer_steps;

/// Colours of a thorough certificate, and of a short one.
const COLOURS: usize = 1 << 18;
/// The films of the talk and their likes.
const CAMERAS: [&str; 5] =
    ["kodak-5207", "kodak-ektachrome-100", "kodak-kodachrome-64", "fuji-velvia-50", "fuji-provia-100f"];

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    look: LookArguments,
    /// Stops by which the scene is made brighter before the film [default: 0]
    #[arg(long, value_name = "STOPS", allow_hyphen_values = true)]
    ev: Option<f64>,
    /// Certify the five films of the README, both aims, all forms; the look's other options apply
    #[arg(long, conflicts_with_all = ["camera", "print", "aim"])]
    all: bool,
    /// Say instead what low-precision frame buffers in front of the film cost
    #[arg(long)]
    buffers: bool,
    /// Colours drawn for each certificate
    #[arg(long, default_value_t = COLOURS, value_name = "N", value_parser = colours)]
    colours: usize,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}

fn colours(text: &str) -> Result<usize, String> {
    let allowed = 1 << 8..=1 << 20;
    text.parse().ok().filter(|n| allowed.contains(n)).ok_or_else(|| "expected a number from 256 to 1048576".to_owned())
}

/// The forms that are compared: name, recipe.
fn forms() -> Vec<(&'static str, Recipe)> {
    let plain = Recipe { storage: Storage::F16, entries: Entries::Fitted, ..Recipe::of(Form::Plain) };
    let counts = |projection, duplication| {
        let nodes = Nodes::Counts { projection, duplication };
        Recipe { nodes, ..Recipe::of(Form::Direct) }
    };
    let structured = Recipe { storage: Storage::F16, ..Recipe::of(Form::Structured) };
    vec![
        ("the talk's 32^3", Recipe { size: 32, shaper: ShaperChoice::Gotanda, entries: Entries::Sampled, ..plain }),
        ("plain 33^3, f16", plain),
        ("plain 33^3 to +6, f16", Recipe { stops: Some(6.0), ..plain }),
        ("structured 16^3, f16", Recipe { size: 16, ..structured }),
        ("structured 32^3, f16", structured),
        ("structured 32^3, f32", Recipe { storage: Storage::F32, ..structured }),
        ("direct 6 + 3", counts(6, 3)),
        ("direct 8 + 4", counts(8, 4)),
        ("direct 10 + 5", counts(10, 5)),
        ("direct, as it is baked", Recipe::of(Form::Direct)),
        ("structured 32^3, 10 bit", Recipe { storage: Storage::Unorm10, coding: TableCoding::Display, ..structured }),
    ]
}

pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    if arguments.buffers {
        return buffer_steps(arguments);
    }
    let mut clock = Clock::default();
    let looks = looks(arguments)?;
    if looks.iter().any(|look| matches!(look.process, Process::Print(_))) {
        bail!(
            "certify compares the forms of camera films, expected a film in the camera (bake --camera none certifies what it bakes)"
        );
    }
    let law = SamplingLaw { count: arguments.colours, ..SamplingLaw::default() };
    let progress = bar("certifying", (looks.len() * forms().len()) as u64);
    let mut text = format!(
        "CIEDE2000 from the exact film, {} sRGB colours from -10 to +10 stops, any saturation; max after following the worst\n\
         {:46} {:24} {:>6} {:>6} {:>6} {:>7}  {:>16}\n",
        arguments.colours, "process", "form", "mean", "worst*", "p99", "max", "to +6: mean, max"
    );
    let mut rows = Vec::new();
    // The best form of a single process is described in full.
    let mut best = (f64::INFINITY, String::new());
    for look in &looks {
        let (process, film) = (&look.process, clock.time("compile", || look.look())?);
        let measure = Certifier::new(&film)?;
        let samples = clock.time("film", || measure.samples(&law, WorkingSpace::Srgb))?;
        // Only a film has the curves that the other forms are made of.
        let fits = |recipe: &Recipe| recipe.form == Form::Plain || film.film().is_ok();
        for (form, recipe) in forms().into_iter().filter(|(_, recipe)| fits(recipe)) {
            let compiled = clock.time("bake", || film.baked(&recipe))?;
            let found =
                clock.time("certify", || measure.certify(&samples, |rgb| compiled.apply(rgb), Search::Ascent))?;
            let name = format!("{}, {} aim", process.name(), process.aim().word());
            row(&mut text, &name, form, &found);
            if found.max_found < best.0 {
                best = (found.max_found, format!("\n{name}, {form}\n{}", in_words(&found, "sRGB")));
            }
            rows.push(
                json!({ "process": process, "form": form, "description": compiled.describe(), "certificate": found }),
            );
            progress.inc(1);
        }
    }
    progress.finish_and_clear();
    text.push_str("* the worst of the five bands of four stops\n");
    if looks.len() == 1 {
        text.push_str(&best.1);
    }
    let _ = writeln!(text, "time: {}", clock.sentence());
    Ok(Report { text, json: Value::from(rows), as_json: arguments.json })
}

#[cfg(feature = "measure")]
fn buffer_steps(arguments: &Arguments) -> Result<Report> {
    use onelight_benches::buffers;

    let mut look = arguments.look.chosen()?;
    look.expose(arguments.ev);
    let film = look.look()?;
    let mut text =
        "largest step (CIEDE2000) on a grey ramp from -8 to +4 stops, through the buffer and the film\n".to_owned();
    let mut json = serde_json::Map::new();
    for case in &buffers::CASES {
        let step = buffers::largest_step(case, &film)?;
        let _ = writeln!(text, "  {:30} {step:.2}", case.name);
        json.insert(case.name.to_owned(), step.into());
    }
    Ok(Report { text, json: Value::from(json), as_json: arguments.json })
}

fn looks(arguments: &Arguments) -> Result<Vec<ChosenLook>> {
    let mut look = arguments.look.chosen()?;
    look.expose(arguments.ev);
    if !arguments.all {
        return Ok(vec![look]);
    }
    Ok(of_the_readme(&look.process)?.into_iter().map(ChosenLook::from).collect())
}

/// The five films of the README in both aims, all else as `base` has it.
pub(super) fn of_the_readme(base: &Process) -> Result<Vec<Process>> {
    let mut all = Vec::new();
    for camera in CAMERAS {
        let usual = ProcessKeys::from(&Process::for_camera(camera)?);
        for aim in [Aim::Neutral, Aim::Sheet] {
            let films = (usual.camera.clone(), usual.print.clone());
            all.push(with_films(base, films, |keys| keys.aim = aim)?);
        }
    }
    Ok(all)
}

/// The same process with other built-in films, and what else `change` says.
pub(super) fn with_films(
    base: &Process,
    (camera, print): (String, Option<String>),
    change: impl FnOnce(&mut ProcessKeys),
) -> Result<Process> {
    let mut keys = ProcessKeys { camera, print, ..ProcessKeys::from(base) };
    (keys.camera_sheet, keys.camera_sha256, keys.print_sheet, keys.print_sha256) = (None, None, None, None);
    change(&mut keys);
    Ok(keys.process()?)
}

fn row(text: &mut String, process: &str, form: &str, found: &Certificate) {
    let MeanAndMax { mean: mean6, max: max6 } = to_six_stops(found);
    let d = &found.overall;
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "{process:46} {form:24} {:>6.3} {:>6.3} {:>6.3} {:>7.3}  {mean6:>8.3}, {max6:.3}",
        d.mean, found.headline_mean, d.p99, found.max_found
    );
}
