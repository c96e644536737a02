//! What a job says at its end.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use onelight::Process;
use serde_json::{Value, json};

use super::outcome::Outcome;
use super::plan::Frame;
use super::progress::rate;
use crate::Report;
use crate::progress::Clock;

/// What is known before the first frame.
#[derive(Debug)]
pub(crate) struct Summary {
    /// The patterns, as they were given.
    pub(crate) input: String,
    pub(crate) output: String,
    /// What the user should know of the job.
    pub(crate) notes: Vec<String>,
    pub(crate) as_json: bool,
}

/// Most failures, and most notes, that the text lists.
const LISTED: usize = 20;

impl Summary {
    pub(super) fn report(self, process: &Process, frames: &[Frame], outcomes: &[Outcome], clock: &Clock) -> Report {
        let failures: Vec<&str> = outcomes
            .iter()
            .filter_map(|outcome| match outcome {
                Outcome::Failed(why) => Some(why.as_str()),
                _ => None,
            })
            .collect();
        let developed: Vec<_> = outcomes
            .iter()
            .filter_map(|outcome| match outcome {
                Outcome::Developed(developed) => Some(developed),
                _ => None,
            })
            .collect();
        let already_done = outcomes.len() - failures.len() - developed.len();

        let mut text = String::new();
        let _ = writeln!(text, "{}   {}{}", self.output, process.name(), stops(developed.iter().map(|one| one.ev)));
        let _ = writeln!(
            text,
            "  {} frames: {} developed, {already_done} already done, {} failed",
            frames.len(),
            developed.len(),
            failures.len()
        );
        list(&mut text, failures.iter().map(|why| format!("failed: {why}")));
        let notes = self.notes.iter().map(|note| format!("note: {note}"));
        list(&mut text, notes.chain(together(frames, outcomes)));
        let _ = write!(text, "time: {}", clock.sentence());
        if let Some(each) = clock.of("develop").checked_div(u32::try_from(developed.len()).unwrap_or(u32::MAX)) {
            let _ = write!(text, ", {}", rate(each));
        }
        text.push('\n');

        let pictures: Vec<Value> =
            frames.iter().zip(outcomes).map(|(frame, outcome)| picture(frame, outcome)).collect();
        let json = json!({
            "process": process,
            "input": self.input,
            "output": self.output,
            "developed": developed.len(),
            "already_done": already_done,
            "failed": failures.len(),
            "notes": self.notes,
            "pictures": pictures,
            "seconds": clock.json(),
        });
        Report { text, json, as_json: self.as_json }
    }
}

fn picture(frame: &Frame, outcome: &Outcome) -> Value {
    let (input, output) = (frame.input.display().to_string(), frame.output.display().to_string());
    match outcome {
        Outcome::Developed(one) => json!({
            "input": input, "output": output, "outcome": "developed", "size": one.size, "ev": one.ev, "notes": one.notes,
        }),
        Outcome::AlreadyDone => json!({ "input": input, "output": output, "outcome": "already done" }),
        Outcome::Failed(why) => json!({ "input": input, "output": output, "outcome": "failed", "error": why }),
    }
}

/// `, +0.50 EV`, or from the least to the most.
fn stops(each: impl Iterator<Item = f64>) -> String {
    let (least, most) = each.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), ev| (a.min(ev), b.max(ev)));
    if least > most {
        String::new()
    } else if least == most {
        format!(", {least:+.2} EV")
    } else {
        format!(", {least:+.2} to {most:+.2} EV")
    }
}

/// What the frames have to say, each sentence once.
fn together(frames: &[Frame], outcomes: &[Outcome]) -> Vec<String> {
    let mut first: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    for (index, outcome) in outcomes.iter().enumerate() {
        if let Outcome::Developed(developed) = outcome {
            developed.notes.iter().for_each(|note| first.entry(note).or_insert((index, 0)).1 += 1);
        }
    }
    let mut notes: Vec<_> = first.into_iter().collect();
    notes.sort_by_key(|(_, (index, _))| *index);
    let sentence = |(note, (index, count)): (&str, (usize, usize))| {
        let input = frames.get(index).map_or_else(String::new, |frame| frame.input.display().to_string());
        match count {
            1 => format!("note: {input}: {note}"),
            _ => format!("note: {input} and {} more: {note}", count - 1),
        }
    };
    notes.into_iter().map(sentence).collect()
}

fn list(text: &mut String, lines: impl Iterator<Item = String>) {
    let lines: Vec<String> = lines.collect();
    for line in lines.iter().take(LISTED) {
        let _ = writeln!(text, "  {line}");
    }
    if lines.len() > LISTED {
        let _ = writeln!(text, "  and {} more (--json lists all)", lines.len() - LISTED);
    }
}
