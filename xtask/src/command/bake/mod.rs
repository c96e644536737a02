mod arguments;
mod job;
mod measured;
mod tints;

use std::fmt::Write as _;

use anyhow::{Result, bail};
use onelight::baked::{Baked, FileFormat, Form};
use onelight::{ColourSpaces, Look, Process, Word as _};
use serde_json::{Value, json};

pub(crate) use self::arguments::Arguments;
use self::job::Job;
use self::measured::Measured;
use crate::atomic_file::AtomicFiles;
use crate::look::ChosenLook;
use crate::progress::Clock;
use crate::{Report, folders, preview, scene_colours};

/// Stops over mid grey beyond which the 1D table of a `.cube`, whose steps are equal in light, leaves too few of them to the
/// shadows: 65536 steps to +14 stops are 0.05 each.
const CUBE_STOPS: f64 = 14.0;

pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    let mut clock = Clock::default();
    let mut looks = arguments.look.each()?;
    looks.iter_mut().for_each(|look| look.expose(arguments.ev));
    let config = arguments.programs().iter().any(|target| target.takes_ocio_config());
    if looks.len() > 1 && !(config && arguments.programs().iter().all(|target| target.takes_ocio_config())) {
        bail!(
            "--camera: several films go into one OpenColorIO configuration, expected --for ocio, blender or nuke with them"
        );
    }
    let mut tables = Vec::new();
    for look in &looks {
        let film = clock.time("compile", || look.look())?;
        let scene = clock.time("scene", || scene_colours::read(&arguments.scene, &look.process))?;
        for job in clock.time("choose", || job::jobs(arguments, &film))? {
            tables.push(Table::new(arguments, look, &film, job, scene.as_deref(), &mut clock)?);
        }
    }
    let process = &looks[0].process;
    let folder = match &arguments.out {
        Some(folder) => folders::make(folder)?,
        None => folders::output(&process.name())?,
    };
    let mut files = AtomicFiles::in_folder(&folder);
    // Several looks in one folder go by the names of their films.
    let stem = |name: &str| if looks.len() > 1 { name.to_owned() } else { "look".to_owned() };
    for table in &mut tables {
        let stem = stem(table.baked.name());
        clock.time("write", || table.write(&mut files, &stem))?;
    }
    for look in &looks {
        files.add(&format!("{}.toml", stem(&look.process.name())), look.text_in(&folder).into_bytes());
    }
    if config {
        files.add("look.ocio", ocio_config(&tables)?);
    }
    let mut json = json(process, &tables);
    if !arguments.quick {
        files.add("look.json", serde_json::to_vec_pretty(&json)?);
        files.add("chart.png", clock.time("chart", || preview::chart(&tables[0].baked))?);
        files.add("preview.png", clock.time("preview", || preview::sheet(&tables[0].baked))?);
    }
    let written = clock.time("save", || files.write())?;
    let shown: Vec<String> = written.iter().map(|file| folders::shown(file)).collect();
    let mut text = format!("{}, {} aim, in {}\n", process.name(), process.aim().word(), folders::shown(&folder));
    for (place, table) in tables.iter().enumerate() {
        text.push_str(&table.text(place == 0));
    }
    if let Some(note) = beyond_colour(process) {
        let _ = writeln!(text, "  note: {note}");
    }
    if arguments.quick {
        text.push_str("not certified: how far it lies from the film was not measured (leave out --quick)\n");
    }
    let _ = writeln!(text, "time: {}", clock.sentence());
    json["files"] = shown.into();
    json["seconds"] = clock.json();
    Ok(Report { text, json, as_json: arguments.json })
}

/// The configuration around the structured tables, each under the name of its films.
fn ocio_config(tables: &[Table]) -> Result<Vec<u8>> {
    let structured = tables.iter().filter(|table| table.job.recipe.form == Form::Structured);
    let views: Vec<(&Baked, &str)> = structured
        .flat_map(|table| table.names.iter().map(|name| (&table.baked, name.as_str())))
        .filter(|(_, name)| name.ends_with(".clf"))
        .collect();
    let comments: Vec<String> = views
        .iter()
        .flat_map(|(baked, file)| [format!("{}: {file}", baked.title()), format!("  {}", baked.output_in_words())])
        .collect();
    Ok(onelight::baked::ocio_config(&views, &comments)?)
}

/// A table that was baked, and what is said of it.
struct Table {
    job: Job,
    baked: Baked,
    measured: Option<Measured>,
    notes: Vec<String>,
    /// The names of its files, once they are written.
    names: Vec<String>,
}

impl Table {
    fn new(
        arguments: &Arguments,
        look: &ChosenLook,
        film: &Look,
        job: Job,
        scene: Option<&[[f64; 3]]>,
        clock: &mut Clock,
    ) -> Result<Self> {
        let mut notes = Vec::new();
        let own = look.process.spaces().output_coding;
        let other = match job.coding.filter(|coding| *coding != own) {
            Some(coding) => {
                notes.push(format!("coded {} for its programs, not {}", coding.word(), own.word()));
                let mut look = look.clone();
                let spaces = look.process.spaces_mut();
                // Only absolute light has a luminance.
                let white_luminance =
                    if coding.is_hdr() { spaces.white_luminance } else { ColourSpaces::default().white_luminance };
                *spaces = ColourSpaces { output_coding: coding, white_luminance, ..*spaces };
                Some(clock.time("compile", || look.look())?)
            }
            None => None,
        };
        // A description always names a coding, be it the default's.
        let unusual = job.loads.iter().find_map(|(target, _)| {
            target.usual_coding().filter(|usual| job.coding.is_none() && *usual != own).map(|usual| (target, usual))
        });
        if let Some((target, usual)) = unusual.filter(|_| !arguments.look.types_output_coding()) {
            notes.push(format!(
                "coded {} as the look says, where {} is usual for {} (--output-coding {1})",
                own.word(),
                usual.word(),
                target.word()
            ));
        }
        let film = other.as_ref().unwrap_or(film);
        let baked = clock.time("bake", || job::baked(film, &job.recipe, scene))?;
        if let Some(note) = too_wide_for_cube(&job, &baked) {
            notes.push(note);
        }
        let measured = match arguments.quick {
            true => None,
            false => {
                let measure = || Measured::new(look, film, &baked, &job.formats, scene, arguments.max_de);
                Some(clock.time("certify", measure)?)
            }
        };
        Ok(Self { job, baked, measured, notes, names: Vec::new() })
    }

    fn write(&mut self, files: &mut AtomicFiles, stem: &str) -> Result<()> {
        let measured = self.measured.as_ref().map(Measured::summary);
        let comments = self.baked.comments(measured.as_deref());
        for format in &self.job.formats {
            for file in self.baked.files(*format, &comments)? {
                let name = file.name.strip_prefix("look").map_or(file.name.clone(), |rest| format!("{stem}{rest}"));
                files.add(&name, file.bytes);
                self.names.push(name);
            }
        }
        Ok(())
    }

    /// What people read of it: all of the first table's certificate, a line of the others'.
    fn text(&self, whole: bool) -> String {
        let mut text = String::new();
        let _ = writeln!(text, "{}: {}", self.names.join(", "), self.baked.describe());
        let _ = writeln!(text, "  takes {}", self.baked.input_in_words());
        for (target, load) in &self.job.loads {
            let _ = writeln!(text, "  {}: {load}", target.word());
        }
        for note in &self.notes {
            let _ = writeln!(text, "  note: {note}");
        }
        let Some(measured) = &self.measured else { return text };
        if whole {
            text.push_str(&measured.text());
        } else {
            let _ = writeln!(text, "  {}", measured.summary());
        }
        for sentence in measured.warnings() {
            let _ = writeln!(text, "  warning: {sentence}");
        }
        text
    }

    fn json(&self) -> Value {
        let recipe = &self.job.recipe;
        let mut json = json!({
            "files": self.names,
            "form": recipe.form.word(),
            "input": self.baked.input_in_words(),
            "output": self.baked.output_in_words(),
            "description": self.baked.describe(),
            "certified": self.measured.is_some(),
        });
        if let Some(table) = self.baked.table() {
            json["size"] = table.size().into();
            json["storage"] = recipe.storage.word().into();
            json["coding"] = recipe.coding.word().into();
        }
        if let (Some(json), Some(measured)) = (json.as_object_mut(), &self.measured) {
            json.extend(measured.json());
        }
        json
    }
}

/// What a look has that no table can.
fn beyond_colour(process: &Process) -> Option<String> {
    let Process::Film(film) = process else { return None };
    film.effects.film_format.map(|format| {
        format!("film_format {format}: sharpness, halation and grain depend on more than a pixel and are in no LUT (develop has them)")
    })
}

/// Why a `.cube` with a wide range is no good: its certificate shows it, a quick bake has none.
fn too_wide_for_cube(job: &Job, baked: &Baked) -> Option<String> {
    let stops = (baked.max()? / onelight::spectra::MID_GREY).log2();
    let shaped = job.recipe.form == Form::Plain && baked.coordinate().is_none();
    (shaped && stops > CUBE_STOPS && job.formats.contains(&FileFormat::Cube)).then(|| {
        format!(
            "the .cube's 1D table has equal steps of light, too wide for shadows where it ends at {stops:+.1} stops; \
             --format clf or --form structured keep them"
        )
    })
}

/// The first table's entries, and those of each table.
fn json(process: &Process, tables: &[Table]) -> Value {
    let all: Vec<Value> = tables.iter().map(Table::json).collect();
    let mut json = all[0].clone();
    json["process"] = json!(process);
    json["tables"] = all.into();
    json
}
