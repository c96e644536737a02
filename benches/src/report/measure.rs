//! Speed and error of every form of a look.

use std::sync::Arc;

use onelight::certify::Certifier;
use onelight::lut::{SamplingLaw, Search};
use onelight::{Films, Process, Reference, Word, WorkingSpace};
use serde::Serialize;

use super::difference::Difference;
use super::forms::{self, Kind, Made};
use super::frame::Frame;
use super::scope::Scope;
use super::stopwatch::{Pass, Timing, copying, interleaved, mapping};
use crate::described_look::DescribedLook;
use crate::error::Result;
use crate::progress::{OnProgress, Steps};

/// A form with its speed and its difference from the film.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Row {
    pub(super) kind: Kind,
    /// What tells it from others of its kind: `32, f16`.
    pub(super) detail: String,
    pub(super) size: Option<usize>,
    pub(super) storage: Option<&'static str>,
    pub(super) coding: Option<&'static str>,
    /// Exponentials of the print's exposure (0 for reversal film) and of the projection.
    pub(super) nodes: Option<[usize; 2]>,
    /// Of all tables and curves; `None` for the reference.
    pub(super) bytes: Option<usize>,
    /// Time for a pixel on one thread.
    pub(super) time: Timing,
    pub(super) error: Difference,
}

impl Row {
    /// What is neither stored nor made of terms.
    pub(super) fn bare(kind: Kind, detail: &str, time: Timing, error: Difference) -> Self {
        let detail = detail.to_owned();
        Self { kind, detail, size: None, storage: None, coding: None, nodes: None, bytes: None, time, error }
    }

    /// `structured 32, f16`
    pub(super) fn name(&self) -> String {
        format!("{} {}", self.kind.name(), self.detail).trim_end().to_owned()
    }
}

/// A look with all its rows.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Look {
    /// `kodak-5207_kodak-2383`
    pub(super) name: String,
    /// The films by their makers' names, and the aim.
    pub(super) title: String,
    pub(super) process: Process,
    /// Every form, by kind; the exact film comes last.
    pub(super) rows: Vec<Row>,
}

/// A process with its film and its forms, before anything is timed.
pub(super) struct Prepared {
    pub(super) process: Process,
    pub(super) films: Arc<Films>,
    title: String,
    pub(super) film: Reference,
    pub(super) made: Vec<Made>,
    errors: Vec<Difference>,
}

/// Colours that errors are measured on.
pub(super) fn law(scope: Scope) -> SamplingLaw {
    let count = match scope {
        Scope::Full => 1 << 17,
        Scope::Quick => 1 << 10,
    };
    SamplingLaw { count, ..SamplingLaw::default() }
}

impl Prepared {
    /// Makes all forms of a process and measures their differences from the film.
    pub(super) fn new(described: &DescribedLook, scope: Scope, progress: OnProgress<'_>) -> Result<Self> {
        let (film, films) = (described.compile()?, described.films()?);
        let steps = Steps::new("making forms", forms::steps(scope), progress);
        let made = forms::all(&film, scope, || steps.step())?;
        drop(steps);
        let look = onelight::Look::from(film.clone());
        let steps = Steps::new("certifying", 1 + made.len() as u64, progress);
        let certifier = Certifier::new(&look)?;
        let samples = certifier.samples(&law(scope), WorkingSpace::Srgb)?;
        steps.step();
        let mut errors = Vec::new();
        for made in &made {
            let certificate = certifier.certify(&samples, |rgb| made.form.apply(rgb), Search::Ascent)?;
            errors.push(Difference::of(&certificate));
            steps.step();
        }
        drop(steps);
        let (process, title) = (described.process.clone(), title(&described.process, &films));
        Ok(Self { process, films, title, film, made, errors })
    }

    /// What to time: one pass for each group of forms that share a time, then the film itself.
    fn passes<'a>(&'a self, frame: &'a Frame) -> Vec<Pass<'a>> {
        let mut passes: Vec<Pass> = Vec::new();
        for made in &self.made {
            if made.timed == passes.len() {
                passes.push(mapping(&made.form, frame));
            }
        }
        passes.push(developing(&self.film, frame));
        passes
    }

    fn look(&self, times: &[Timing]) -> Look {
        let rows = self.made.iter().zip(&self.errors).filter_map(|(made, &error)| {
            Some(Row {
                kind: made.kind,
                detail: made.detail.clone(),
                size: made.size,
                storage: made.storage.map(Word::word),
                coding: made.coding.map(Word::word),
                nodes: made.nodes,
                bytes: Some(made.bytes),
                time: *times.get(made.timed)?,
                error,
            })
        });
        let reference = times.last();
        let reference = reference.map(|&time| Row::bare(Kind::Reference, "float64, 1 nm", time, Difference::default()));
        let mut rows: Vec<Row> = rows.chain(reference).collect();
        rows.sort_by_key(|row| row.kind);
        Look { name: self.process.name(), title: self.title.clone(), process: self.process.clone(), rows }
    }
}

/// `KODAK VISION3 250D 5207 on KODAK 2383, neutral aim`
fn title(process: &Process, films: &Films) -> String {
    let on = films.print.as_ref().map_or_else(String::new, |print| format!(" on {}", print.name()));
    format!("{}{on}, {} aim", films.camera.name(), process.aim().word())
}

/// Times all forms of all looks together; the last time is that of a copy.
pub(super) fn timed(
    looks: &[Prepared],
    frame: &Frame,
    rounds: usize,
    progress: OnProgress<'_>,
) -> Result<(Vec<Look>, Timing)> {
    let mut passes: Vec<Pass> = Vec::new();
    let mut ranges = Vec::new();
    for look in looks {
        let from = passes.len();
        passes.extend(look.passes(frame));
        ranges.push(from..passes.len());
    }
    passes.push(copying(frame));
    let steps = Steps::new("timing", rounds as u64, progress);
    let times = interleaved(&passes, frame, 1, rounds, || steps.step())?;
    drop(steps);
    let measured = looks.iter().zip(ranges).map(|(look, range)| look.look(&times[range])).collect();
    Ok((measured, times[times.len() - 1]))
}

/// The exact film, pixel by pixel.
fn developing<'a>(film: &'a Reference, frame: &'a Frame) -> Pass<'a> {
    Box::new(move |first, every, buffer| {
        let [width, height] = frame.size();
        let rows = (first % every..height).step_by(every);
        let count = rows.len();
        for (to, y) in buffer.chunks_exact_mut(width * 3).zip(rows) {
            for (to, from) in to.chunks_exact_mut(3).zip(frame.row(y).chunks_exact(3)) {
                let shown = film.develop([from[0], from[1], from[2]].map(f64::from));
                to.iter_mut().zip(shown).for_each(|(to, v)| *to = v as f32);
            }
        }
        Ok(count * width)
    })
}
