//! What is measured, and how it is written.

use std::fmt::Write as _;

use onelight::baked::Recipe;
use onelight::lut::{DirectForm, PlainLut, Storage, StructuredLut};
use onelight::{Look, Process, Reference, StructuredSettings};
use onelight_gpu::{Fetch, LookSettings, wgpu};
use serde_json::{Value, json};
use wgpu::TextureFormat::{self, Rgb10a2Unorm, Rgba8Unorm, Rgba8UnormSrgb, Rgba16Float, Rgba32Float};

use super::card::Card;
use super::difference::{Difference, difference};
use super::measure::{Subject, times};
use super::pictures::{Sources, scene};
use crate::calendar::{date, now};
use crate::error::{Error, Result};
use crate::form::Form;

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

/// The time of one pass between two formats.
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

/// What is known of a measured pass besides its times.
struct Facts {
    /// `structured, tetrahedral`
    name: String,
    /// `plain`, `structured` or `direct`
    form: String,
    table_size: Option<usize>,
    difference: Difference,
}

/// Times of the forms on a graphics card beside a plain copy, and their differences from the film.
pub struct Summary {
    card: Card,
    look: String,
    bandwidth: f64,
    reached: f64,
    facts: Vec<Facts>,
    rows: Vec<Row>,
}

/// Measures the default look on the fastest adapter; `software` allows one that is none, on which a few passes are run.
///
/// # Errors
/// If there is no adapter, it is software and that is not allowed, it has no clock, or it fails.
pub fn measure(software: bool) -> Result<Summary> {
    let card = Card::open(software)?;
    let process = Process::default();
    let film = process.compile()?;
    let forms = Forms::new(&film)?;
    let subjects = forms.subjects();
    let mut facts = Vec::new();
    for subject @ Subject { form, settings } in &subjects {
        facts.push(Facts {
            name: subject.name(),
            form: form.kind().to_string(),
            table_size: subject.table_size(),
            difference: difference(&card, &film, *form, settings)?,
        });
    }
    let bandwidth = card.copy_bandwidth()?;
    let rows = rows(&card, &subjects)?;
    let reached =
        rows.iter().find(|row| row.is_frame(&card) && row.subject.is_none()).map_or(0.0, Row::bandwidth) / bandwidth;
    Ok(Summary { card, look: process.name(), bandwidth, reached, facts, rows })
}

impl Forms {
    fn new(film: &Reference) -> Result<Self> {
        let Form::Plain(plain) = Form::baked(&Look::from(film.clone()), &Recipe::cube(PLAIN_SIZE))? else {
            return Err(Error::new("a table with a shaper has another form"));
        };
        let settings = StructuredSettings { size: STRUCTURED_SIZE, ..Default::default() };
        Ok(Self { plain, structured: film.structured(&settings)?, direct: film.direct(&Default::default())? })
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

impl Summary {
    /// A sentence where the copy pass is so far from the card's copy bandwidth that ratios to it mean nothing; software is excused.
    pub fn fault(&self) -> Option<String> {
        let is_slow = self.reached < LEAST_BANDWIDTH && !self.card.is_software;
        is_slow.then(|| {
            format!(
                "copy pass: found {:.0} % of the card's copy bandwidth, expected {:.0} %",
                100.0 * self.reached,
                100.0 * LEAST_BANDWIDTH
            )
        })
    }

    fn facts(&self, row: &Row) -> Option<&Facts> {
        row.subject.and_then(|i| self.facts.get(i))
    }

    fn name(&self, row: &Row) -> &str {
        self.facts(row).map_or("copy", |facts| &facts.name)
    }

    /// Every pass, a line each.
    pub fn text(&self) -> String {
        let mut text = String::new();
        let Card { name, driver, .. } = &self.card;
        let _ = writeln!(text, "{name}, {driver}, {}: copies {:.0} GB/s", today(), self.bandwidth / 1e9);
        let _ = writeln!(text, "copy pass: {:.0} % of that", 100.0 * self.reached);
        for Facts { name, difference: Difference { mean, max }, .. } in &self.facts {
            let _ = writeln!(text, "{name:26} dE from the film: mean {mean:.3}, max {max:.3}");
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

    /// Everything as one object, as `gpu.json` holds it.
    pub fn json(&self) -> Value {
        let passes: Vec<Value> = self.rows.iter().map(|row| self.row(row)).collect();
        let frame = self.rows.iter().filter(|row| row.is_frame(&self.card) && row.subject.is_some());
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
        let facts = self.facts(row);
        let difference = facts.map(|facts| facts.difference);
        json!({
            "form": facts.map_or("copy", |facts| &facts.form),
            "pass": self.name(row),
            "name": self.look,
            "size": facts.and_then(|facts| facts.table_size),
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

/// `2026-03-01`, UTC
fn today() -> String {
    date(now())
}
