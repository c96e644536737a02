use std::cell::RefCell;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

use anyhow::{Context, Result};
use onelight_benches::DescribedLook;
use onelight_benches::report::{self, Elsewhere, Listener, Scope};

use super::Arguments;
use crate::atomic_file::AtomicFiles;
use crate::command::certify::with_films;
use crate::look::LookArguments;
use crate::progress::{Clock, bars};
use crate::{Report, folders};

/// The reversal film beside the default negative, so that both kinds show.
const REVERSAL: &str = "fuji-velvia-50";

/// Longest file of other measurements that is read.
const MAX_BYTES: u64 = 4 << 20;

pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    let clock = RefCell::new(Clock::default());
    let scope = if arguments.quick { Scope::Quick } else { Scope::Full };
    let elsewhere = elsewhere()?;
    let folder = match &arguments.out {
        Some(folder) => folders::make(folder)?,
        None => folders::output("report")?,
    };
    let bars = bars();
    let time = |part, taken| clock.borrow_mut().add(part, taken);
    let listener = Listener { progress: &bars, time: &time };
    let found = report::measure(&looks(&arguments.look)?, scope, elsewhere, listener)?;
    let clock = clock.into_inner();
    let found = found.with_clock(clock.sentence());
    let mut files = AtomicFiles::in_folder(&folder);
    let mut json = found.json(&clock.json());
    files.add("index.html", found.html().into_bytes());
    files.add("report.json", serde_json::to_vec_pretty(&json)?);
    let mut written = files.write()?;
    if arguments.commit {
        let mut picture = AtomicFiles::in_folder(&folders::workspace()?.join("docs/images"));
        picture.add("speed-error.svg", found.plot().into_bytes());
        written.extend(picture.write()?);
    }
    let shown: Vec<String> = written.iter().map(|file| folders::shown(file)).collect();
    let text = found.summary(&shown);
    json["files"] = shown.into();
    Ok(Report { text, json, as_json: arguments.json })
}

/// What `gpu-bench` and `benches/peers/run.py` measured; nothing where they have not run, or outside the workspace.
fn elsewhere() -> Result<Elsewhere> {
    let Ok(folder) = folders::output("") else { return Ok(Elsewhere::default()) };
    let mut elsewhere = Elsewhere::default();
    if let Some((name, text)) = text_of(&folder.join("gpu.json"))? {
        elsewhere = elsewhere.with_cards(&name, &text)?;
    }
    if let Some((name, text)) = text_of(&folder.join("peers.json"))? {
        elsewhere = elsewhere.with_peers(&name, &text)?;
    }
    Ok(elsewhere)
}

/// A file with its name, if it is there.
fn text_of(path: &Path) -> Result<Option<(String, String)>> {
    let name = path.display().to_string();
    let file = match File::open(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        other => other.with_context(|| format!("{name}: cannot be read"))?,
    };
    let mut text = String::new();
    file.take(MAX_BYTES).read_to_string(&mut text).with_context(|| format!("{name}: is no text"))?;
    Ok(Some((name, text)))
}

/// The look asked for; without a word about films, the default negative and a reversal film.
fn looks(arguments: &LookArguments) -> Result<Vec<DescribedLook>> {
    let chosen = arguments.chosen()?;
    if arguments.names_film() {
        return Ok(vec![chosen.described()]);
    }
    let reversal = with_films(&chosen.process, (REVERSAL.to_owned(), None), |_| {})?;
    Ok(vec![chosen.described(), reversal.into()])
}
