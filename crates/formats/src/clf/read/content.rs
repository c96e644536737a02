use std::str::FromStr;

use onelight_lut::{Lut1d, Lut3d};

use super::element::Element;
use super::markup::{Markup, Part};
use crate::error::{Error, TextProblem};
use crate::text::{RESERVED, number, quoted};

/// What is inside an operation, but for descriptions.
pub(super) enum Content {
    /// An element with attributes, such as `LogParams`.
    Parameters(Element),
    /// An element with one number, such as `minInValue`.
    Value(Element, f64),
    /// What a `SOPNode` or `SatNode` has: elements with three numbers, or one thrice.
    Triples(Vec<(Element, [f64; 3])>),
    /// The rows of a `Matrix`, each with its offset.
    Matrix([[f64; 4]; 3]),
    /// Entries of three channels, in the order of the file.
    Lut1d(Vec<[f32; 3]>),
    /// Nodes a side, and entries in the order of the file.
    Lut3d(usize, Vec<[f32; 3]>),
}

/// Reads a node of a colour decision list, to its end.
fn triples(markup: &mut Markup<'_>, node: &Element) -> Result<Content, Error> {
    let mut found = Vec::new();
    loop {
        match markup.next_part()? {
            (_, Part::End) => return Ok(Content::Triples(found)),
            (_, Part::Start(child)) if child.name() == "Description" => markup.skip()?,
            (at, Part::Start(child)) => {
                let values = match (node.name(), child.name()) {
                    ("SOPNode", "Slope" | "Offset" | "Power") => {
                        let values = numbers(markup, &child, 1, |values: [f64; 3]| values)?;
                        let [values] = all(markup, &child, values)?;
                        values
                    }
                    ("SatNode", "Saturation") => {
                        let values = numbers(markup, &child, 1, |[value]: [f64; 1]| [value; 3])?;
                        let [values] = all(markup, &child, values)?;
                        values
                    }
                    _ => {
                        let [what, expected] = ["content of a node of ASC_CDL", "Slope, Offset, Power or Saturation"];
                        let found = format!("<{}> in <{}>", quoted(child.name()), quoted(node.name()));
                        return Err(markup.fail(at, TextProblem::Unexpected { what, found, expected }));
                    }
                };
                // Three are the most that a node has.
                if found.len() == 3 {
                    return Err(markup.fail(at, TextProblem::TooMany { what: "elements of a node", max: 3 }));
                }
                found.push((child, values));
            }
            (at, part) => return Err(markup.unexpected(at, "content of a node of ASC_CDL", &part, "an element")),
        }
    }
}

/// Reads an element of an operation, to its end.
pub(super) fn content(markup: &mut Markup<'_>, start: &Element, child: Element) -> Result<Content, Error> {
    let content = match (start.name(), child.name()) {
        ("Range", "minInValue" | "maxInValue" | "minOutValue" | "maxOutValue") => {
            let values = numbers(markup, &child, 1, |[value]: [f64; 1]| value)?;
            let [value] = all(markup, &child, values)?;
            return Ok(Content::Value(child, value));
        }
        ("Log", "LogParams") | ("Exponent", "ExponentParams") => {
            markup.skip()?;
            return Ok(Content::Parameters(child));
        }
        ("ASC_CDL", "SOPNode" | "SatNode") => return triples(markup, &child),
        ("Matrix" | "LUT1D" | "LUT3D", "Array") => child,
        _ => {
            let [what, expected] = ["content of an operation", "what belongs to it"];
            let found = format!("<{}> in <{}>", quoted(child.name()), quoted(start.name()));
            return Err(markup.fail(child.at(), TextProblem::Unexpected { what, found, expected }));
        }
    };
    let shape = shape(start.name(), &content).map_err(|problem| markup.fail(content.at(), problem))?;
    Ok(match shape {
        ArrayShape::Matrix => {
            let rows = numbers(markup, &content, 3, |[r, g, b]: [f64; 3]| [r, g, b, 0.0])?;
            Content::Matrix(all(markup, &content, rows)?)
        }
        ArrayShape::MatrixWithOffset => {
            let rows = numbers(markup, &content, 3, |row: [f64; 4]| row)?;
            Content::Matrix(all(markup, &content, rows)?)
        }
        ArrayShape::Lut1d(size, 1) => Content::Lut1d(numbers(markup, &content, size, |[value]: [f32; 1]| [value; 3])?),
        ArrayShape::Lut1d(size, _) => Content::Lut1d(numbers(markup, &content, size, |entry: [f32; 3]| entry)?),
        ArrayShape::Lut3d(size) => {
            Content::Lut3d(size, numbers(markup, &content, size.pow(3), |entry: [f32; 3]| entry)?)
        }
    })
}

/// What the dimensions of an array say.
enum ArrayShape {
    Matrix,
    MatrixWithOffset,
    /// A 1D table: its entries, and its columns (1 or 3).
    Lut1d(usize, usize),
    /// A 3D table: its nodes along each side.
    Lut3d(usize),
}

/// The format once wrote the channels of a matrix as a third dimension.
fn shape(operation: &str, array: &Element) -> Result<ArrayShape, TextProblem> {
    let expected = match operation {
        "Matrix" => "3 3 or 3 4",
        "LUT1D" => "2 to 1048576 entries, then 3 or 1",
        _ => "three times the same size from 2 to 256, then 3",
    };
    match (operation, array.dimensions(expected)?.as_slice()) {
        ("Matrix", &[3, 3] | &[3, 3, 3]) => Ok(ArrayShape::Matrix),
        ("Matrix", &[3, 4] | &[3, 4, 3]) => Ok(ArrayShape::MatrixWithOffset),
        ("LUT1D", &[size @ Lut1d::MIN_SIZE..=Lut1d::MAX_SIZE, columns @ (1 | 3)]) => {
            Ok(ArrayShape::Lut1d(size, columns))
        }
        ("LUT3D", &[size @ Lut3d::MIN_SIZE..=Lut3d::MAX_SIZE, green, blue, 3]) if green == size && blue == size => {
            Ok(ArrayShape::Lut3d(size))
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

/// Exactly `N` items; [`numbers`] has counted them.
fn all<const N: usize, T>(markup: &Markup<'_>, element: &Element, items: Vec<T>) -> Result<[T; N], Error> {
    items.try_into().map_err(|items: Vec<T>| {
        let (found, expected) = (items.len(), N);
        markup.fail(element.at(), TextProblem::NumberCount { what: "an element", found, expected })
    })
}
