//! What other commands measured: forms on a graphics card, and other programs on the same work.

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

use anyhow::{Context, Result, anyhow, bail};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Longest file that is read.
const MAX_BYTES: u64 = 4 << 20;

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
    /// The other program.
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
    /// Their time over ours.
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

/// All that other commands measured.
#[derive(Debug, Default, Serialize)]
pub(super) struct Elsewhere {
    pub(super) cards: Vec<OnCard>,
    pub(super) peers: Vec<Peer>,
}

impl Elsewhere {
    /// Reads `gpu.json` and `peers.json` in a folder; what is not there was not measured.
    pub(super) fn read(folder: &Path) -> Result<Self> {
        Ok(Self { cards: on_cards(&folder.join("gpu.json"))?, peers: peers(&folder.join("peers.json"))? })
    }

    /// What was measured of a look on graphics cards.
    pub(super) fn of_look(&self, name: &str) -> impl Iterator<Item = &OnCard> {
        self.cards.iter().filter(move |card| card.name == name)
    }
}

/// The rows of `gpu.json`; none where there is no such file.
fn on_cards(path: &Path) -> Result<Vec<OnCard>> {
    let rows: Vec<OnCard> = rows(path)?;
    checked(path, rows, OnCard::is_drawable, "times above 0 and differences of 0 or more")
}

/// The rows of `peers.json`; none where there is no such file.
fn peers(path: &Path) -> Result<Vec<Peer>> {
    let rows: Vec<Peer> = rows(path)?;
    checked(path, rows, Peer::is_drawable, "times above 0")
}

fn checked<T>(path: &Path, rows: Vec<T>, good: impl Fn(&T) -> bool, expected: &str) -> Result<Vec<T>> {
    match rows.iter().position(|row| !good(row)) {
        Some(index) => bail!("{}: row {index} holds other numbers, expected {expected}", path.display()),
        None => Ok(rows),
    }
}

/// An array of rows, bare or as `rows` of an object.
fn rows<T: for<'a> Deserialize<'a>>(path: &Path) -> Result<Vec<T>> {
    let file = match File::open(path) {
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        other => other.with_context(|| format!("{}: cannot be read", path.display()))?,
    };
    let mut text = String::new();
    file.take(MAX_BYTES).read_to_string(&mut text).with_context(|| format!("{}: is no text", path.display()))?;
    let value: Value = serde_json::from_str(&text).with_context(|| format!("{}: is no JSON", path.display()))?;
    let rows = match value {
        Value::Object(mut object) => object.remove("rows").unwrap_or(Value::Null),
        other => other,
    };
    if !rows.is_array() {
        return Err(anyhow!("{}: holds no rows, expected an array of them", path.display()));
    }
    serde_json::from_value(rows).with_context(|| path.display().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(text: &str) -> (tempfile::TempDir, std::path::PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.json");
        std::fs::write(&path, text).unwrap();
        (folder, path)
    }

    #[test]
    fn rows_come_bare_or_named_or_not_at_all() {
        let row =
            r#"{"job": "cube 33", "ours_ns_per_pixel": 10, "theirs_ns_per_pixel": 25, "difference": 4e-5, "more": 1}"#;
        for text in [format!("[{row}]"), format!("{{\"rows\": [{row}]}}")] {
            let (_folder, path) = written(&text);
            let peers = peers(&path).unwrap();
            assert_eq!((peers.len(), peers[0].ratio(), peers[0].difference()), (1, 2.5, "4.0e-5".to_owned()));
        }
        assert!(on_cards(Path::new("/nowhere/gpu.json")).unwrap().is_empty());
    }

    #[test]
    fn bad_rows_are_named() {
        for text in ["", "3", "{}", "[{}]", r#"[{"job": "x", "ours_ns_per_pixel": 0, "theirs_ns_per_pixel": 1}]"#] {
            let (_folder, path) = written(text);
            let error = format!("{:#}", peers(&path).unwrap_err());
            assert!(error.contains("a.json"), "{error}");
        }
    }
}
