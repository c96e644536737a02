//! `look.direct.json`: a direct form as bare numbers, with its equations, for shaders and other programs.

use anyhow::{Context, Result, bail};
use onelight::lut::{
    DirectForm, DirectParts, DirectPrint, Domain, ExponentialSum, ExponentialTerm, LOG_FLOOR, Lut1d, PowerCoding, Rows,
    SCENE_MAX,
};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// What a reader needs to know, line by line.
const EQUATIONS: [&str; 9] = [
    "in: scene-linear RGB; NaN counts as 0, and |v| above input_max as input_max",
    "scene = clamp(input * in, 0, input_max); rows of matrices are outputs",
    "h = log2(max(exposure * scene, log_floor))",
    "dye = curves(h): each channel's own curve; entries at equal steps over [from, to], linear between them, held outside",
    "if print is not null: h = log2(max(S(print.exposure, dye), log_floor)), and dye = print.curves(h)",
    "rgb = S(projection, dye), display-linear; may lie a little outside 0 to 1",
    "S(terms, x)[j] = sum over terms of weight[j] * 2^-(rate[0] x[0] + rate[1] x[1] + rate[2] x[2])",
    "out = sign(rgb) * code(|rgb|); code(v) = (1 + offset) v^(1 / exponent) - offset, but slope v where v <= end",
    "offset 0: no line; exponent 1: out = rgb; else end = (offset / (exponent - 1) * exponent / (1 + offset))^exponent, slope = offset / (exponent - 1) / end",
];

const FORMAT: &str = "onelight direct form";
const VERSION: u32 = 1;

#[derive(Deserialize)]
struct File {
    format: String,
    version: u32,
    input: Rows,
    exposure: Rows,
    curves: Curves,
    print: Option<Print>,
    projection: Vec<Term>,
    coding: Coding,
}

#[derive(Serialize, Deserialize)]
struct Print {
    exposure: Vec<Term>,
    curves: Curves,
}

#[derive(Serialize, Deserialize)]
struct Curves {
    from: [f32; 3],
    to: [f32; 3],
    entries: Vec<[f32; 3]>,
}

#[derive(Serialize, Deserialize)]
struct Term {
    rate: [f32; 3],
    weight: [f32; 3],
}

#[derive(Serialize, Deserialize)]
struct Coding {
    exponent: f64,
    offset: f64,
}

/// The file's bytes: JSON, a triple of numbers a line.
pub(crate) fn write(direct: &DirectForm, comments: &[String]) -> Result<Vec<u8>> {
    let parts = direct.parts();
    let print = parts.print.as_ref();
    let print = print.map(|print| Print { exposure: terms(&print.exposure), curves: Curves::of(&print.curves) });
    let coding = Coding { exponent: parts.coding.exponent(), offset: parts.coding.offset() };
    let fields = [
        ("format", Value::from(FORMAT)),
        ("version", Value::from(VERSION)),
        ("comments", Value::from(comments)),
        ("equations", Value::from(EQUATIONS.to_vec())),
        ("input_max", Value::from(SCENE_MAX)),
        ("log_floor", Value::from(LOG_FLOOR)),
        ("input", serde_json::to_value(parts.input)?),
        ("exposure", serde_json::to_value(parts.exposure)?),
        ("curves", serde_json::to_value(Curves::of(&parts.curves))?),
        ("print", serde_json::to_value(print)?),
        ("projection", serde_json::to_value(terms(&parts.projection))?),
        ("coding", serde_json::to_value(coding)?),
    ];
    let mut text = String::new();
    block(['{', '}'], fields.iter().map(|(key, item)| (Some(*key), item)), 0, &mut text);
    text.push('\n');
    Ok(text.into_bytes())
}

/// The form that a file holds.
pub(crate) fn read(bytes: &[u8]) -> Result<DirectForm> {
    let file: File = serde_json::from_slice(bytes).context("look.direct.json")?;
    if (file.format.as_str(), file.version) != (FORMAT, VERSION) {
        bail!("look.direct.json: found {} {}, expected {FORMAT} {VERSION}", file.format, file.version);
    }
    let print = file.print.map(|print| -> Result<DirectPrint> {
        Ok(DirectPrint { exposure: sum(&print.exposure)?, curves: print.curves.table()? })
    });
    let coding = match (file.coding.exponent, file.coding.offset) {
        (1.0, 0.0) => PowerCoding::LINEAR,
        (exponent, offset) => PowerCoding::new(exponent, offset)?,
    };
    Ok(DirectForm::new(DirectParts {
        input: file.input,
        exposure: file.exposure,
        curves: file.curves.table()?,
        print: print.transpose()?,
        projection: sum(&file.projection)?,
        coding,
    })?)
}

impl Curves {
    fn of(table: &Lut1d) -> Self {
        Self { from: table.domain().min(), to: table.domain().max(), entries: table.entries().to_vec() }
    }

    fn table(self) -> Result<Lut1d> {
        Ok(Lut1d::new(Domain::new(self.from, self.to)?, self.entries)?)
    }
}

fn terms(sum: &ExponentialSum) -> Vec<Term> {
    sum.terms().iter().map(|term| Term { rate: term.rate, weight: term.weight }).collect()
}

fn sum(terms: &[Term]) -> Result<ExponentialSum> {
    let terms = terms.iter().map(|term| ExponentialTerm { rate: term.rate, weight: term.weight });
    Ok(ExponentialSum::new(terms.collect())?)
}

/// JSON in which a list of numbers stays on one line.
fn lay_out(value: &Value, indent: usize, text: &mut String) {
    match value {
        Value::Object(map) => {
            block(['{', '}'], map.iter().map(|(key, item)| (Some(key.as_str()), item)), indent, text);
        }
        Value::Array(items) if !items.iter().all(Value::is_number) => {
            block(['[', ']'], items.iter().map(|item| (None, item)), indent, text);
        }
        Value::Array(items) => {
            let numbers: Vec<String> = items.iter().map(number).collect();
            text.push_str(&format!("[{}]", numbers.join(", ")));
        }
        _ => text.push_str(&number(value)),
    }
}

fn block<'a>(
    [open, close]: [char; 2],
    items: impl Iterator<Item = (Option<&'a str>, &'a Value)>,
    indent: usize,
    text: &mut String,
) {
    let new_line = |text: &mut String, indent: usize| {
        text.push('\n');
        text.extend(std::iter::repeat_n(' ', indent));
    };
    text.push(open);
    for (i, (key, item)) in items.enumerate() {
        if i > 0 {
            text.push(',');
        }
        new_line(text, indent + 1);
        if let Some(key) = key {
            text.push_str(&format!("\"{key}\": "));
        }
        lay_out(item, indent + 1, text);
    }
    new_line(text, indent);
    text.push(close);
}

/// A value that is no list or object; what came from a 32-bit float has no more digits than one needs.
fn number(value: &Value) -> String {
    match value.as_f64() {
        Some(v) if value.is_f64() && f64::from(v as f32) == v => format!("{:?}", v as f32),
        _ => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use onelight::{DirectSettings, Nodes, Process};

    use super::*;

    #[test]
    fn a_file_holds_every_bit_of_its_form() {
        for process in [Process::default(), Process::for_camera("fuji-velvia-50").unwrap()] {
            for output_coding in [onelight::TransferCurve::Srgb, onelight::TransferCurve::Linear] {
                let film = Process { output_coding, ..process.clone() }.compile().unwrap();
                let nodes = Nodes::Grid { step_nm: 20 };
                let direct = film.direct(&DirectSettings { nodes }).unwrap();
                let bytes = write(&direct, &["a look".to_owned()]).unwrap();
                assert!(read(&bytes).unwrap() == direct);
                assert_eq!(bytes, write(&direct, &["a look".to_owned()]).unwrap());
            }
        }
    }

    #[test]
    fn what_is_no_such_file_is_refused() {
        let film = Process::for_camera("fuji-velvia-50").unwrap().compile().unwrap();
        let direct = film.direct(&DirectSettings { nodes: Nodes::Grid { step_nm: 20 } }).unwrap();
        let text = String::from_utf8(write(&direct, &[]).unwrap()).unwrap();
        let refused = |text: &str| format!("{:#}", read(text.as_bytes()).unwrap_err());
        assert!(refused("").contains("look.direct.json"));
        assert!(refused(&text.replace("\"version\": 1", "\"version\": 2")).contains("expected onelight direct form 1"));
        assert!(refused(&text.replace("\"exponent\": 2.4", "\"exponent\": 0.1")).contains("exponent of a coding"));
        assert!(refused(&text.replace("\"projection\"", "\"projektion\"")).contains("projection"));
    }

    #[test]
    fn the_equations_are_those_of_the_form() {
        let film = Process::default().compile().unwrap();
        let direct = film.direct(&DirectSettings { nodes: Nodes::Grid { step_nm: 20 } }).unwrap();
        let file: File = serde_json::from_slice(&write(&direct, &[]).unwrap()).unwrap();
        let sum = |terms: &[Term], x: [f64; 3]| -> [f64; 3] {
            std::array::from_fn(|j| {
                let passed = |t: &Term| (-(0..3).map(|k| f64::from(t.rate[k]) * x[k]).sum::<f64>()).exp2();
                terms.iter().map(|t| f64::from(t.weight[j]) * passed(t)).sum()
            })
        };
        let curve = |c: &Curves, e: [f64; 3]| -> [f64; 3] {
            std::array::from_fn(|j| {
                let [from, to] = [c.from[j], c.to[j]].map(f64::from);
                let h = e[j].max(f64::from(LOG_FLOOR)).log2();
                let last = c.entries.len() - 1;
                let at = ((h - from) / (to - from)).clamp(0.0, 1.0) * last as f64;
                let i = (at as usize).min(last - 1);
                let [a, b] = [c.entries[i][j], c.entries[i + 1][j]].map(f64::from);
                a + (at - i as f64) * (b - a)
            })
        };
        let multiply = |rows: &Rows, v: [f64; 3]| rows.map(|row| (0..3).map(|k| f64::from(row[k]) * v[k]).sum::<f64>());
        let Coding { exponent, offset } = file.coding;
        let end = (offset / (exponent - 1.0) * exponent / (1.0 + offset)).powf(exponent);
        let slope = offset / (exponent - 1.0) / end;
        let code = |v: f64| {
            let size = v.abs();
            let coded = if size <= end { slope * size } else { (1.0 + offset) * size.powf(1.0 / exponent) - offset };
            coded.copysign(v)
        };
        for rgb in [[0.18; 3], [0.0, 0.0, 0.0], [4.0, 0.2, 0.01], [0.001, 0.0, 30.0], [-1.0, 2.0, 0.5]] {
            let scene = multiply(&file.input, rgb).map(|v| v.clamp(0.0, f64::from(SCENE_MAX)));
            let dye = curve(&file.curves, multiply(&file.exposure, scene));
            let print = file.print.as_ref().unwrap();
            let dye = curve(&print.curves, sum(&print.exposure, dye));
            let out = sum(&file.projection, dye).map(code);
            let ours = direct.apply(rgb.map(|v| v as f32));
            for (a, b) in out.into_iter().zip(ours) {
                assert!((a - f64::from(b)).abs() < 2e-5, "{rgb:?}: {out:?} {ours:?}");
            }
        }
    }
}
