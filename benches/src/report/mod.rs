//! The speed of every form against its error, and what its parts cost, as one page.
//!
//! [`measure`] takes minutes on a quiet machine ([`Scope::Full`]) or seconds ([`Scope::Quick`]); what it returns is the page, the
//! plot and all numbers.

mod axis;
mod contents;
mod difference;
mod figure;
mod forms;
mod frame;
mod labels;
mod machine;
mod measure;
mod page;
mod peers;
mod plot;
mod scope;
mod stopwatch;
mod studies;
mod table;
mod text;
mod words;

use std::fmt::Write as _;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use self::contents::Contents;
use self::forms::Kind;
use self::frame::Frame;
use self::machine::Machine;
use self::measure::{Prepared, law, timed};
pub use self::peers::Elsewhere;
pub use self::scope::Scope;
use self::studies::{Studies, growth};
use crate::described_look::DescribedLook;
use crate::effect_decisions::decisions;
use crate::error::{Error, Result};
use crate::progress::OnProgress;

/// Speed and error of every form of some looks, and what their parts cost.
pub struct Report(Contents);

/// What a caller hears while a report is measured.
#[derive(Clone, Copy)]
pub struct Listener<'a> {
    /// Called at every step.
    pub progress: OnProgress<'a>,
    /// Called with the name of a part and how long it took; parts of one name come several times.
    pub time: &'a dyn Fn(&'static str, Duration),
}

impl Listener<'_> {
    fn time<T>(&self, part: &'static str, run: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let value = run();
        (self.time)(part, start.elapsed());
        value
    }
}

/// Measures every form of some looks; how cost grows is measured on the first.
///
/// # Errors
/// If a look does not compile or there is none, or if the system gives no threads.
pub fn measure(
    described: &[DescribedLook],
    scope: Scope,
    elsewhere: Elsewhere,
    listener: Listener<'_>,
) -> Result<Report> {
    let progress = listener.progress;
    let mut prepared = Vec::new();
    for described in described {
        prepared.push(listener.time("forms", || Prepared::new(described, scope, progress))?);
    }
    let frame = listener.time("picture", || Frame::new(scope.scene_size()))?;
    let rounds = scope.rounds();
    let (looks, copy) = listener.time("timing", || timed(&prepared, &frame, rounds, progress))?;
    let mut studied = Vec::new();
    for (prepared, look) in prepared.iter().zip(looks) {
        let studies = listener.time("studies", || Studies::of(prepared, &look, scope, progress))?;
        studied.push((look, studies));
    }
    let (Some(first), Some((look, _))) = (prepared.first(), studied.first()) else {
        return Err(Error::new("no look was named, expected one or more to measure"));
    };
    let growth = listener.time("growth", || growth(first, look, &frame, scope, progress))?;
    let decisions = listener.time("decisions", || decisions(scope.decision_cases(), progress))?;
    Ok(Report(Contents {
        scope,
        machine: Machine::here(),
        colours: law(scope).count,
        rounds,
        frame: frame.size(),
        content: "the fixture scene enlarged four times, with grain",
        copy,
        looks: studied,
        growth,
        decisions,
        elsewhere,
        clock: String::new(),
    }))
}

impl Report {
    /// The same with a sentence that says how long each part took.
    #[must_use]
    pub fn with_clock(self, clock: String) -> Self {
        Self(Contents { clock, ..self.0 })
    }

    /// The page: HTML that needs nothing else.
    pub fn html(&self) -> String {
        page::html(&self.0)
    }

    /// The plot of speed against error alone, as SVG.
    pub fn plot(&self) -> String {
        page::picture(&self.0)
    }

    /// All numbers; `seconds` says how long each part took.
    pub fn json(&self, seconds: &Value) -> Value {
        let contents = &self.0;
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
            "decisions": contents.decisions,
            "elsewhere": contents.elsewhere,
            "seconds": seconds,
        })
    }

    /// The advice, and the files that hold the rest.
    pub fn summary(&self, files: &[String]) -> String {
        let contents = &self.0;
        let mut text = String::new();
        for file in files {
            let _ = writeln!(text, "{file}");
        }
        for (look, _) in &contents.looks {
            let _ = writeln!(text, "{}", look.name);
            for row in figure::front(&look.rows, figure::Which::Max) {
                let (time, error) = (row.time.ns, row.error);
                let (mean, max) = (text::figure(error.mean), text::figure(error.max));
                let _ = writeln!(text, "  {:26} {:>8} ns  mean {mean}, max {max}", row.name(), text::figure(time));
            }
            if let Some(film) = look.rows.iter().find(|row| row.kind == Kind::Reference) {
                let _ = writeln!(text, "  {:26} {:>8} ns", "the film itself", text::figure(film.time.ns));
            }
            for advice in words::advice(look, contents.copy, &contents.elsewhere) {
                let _ = writeln!(text, "  {}: {}", advice.whom, advice.sentence);
            }
        }
        let _ = writeln!(text, "copy: {:.2} ns\ntime: {}", contents.copy.ns, contents.clock);
        text
    }
}
