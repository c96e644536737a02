use std::str::FromStr;

use super::element::Element;
use super::markup::{Markup, Part};
use super::parameters::{exponent, log, range};
use crate::domain::Domain;
use crate::error::{Error, TextProblem};
use crate::format::clf::op::Op;
use crate::format::text::{RESERVED, number, shortened};
use crate::interpolate::Interpolation;
use crate::lut1d::Lut1d;
use crate::lut3d::Lut3d;

/// What is inside an operation, but for descriptions.
pub(super) enum Content {
    /// An element with attributes, such as `LogParams`.
    Parameters(Element),
    /// An element with one number, such as `minInValue`.
    Value(Element, f64),
    /// All numbers of a `Matrix` with their columns.
    Matrix(usize, Vec<f64>),
    /// Entries in the order of the file.
    Lut1d(Vec<[f32; 3]>),
    /// Nodes a side, and entries in the order of the file.
    Lut3d(usize, Vec<[f32; 3]>),
}

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
    match start.name() {
        "Range" => range(start, &contents),
        "Log" => log(start, &contents),
        "Exponent" => exponent(start, &contents),
        _ => array(start, contents),
    }
    .map_err(|problem| markup.fail(start.at(), problem))
}

/// Refuses operations that are not read before their content is.
fn check(start: &Element) -> Result<(), TextProblem> {
    if !matches!(start.name(), "Matrix" | "Range" | "Log" | "Exponent" | "LUT1D" | "LUT3D") {
        let [what, expected] = ["operation", "Matrix, Range, Log, Exponent, LUT1D or LUT3D"];
        return Err(TextProblem::Unexpected { what, found: format!("<{}>", shortened(start.name())), expected });
    }
    for depth in ["inBitDepth", "outBitDepth"] {
        if !matches!(start.required(depth, "32f or 16f")?, "32f" | "16f") {
            return Err(start.bad(depth, "32f or 16f"));
        }
    }
    for (attribute, value) in [("halfDomain", "false"), ("rawHalfs", "false")] {
        if start.get(attribute).is_some_and(|found| found != value) {
            return Err(start.bad(attribute, value));
        }
    }
    Ok(())
}

fn content(markup: &mut Markup<'_>, start: &Element, child: Element) -> Result<Content, Error> {
    let content = match (start.name(), child.name()) {
        ("Range", "minInValue" | "maxInValue" | "minOutValue" | "maxOutValue") => {
            let value = numbers(markup, &child, 1, |[value]: [f64; 1]| value)?;
            return Ok(Content::Value(child, value.first().copied().unwrap_or_default()));
        }
        ("Log", "LogParams") | ("Exponent", "ExponentParams") => {
            markup.skip()?;
            return Ok(Content::Parameters(child));
        }
        ("Matrix" | "LUT1D" | "LUT3D", "Array") => child,
        _ => {
            let [what, expected] = ["content of an operation", "what belongs to it"];
            let found = format!("<{}> in <{}>", shortened(child.name()), shortened(start.name()));
            return Err(markup.fail(child.at(), TextProblem::Unexpected { what, found, expected }));
        }
    };
    let shape = shape(start.name(), &content).map_err(|problem| markup.fail(content.at(), problem))?;
    Ok(match shape {
        Shape::Matrix(columns) => {
            Content::Matrix(columns, numbers(markup, &content, 3 * columns, |[value]: [f64; 1]| value)?)
        }
        Shape::Lut1d(size, 1) => Content::Lut1d(numbers(markup, &content, size, |[value]: [f32; 1]| [value; 3])?),
        Shape::Lut1d(size, _) => Content::Lut1d(numbers(markup, &content, size, |entry: [f32; 3]| entry)?),
        Shape::Lut3d(size) => Content::Lut3d(size, numbers(markup, &content, size.pow(3), |entry: [f32; 3]| entry)?),
    })
}

/// What the dimensions of an array say.
enum Shape {
    /// Columns.
    Matrix(usize),
    /// Entries and columns.
    Lut1d(usize, usize),
    /// Nodes a side.
    Lut3d(usize),
}

/// The format once wrote the channels of a matrix as a third dimension.
fn shape(operation: &str, array: &Element) -> Result<Shape, TextProblem> {
    let expected = match operation {
        "Matrix" => "3 3 or 3 4",
        "LUT1D" => "2 to 1048576 entries, then 3 or 1",
        _ => "three times the same size from 2 to 256, then 3",
    };
    match (operation, array.dimensions(expected)?.as_slice()) {
        ("Matrix", &[3, columns @ (3 | 4)] | &[3, columns @ (3 | 4), 3]) => Ok(Shape::Matrix(columns)),
        ("LUT1D", &[size @ Lut1d::MIN_SIZE..=Lut1d::MAX_SIZE, columns @ (1 | 3)]) => Ok(Shape::Lut1d(size, columns)),
        ("LUT3D", &[size @ Lut3d::MIN_SIZE..=Lut3d::MAX_SIZE, green, blue, 3]) if green == size && blue == size => {
            Ok(Shape::Lut3d(size))
        }
        _ => Err(array.bad("dim", expected)),
    }
}

/// All numbers of the element just started, `N` at a time.
fn numbers<const N: usize, T, Item>(
    markup: &mut Markup<'_>,
    element: &Element,
    count: usize,
    item: impl Fn([T; N]) -> Item,
) -> Result<Vec<Item>, Error>
where
    T: FromStr + Copy + Default + Into<f64>,
{
    let mut items = Vec::with_capacity(count.min(RESERVED));
    let mut pending = [T::default(); N];
    let mut filled = 0;
    markup.words(|word| {
        if items.len() == count {
            return Err(TextProblem::TooMany { what: "numbers", max: N * count });
        }
        if let Some(slot) = pending.get_mut(filled) {
            *slot = number("number", word)?;
        }
        filled += 1;
        if filled == N {
            items.push(item(pending));
            filled = 0;
        }
        Ok(())
    })?;
    if items.len() == count {
        return Ok(items);
    }
    let found = N * items.len() + filled;
    Err(markup.fail(element.at(), TextProblem::NumberCount { what: "an element", found, expected: N * count }))
}

fn array(start: &Element, contents: Vec<Content>) -> Result<Op, TextProblem> {
    let [what, expected] = ["arrays of an operation", "one"];
    let found = contents.len().to_string();
    let mut contents = contents.into_iter();
    match (contents.next(), contents.next()) {
        (Some(Content::Matrix(columns, numbers)), None) => {
            let at = |row: usize, column: usize| numbers.get(row * columns + column).copied().unwrap_or_default();
            let rows = std::array::from_fn(|row| std::array::from_fn(|column| at(row, column)));
            let offset = std::array::from_fn(|row| if columns == 4 { at(row, 3) } else { 0.0 });
            Ok(Op::Matrix { rows, offset })
        }
        (Some(Content::Lut1d(entries)), None) => match start.get("interpolation") {
            None | Some("linear") => Lut1d::new(Domain::UNIT, entries).map(Op::Lut1d).map_err(|error| refused(&error)),
            Some(_) => Err(start.bad("interpolation", "linear")),
        },
        (Some(Content::Lut3d(size, entries)), None) => {
            let interpolation = match start.get("interpolation") {
                None | Some("trilinear") => Interpolation::Trilinear,
                Some("tetrahedral") => Interpolation::Tetrahedral,
                Some(_) => return Err(start.bad("interpolation", "trilinear or tetrahedral")),
            };
            let lut = Lut3d::new(size, red_fastest(size, &entries)).map_err(|error| refused(&error))?;
            Ok(Op::Lut3d(lut, interpolation))
        }
        _ => Err(TextProblem::Unexpected { what, found, expected }),
    }
}

/// A CLF has blue fastest.
fn red_fastest(size: usize, entries: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let plane = size * size;
    (0..entries.len())
        .filter_map(|index| {
            let [red, green, blue] = [index % size, index / size % size, index / plane];
            entries.get(blue + size * green + plane * red).copied()
        })
        .collect()
}

/// Sizes and numbers have been checked, so this is never seen.
fn refused(error: &Error) -> TextProblem {
    TextProblem::Unexpected { what: "table", found: error.to_string(), expected: "finite entries" }
}
