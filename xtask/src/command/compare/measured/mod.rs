mod banding;
mod develop;
mod frame;
mod plan;

use std::fmt::Write as _;

use anyhow::Result;
use onelight::Process;
use onelight_charts::{SheetRow, SheetSection, Tile, contact_sheet, difference_map, mean_p95_max, sheet_page};
use rayon::prelude::*;
use serde_json::{Value, json};

use super::Arguments;
use crate::atomic_file::AtomicFiles;
use crate::progress::{Clock, bar};
use crate::{Report, folders};
use develop::{Darkroom, Developed, coded, differences, on_chart};
use frame::Frame;
use plan::Sheet;

/// The sheet of frame buffers, which has no frame.
const BANDING: &str = "banding";

pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    let mut clock = Clock::default();
    let own = arguments.look.chosen()?.described();
    let own = (own.process != Process::default()).then_some(own);
    let sheets = chosen(&arguments.sheets, own.as_ref().map(|own| &own.process))?;
    let folder = match &arguments.out {
        Some(folder) => folders::make(folder)?,
        None => folders::output("compare")?,
    };
    let mut frames = vec![clock.time("scene", frame::scene)?, frame::chart()?];
    if sheets.iter().any(Sheet::is_on_film) {
        frames.push(clock.time("scene", || frame::scene_on_film(&frames[0]))?);
    }
    for path in &arguments.pictures {
        let mut user = clock.time("read", || frame::user(path, arguments.ev))?;
        if frames.iter().any(|frame| frame.name == user[0].name) {
            let name = format!("{}_{}", user[0].name, frames.len());
            user.iter_mut().for_each(|frame| frame.name.clone_from(&name));
        }
        frames.extend(user);
    }
    let chart = frame::chart_colours()?;
    let mut darkroom = Darkroom::new(own.and_then(|own| own.films));
    let mut sections = Vec::new();
    let of = |frame: &Frame| {
        let is_on_film = frame.on_film.is_some();
        sheets.iter().filter(move |sheet| sheet.is_on_film() == is_on_film)
    };
    let progress = bar("comparing", frames.iter().map(|frame| of(frame).count() as u64).sum());
    for frame in &frames {
        darkroom.change_frame();
        let mut drafts = Vec::new();
        for sheet in of(frame) {
            drafts.push(clock.time("develop", || draft(&mut darkroom, frame, sheet, &chart))?);
            progress.inc(1);
        }
        let drawn: Result<Vec<SheetSection>> =
            clock.time("draw", || drafts.into_par_iter().map(Draft::drawn).collect());
        sections.extend(drawn?);
    }
    progress.finish_and_clear();
    if arguments.sheets.is_empty() || arguments.sheets.iter().any(|name| name == BANDING) {
        sections.push(clock.time("banding", || bands(&mut darkroom))?);
    }
    let json_sections: Vec<Value> = sections.iter().map(as_json).collect();
    let mut files = AtomicFiles::in_folder(&folder);
    files.add("index.html", sheet_page(&sections).into_bytes());
    let mut text = String::new();
    for section in sections {
        figures(&mut text, &section);
        files.add(&format!("{}.png", section.file), section.png);
    }
    let written = clock.time("write", || files.write())?;
    let shown: Vec<String> = written.iter().map(|file| folders::shown(file)).collect();
    let first = shown.first().cloned().unwrap_or_default();
    let _ = writeln!(text, "{first}   {} sheets beside it", shown.len().saturating_sub(1));
    let _ = writeln!(text, "time: {}", clock.sentence());
    let json = json!({ "unit": "CIEDE2000", "files": shown, "sheets": json_sections, "seconds": clock.json() });
    Ok(Report { text, json, as_json: arguments.json })
}

/// The sheets of these names; all of them for none.
fn chosen(names: &[String], own: Option<&Process>) -> Result<Vec<Sheet>> {
    let sheets = plan::sheets(own)?;
    let known: Vec<&str> = sheets.iter().map(|sheet| sheet.name).chain([BANDING]).collect();
    if let Some(unknown) = names.iter().find(|name| !known.contains(&name.as_str())) {
        anyhow::bail!("no sheet is called {unknown:?}, expected one of {}", known.join(", "));
    }
    Ok(sheets.into_iter().filter(|sheet| names.is_empty() || names.iter().any(|name| name == sheet.name)).collect())
}

/// A sheet whose pictures are developed.
struct Draft {
    section: SheetSection,
    columns: usize,
    tiles: Vec<Tile>,
}

impl Draft {
    fn drawn(self) -> Result<SheetSection> {
        let Self { mut section, columns, tiles } = self;
        section.png = contact_sheet(&section.title, columns, &tiles)?;
        Ok(section)
    }
}

fn draft(darkroom: &mut Darkroom, frame: &Frame, sheet: &Sheet, chart: &[[f64; 3]]) -> Result<Draft> {
    let developed: Vec<Developed> = sheet.shots.iter().map(|shot| darkroom.develop(frame, shot)).collect();
    let looks: Vec<_> = sheet.shots.iter().map(|shot| darkroom.look(&shot.keys).ok()).collect();
    let made: Result<Vec<(Tile, Option<SheetRow>)>> = (0..sheet.shots.len())
        .into_par_iter()
        .map(|i| {
            let shot = &sheet.shots[i];
            let row = match (shot.beside, &developed[i], shot.beside.map(|b| &developed[b])) {
                (Some(b), Ok(turned), Some(Ok(plain))) => {
                    let differences = frame.spread(&differences(plain, turned)?);
                    let comparable = shot.ev == 0 && !sheet.is_on_film();
                    let looks = looks[b].as_ref().zip(looks[i].as_ref()).filter(|_| comparable);
                    Some(SheetRow {
                        shot: shot.caption.clone(),
                        beside: sheet.shots[b].caption.clone(),
                        here: mean_p95_max(&differences),
                        chart: looks.map(|(plain, turned)| on_chart(plain, turned, chart)).transpose()?,
                        note: String::new(),
                        picture: Some(difference_map(frame.width as u32, &differences)?),
                    })
                }
                _ => None,
            };
            let figures = row.as_ref().map_or_else(String::new, |row| {
                let [mean, p95, max] = row.here;
                format!("dE {mean:.2}, 95% {p95:.2}, max {max:.2}")
            });
            let tile = Tile {
                captions: [shot.caption.clone(), figures],
                width: frame.width as u32,
                height: frame.height as u32,
                picture: developed[i].clone().map(|linear| frame.spread(&coded(&linear))),
            };
            Ok((tile, row))
        })
        .collect();
    let (tiles, rows): (Vec<Tile>, Vec<Option<SheetRow>>) = made?.into_iter().unzip();
    let section = SheetSection {
        file: format!("{}_{}", frame.name, sheet.name),
        title: format!("{}: {}", sheet.title, frame.name),
        text: sheet.text.to_owned(),
        png: Vec::new(),
        rows: rows.into_iter().flatten().collect(),
    };
    Ok(Draft { section, columns: sheet.columns, tiles })
}

fn bands(darkroom: &mut Darkroom) -> Result<SheetSection> {
    let look = darkroom.look(&plan::usual(onelight::DEFAULT_CAMERA)?).map_err(anyhow::Error::msg)?;
    let (tiles, bands) = banding::tiles(&look)?;
    let title = "Banding of frame buffers before the film".to_owned();
    let row = |band: &banding::Band| SheetRow {
        shot: band.name.to_owned(),
        beside: "no buffer".to_owned(),
        here: band.distance,
        chart: None,
        note: format!("largest step {:.2}", band.step),
        picture: None,
    };
    Ok(SheetSection {
        file: BANDING.to_owned(),
        png: contact_sheet(&title, 4, &tiles)?,
        text: "A ramp from -7 to +3 stops through K-negative, grey and warm, and its dark part with the contrast stretched. The \
               talk's scale factor lifts the scene in the 10-bit float out of its coarse denormals: its steps fall to a third."
            .to_owned(),
        title,
        rows: bands.iter().map(row).collect(),
    })
}

fn figures(text: &mut String, section: &SheetSection) {
    let _ = writeln!(text, "{:46} {:>20}  {:>20}", section.title, "mean, 95 %, max", "ColorChecker +-2");
    for row in &section.rows {
        let of = |[mean, p95, max]: [f64; 3]| format!("{mean:.2} {p95:.2} {max:.2}");
        let chart = row.chart.map(of).unwrap_or_default();
        let _ = writeln!(text, "  {:44} {:>20}  {chart:>20}  {}", row.shot, of(row.here), row.note);
    }
}

fn as_json(section: &SheetSection) -> Value {
    let of = |[mean, p95, max]: [f64; 3]| json!({ "mean": mean, "p95": p95, "max": max });
    let rows = section.rows.iter().map(|row| {
        let (here, chart) = (of(row.here), row.chart.map(of));
        json!({ "shot": row.shot, "against": row.beside, "here": here, "color_checker": chart, "note": row.note })
    });
    json!({ "file": format!("{}.png", section.file), "title": section.title, "rows": rows.collect::<Vec<_>>() })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// docs/talk.md has the figures of every shot at normal exposure that has something to be compared with.
    #[test]
    fn docs_hold_the_sizes() {
        let docs = include_str!("../../../../../docs/talk.md");
        let (chart, mut darkroom) = (frame::chart_colours().unwrap(), Darkroom::default());
        let (mut count, mut missing) = (0, Vec::new());
        for sheet in plan::sheets(None).unwrap().iter().filter(|sheet| !sheet.is_on_film()) {
            for shot in sheet.shots.iter().filter(|shot| shot.ev == 0) {
                let Some(beside) = shot.beside else { continue };
                let (plain, turned) = (darkroom.look(&sheet.shots[beside].keys), darkroom.look(&shot.keys));
                let (Ok(plain), Ok(turned)) = (plain, turned) else { continue };
                let [mean, p95, max] = on_chart(&plain, &turned, &chart).unwrap();
                let row = format!("| {} | {mean:.2} | {p95:.2} | {max:.2} |", shot.caption);
                if !docs.lines().any(|line| line.starts_with(&row)) {
                    missing.push(row);
                }
                count += 1;
            }
        }
        assert!(missing.is_empty(), "docs/talk.md lacks\n{}", missing.join("\n"));
        assert!(count > 50, "{count}");
    }

    #[test]
    fn sheets_are_chosen_by_name() {
        assert_eq!(chosen(&["infrared".to_owned()], None).unwrap().len(), 1);
        assert!(chosen(&[BANDING.to_owned()], None).unwrap().is_empty());
        let error = chosen(&["infared".to_owned()], None).map(|_| ()).unwrap_err().to_string();
        assert!(error.contains("infared") && error.contains("infrared"), "{error}");
    }
}
