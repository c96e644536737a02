//! What other commands measured: forms on a graphics card, and other programs on the same work.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::error::{Error, Result};

/// A form on a graphics card: a row of `gpu.json`.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct OnCard {
    /// `plain`, `structured` or `direct`.
    pub(super) form: String,
    /// The look: `kodak-5207_kodak-2383`.
    pub(super) name: String,
    #[serde(default)]
    pub(super) size: Option<usize>,
    pub(super) ns_per_pixel: f64,
    /// CIEDE2000 from the reference.
    pub(super) mean: f64,
    pub(super) max: f64,
    pub(super) card: String,
    #[serde(default)]
    pub(super) date: String,
}

/// The same work by us and by another program: a row of `peers.json`.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Peer {
    pub(super) job: String,
    /// The name of the other program.
    #[serde(default)]
    pub(super) peer: String,
    /// `warm`: done before; `cold`: for the first time; `process`: the whole program.
    #[serde(default)]
    pub(super) state: String,
    pub(super) ours_ns_per_pixel: f64,
    pub(super) theirs_ns_per_pixel: f64,
    /// How far the results lie apart, in the words of the measurement.
    #[serde(default)]
    pub(super) difference: Value,
    #[serde(default)]
    difference_unit: Option<String>,
    #[serde(default)]
    pub(super) threads: Option<usize>,
}

impl OnCard {
    /// `structured 32`
    pub(super) fn detail(&self) -> String {
        self.size.map_or_else(|| self.form.clone(), |size| format!("{} {size}", self.form))
    }

    fn is_drawable(&self) -> bool {
        self.ns_per_pixel > 0.0 && self.mean >= 0.0 && self.max >= 0.0
    }
}

impl Peer {
    /// How many times as long as ours the other program takes.
    pub(super) fn ratio(&self) -> f64 {
        self.theirs_ns_per_pixel / self.ours_ns_per_pixel
    }

    /// The difference as a cell of a table.
    pub(super) fn difference(&self) -> String {
        let difference = match &self.difference {
            Value::Null => return "-".to_owned(),
            Value::String(text) => text.clone(),
            Value::Number(number) => number.as_f64().map_or_else(|| number.to_string(), super::text::figure),
            other => other.to_string(),
        };
        format!("{difference} {}", self.difference_unit.as_deref().unwrap_or_default()).trim_end().to_owned()
    }

    /// Whether it is drawn beside others: on one thread, done before.
    pub(super) fn is_usual(&self) -> bool {
        self.threads == Some(1) && self.state == "warm"
    }

    /// Whether another program applied the very table that we do, so that its error is that of our plain form.
    pub(super) fn applies_our_table(&self) -> bool {
        self.is_usual() && self.job == "plain, f32 to f32" && self.peer == "OpenColorIO"
    }

    /// `plain, f32 to f32, beside OpenColorIO`
    pub(super) fn title(&self) -> String {
        if self.peer.is_empty() { self.job.clone() } else { format!("{}, beside {}", self.job, self.peer) }
    }

    fn is_drawable(&self) -> bool {
        self.ours_ns_per_pixel > 0.0 && self.theirs_ns_per_pixel > 0.0
    }
}

/// All that other commands measured. What is not there was not measured.
#[derive(Debug, Default, Serialize)]
pub struct Elsewhere {
    pub(super) cards: Vec<OnCard>,
    pub(super) peers: Vec<Peer>,
}

impl Elsewhere {
    /// With the rows of a `gpu.json`, as `gpu-bench` writes it; `name` is what errors call it.
    ///
    /// # Errors
    /// If it holds no rows, or other numbers than times above 0 and differences of 0 or more.
    pub fn with_cards(self, name: &str, text: &str) -> Result<Self> {
        let rows: Vec<OnCard> = rows(name, text)?;
        let cards = checked(name, rows, OnCard::is_drawable, "times above 0 and differences of 0 or more")?;
        Ok(Self { cards, ..self })
    }

    /// With the rows of a `peers.json`, as `benches/peers/run.py` writes it; `name` is what errors call it.
    ///
    /// # Errors
    /// If it holds no rows, or times that are not above 0.
    pub fn with_peers(self, name: &str, text: &str) -> Result<Self> {
        let peers = checked(name, rows(name, text)?, Peer::is_drawable, "times above 0")?;
        Ok(Self { peers, ..self })
    }

    /// What was measured of a look on graphics cards.
    pub(super) fn of_look(&self, name: &str) -> impl Iterator<Item = &OnCard> {
        self.cards.iter().filter(move |card| card.name == name)
    }
}

fn checked<T>(name: &str, rows: Vec<T>, good: impl Fn(&T) -> bool, expected: &str) -> Result<Vec<T>> {
    match rows.iter().position(|row| !good(row)) {
        Some(index) => Err(Error::new(format!("{name}: row {index} holds other numbers, expected {expected}"))),
        None => Ok(rows),
    }
}

/// An array of rows, bare or as `rows` of an object.
fn rows<T: for<'a> Deserialize<'a>>(name: &str, text: &str) -> Result<Vec<T>> {
    let value: Value = serde_json::from_str(text).map_err(|error| Error::of(&format!("{name}: is no JSON"), error))?;
    let rows = match value {
        Value::Object(mut object) => object.remove("rows").unwrap_or(Value::Null),
        other => other,
    };
    if !rows.is_array() {
        return Err(Error::new(format!("{name}: holds no rows, expected an array of them")));
    }
    serde_json::from_value(rows).map_err(|error| Error::of(name, error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_come_bare_or_named_or_not_at_all() {
        let row =
            r#"{"job": "cube 33", "ours_ns_per_pixel": 10, "theirs_ns_per_pixel": 25, "difference": 4e-5, "more": 1}"#;
        for text in [format!("[{row}]"), format!("{{\"rows\": [{row}]}}")] {
            let peers = Elsewhere::default().with_peers("a.json", &text).unwrap().peers;
            assert_eq!((peers.len(), peers[0].ratio(), peers[0].difference()), (1, 2.5, "4.0e-5".to_owned()));
        }
        assert!(Elsewhere::default().cards.is_empty());
    }

    #[test]
    fn bad_rows_are_named() {
        for text in ["", "3", "{}", "[{}]", r#"[{"job": "x", "ours_ns_per_pixel": 0, "theirs_ns_per_pixel": 1}]"#] {
            let error = Elsewhere::default().with_peers("a.json", text).unwrap_err().to_string();
            assert!(error.contains("a.json"), "{error}");
        }
    }
}
