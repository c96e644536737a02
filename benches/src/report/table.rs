//! Tables as markup.

use std::fmt::Write as _;

use super::forms::sum;
use super::measure::{Look, Row};
use super::peers::Peer;
use super::stopwatch::Timing;
use super::studies::{CurveRow, EffectRow, ExposureRow, GridRow, Measured, PictureEffectRow};
use super::text::{bytes, escaped, figure, plain};
use crate::effect_decisions::DecisionSummary;

/// A cell: what is written, and the number that it is sorted by.
pub(super) enum Cell {
    Text(String),
    Number(f64, String),
}

impl Cell {
    fn figure(value: f64) -> Self {
        Self::Number(value, figure(value))
    }

    fn count(value: usize) -> Self {
        Self::Number(value as f64, value.to_string())
    }

    /// No number where the column holds numbers.
    fn none() -> Self {
        Self::Number(f64::INFINITY, "-".to_owned())
    }
}

/// A table whose columns sort where scripts run.
pub(super) fn table(caption: &str, columns: &[&str], rows: &[Vec<Cell>]) -> String {
    let mut html =
        format!("<div class=\"wide\"><table class=\"sortable\"><caption>{}</caption><thead><tr>", escaped(caption));
    for (i, column) in columns.iter().enumerate() {
        let numbers = rows.first().and_then(|row| row.get(i)).is_some_and(|cell| matches!(cell, Cell::Number(..)));
        let class = if numbers { " class=\"n\"" } else { "" };
        let _ = write!(html, "<th scope=\"col\"{class}>{}</th>", escaped(column));
    }
    html.push_str("</tr></thead><tbody>\n");
    for row in rows {
        html.push_str("<tr>");
        for cell in row {
            let _ = match cell {
                Cell::Text(text) => write!(html, "<td>{}</td>", escaped(text)),
                Cell::Number(value, text) if value.is_finite() => {
                    write!(html, "<td class=\"n\" data-v=\"{value}\">{}</td>", escaped(text))
                }
                Cell::Number(_, text) => write!(html, "<td class=\"n\">{}</td>", escaped(text)),
            };
        }
        html.push_str("</tr>\n");
    }
    html.push_str("</tbody></table></div>\n");
    html
}

/// Every form of a look.
pub(super) fn forms(look: &Look, copy: Timing) -> String {
    let columns = [
        "form",
        "size",
        "storage",
        "bytes",
        "exponentials",
        "ns/pixel",
        "Mpixel/s",
        "x copy",
        "mean",
        "worst band",
        "p99",
        "max",
        "max to +6",
    ];
    let mut rows: Vec<Vec<Cell>> = look.rows.iter().map(|row| cells(row, copy)).collect();
    let mut floor = vec![Cell::Text("copy of the picture".to_owned())];
    floor.extend([Cell::none(), Cell::Text(String::new()), Cell::none(), Cell::none()]);
    floor.extend([Cell::figure(copy.ns), Cell::figure(1e3 / copy.ns), Cell::figure(1.0)]);
    floor.extend((0..5).map(|_| Cell::none()));
    rows.push(floor);
    table("Every form: time on one thread, difference from the film in CIEDE2000", &columns, &rows)
}

fn cells(row: &Row, copy: Timing) -> Vec<Cell> {
    let time = row.time.ns;
    let name = match row.size {
        // Size and storage have columns of their own.
        Some(_) if row.detail.contains("to +6") => format!("{} to +6", row.kind.name()),
        Some(_) => row.kind.name().to_owned(),
        None => row.name(),
    };
    let storage = row.storage.map_or_else(String::new, |word| {
        let coding = row.coding.map(|coding| format!(", {coding}")).unwrap_or_default();
        format!("{word}{coding}")
    });
    let nodes = row.nodes.map_or_else(Cell::none, |[printing, projection]| {
        Cell::Number((printing + projection) as f64, sum([printing, projection]))
    });
    let error = row.error;
    let mut cells = vec![
        Cell::Text(name),
        row.size.map_or_else(Cell::none, Cell::count),
        Cell::Text(storage),
        row.bytes.map_or_else(Cell::none, |count| Cell::Number(count as f64, bytes(count))),
        nodes,
        Cell::figure(time),
        Cell::figure(1e3 / time),
        Cell::figure(time / copy.ns),
    ];
    cells.extend([error.mean, error.worst_band, error.p99, error.max, error.max_to_six].map(Cell::figure));
    cells
}

pub(super) fn grids(rows: &[GridRow]) -> String {
    let pair = |miss: Option<super::studies::Miss>| match miss {
        Some(miss) => [Cell::figure(miss.mean), Cell::figure(miss.max)],
        None => [Cell::none(), Cell::none()],
    };
    let rows: Vec<Vec<Cell>> = rows
        .iter()
        .map(|row| {
            let mut cells = vec![Cell::Text(row.name.clone()), Cell::count(row.nodes[0]), Cell::count(row.nodes[1])];
            cells.extend(pair(row.printing));
            cells.extend(pair(Some(row.projection)));
            cells.extend(pair(Some(row.both)));
            cells.push(Cell::figure(row.ns));
            cells
        })
        .collect();
    let columns = [
        "wavelengths",
        "printing",
        "projection",
        "printing alone: mean",
        "max",
        "projection alone: mean",
        "max",
        "both: mean",
        "max",
        "ns/pixel",
    ];
    table("Exponentials in place of spectra, difference in CIEDE2000", &columns, &rows)
}

pub(super) fn exposure(rows: &[ExposureRow]) -> String {
    let rows: Vec<Vec<Cell>> = rows
        .iter()
        .map(|row| {
            let misses = [row.unmatched, row.matched].into_iter().flat_map(|miss| [miss.mean, miss.max]);
            [Cell::count(row.step_nm.into())].into_iter().chain(misses.map(Cell::figure)).collect()
        })
        .collect();
    let columns = ["step (nm)", "mean dE", "max", "grey matched on that grid: mean", "max"];
    table("The exposure matrix on coarse grids", &columns, &rows)
}

pub(super) fn curves(rows: &[CurveRow]) -> String {
    let rows: Vec<Vec<Cell>> = rows
        .iter()
        .map(|row| vec![Cell::count(row.points), Cell::figure(row.miss.mean), Cell::figure(row.miss.max)])
        .collect();
    table("Curves as tables, read linearly", &["points", "mean dE", "max dE"], &rows)
}

/// What effects of the film add: nanoseconds, and parts of the time without any.
pub(super) fn effects(rows: &[EffectRow]) -> String {
    let Some(EffectRow { structured, direct, .. }) = rows.first() else { return String::new() };
    let rows: Vec<Vec<Cell>> = rows
        .iter()
        .map(|row| {
            vec![
                Cell::Text(row.effects.to_owned()),
                Cell::figure(row.structured.ns),
                Cell::figure(row.structured.ns / structured.ns),
                Cell::figure(row.direct.ns),
                Cell::figure(row.direct.ns / direct.ns),
            ]
        })
        .collect();
    let columns = ["effects", "structured (ns)", "of none", "direct (ns)", "of none"];
    table("Effects of the film, nanoseconds a pixel, one thread", &columns, &rows)
}

/// What sharpness, halation and grain add to a pixel's time.
pub(super) fn picture_effects(rows: &[PictureEffectRow]) -> String {
    let alone = rows.iter().find(|row| row.what == PictureEffectRow::COLOUR_ALONE);
    let rows: Vec<Vec<Cell>> = rows
        .iter()
        .map(|row| {
            let mut cells = vec![Cell::Text(row.what.to_owned())];
            for (here, alone) in
                [(row.one_thread, alone.map(|row| row.one_thread)), (row.all_threads, alone.map(|row| row.all_threads))]
            {
                cells.push(Cell::figure(here.ns));
                cells.push(alone.map_or_else(Cell::none, |alone| Cell::figure(here.ns - alone.ns)));
            }
            cells
        })
        .collect();
    let columns =
        ["a picture's way", "one thread (ns)", "more than colour alone", "all threads (ns)", "more than colour alone"];
    table("Sharpness, halation and grain of KODAK VISION3 500T 5219 on Super 35, nanoseconds a pixel", &columns, &rows)
}

/// What `auto` leaves out, and whether it could be seen.
pub(super) fn decisions(summaries: &[DecisionSummary]) -> String {
    let pair = |found: Vec<f64>, worst: fn(f64, f64) -> f64| {
        let all = found.iter().copied().reduce(worst);
        [Cell::count(found.len()), all.map_or_else(Cell::none, Cell::figure)]
    };
    let rows: Vec<Vec<Cell>> = summaries
        .iter()
        .map(|summary| {
            let mut cells = vec![Cell::Text(summary.effect.clone()), Cell::figure(summary.limit)];
            cells.extend([Cell::count(summary.cases.len()), Cell::count(summary.left_out())]);
            cells.extend(pair(summary.missed(), f64::max));
            cells.extend(pair(summary.needless(), f64::min));
            cells
        })
        .collect();
    let columns = [
        "effect",
        "seen from (dE)",
        "cases",
        "left out",
        "of these seen in truth",
        "worst (dE)",
        "run, not seen in truth",
        "least (dE)",
    ];
    table("What auto leaves out of parts of the fixture scene and of a camera's picture", &columns, &rows)
}

pub(super) fn buffers(steps: &[(&'static str, f64)]) -> String {
    let rows: Vec<Vec<Cell>> =
        steps.iter().map(|(name, step)| vec![Cell::Text((*name).to_owned()), Cell::figure(*step)]).collect();
    table("Frame buffers before the film: largest step on a grey ramp", &["buffer", "largest step (dE)"], &rows)
}

/// One column for each form, one row for each value that all have.
pub(super) fn growth(caption: &str, x: &str, measured: &[Measured]) -> String {
    let names: Vec<&str> = measured.iter().map(|m| m.name.as_str()).collect();
    let values = measured.first().map_or(&[][..], |m| &m.points);
    let rows: Vec<Vec<Cell>> = values
        .iter()
        .enumerate()
        .map(|(i, (value, _))| {
            let found = measured.iter().map(|m| m.points.get(i).map_or_else(Cell::none, |p| Cell::figure(p.1)));
            let value = if value.fract() == 0.0 { Cell::Number(*value, plain(*value)) } else { Cell::figure(*value) };
            [value].into_iter().chain(found).collect()
        })
        .collect();
    table(caption, &[&[x][..], &names].concat(), &rows)
}

pub(super) fn peers(rows: &[Peer]) -> String {
    let rows: Vec<Vec<Cell>> = rows
        .iter()
        .map(|row| {
            vec![
                Cell::Text(row.title()),
                Cell::figure(row.ours_ns_per_pixel),
                Cell::figure(row.theirs_ns_per_pixel),
                Cell::figure(row.ratio()),
                Cell::Text(row.difference()),
                row.threads.map_or_else(Cell::none, Cell::count),
                Cell::Text(row.state.clone()),
            ]
        })
        .collect();
    let columns = ["job", "ours, ns/pixel", "theirs, ns/pixel", "theirs / ours", "difference", "threads", "state"];
    table("Outside programs on the same work", &columns, &rows)
}
