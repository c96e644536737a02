use anyhow::Result;
use onelight::{StockKind, stock, stock_ids};
use onelight_benches::DescribedLook;
use onelight_benches::stability::{Card, Contents, STEPS, rows as measured};

use super::Arguments;
use crate::atomic_file::AtomicFiles;
use crate::command::certify::{of_the_readme, with_films};
use crate::progress::{Clock, bar};
use crate::{Report, folders};

pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    let mut clock = Clock::default();
    let folder = match &arguments.out {
        Some(folder) => folders::make(folder)?,
        None => folders::output("")?,
    };
    let looks = looks(arguments)?;
    let card = Card::open()?;
    let progress = bar("measuring", (looks.len() * STEPS) as u64);
    let mut rows = Vec::new();
    for look in &looks {
        rows.extend(clock.time("measure", || measured(look, card.as_ref(), || progress.inc(1)))?);
    }
    progress.finish_and_clear();
    let contents = Contents { card: card.as_ref().map(|card| card.name().to_owned()), rows: &rows };
    let mut json = contents.json();
    let mut files = AtomicFiles::in_folder(&folder);
    files.add("stability.md", contents.markdown().into_bytes());
    files.add("stability.json", serde_json::to_vec_pretty(&json)?);
    let written: Vec<String> = files.write()?.iter().map(|file| folders::shown(file)).collect();
    let text = format!("{}{}\ntime: {}\n", contents.summary(), written.join("\n"), clock.sentence());
    json["files"] = written.into();
    Ok(Report { text, json, as_json: arguments.json })
}

/// The look named; else those of the README, or all.
fn looks(arguments: &Arguments) -> Result<Vec<DescribedLook>> {
    let chosen = arguments.look.chosen()?;
    if !arguments.all {
        if arguments.look.names_film() {
            return Ok(vec![chosen.described()]);
        }
        return Ok(of_the_readme(&chosen.process)?.into_iter().map(DescribedLook::from).collect());
    }
    let of_kind = |kind| stock_ids().filter(move |id| stock(id).is_ok_and(|stock| stock.kind() == kind));
    let look = |camera: &str, print: Option<&str>| {
        with_films(&chosen.process, (camera.to_owned(), print.map(str::to_owned)), |_| {}).map(DescribedLook::from)
    };
    let reversal = of_kind(StockKind::Reversal).map(|camera| look(camera, None));
    let negatives = of_kind(StockKind::Negative)
        .flat_map(|camera| of_kind(StockKind::Print).map(move |print| (camera, print)))
        .map(|(camera, print)| look(camera, Some(print)));
    reversal.chain(negatives).collect()
}
