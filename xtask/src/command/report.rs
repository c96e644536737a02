//! `report`: the speed of every form against its error, and what its parts cost, as one page.

mod axis;
mod figure;
mod forms;
mod frame;
mod labels;
mod machine;
mod measure;
mod outside;
mod page;
mod plot;
mod stopwatch;
mod studies;
mod table;
mod text;
mod words;

use std::fmt::Write as _;
use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use onelight::Process;
use serde_json::json;

use self::forms::{Kind, Scope};
use self::machine::Machine;
use self::measure::{Look, Prepared, law, timed};
use self::outside::Elsewhere;
use self::stopwatch::Timing;
use self::studies::{Growth, Studies, frame, growth, rounds};
use crate::look::LookArguments;
use crate::progress::Clock;
use crate::whole::WholeSet;
use crate::{Report, folders};

/// The reversal film beside the default negative, so that both kinds show.
const REVERSAL: &str = "fuji-velvia-50";

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    #[command(flatten)]
    look: LookArguments,
    /// Fewer forms, fewer colours and a smaller picture: seconds instead of minutes, and rough figures
    #[arg(long)]
    quick: bool,
    /// Folder to write to [default: target/onelight/report]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Write the plot that the README shows too, to docs/images/speed-error.svg
    #[arg(long, conflicts_with = "quick")]
    commit: bool,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}

/// Everything that is on the page.
struct Contents {
    scope: Scope,
    machine: Machine,
    colours: usize,
    rounds: usize,
    /// Width and height of the picture timed on.
    frame: [usize; 2],
    /// What is on it.
    content: &'static str,
    copy: Timing,
    looks: Vec<(Look, Studies)>,
    /// Of the first look.
    growth: Growth,
    elsewhere: Elsewhere,
    /// How long each part took.
    clock: String,
}

pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    let mut clock = Clock::default();
    let scope = if arguments.quick { Scope::Quick } else { Scope::Full };
    // Outside the workspace nothing else was measured.
    let elsewhere = folders::output("").map_or_else(|_| Ok(Elsewhere::default()), |folder| Elsewhere::read(&folder))?;
    let folder = match &arguments.out {
        Some(folder) => folders::make(folder)?,
        None => folders::output("report")?,
    };
    let mut prepared = Vec::new();
    for process in processes(&arguments.look)? {
        prepared.push(clock.time("forms", || Prepared::new(&process, scope))?);
    }
    let frame = clock.time("picture", || frame(scope))?;
    let (looks, copy) = clock.time("timing", || timed(&prepared, &frame, rounds(scope)))?;
    let mut studied = Vec::new();
    for (prepared, look) in prepared.iter().zip(looks) {
        let studies = clock.time("studies", || Studies::of(prepared, &look, scope))?;
        studied.push((look, studies));
    }
    let growth = clock.time("growth", || growth(&prepared[0], &studied[0].0, &frame, scope))?;
    let contents = Contents {
        scope,
        machine: Machine::here(),
        colours: law(scope).count,
        rounds: rounds(scope),
        frame: frame.size(),
        content: "the fixture scene enlarged four times, with grain",
        copy,
        looks: studied,
        growth,
        elsewhere,
        clock: clock.sentence(),
    };
    let mut files = WholeSet::in_folder(&folder);
    let mut json = json(&contents, &clock);
    files.add("index.html", page::html(&contents).into_bytes());
    files.add("report.json", serde_json::to_vec_pretty(&json)?);
    let mut written = files.write()?;
    if arguments.commit {
        let mut picture = WholeSet::in_folder(&folders::workspace()?.join("docs/images"));
        picture.add("speed-error.svg", page::picture(&contents).into_bytes());
        written.extend(picture.write()?);
    }
    let shown: Vec<String> = written.iter().map(|file| folders::shown(file)).collect();
    let text = said(&contents, &shown);
    json["files"] = shown.into();
    Ok(Report { text, json, as_json: arguments.json })
}

/// The look asked for; without a word about films, the default negative and a reversal film.
fn processes(arguments: &LookArguments) -> Result<Vec<Process>> {
    let process = arguments.process()?;
    if arguments.names_film() {
        return Ok(vec![process]);
    }
    let Process { camera, print, .. } = Process::for_camera(REVERSAL)?;
    let reversal = Process { camera, print, ..process.clone() };
    Ok(vec![process, reversal])
}

fn json(contents: &Contents, clock: &Clock) -> serde_json::Value {
    let looks: Vec<_> =
        contents.looks.iter().map(|(look, studies)| json!({ "look": look, "studies": studies })).collect();
    json!({
        "scope": contents.scope,
        "machine": contents.machine,
        "unit": { "error": "CIEDE2000", "time": "ns for a pixel, one thread" },
        "colours": contents.colours,
        "rounds": contents.rounds,
        "frame": contents.frame,
        "copy": contents.copy,
        "looks": looks,
        "growth": contents.growth,
        "elsewhere": contents.elsewhere,
        "seconds": clock.json(),
    })
}

/// The advice, and where the rest is.
fn said(contents: &Contents, files: &[String]) -> String {
    let mut said = String::new();
    for file in files {
        let _ = writeln!(said, "{file}");
    }
    for (look, _) in &contents.looks {
        let _ = writeln!(said, "{}", look.name);
        for row in figure::front(&look.rows, figure::Which::Max) {
            let (time, error) = (row.time.ns, row.error);
            let (mean, max) = (text::figure(error.mean), text::figure(error.max));
            let _ = writeln!(said, "  {:26} {:>8} ns  mean {mean}, max {max}", row.name(), text::figure(time));
        }
        if let Some(film) = look.rows.iter().find(|row| row.kind == Kind::Reference) {
            let _ = writeln!(said, "  {:26} {:>8} ns", "the film itself", text::figure(film.time.ns));
        }
        for advice in words::advice(look, contents.copy, &contents.elsewhere) {
            let _ = writeln!(said, "  {}: {}", advice.whom, advice.sentence);
        }
    }
    let _ = writeln!(said, "copy: {:.2} ns\ntime: {}", contents.copy.ns, contents.clock);
    said
}
