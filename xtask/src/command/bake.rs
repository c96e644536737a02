use std::fmt::Write as _;
use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use clap::Args;
use onelight::baked::{AsWritten, Baked, FileFormat, Form, Recipe, ShaperChoice, smallest_under};
use onelight::certify::{Certifier, Gamut, Tint, in_words, summary};
use onelight::lut::{Certificate, Deviation, SamplingLaw, Search, Storage, deviation};
use onelight::{DirectSettings, Entries, Look, Nodes, Process, TableCoding, TransferCurve, Word, WorkingSpace};
use serde_json::json;

use crate::atomic_file::AtomicFiles;
use crate::look::LookArguments;
use crate::progress::{Clock, bar};
use crate::words::words;
use crate::{Report, folders, preview, scene_colours};

/// A table whose largest certified difference is above this deserves a warning, unless `--max-de` names another.
const WARN_ABOVE: f64 = 2.0;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    look: LookArguments,
    /// What the look is baked to
    #[arg(long, default_value = "plain", value_parser = words::<Form>())]
    form: Form,
    /// Nodes along each side of the table [default: 33 plain, 32 structured]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(2..=129))]
    size: Option<u16>,
    /// How scene light becomes a coordinate of a plain table
    #[arg(long, default_value = "log2", value_parser = words::<ShaperChoice>())]
    shaper: ShaperChoice,
    /// Where the range of a plain table ends, in stops over mid grey [default: fitted to the look]
    #[arg(long, value_name = "STOPS", value_parser = stops)]
    stops: Option<f64>,
    /// Where the entries come from [default: sampled plain, fitted structured]
    #[arg(long, value_parser = words::<Entries>())]
    entries: Option<Entries>,
    /// How the entries are stored; what is measured is what was stored
    #[arg(long, default_value = "f32", value_parser = words::<Storage>())]
    storage: Storage,
    /// What the entries of a structured table are
    #[arg(long, default_value = "density", value_parser = words::<TableCoding>())]
    coding: TableCoding,
    /// Files to write, comma-separated [default: cube for plain, clf for structured]
    #[arg(long, value_delimiter = ',', value_name = "FORMATS", value_parser = words::<FileFormat>())]
    format: Vec<FileFormat>,
    /// Exponentials of the direct form: of the projection, and of the print's exposure [default: 10,5]
    #[arg(long, value_name = "P[,D]", value_parser = nodes)]
    nodes: Option<Nodes>,
    /// Choose the smallest structured table, or with --form direct the fewest exponentials, whose certified maximum is at most X
    #[arg(long, value_name = "X", conflicts_with_all = ["size", "storage", "coding", "shaper", "stops", "entries", "nodes"])]
    max_de: Option<f64>,
    /// Write the LUT alone, at once: no certificate, no preview
    #[arg(long, conflicts_with_all = ["max_de", "scene"])]
    quick: bool,
    /// Pictures to measure on, and to fit the range of a plain table to
    #[arg(long, num_args = 1.., value_name = "EXR")]
    scene: Vec<PathBuf>,
    /// Folder to write to (target/onelight/ and the films' names if left out)
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    let mut clock = Clock::default();
    let mut look = arguments.look.chosen()?;
    let spaces = look.process.spaces_mut();
    let mut notes = Vec::new();
    if arguments.shaper == ShaperChoice::Bevy && spaces.output_coding != TransferCurve::Linear {
        notes.push(format!("Bevy's tables hold linear light: not coded by {}", spaces.output_coding.word()));
        spaces.output_coding = TransferCurve::Linear;
    }
    let (process, film) = (&look.process, clock.time("compile", || look.look())?);
    let scene = clock.time("scene", || scene_colours::read(&arguments.scene, process))?;
    let recipe = clock.time("choose", || recipe(arguments, &film))?;
    let formats = formats(arguments, recipe.form)?;
    let baked = clock.time("bake", || baked(&film, &recipe, scene.as_deref()))?;
    let measured = match arguments.quick {
        true => None,
        false => Some(clock.time("certify", || Measured::new(&film, &baked, &formats, scene.as_deref()))?),
    };
    let folder = match &arguments.out {
        Some(folder) => folders::make(folder)?,
        None => folders::output(&process.name())?,
    };
    let measured_line = measured.as_ref().map(|measured| summary(measured.srgb()));
    let comments = baked.comments(measured_line.as_deref());
    let mut files = AtomicFiles::in_folder(&folder);
    let mut json = json(arguments, process, &recipe, &baked, measured.as_ref());
    clock.time("write", || -> Result<()> {
        for format in &formats {
            for file in baked.files(*format, &comments)? {
                files.add(file.name, file.bytes);
            }
        }
        files.add("look.toml", look.text_in(&folder).into_bytes());
        if !arguments.quick {
            files.add("look.json", serde_json::to_vec_pretty(&json)?);
        }
        Ok(())
    })?;
    if !arguments.quick {
        files.add("preview.png", clock.time("preview", || preview::sheet(&baked))?);
    }
    let written = clock.time("save", || files.write())?;
    let shown: Vec<String> = written.iter().map(|file| folders::shown(file)).collect();
    let mut text = String::new();
    let _ = writeln!(text, "{}, {} aim: {}", process.name(), process.aim().word(), baked.describe());
    for file in &shown {
        let _ = writeln!(text, "  {file}");
    }
    for note in &notes {
        let _ = writeln!(text, "  note: {note}");
    }
    match &measured {
        Some(measured) => text.push_str(&measured.text()),
        None => text.push_str("not certified: how far it lies from the film was not measured (leave out --quick)\n"),
    }
    for sentence in measured.iter().flat_map(|measured| measured.warnings(arguments.max_de)) {
        let _ = writeln!(text, "warning: {sentence}");
    }
    let _ = writeln!(text, "time: {}", clock.sentence());
    json["files"] = shown.into();
    json["seconds"] = clock.json();
    Ok(Report { text, json, as_json: arguments.json })
}

fn stops(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|v| (1.0..=40.0).contains(v))
        .ok_or_else(|| "expected a number of stops from 1 to 40".to_owned())
}

fn nodes(text: &str) -> Result<Nodes, String> {
    let counts: Result<Vec<usize>, _> = text.split(',').map(str::parse).collect();
    let usual = DirectSettings::default().nodes;
    match (counts.as_deref(), usual) {
        (Ok(&[projection, duplication]), _) | (Ok(&[projection]), Nodes::Counts { duplication, .. }) => {
            Ok(Nodes::Counts { projection, duplication })
        }
        _ => Err("expected one or two numbers from 2 to 16, such as 8 or 8,4".to_owned()),
    }
}

fn recipe(arguments: &Arguments, film: &Look) -> Result<Recipe> {
    let usual = Recipe::of(arguments.form);
    if arguments.nodes.is_some() && arguments.form != Form::Direct {
        bail!("--nodes: the {} form has no exponentials, expected --form direct with it", arguments.form.word());
    }
    match arguments.max_de {
        Some(limit) if arguments.form == Form::Direct => {
            return Ok(Recipe { nodes: Nodes::UnderMaxDe(limit), ..usual });
        }
        Some(limit) => {
            let progress = bar("choosing", 0);
            let found = smallest_under(film, limit, |tried, all| {
                progress.set_length(all as u64);
                progress.set_position(tried as u64);
            });
            progress.finish_and_clear();
            return found.with_context(|| format!("--max-de {limit}"));
        }
        None => {}
    }
    Ok(Recipe {
        size: arguments.size.map_or_else(|| usual_size(arguments, usual.size), usize::from),
        shaper: arguments.shaper,
        stops: arguments.stops,
        entries: arguments.entries.unwrap_or(usual.entries),
        storage: arguments.storage,
        coding: arguments.coding,
        nodes: arguments.nodes.unwrap_or(usual.nodes),
        ..usual
    })
}

/// The size that a format or an engine expects, where it expects one.
fn usual_size(arguments: &Arguments, usual: usize) -> usize {
    match arguments.format.as_slice() {
        [FileFormat::Hald] => 64,
        [FileFormat::Strip] => 32,
        _ if arguments.shaper == ShaperChoice::Bevy => 64,
        _ => usual,
    }
}

fn formats(arguments: &Arguments, form: Form) -> Result<Vec<FileFormat>> {
    let mut formats = arguments.format.clone();
    if formats.is_empty() {
        formats.push(FileFormat::usual(form));
    }
    formats.dedup();
    if let Some(format) = formats.iter().find(|format| !format.holds(form)) {
        let other = if *format == FileFormat::Json { Form::Direct } else { Form::Plain };
        bail!(
            "--format {} cannot hold the {} form, expected {}, or --form {}",
            format.word(),
            form.word(),
            FileFormat::usual(form).word(),
            other.word()
        );
    }
    if let Some(format) = formats.iter().find(|format| format.needs_coding() && !arguments.shaper.is_coding()) {
        bail!(
            "--format {} holds no shaper for scene-linear light, expected a coding such as --shaper srgb",
            format.word()
        );
    }
    Ok(formats)
}

/// Certificates of the files' numbers as written, and the deviation on the user's own pictures.
struct Measured {
    /// By format, in the order asked for.
    files: Vec<(FileFormat, Certificate)>,
    rec2020: Option<Certificate>,
    scene: Option<Deviation>,
    /// The tint of greys that the look itself has, whatever it is baked to.
    tint: Tint,
}

impl Measured {
    fn new(film: &Look, baked: &Baked, formats: &[FileFormat], scene: Option<&[[f64; 3]]>) -> Result<Self> {
        let measure = Certifier::new(film)?;
        let samples = measure.samples(&SamplingLaw::default(), WorkingSpace::Srgb)?;
        let mut written = Vec::new();
        for &format in formats {
            written.push(baked.as_written(format)?);
        }
        let mut files = Vec::new();
        for (&format, written) in formats.iter().zip(&written) {
            files.push((format, measure.certify(&samples, |rgb| written.apply(rgb), Search::Ascent)?));
        }
        let first = &written[0];
        let rec2020 = match baked.gamut() {
            Gamut::Wide => {
                let samples = measure.samples(&SamplingLaw::default(), WorkingSpace::Rec2020)?;
                let map = |rgb| first.apply(rgb);
                Some(measure.certify_in(WorkingSpace::Rec2020, &samples, map, Search::Ascent)?)
            }
            Gamut::Srgb => None,
        };
        let scene = scene.map(|colours| on_scene(film, first, colours)).transpose()?;
        Ok(Self { files, rec2020, scene, tint: measure.tint() })
    }

    /// The certificate of the first format.
    fn srgb(&self) -> &Certificate {
        &self.files[0].1
    }

    fn text(&self) -> String {
        let mut text = in_words(self.srgb(), "sRGB");
        for (format, certificate) in &self.files[1..] {
            let (mean, max) = (certificate.overall.mean, certificate.max_found);
            let _ = writeln!(text, "  the same for {}: mean {mean:.3}, max {max:.3}", format.word());
        }
        if let Some(wide) = &self.rec2020 {
            let (mean, max) = (wide.overall.mean, wide.max_found);
            let _ = writeln!(text, "  the same for Rec.2020 colours: mean {mean:.3}, max {max:.3}");
        }
        let _ = writeln!(text, "{}", self.tint);
        if let Some(d) = &self.scene {
            let _ = writeln!(
                text,
                "on the scene given, {} pixels: mean {:.3}, p95 {:.3}, p99 {:.3}, max {:.3} at {:.4}, {:.4}, {:.4}",
                d.count, d.mean, d.p95, d.p99, d.max, d.worst[0], d.worst[1], d.worst[2]
            );
        }
        text
    }

    fn warnings(&self, max_de: Option<f64>) -> Vec<String> {
        self.srgb().failures(max_de.unwrap_or(WARN_ABOVE))
    }
}

fn baked(film: &Look, recipe: &Recipe, scene: Option<&[[f64; 3]]>) -> Result<Baked> {
    Ok(scene.map_or_else(|| film.baked(recipe), |colours| film.baked_for_scene(recipe, colours))?)
}

fn on_scene(film: &Look, written: &AsWritten, colours: &[[f64; 3]]) -> Result<Deviation> {
    let difference = film.difference()?;
    let table = |rgb: [f64; 3]| written.apply(rgb.map(|v| v as f32)).map(|v| film.coding().decode(f64::from(v)));
    let between = |a: &[f64; 3], b: &[f64; 3]| difference.between(*a, *b);
    deviation(colours, |rgb| film.develop_linear(rgb), table, between).context("the scene")
}

fn json(
    arguments: &Arguments,
    process: &Process,
    recipe: &Recipe,
    baked: &Baked,
    measured: Option<&Measured>,
) -> serde_json::Value {
    let mut json = json!({
        "process": process,
        "form": recipe.form.word(),
        "description": baked.describe(),
        "certified": measured.is_some(),
    });
    if let Some(table) = baked.table() {
        json["size"] = table.size().into();
        json["storage"] = recipe.storage.word().into();
        json["coding"] = recipe.coding.word().into();
    }
    let Some(measured) = measured else { return json };
    let limit = arguments.max_de.unwrap_or(WARN_ABOVE);
    let Tint { mid_grey, largest, stops } = measured.tint;
    let found = json!({
        "unit": "CIEDE2000",
        "certificate": measured.srgb(),
        "certificates": measured.files.iter().map(|(f, c)| (f.word().to_owned(), json!(c))).collect::<serde_json::Map<_, _>>(),
        "certificate_rec2020": measured.rec2020,
        "scene": measured.scene,
        "tint": { "unit": "CIELAB C*", "mid_grey": mid_grey, "largest": largest, "stops": stops },
        "limit": limit,
        "failures": measured.srgb().failures(limit),
    });
    if let (Some(json), serde_json::Value::Object(found)) = (json.as_object_mut(), found) {
        json.extend(found);
    }
    json
}
