//! The command: what is measured, and how it is said.

use std::fmt::Write as _;
use std::time::{SystemTime, UNIX_EPOCH};

use anyhow::{Result, bail};
use onelight::lut::{DirectForm, Interpolation, PlainLut, Storage, StructuredLut, bake};
use onelight::{Process, Reference, StructuredSettings};
use onelight_gpu::{Fetch, LookSettings, wgpu};
use serde_json::{Value, json};
use wgpu::TextureFormat::{self, Rgb10a2Unorm, Rgba8Unorm, Rgba8UnormSrgb, Rgba16Float, Rgba32Float};

use super::Arguments;
use super::card::Card;
use super::difference::{Difference, difference};
use super::measure::{Subject, times};
use super::pictures::{Sources, scene};
use crate::compiled::{Fitted, fitted_to};
use crate::whole::write_whole;
use crate::{Report, folders};

const SIZES: [[u32; 2]; 2] = [[1920, 1080], [3840, 2160]];
const INPUTS: [TextureFormat; 2] = [Rgba16Float, Rgba32Float];
const OUTPUTS: [TextureFormat; 4] = [Rgba8Unorm, Rgba8UnormSrgb, Rgb10a2Unorm, Rgba16Float];
/// The size and formats that stand for a frame: what the report draws.
const FRAME: ([u32; 2], TextureFormat, TextureFormat) = ([3840, 2160], Rgba16Float, Rgba8Unorm);
/// Nodes a side of the tables.
const PLAIN_SIZE: usize = 33;
const STRUCTURED_SIZE: usize = 32;
/// The part of the card's copy bandwidth that the copy pass has to reach, for ratios to it to mean something.
const LEAST_BANDWIDTH: f64 = 0.8;

/// One measured pass.
struct Row {
    subject: Option<usize>,
    size: [u32; 2],
    input: TextureFormat,
    output: TextureFormat,
    ms: f64,
    /// The time of the copy pass between the same formats, in the same turns.
    copy_ms: f64,
}

/// The forms of the look that is measured.
struct Forms {
    plain: PlainLut,
    structured: StructuredLut,
    direct: DirectForm,
}

pub(super) fn run(arguments: &Arguments) -> Result<Report> {
    let card = Card::open(arguments.software)?;
    let folder = match &arguments.out {
        Some(folder) => folders::make(folder)?,
        None => folders::output("")?,
    };
    let process = Process::default();
    let film = process.compile()?;
    let forms = Forms::new(&film)?;
    let subjects = forms.subjects();
    let mut differences = Vec::new();
    for Subject { form, settings } in &subjects {
        differences.push(difference(&card, &film, *form, settings)?);
    }
    let bandwidth = card.copy_bandwidth()?;
    let rows = rows(&card, &subjects)?;
    let reached =
        rows.iter().find(|row| row.is_frame(&card) && row.subject.is_none()).map_or(0.0, Row::bandwidth) / bandwidth;

    let summary =
        Summary { card: &card, look: process.name(), bandwidth, reached, subjects: &subjects, differences, rows };
    let json = summary.json();
    let path = folder.join("gpu.json");
    write_whole(&path, |file| Ok(serde_json::to_writer_pretty(file, &json)?))?;
    let mut text = summary.text();
    let _ = writeln!(text, "{}", folders::shown(&path));
    if reached < LEAST_BANDWIDTH && !card.is_software {
        bail!(
            "{text}copy pass: found {:.0} % of the card's copy bandwidth, expected {:.0} %",
            100.0 * reached,
            100.0 * LEAST_BANDWIDTH
        );
    }
    Ok(Report { text, json, as_json: arguments.json })
}

impl Forms {
    fn new(film: &Reference) -> Result<Self> {
        let shaper = fitted_to(&onelight::Look::from(film.clone()), &Fitted::Look { stops: None })?;
        let table = bake(PLAIN_SIZE, &shaper, |rgb| film.develop(rgb), |_| {})?;
        let settings = StructuredSettings { size: STRUCTURED_SIZE, ..Default::default() };
        Ok(Self {
            plain: PlainLut::new(shaper, table, Interpolation::Tetrahedral),
            structured: film.structured(&settings)?,
            direct: film.direct(&Default::default())?,
        })
    }

    fn subjects(&self) -> [Subject<'_>; 5] {
        let settings = |fetch| LookSettings { fetch, storage: Storage::F16, ..Default::default() };
        let (texels, filtered) = (settings(Fetch::Texels), settings(Fetch::Filtered));
        [
            Subject { form: (&self.plain).into(), settings: filtered },
            Subject { form: (&self.plain).into(), settings: texels },
            Subject { form: (&self.structured).into(), settings: filtered },
            Subject { form: (&self.structured).into(), settings: texels },
            Subject { form: (&self.direct).into(), settings: texels },
        ]
    }
}

fn rows(card: &Card, subjects: &[Subject<'_>]) -> Result<Vec<Row>> {
    // Software shows that the command works on one size and pair of formats.
    let (sizes, inputs, outputs) = if card.is_software {
        (&SIZES[..1], &INPUTS[..1], &OUTPUTS[..1])
    } else {
        (&SIZES[..], &INPUTS[..], &OUTPUTS[..])
    };
    let scene = scene()?;
    let mut rows = Vec::new();
    for (&size, &input) in sizes.iter().flat_map(|size| inputs.iter().map(move |input| (size, input))) {
        let sources = Sources::new(card, &scene, input, size);
        for &output in outputs {
            let times = times(card, &sources, output, subjects)?;
            let copy_ms = times.first().map_or(f64::NAN, |copy| copy.ms);
            rows.extend(times.iter().map(|timed| Row {
                subject: timed.subject,
                size,
                input: sources.format,
                output,
                ms: timed.ms,
                copy_ms,
            }));
        }
    }
    Ok(rows)
}

impl Row {
    fn pixels(&self) -> f64 {
        f64::from(self.size[0]) * f64::from(self.size[1])
    }

    /// Bytes read and written in a second, tables left out.
    fn bandwidth(&self) -> f64 {
        let bytes = |format: TextureFormat| f64::from(format.block_copy_size(None).unwrap_or(0));
        self.pixels() * (bytes(self.input) + bytes(self.output)) / (self.ms * 1e-3)
    }

    fn is_frame(&self, card: &Card) -> bool {
        let (size, input, output) = FRAME;
        (self.size == size || card.is_software) && self.input == input && self.output == output
    }
}

struct Summary<'a> {
    card: &'a Card,
    look: String,
    bandwidth: f64,
    reached: f64,
    subjects: &'a [Subject<'a>],
    differences: Vec<Difference>,
    rows: Vec<Row>,
}

impl Summary<'_> {
    fn name(&self, row: &Row) -> String {
        row.subject.and_then(|i| self.subjects.get(i)).map_or_else(|| "copy".to_owned(), Subject::name)
    }

    fn text(&self) -> String {
        let mut text = String::new();
        let Card { name, driver, .. } = self.card;
        let _ = writeln!(text, "{name}, {driver}, {}: copies {:.0} GB/s", today(), self.bandwidth / 1e9);
        let _ = writeln!(text, "copy pass: {:.0} % of that", 100.0 * self.reached);
        for (subject, Difference { mean, max }) in self.subjects.iter().zip(&self.differences) {
            let _ = writeln!(text, "{:26} dE from the film: mean {mean:.3}, max {max:.3}", subject.name());
        }
        let mut group = None;
        for row in &self.rows {
            let here = (row.size, row.input, row.output);
            if group.replace(here) != Some(here) {
                let _ = writeln!(text, "\n{}x{} {:?} to {:?}", row.size[0], row.size[1], row.input, row.output);
            }
            let _ =
                writeln!(text, "  {:26} {:8.4} ms  {:5.2} of the copy", self.name(row), row.ms, row.ms / row.copy_ms);
        }
        text
    }

    fn json(&self) -> Value {
        let passes: Vec<Value> = self.rows.iter().map(|row| self.row(row)).collect();
        let frame = self.rows.iter().filter(|row| row.is_frame(self.card) && row.subject.is_some());
        json!({
            "card": self.card.name,
            "driver": self.card.driver,
            "software": self.card.is_software,
            "date": today(),
            "copy_gb_per_s": self.bandwidth / 1e9,
            "copy_pass_of_that": self.reached,
            "rows": frame.map(|row| self.row(row)).collect::<Vec<_>>(),
            "passes": passes,
        })
    }

    fn row(&self, row: &Row) -> Value {
        let subject = row.subject.and_then(|i| self.subjects.get(i));
        let difference = row.subject.and_then(|i| self.differences.get(i));
        json!({
            "form": subject.map_or_else(|| "copy".to_owned(), |subject| subject.form.kind().to_string()),
            "pass": self.name(row),
            "name": self.look,
            "size": subject.and_then(Subject::table_size),
            "width": row.size[0],
            "height": row.size[1],
            "input": format!("{:?}", row.input),
            "output": format!("{:?}", row.output),
            "ms": row.ms,
            "ns_per_pixel": row.ms * 1e6 / row.pixels(),
            "of_copy": row.ms / row.copy_ms,
            "gb_per_s": row.bandwidth() / 1e9,
            "mean": difference.map(|d| d.mean),
            "max": difference.map(|d| d.max),
            "card": self.card.name,
            "date": today(),
        })
    }
}

/// The date in UTC: `2026-03-01`.
fn today() -> String {
    let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    date(seconds / 86_400)
}

/// The date so many days after 1970-01-01, by years of March to February, whose leap day is the last.
fn date(days: u64) -> String {
    // From 0000-03-01.
    let days = days + 719_468;
    let (era, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (month, next) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    format!("{:04}-{month:02}-{day:02}", 400 * era + year + next)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn days_are_dates() {
        for (days, expected) in [
            (0, "1970-01-01"),
            (59, "1970-03-01"),
            (11_016, "2000-02-29"),
            (11_017, "2000-03-01"),
            (20_453, "2025-12-31"),
        ] {
            assert_eq!(date(days), expected);
        }
    }
}
