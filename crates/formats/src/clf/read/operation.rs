use super::content::{Content, content};
use super::element::Element;
use super::markup::{Markup, Part};
use super::parameters::{cdl, exponent, log, range};
use crate::clf::op::{Op, Range};
use crate::error::{Error, TextProblem};
use crate::node_order::{node_at, place_of};
use crate::text::quoted;
use onelight_lut::{Domain, Interpolation, Lut1d, Lut3d};

/// Reads an operation whose start has come, to its end.
pub(super) fn read(markup: &mut Markup<'_>, start: &Element) -> Result<Op, Error> {
    check(start).map_err(|problem| markup.fail(start.at(), problem))?;
    let mut contents = Vec::new();
    loop {
        match markup.next_part()? {
            (_, Part::End) => break,
            (_, Part::Start(child)) if child.name() == "Description" => markup.skip()?,
            (at, Part::Start(child)) => {
                // Six are the most that any operation has.
                if contents.len() == 6 {
                    let what = "elements of an operation";
                    return Err(markup.fail(at, TextProblem::TooMany { what, max: 6 }));
                }
                contents.push(content(markup, start, child)?);
            }
            (at, part) => return Err(markup.unexpected(at, "content of an operation", &part, "an element")),
        }
    }
    let op = match start.name() {
        "Range" => range(start, &contents),
        "Log" => log(start, &contents),
        "Exponent" => exponent(start, &contents),
        "ASC_CDL" => cdl(start, &contents),
        _ => array(start, contents),
    };
    let depths = || Ok([code_of_one(start, "inBitDepth")?, code_of_one(start, "outBitDepth")?]);
    op.and_then(|op| normalised(op, depths()?)).map_err(|problem| markup.fail(start.at(), problem))
}

/// Refuses operations that are not read before their content is.
fn check(start: &Element) -> Result<(), TextProblem> {
    if !matches!(start.name(), "Matrix" | "Range" | "Log" | "Exponent" | "ASC_CDL" | "LUT1D" | "LUT3D") {
        let [what, expected] = ["operation", "Matrix, Range, Log, Exponent, ASC_CDL, LUT1D or LUT3D"];
        return Err(TextProblem::Unexpected { what, found: format!("<{}>", quoted(start.name())), expected });
    }
    for depth in ["inBitDepth", "outBitDepth"] {
        code_of_one(start, depth)?;
    }
    for (attribute, value) in [("halfDomain", "false"), ("rawHalfs", "false")] {
        if start.get(attribute).is_some_and(|found| found != value) {
            return Err(start.bad(attribute, value));
        }
    }
    Ok(())
}

/// The number that stands for 1 at a depth: codes of integers are taken as parts of the largest.
fn code_of_one(start: &Element, depth: &'static str) -> Result<f64, TextProblem> {
    const EXPECTED: &str = "32f, 16f, 16i, 12i, 10i or 8i";
    match start.required(depth, EXPECTED)? {
        "32f" | "16f" => Ok(1.0),
        "16i" => Ok(65_535.0),
        "12i" => Ok(4095.0),
        "10i" => Ok(1023.0),
        "8i" => Ok(255.0),
        _ => Err(start.bad(depth, EXPECTED)),
    }
}

/// The operation between numbers of which 1 is the largest code.
fn normalised(op: Op, [input, output]: [f64; 2]) -> Result<Op, TextProblem> {
    if [input, output] == [1.0; 2] {
        return Ok(op);
    }
    let entry = |rgb: [f32; 3]| rgb.map(|v| (f64::from(v) / output) as f32);
    Ok(match op {
        Op::Matrix { rows, offset } => {
            Op::Matrix { rows: rows.map(|row| row.map(|v| v * input / output)), offset: offset.map(|v| v / output) }
        }
        Op::Range(range) => {
            let end = |end: Option<[f64; 2]>| end.map(|[from, to]| [from / input, to / output]);
            Op::Range(Range { low: end(range.low), high: end(range.high), ..range })
        }
        Op::Lut1d(lut) => {
            let entries = lut.entries().iter().map(|rgb| entry(*rgb)).collect();
            Op::Lut1d(Lut1d::new(Domain::UNIT, entries).map_err(TextProblem::Table)?)
        }
        Op::Lut3d(lut, interpolation) => {
            let entries = lut.entries().map(entry).collect();
            Op::Lut3d(Lut3d::new(lut.size(), entries).map_err(TextProblem::Table)?, interpolation)
        }
        // Curves are between numbers of which 1 is the largest code already.
        op @ (Op::Log { .. } | Op::Exponent { .. } | Op::Cdl(_)) => op,
    })
}

fn array(start: &Element, contents: Vec<Content>) -> Result<Op, TextProblem> {
    let [what, expected] = ["arrays of an operation", "one"];
    let found = contents.len().to_string();
    let mut contents = contents.into_iter();
    match (contents.next(), contents.next()) {
        (Some(Content::Matrix(rows)), None) => {
            let offset = rows.map(|[.., offset]| offset);
            Ok(Op::Matrix { rows: rows.map(|[r, g, b, _]| [r, g, b]), offset })
        }
        (Some(Content::Lut1d(entries)), None) => match start.get("interpolation") {
            None | Some("linear") => Lut1d::new(Domain::UNIT, entries).map(Op::Lut1d).map_err(TextProblem::Table),
            Some(_) => Err(start.bad("interpolation", "linear")),
        },
        (Some(Content::Lut3d(size, entries)), None) => {
            let interpolation = match start.get("interpolation") {
                None | Some("trilinear") => Interpolation::Trilinear,
                Some("tetrahedral") => Interpolation::Tetrahedral,
                Some(_) => return Err(start.bad("interpolation", "trilinear or tetrahedral")),
            };
            let lut = Lut3d::new(size, red_fastest(size, &entries)).map_err(TextProblem::Table)?;
            Ok(Op::Lut3d(lut, interpolation))
        }
        _ => Err(TextProblem::Unexpected { what, found, expected }),
    }
}

/// The entries of an array, which has blue fastest, as a table has them.
fn red_fastest(size: usize, entries: &[[f32; 3]]) -> Vec<[f32; 3]> {
    (0..entries.len())
        .map(|index| {
            let [red, green, blue] = node_at(index, size);
            entries[place_of([blue, green, red], size)]
        })
        .collect()
}
