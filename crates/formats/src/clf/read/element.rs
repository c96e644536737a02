use quick_xml::XmlVersion;
use quick_xml::events::BytesStart;

use crate::error::TextProblem;
use crate::text::{foreign_message, number, quoted};

/// The most attributes of one element that are read.
const MAX_ATTRIBUTES: usize = 32;

/// The start of an element.
#[derive(Debug)]
pub(super) struct Element {
    at: usize,
    name: String,
    attributes: Vec<(String, String)>,
}

impl Element {
    /// `at` is the byte of the text where it starts.
    pub(super) fn new(at: usize, start: &BytesStart<'_>) -> Result<Self, TextProblem> {
        let bad =
            |found: String| TextProblem::Unexpected { what: "attribute", found, expected: "name=\"value\", once" };
        let mut attributes = Vec::new();
        for attribute in start.attributes() {
            if attributes.len() == MAX_ATTRIBUTES {
                return Err(TextProblem::TooMany { what: "attributes of an element", max: MAX_ATTRIBUTES });
            }
            let attribute = attribute.map_err(|error| bad(foreign_message(&error.to_string())))?;
            let value = attribute
                .normalized_value(XmlVersion::Implicit1_0)
                .map_err(|error| bad(foreign_message(&error.to_string())))?;
            attributes.push((attribute.key.local_name().into_inner().to_owned(), value.into_owned()));
        }
        Ok(Self { at, name: start.local_name().into_inner().to_owned(), attributes })
    }

    pub(super) fn at(&self) -> usize {
        self.at
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    pub(super) fn get(&self, attribute: &str) -> Option<&str> {
        self.attributes.iter().find(|(name, _)| name == attribute).map(|(_, value)| value.as_str())
    }

    pub(super) fn required(&self, attribute: &'static str, expected: &'static str) -> Result<&str, TextProblem> {
        self.get(attribute).ok_or_else(|| TextProblem::Unexpected {
            what: attribute,
            found: format!("no such attribute of <{}>", quoted(&self.name)),
            expected,
        })
    }

    /// The value of an attribute that has to be finite.
    pub(super) fn number(&self, attribute: &'static str) -> Result<Option<f64>, TextProblem> {
        self.get(attribute).map(|word| number(attribute, word.trim())).transpose()
    }

    /// Whole numbers up to a few digits, separated by white space.
    pub(super) fn dimensions(&self, expected: &'static str) -> Result<Vec<usize>, TextProblem> {
        let dim = self.required("dim", expected)?;
        let numbers: Option<Vec<_>> = dim.split_ascii_whitespace().take(5).map(|word| word.parse().ok()).collect();
        numbers.ok_or_else(|| TextProblem::Unexpected { what: "dim", found: quoted(dim), expected })
    }

    /// The problem with the value of an attribute.
    pub(super) fn bad(&self, attribute: &'static str, expected: &'static str) -> TextProblem {
        let found = self.get(attribute).map_or("none".to_owned(), |value| format!("{:?}", quoted(value)));
        TextProblem::Unexpected { what: attribute, found, expected }
    }
}
