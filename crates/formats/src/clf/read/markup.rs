use std::borrow::Cow;

use quick_xml::Reader;
use quick_xml::escape::resolve_predefined_entity;
use quick_xml::events::{BytesRef, Event};

use super::element::Element;
use crate::error::{Error, TextProblem};
use crate::text::{foreign_message, quoted};

/// The parts of an XML text, each with the byte where it starts.
pub(super) struct Markup<'a> {
    text: &'a str,
    reader: Reader<&'a [u8]>,
}

/// A part that means something here; comments and declarations do not.
pub(super) enum Part<'a> {
    Start(Element),
    End,
    /// Text that is more than white space.
    Text(Cow<'a, str>),
}

impl<'a> Markup<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        let mut reader = Reader::from_str(text);
        // An empty element is then a start and an end.
        reader.config_mut().expand_empty_elements = true;
        Self { text, reader }
    }

    /// The next part inside an element; blank text is passed over.
    pub(super) fn next_part(&mut self) -> Result<(usize, Part<'a>), Error> {
        let part = self.part_or_end()?;
        part.ok_or_else(|| self.fail(self.text.len(), ended()))
    }

    /// Checks that nothing follows the root.
    pub(super) fn end(&mut self) -> Result<(), Error> {
        match self.part_or_end()? {
            None => Ok(()),
            Some((at, part)) => Err(self.unexpected(at, "text after ProcessList", &part, "the end of the file")),
        }
    }

    /// All text of the element just started, which has no others inside.
    pub(super) fn text(&mut self) -> Result<String, Error> {
        let mut text = String::new();
        self.text_parts(|_, part| {
            text.push_str(part);
            Ok(())
        })?;
        Ok(text.trim().replace("\r\n", "\n"))
    }

    /// Passes on the words of the element just started, which has no others inside.
    pub(super) fn words(&mut self, mut take: impl FnMut(&str) -> Result<(), TextProblem>) -> Result<(), Error> {
        self.text_parts(|at, part| {
            for word in part.split_ascii_whitespace() {
                let within = (word.as_ptr() as usize).saturating_sub(part.as_ptr() as usize);
                take(word).map_err(|problem| (at + within, problem))?;
            }
            Ok(())
        })
    }

    /// Passes over the rest of the element just started.
    pub(super) fn skip(&mut self) -> Result<(), Error> {
        let mut depth = 1_usize;
        while depth > 0 {
            match self.event()? {
                (_, Event::Start(_)) => depth += 1,
                (_, Event::End(_)) => depth -= 1,
                (at, Event::Eof) => return Err(self.fail(at, ended())),
                _ => {}
            }
        }
        Ok(())
    }

    /// An error at a byte of the text.
    pub(super) fn fail(&self, at: usize, problem: TextProblem) -> Error {
        let before = self.text.as_bytes().get(..at).unwrap_or(self.text.as_bytes());
        Error::text(1 + before.iter().filter(|&&byte| byte == b'\n').count(), problem)
    }

    /// Where the next part starts.
    pub(super) fn position(&self) -> usize {
        usize::try_from(self.reader.buffer_position()).unwrap_or(usize::MAX)
    }

    /// The error for a part that does not belong where it stands.
    pub(super) fn unexpected(&self, at: usize, what: &'static str, part: &Part<'_>, expected: &'static str) -> Error {
        let found = match part {
            Part::Start(element) => format!("<{}>", quoted(element.name())),
            Part::End => "its end".to_owned(),
            Part::Text(text) => format!("{:?}", quoted(text.trim())),
        };
        self.fail(at, TextProblem::Unexpected { what, found, expected })
    }

    fn text_parts(
        &mut self,
        mut each: impl FnMut(usize, &str) -> Result<(), (usize, TextProblem)>,
    ) -> Result<(), Error> {
        loop {
            let (at, event) = self.event()?;
            let text = match event {
                Event::Text(text) => text.into_inner(),
                Event::CData(text) => text.into_inner(),
                Event::GeneralRef(reference) => self.referred(at, &reference)?.into(),
                Event::End(_) => return Ok(()),
                Event::Start(start) => {
                    let found = format!("<{}>", quoted(start.local_name().into_inner()));
                    let problem =
                        TextProblem::Unexpected { what: "content of an element", found, expected: "text only" };
                    return Err(self.fail(at, problem));
                }
                Event::Eof => return Err(self.fail(at, ended())),
                _ => continue,
            };
            each(at, &text).map_err(|(at, problem)| self.fail(at, problem))?;
        }
    }

    /// The next part with its place, or none at the end of the text.
    fn part_or_end(&mut self) -> Result<Option<(usize, Part<'a>)>, Error> {
        loop {
            let (at, event) = self.event()?;
            let part = match event {
                Event::Start(start) => Part::Start(Element::new(at, &start).map_err(|bad| self.fail(at, bad))?),
                Event::End(_) => Part::End,
                Event::Text(text) if text.trim().is_empty() => continue,
                Event::Text(text) => Part::Text(text.into_inner()),
                Event::CData(text) => Part::Text(text.into_inner()),
                Event::GeneralRef(reference) => Part::Text(reference.into_inner()),
                Event::Eof => return Ok(None),
                _ => continue,
            };
            return Ok(Some((at, part)));
        }
    }

    fn event(&mut self) -> Result<(usize, Event<'a>), Error> {
        let at = self.position();
        match self.reader.read_event() {
            Ok(Event::DocType(_)) => {
                let [what, expected] = ["document type", "none in a CLF"];
                Err(self.fail(at, TextProblem::Unexpected { what, found: "a declaration".to_owned(), expected }))
            }
            Ok(event) => Ok((at, event)),
            Err(error) => {
                let at = usize::try_from(self.reader.error_position()).unwrap_or(usize::MAX);
                let found = foreign_message(&error.to_string());
                Err(self.fail(at, TextProblem::Unexpected { what: "markup", found, expected: "well-formed XML" }))
            }
        }
    }

    /// What `&name;` or `&#number;` stands for.
    fn referred(&self, at: usize, reference: &BytesRef<'_>) -> Result<String, Error> {
        let named = resolve_predefined_entity(reference).map(str::to_owned);
        let character = || reference.resolve_char_ref().ok().flatten().map(String::from);
        named.or_else(character).ok_or_else(|| {
            let found = format!("&{};", quoted(reference));
            self.fail(at, TextProblem::Unexpected { what: "reference", found, expected: "a character of XML" })
        })
    }
}

fn ended() -> TextProblem {
    let [what, expected] = ["end of the file", "the end of every element before it"];
    TextProblem::Unexpected { what, found: "an open element".to_owned(), expected }
}
