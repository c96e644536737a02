//! The worst of everything, as text; all of it, as a table and as JSON.

use std::fmt::Write as _;

use serde_json::{Value, json};

use super::law::limit;
use super::measure::{Quantity, Row, Worst};

/// Everything that was measured, to be written.
pub struct Contents<'a> {
    /// The graphics card, if there is one.
    pub card: Option<String>,
    /// What [`rows`](super::rows) found, look by look.
    pub rows: &'a [Row],
}

/// The worst of one quantity in one form.
struct Line<'a> {
    row: &'a Row,
    worst: Worst,
    limit: Option<f64>,
}

impl Line<'_> {
    fn is_kept(&self) -> bool {
        self.limit.is_none_or(|limit| self.worst.value <= limit)
    }
}

impl Contents<'_> {
    /// The worst of each quantity and form, worst first, a line each.
    pub fn summary(&self) -> String {
        let mut text = String::new();
        for quantity in Quantity::ALL {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{}", title(quantity));
            let (none, some): (Vec<_>, Vec<_>) =
                self.lines(quantity).into_iter().partition(|line| line.worst.value == 0.0);
            for line in some {
                let Line { row, worst, limit } = &line;
                let form = format!("{}, {}", row.form, row.implementation);
                let value = figure(quantity, worst.value);
                let limit = limit.map_or_else(String::new, |limit| format!("of {}", figure(quantity, limit)));
                let broken = if line.is_kept() { "" } else { "BROKEN: " };
                let _ = writeln!(
                    text,
                    "  {form:46} {value:>8} {limit:11} {broken}{} at {}; {}",
                    row.case,
                    scene(worst.at),
                    row.process
                );
            }
            if !none.is_empty() {
                let forms: Vec<String> =
                    none.iter().map(|line| format!("{}, {}", line.row.form, line.row.kind.word())).collect();
                let _ = writeln!(text, "  {:46} {:>8}", forms.join("; "), "none");
            }
        }
        let broken = self.broken();
        let card = self.card.as_deref().map_or("no graphics card".to_owned(), |card| format!("on the card {card}"));
        let processes = self.processes();
        let colours: usize = self.rows.iter().filter(|row| row.form == "film").map(|row| row.colours).sum();
        let _ = writeln!(text, "{processes} looks, {colours} colours, {card}; {broken} limits broken");
        text
    }

    /// The summary, and every row.
    pub fn markdown(&self) -> String {
        let mut text = format!("# Stability\n\n```\n{}```\n\n", self.summary());
        text.push_str("| look | form | way | case | colours |");
        Quantity::ALL.iter().for_each(|quantity| text.push_str(&format!(" {} |", short(*quantity))));
        text.push_str(" mean dE |\n|---|---|---|---|---|");
        text.push_str(&"---|".repeat(Quantity::ALL.len() + 1));
        text.push('\n');
        for row in self.rows {
            let _ = write!(
                text,
                "| {} | {} | {} | {} | {} |",
                row.process, row.form, row.implementation, row.case, row.colours
            );
            for quantity in Quantity::ALL {
                let found = row.found.iter().find(|(q, _)| *q == quantity);
                let _ = write!(text, " {} |", found.map_or(String::new(), |(q, worst)| figure(*q, worst.value)));
            }
            let _ = writeln!(text, " {} |", row.mean.map_or(String::new(), |mean| figure(Quantity::Film, mean)));
        }
        text
    }

    /// The summary and every row as one object.
    pub fn json(&self) -> Value {
        let found = |quantity: Quantity, row: &Row, worst: &Worst| {
            json!({
                "value": worst.value,
                "limit": limit(row, quantity),
                // As text: JSON has no infinities.
                "scene": worst.at.map(number),
            })
        };
        let row = |row: &Row| {
            let quantities: serde_json::Map<String, Value> = row
                .found
                .iter()
                .map(|(quantity, worst)| (key(*quantity).to_owned(), found(*quantity, row, worst)))
                .collect();
            json!({
                "look": row.process, "form": row.form, "way": row.implementation, "case": row.case, "colours": row.colours,
                "found": quantities, "mean_de": row.mean,
            })
        };
        let worst: serde_json::Map<String, Value> = Quantity::ALL
            .into_iter()
            .map(|quantity| {
                let lines = self.lines(quantity).into_iter().map(|line| {
                    let mut value = found(quantity, line.row, &line.worst);
                    for (key, text) in [
                        ("look", &line.row.process),
                        ("form", &line.row.form),
                        ("way", &line.row.implementation),
                        ("case", &line.row.case.to_owned()),
                    ] {
                        value[key] = text.as_str().into();
                    }
                    value
                });
                (key(quantity).to_owned(), lines.collect())
            })
            .collect();
        json!({
            "card": self.card,
            "looks": self.processes(),
            "broken": self.broken(),
            "worst": worst,
            "rows": self.rows.iter().map(row).collect::<Vec<_>>(),
        })
    }

    fn processes(&self) -> usize {
        let mut names: Vec<&str> = self.rows.iter().map(|row| row.process.as_str()).collect();
        names.dedup();
        names.len()
    }

    /// How many rows break a limit.
    fn broken(&self) -> usize {
        let breaks = |row: &Row, quantity: Quantity, worst: &Worst| {
            limit(row, quantity).is_some_and(|limit| worst.value > limit)
        };
        self.rows.iter().map(|row| row.found.iter().filter(|(q, worst)| breaks(row, *q, worst)).count()).sum()
    }

    /// The worst row of each form, nearest to its limit or beyond first.
    fn lines(&self, quantity: Quantity) -> Vec<Line<'_>> {
        let mut lines: Vec<Line<'_>> = Vec::new();
        for row in self.rows {
            let Some((_, worst)) = row.found.iter().find(|(q, _)| *q == quantity) else { continue };
            let line = Line { row, worst: *worst, limit: limit(row, quantity) };
            // Implementations with limits of their own have lines of their own.
            let same = |other: &&mut Line<'_>| other.row.form == row.form && other.limit == line.limit;
            match lines.iter_mut().find(same) {
                Some(other) if other.worst.value >= worst.value => {}
                Some(other) => *other = line,
                None => lines.push(line),
            }
        }
        lines.sort_by(|a, b| b.worst.value.total_cmp(&a.worst.value));
        lines
    }
}

fn title(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::NotFinite => "colours that are not finite",
        Quantity::Fall => "fall of luminance on rising greys (white is 1)",
        Quantity::Step => "largest step between neighbours (dE)",
        Quantity::Excess => "step beyond the film's own at the same place (dE)",
        Quantity::Rounding => "float32 against the same form in float64 (sRGB-coded)",
        Quantity::Vectors => "vectors and cards against one pixel at a time in float32 (sRGB-coded)",
        Quantity::Codes => "the same in pictures of 8 bits (codes)",
        Quantity::Film => "form against film (dE)",
        Quantity::Forms => "form against form (dE)",
    }
}

fn short(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::NotFinite => "not finite",
        Quantity::Fall => "fall",
        Quantity::Step => "step, dE",
        Quantity::Excess => "beyond the film's, dE",
        Quantity::Rounding => "from float64",
        Quantity::Vectors => "from float32",
        Quantity::Codes => "codes",
        Quantity::Film => "film, dE",
        Quantity::Forms => "forms, dE",
    }
}

fn key(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::NotFinite => "not_finite",
        Quantity::Fall => "fall",
        Quantity::Step => "step",
        Quantity::Excess => "step_beyond_film",
        Quantity::Rounding => "from_float64",
        Quantity::Vectors => "from_float32",
        Quantity::Codes => "from_float32_codes",
        Quantity::Film => "from_film",
        Quantity::Forms => "between_forms",
    }
}

fn figure(quantity: Quantity, value: f64) -> String {
    match quantity {
        Quantity::NotFinite | Quantity::Codes => format!("{value:.0}"),
        Quantity::Step | Quantity::Excess | Quantity::Film | Quantity::Forms => format!("{value:.4}"),
        Quantity::Fall | Quantity::Rounding | Quantity::Vectors if value == 0.0 => "0".to_owned(),
        Quantity::Fall | Quantity::Rounding | Quantity::Vectors => format!("{value:.1e}"),
    }
}

fn scene(rgb: [f32; 3]) -> String {
    rgb.map(number).join(", ")
}

/// As Rust reads it back, short.
fn number(v: f32) -> String {
    if v == 0.0 || (1e-3..1e4).contains(&v.abs()) || !v.is_finite() { format!("{v}") } else { format!("{v:e}") }
}
