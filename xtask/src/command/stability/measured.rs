use anyhow::Result;
use onelight::{Stock, StockKind, pairs, stock, stock_ids};
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
    let stocks: Vec<Stock> = stock_ids().map(stock).collect::<Result<_, _>>()?;
    let look = |(camera, print): (&Stock, Option<&Stock>)| {
        let print = match print {
            None if camera.kind() == StockKind::Negative => Some("scan"),
            print => print.map(Stock::id),
        };
        let films = (camera.id().to_owned(), print.map(str::to_owned));
        with_films(&chosen.process, films, |_| {}).map(DescribedLook::from)
    };
    pairs(&stocks).into_iter().map(look).collect()
}
