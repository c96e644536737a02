//! The JSON of a direct form, `look.direct.json`: its numbers and equations as text, for engines, shaders and other programs.
//!
//! | Key | What it holds |
//! |---|---|
//! | `format`, `version` | `"onelight direct form"` and 2 |
//! | `comments`, `equations` | lines for people; a reader passes over them |
//! | `input_max`, `log_floor` | [`onelight_lut::SCENE_MAX`] and [`onelight_lut::LOG_FLOOR`] |
//! | `input`, `exposure` | 3x3 matrices, a row for each output |
//! | `negative_light` | `"clip"` or `"compress"`: what light outside the primaries of `exposure` does |
//! | `coupling` | `null`, or `curves` and a 3x3 `matrix`: how channels act on each other |
//! | `curves` | `from` and `to` (log2 of exposure, a number for each channel), `entries` at equal steps between them |
//! | `print` | `null`, or `exposure` (terms) and `curves` of a second film |
//! | `projection` | terms, each with `rate` and `weight` for three channels |
//! | `coding` | `exponent` and `offset` of a [`PowerCoding`] |
//!
//! What each number means is written down at [`DirectForm`] and in the file itself, under `equations`. Files of version 1 are read
//! too: they have neither `negative_light`, which is then `"clip"`, nor `coupling`.

mod layout;
mod limited;

use std::io::{Read, Write};

use onelight_lut::{
    Coupling, Develop, DirectForm, DirectParts, DirectPrint, Domain, ExponentialSum, ExponentialTerm, Expose,
    LOG_FLOOR, Lut1d, NegativeLight, PowerCoding, Rows, SCENE_MAX,
};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::Value;

use crate::error::{Error, ErrorKind, TextProblem};
use crate::text::{foreign_message, quoted, read_text};
use limited::Limited;

/// The most bytes of a file that are read, 256 MiB: the largest curves take half as many.
pub const MAX_BYTES: u64 = 1 << 28;

/// What a reader needs to know, line by line.
const EQUATIONS: [&str; 11] = [
    "in: scene-linear RGB; NaN counts as 0, and |v| above input_max as input_max",
    "u = input * in; rows of matrices are outputs",
    "p = max(exposure * clamp(u, 0, input_max), log_floor); n = max(exposure * clamp(-u, 0, input_max), 0), 0 if negative_light is clip",
    "h = log2(p) - log2(e) min(n, 88 p) / p",
    "if coupling is not null: q = coupling.curves(h), and h = h + coupling.matrix * q",
    "dye = curves(h): each channel's own curve; entries at equal steps over [from, to], linear between them, held outside",
    "if print is not null: h = log2(max(S(print.exposure, dye), log_floor)), and dye = print.curves(h)",
    "rgb = S(projection, dye), display-linear; may lie a little outside 0 to 1",
    "S(terms, x)[j] = sum over terms of weight[j] * 2^-(rate[0] x[0] + rate[1] x[1] + rate[2] x[2])",
    "out = sign(rgb) * code(|rgb|); code(v) = (1 + offset) v^(1 / exponent) - offset, but slope v where v <= end",
    "offset 0: no line; exponent 1: out = rgb; else end = (offset / (exponent - 1) * exponent / (1 + offset))^exponent, slope = offset / (exponent - 1) / end",
];

const FORMAT: &str = "onelight direct form";
const VERSION: u32 = 2;
/// The version that knew neither coupled channels nor light outside the primaries.
const VERSION_1: u64 = 1;

/// The two numbers that every file repeats and none may change.
const CONSTANTS_EXPECTED: &str = "the numbers of the format, input_max 1e30 and log_floor 1e-12";

type Entries = Limited<[f32; 3], { Lut1d::MAX_SIZE }>;
type Terms = Limited<Term, { ExponentialSum::MAX_TERMS }>;

/// The two keys that say whether the others can be read.
#[derive(Deserialize)]
struct Head {
    format: String,
    version: u64,
}

/// The keys that decide what the form does.
#[derive(Deserialize)]
struct Body {
    input_max: Option<f32>,
    log_floor: Option<f32>,
    input: Rows,
    exposure: Rows,
    /// Files of version 2 have both of these.
    negative_light: Option<Negative>,
    #[serde(default, deserialize_with = "present")]
    coupling: Option<Option<Couple>>,
    curves: Curves,
    print: Option<Print>,
    projection: Terms,
    coding: Coding,
}

#[derive(Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Negative {
    Clip,
    Compress,
}

// Keys are written in the order of the alphabet, below the first level, whatever maps of `serde_json` keep.

#[derive(Serialize, Deserialize)]
struct Couple {
    curves: Curves,
    matrix: Rows,
}

#[derive(Serialize, Deserialize)]
struct Print {
    curves: Curves,
    exposure: Terms,
}

#[derive(Serialize, Deserialize)]
struct Curves {
    entries: Entries,
    from: [f32; 3],
    to: [f32; 3],
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

/// Writes a direct form as JSON, a triple of numbers a line, with the comments as a list of lines.
///
/// Every number is the shortest decimal that reads back as the same number.
///
/// # Errors
///
/// If the writer fails; what it took until then is an incomplete file.
///
/// ```
/// use onelight_formats::direct_json;
/// # use onelight_lut::{
/// #     Develop, DirectForm, DirectParts, Domain, Expose, ExponentialSum, ExponentialTerm, IDENTITY, Lut1d, PowerCoding,
/// # };
/// # let term = ExponentialTerm { rate: [0.5; 3], weight: [1.0; 3] };
/// # let form = DirectForm::new(DirectParts {
/// #     expose: Expose::by(IDENTITY),
/// #     develop: Develop { coupling: None, curves: Lut1d::sample(64, [-8.0, 4.0], |h| 4.0 - h)? },
/// #     print: None,
/// #     projection: ExponentialSum::new(vec![term])?,
/// #     coding: PowerCoding::new(2.4, 0.055)?,
/// # })?;
/// let mut file = Vec::new();
/// direct_json::write(&mut file, &form, ["input: scene-linear, 1 is diffuse white"])?;
/// assert_eq!(direct_json::read(file.as_slice())?, form);
/// # Ok::<(), onelight_formats::Error>(())
/// ```
pub fn write<S: AsRef<str>>(
    mut writer: impl Write,
    form: &DirectForm,
    comments: impl IntoIterator<Item = S>,
) -> Result<(), Error> {
    let parts = form.parts();
    let print = parts.print.as_ref();
    let print = print.map(|print| Print { exposure: terms(&print.exposure), curves: Curves::of(&print.curves) });
    let coupling = parts.develop.coupling.as_ref();
    let coupling = coupling.map(|coupling| Couple { curves: Curves::of(&coupling.curves), matrix: coupling.matrix });
    let negative = match parts.expose.negative {
        NegativeLight::Clip => Negative::Clip,
        NegativeLight::Compress => Negative::Compress,
    };
    let coding = Coding { exponent: parts.coding.exponent(), offset: parts.coding.offset() };
    let comments: Vec<Value> = comments.into_iter().map(|line| Value::from(line.as_ref())).collect();
    let fields = [
        ("format", Value::from(FORMAT)),
        ("version", Value::from(VERSION)),
        ("comments", Value::from(comments)),
        ("equations", Value::from(EQUATIONS.to_vec())),
        ("input_max", Value::from(SCENE_MAX)),
        ("log_floor", Value::from(LOG_FLOOR)),
        ("input", value(&parts.expose.input)?),
        ("exposure", value(&parts.expose.matrix)?),
        ("negative_light", value(&negative)?),
        ("coupling", value(&coupling)?),
        ("curves", value(&Curves::of(&parts.develop.curves))?),
        ("print", value(&print)?),
        ("projection", value(&terms(&parts.projection))?),
        ("coding", value(&coding)?),
    ];
    writer.write_all(layout::object(&fields).as_bytes())?;
    writer.flush()?;
    Ok(())
}

/// Reads the file of a direct form, to its end, of at most [`MAX_BYTES`].
///
/// # Errors
///
/// If the input fails or is too large, or as [`parse`].
///
/// ```
/// let error = onelight_formats::direct_json::read(&b"{\"format\": \"PNG\"}"[..]).unwrap_err();
/// assert!(error.is_text());
/// ```
pub fn read(input: impl Read) -> Result<DirectForm, Error> {
    parse(&read_text(input, MAX_BYTES)?)
}

/// The same as [`read`], from text that is in memory.
///
/// # Errors
///
/// If the text is no JSON, names another format or version, lacks a key, repeats one or has a value of another shape, more
/// entries than a [`Lut1d`] or more terms than an [`ExponentialSum`] may have; or if a number is out of the bounds of the part
/// it belongs to, which the message names.
///
/// ```
/// let error = onelight_formats::direct_json::parse("{\"format\": \"onelight direct form\", \"version\": 3}").unwrap_err();
/// assert_eq!(
///     error.to_string(),
///     "kind of file: found \"onelight direct form\" version 3, expected \"onelight direct form\" version 1 or 2"
/// );
/// ```
pub fn parse(text: &str) -> Result<DirectForm, Error> {
    let head: Head = serde_json::from_str(text).map_err(|error| refused(&error))?;
    if head.format != FORMAT || !(VERSION_1..=u64::from(VERSION)).contains(&head.version) {
        let found = format!("{:?} version {}", quoted(&head.format), head.version);
        return Err(unexpected("kind of file", found, "\"onelight direct form\" version 1 or 2"));
    }
    let body: Body = serde_json::from_str(text).map_err(|error| refused(&error))?;
    for (what, found, constant) in [("input_max", body.input_max, SCENE_MAX), ("log_floor", body.log_floor, LOG_FLOOR)]
    {
        if let Some(found) = found.filter(|&found| found != constant) {
            return Err(unexpected(what, found.to_string(), CONSTANTS_EXPECTED));
        }
    }
    let (negative, coupling) = match (head.version, body.negative_light, body.coupling) {
        (VERSION_1, None, None) => (NegativeLight::Clip, None),
        (VERSION_1, ..) => {
            let expected = "version 2 beside it, or neither it nor negative_light";
            return Err(unexpected("coupling", "a file of version 1 with it".to_owned(), expected));
        }
        (_, Some(negative), Some(coupling)) => (negative.into(), coupling),
        (_, None, _) => return Err(unexpected("negative_light", "no such key".to_owned(), "\"clip\" or \"compress\"")),
        (_, _, None) => return Err(unexpected("coupling", "no such key".to_owned(), "null, or curves and a matrix")),
    };
    let coupling = coupling.map(|coupling| -> Result<Coupling, Error> {
        Ok(Coupling { curves: coupling.curves.table("curves of the coupling")?, matrix: coupling.matrix })
    });
    let print = body.print.map(|print| -> Result<DirectPrint, Error> {
        let exposure = sum("exposure of the print", &print.exposure)?;
        Ok(DirectPrint { exposure, curves: print.curves.table("curves of the print")? })
    });
    let Coding { exponent, offset } = body.coding;
    let parts = DirectParts {
        expose: Expose { input: body.input, matrix: body.exposure, negative },
        develop: Develop { coupling: coupling.transpose()?, curves: body.curves.table("curves")? },
        print: print.transpose()?,
        projection: sum("projection", &body.projection)?,
        coding: PowerCoding::new(exponent, offset).map_err(|error| of_part("coding", error))?,
    };
    DirectForm::new(parts).map_err(|error| of_part("matrices", error))
}

impl From<Negative> for NegativeLight {
    fn from(negative: Negative) -> Self {
        match negative {
            Negative::Clip => Self::Clip,
            Negative::Compress => Self::Compress,
        }
    }
}

/// A key that is there, with or without a value: `null` is one, a missing key is not.
fn present<'de, D: Deserializer<'de>, T: Deserialize<'de>>(deserializer: D) -> Result<Option<Option<T>>, D::Error> {
    Option::deserialize(deserializer).map(Some)
}

impl Curves {
    fn of(table: &Lut1d) -> Self {
        Self { from: table.domain().min(), to: table.domain().max(), entries: Limited(table.entries().to_vec()) }
    }

    fn table(self, part: &'static str) -> Result<Lut1d, Error> {
        let domain = Domain::new(self.from, self.to);
        domain.and_then(|domain| Lut1d::new(domain, self.entries.0)).map_err(|error| of_part(part, error))
    }
}

fn terms(sum: &ExponentialSum) -> Terms {
    Limited(sum.terms().iter().map(|term| Term { rate: term.rate, weight: term.weight }).collect())
}

fn sum(part: &'static str, terms: &Terms) -> Result<ExponentialSum, Error> {
    let terms = terms.0.iter().map(|term| ExponentialTerm { rate: term.rate, weight: term.weight });
    ExponentialSum::new(terms.collect()).map_err(|error| of_part(part, error))
}

fn of_part(part: &'static str, error: onelight_lut::Error) -> Error {
    ErrorKind::Table { part: Some(part), error }.into()
}

/// A key of the file with a value for which this reader was not made.
fn unexpected(what: &'static str, found: String, expected: &'static str) -> Error {
    ErrorKind::Key { what, found, expected }.into()
}

/// What the JSON reader says, with its line.
fn refused(error: &serde_json::Error) -> Error {
    let message = error.to_string();
    // It says the line once more at the end.
    let place = format!(" at line {} column {}", error.line(), error.column());
    let found = foreign_message(message.strip_suffix(&place).unwrap_or(&message));
    Error::text(error.line().max(1), TextProblem::Json { found })
}

/// Numbers as JSON; of finite ones, as the parts of a form are, nothing is refused.
fn value(of: &impl Serialize) -> Result<Value, Error> {
    serde_json::to_value(of).map_err(|error| std::io::Error::from(error).into())
}
