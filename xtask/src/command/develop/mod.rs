mod bands;
pub(crate) mod exposure;
mod film;
mod input;
mod job;
mod light;
mod on_film;
mod output;
mod paths;
mod sample;
mod sequence;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use clap::Args;
use onelight::{ColourSpaces, Process, TransferCurve, Word};
use onelight_picture::{Band, Description, Limits};
use serde_json::json;

use self::exposure::Exposure;
use self::film::{Film, Form};
use self::input::InputArguments;
use self::job::{Developed, Order, Settings, develop_picture};
use self::on_film::OnFilm;
use self::output::{OutputArguments, Target};
use self::paths::same_file;
use self::sample::Sample;
use self::sequence::{FrameNumbers, Memory, Shard, Summary};
use crate::exposure::ExposureArguments;
use crate::look::LookArguments;
use crate::progress::{Clock, bar};
use crate::{Report, atomic_file, folders};

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Picture: scene-linear EXR, float TIFF or Radiance, or TIFF, PNG or JPEG, whose coding is undone; many as 'shot.####.exr', shot.@@@@.exr, 'shot.$F4.exr', shot.%04d.exr or '*.exr'
    #[arg(value_name = "IN")]
    input: PathBuf,
    /// Developed picture: .png, .tif or .jpg (display-coded) or .exr (linear, display-referred, not clipped, as floats of .tif);
    /// many as IN says it
    #[arg(value_name = "OUT")]
    output: PathBuf,
    #[arg(hide = true)]
    more: Vec<PathBuf>,
    #[command(flatten)]
    many: Many,
    #[command(flatten)]
    look: LookArguments,
    #[command(flatten)]
    camera: ExposureArguments,
    /// Exposure in stops, or auto: the log average of the picture, without a black background, comes to 0.18 [default: the look's,
    /// else 0]
    #[arg(long, value_name = "STOPS|auto", allow_hyphen_values = true)]
    ev: Option<Exposure>,
    /// How the film is computed [default: direct; reference for approaches without film]
    #[arg(long)]
    form: Option<Form>,
    #[command(flatten)]
    picture: InputArguments,
    #[command(flatten)]
    on_film: OnFilm,
    #[command(flatten)]
    out: OutputArguments,
    /// Also write an EXR map of what the look is uncertain by, as CIEDE2000: red all of it, green what the data sheets make, blue
    /// the inter-image effect (twenty exact films: about 0.1 ms a pixel)
    #[arg(long, value_name = "MAP.exr")]
    uncertainty: Option<PathBuf>,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}

/// Many pictures in one run.
#[derive(Debug, Args)]
#[command(next_help_heading = "Many pictures (docs/using.md, docs/farm.md)")]
struct Many {
    /// Frames, such as 1001-1100, 1001-1010,1020, 1001-1100x2, -10-10 or 1100-1001 [default: all that are there]
    #[arg(long, value_name = "FRAMES", allow_hyphen_values = true)]
    frames: Option<FrameNumbers>,
    /// Develop only part K of N, every Nth picture from the Kth on
    #[arg(long, value_name = "K/N")]
    shard: Option<Shard>,
    /// GiB that pictures beside each other may take; one that takes more runs alone [default: 1]
    ///
    /// Above 1 it is also the limit of what a picture holds in one piece, a tile or a strip (docs/limits.md).
    #[arg(long, value_name = "GIB")]
    memory: Option<Memory>,
}

/// Whether a map of uncertainty can be written there.
fn check_map(map: &Path, arguments: &Arguments, many: bool) -> Result<()> {
    let name = map.display();
    if many {
        bail!("--uncertainty {name}: is of one picture, expected no pattern of many");
    }
    if !map.extension().is_some_and(|end| end.eq_ignore_ascii_case("exr")) {
        bail!("{name}: holds differences as numbers, expected a name that ends in .exr");
    }
    if same_file(map, &arguments.input) || same_file(map, &arguments.output) || map == arguments.output {
        bail!("{name}: is the picture itself, expected another name");
    }
    Ok(())
}

pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    let mut clock = Clock::default();
    if let Some(more) = arguments.more.first() {
        bail!("{}: is a third name, expected two (quote a pattern: develop 'in/*.exr' 'out/*.png')", more.display());
    }
    let Many { frames, shard, memory } = &arguments.many;
    let plan = sequence::plan(&arguments.input, &arguments.output, frames.as_ref(), *shard)?;
    if let Some(plan) = &plan {
        sequence::check_exposure(plan, arguments.ev.unwrap_or_default())?;
    }
    let mut notes = Vec::new();
    let mut target = arguments.out.target(&arguments.output, &mut notes)?;
    if same_file(&arguments.input, &arguments.output) {
        bail!(
            "{}: the output would replace the picture it is made from, expected another name",
            arguments.output.display()
        );
    }
    let mut look = arguments.look.chosen()?;
    let spaces = look.process.spaces_mut();
    let white_luminance = spaces.output_coding.is_hdr().then_some(spaces.white_luminance as f32);
    if target.is_linear() && spaces.output_coding != TransferCurve::Linear {
        let what = if target == Target::Exr { "an EXR" } else { "a TIFF of floats" };
        notes.push(format!("{what} holds linear light: not coded by {}", spaces.output_coding.word()));
        if spaces.output_coding.is_hdr() {
            notes.push(format!("(1, 1, 1) is {} cd/m2", spaces.white_luminance));
        }
        *spaces = ColourSpaces {
            output_coding: TransferCurve::Linear,
            white_luminance: ColourSpaces::default().white_luminance,
            ..*spaces
        };
    }
    if spaces.output_coding.is_hdr() {
        target = arguments.out.for_hdr(target, spaces.output_coding, &arguments.output)?;
    }
    // What is typed takes the place of the look's own exposure.
    if arguments.ev.is_some() {
        look.expose(Some(0.0));
    }
    let scene = arguments.camera.resolve(&look)?;
    if scene.is_metered() && arguments.ev == Some(Exposure::Auto) {
        bail!("--ev auto exposes by the picture: the camera's settings change nothing, expected one or the other");
    }
    let mut input = arguments.picture.settings(arguments.look.names_input_space());
    input.match_to(&look.process)?;
    if matches!(look.process, Process::Print(_)) && (arguments.ev.is_some() || !scene.changes_nothing()) {
        bail!(
            "--camera none prints codes of a scan, which are no light: --ev, --unit and --buffer change nothing, expected them left out (--points changes the print)"
        );
    }
    let mut settings = Settings {
        film: clock.time("compile", || Film::new(&look, arguments.form))?,
        look,
        exposure: arguments.ev.unwrap_or_default(),
        scene,
        input,
        on_film: arguments.on_film,
        target,
        white_luminance,
        metadata: arguments.out.metadata.unwrap_or_default(),
        limits: Limits {
            max_pixels: arguments.picture.max_pixels,
            max_bytes: memory.unwrap_or_default().bytes().max(Limits::default().max_bytes),
            ..Limits::default()
        },
    };
    settings.on_film.check(settings.film.effects())?;
    let output = folders::shown(&arguments.output);
    if let Some(map) = &arguments.uncertainty {
        check_map(map, arguments, plan.is_some())?;
    }
    if let Some(plan) = plan {
        let input = arguments.input.display().to_string();
        let summary = Summary { input, output, notes, as_json: arguments.json };
        return sequence::run(&settings, plan, memory.unwrap_or_default(), clock, summary);
    }
    atomic_file::remove_leftovers([arguments.output.as_path()]);
    let progress = bar("developing", 0);
    let order = Order { input: &arguments.input, output: &arguments.output, number: 0, digest: None };
    let mut sample = Sample::new(&settings.film);
    let watch = |picture: &Description, band: &Band| sample.look_at([picture.width, picture.height], band);
    let developed = clock.time("develop", || develop_picture(&settings, &order, &progress, watch));
    progress.finish_and_clear();
    let Developed { size, ev, notes: more, busy } = developed?;
    notes.extend(more);
    notes.extend(sample.notes()?);
    if let Some(map) = &arguments.uncertainty {
        settings.film = Film::uncertainty(&settings.look)?;
        (settings.exposure, settings.target) = (Exposure::Stops(ev), Target::Exr);
        // Differences are no light.
        settings.white_luminance = None;
        let progress = bar("uncertainty", 0);
        let order = Order { input: &arguments.input, output: map, number: 0, digest: None };
        let mapped = clock.time("uncertainty", || develop_picture(&settings, &order, &progress, |_, _| {}));
        progress.finish_and_clear();
        mapped?;
        notes.push(format!("{}: what the look is uncertain by, as CIEDE2000", folders::shown(map)));
    }

    let process = &settings.look.process;
    let ev = ev + process.spaces().ev;
    let mut text = String::new();
    let _ = writeln!(text, "{output}   {}x{}, {}, {ev:+.2} EV", size[0], size[1], process.name());
    for note in &notes {
        let _ = writeln!(text, "  note: {note}");
    }
    let steps = [("reading", busy.reading), ("film", busy.developing), ("writing", busy.writing)];
    let shown = steps.map(|(step, time)| format!("{step} {:.2} s", time.as_secs_f64())).join(", ");
    let _ = writeln!(text, "time: {} (side by side: {shown})", clock.sentence());
    let steps: serde_json::Map<_, _> =
        steps.map(|(step, time)| (step.to_owned(), time.as_secs_f64().into())).into_iter().collect();
    let json = json!({
        "process": process,
        "input": arguments.input.display().to_string(),
        "output": output,
        "size": size,
        "ev": ev,
        "notes": notes,
        "seconds": clock.json(),
        "seconds_side_by_side": steps,
    });
    Ok(Report { text, json, as_json: arguments.json })
}
