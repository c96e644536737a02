mod content;
mod element;
mod markup;
mod operation;
mod parameters;

use std::io::Read;

use super::ClfProcess;
use super::write::NAMESPACE;
use crate::error::{Error, TextProblem};
use crate::text::{quoted, read_text};
use element::Element;
use markup::{Markup, Part};

impl ClfProcess {
    /// Reads a file, to its end.
    ///
    /// # Errors
    ///
    /// If the input fails or is larger than [`ClfProcess::MAX_BYTES`], or as [`ClfProcess::parse`].
    pub fn read(input: impl Read) -> Result<Self, Error> {
        Self::parse(&read_text(input, Self::MAX_BYTES)?)
    }

    /// The same as [`ClfProcess::read`], from text that is in memory.
    ///
    /// # Errors
    ///
    /// If the text is not well-formed XML with a `ProcessList` of version 3, or an operation is none of those that are
    /// read, lacks something, or has a number too few, too many, not finite or out of bounds. Table sizes are those of
    /// [`onelight_lut::Lut1d`] and [`onelight_lut::Lut3d`]; memory for entries is taken as their numbers come.
    pub fn parse(text: &str) -> Result<Self, Error> {
        let mut markup = Markup::new(text);
        let root = match markup.next_part()? {
            (_, Part::Start(root)) if root.name() == "ProcessList" => root,
            (at, part) => return Err(markup.unexpected(at, "first element of a CLF", &part, "<ProcessList>")),
        };
        check_version(&root).map_err(|problem| markup.fail(root.at(), problem))?;
        let mut process = Self::with_ops(Vec::new());
        process.name = root.get("name").unwrap_or_default().to_owned();
        let mut named = root.get("id").is_some_and(|id| !id.trim().is_empty());
        let mut description_bytes = 0;
        let mut depth = None;
        loop {
            match markup.next_part()? {
                (_, Part::End) => break,
                (_, Part::Start(start)) if start.name() == "Id" => named |= !markup.text()?.is_empty(),
                (_, Part::Start(start)) => {
                    process.read_child(&mut markup, &start, &mut description_bytes)?;
                    joined(&start, &mut depth).map_err(|problem| markup.fail(start.at(), problem))?;
                }
                (at, part) => return Err(markup.unexpected(at, "content of <ProcessList>", &part, "an element")),
            }
        }
        markup.end()?;
        if !named {
            return Err(markup.fail(root.at(), root.bad("id", "an id of the ProcessList that is not empty")));
        }
        if process.ops.is_empty() {
            let [what, expected] = ["operations of the ProcessList", "at least one"];
            let found = "none".to_owned();
            return Err(markup.fail(root.at(), TextProblem::Unexpected { what, found, expected }));
        }
        Ok(process)
    }

    fn read_child(
        &mut self,
        markup: &mut Markup<'_>,
        start: &Element,
        description_bytes: &mut usize,
    ) -> Result<(), Error> {
        match start.name() {
            "Info" => markup.skip(),
            name @ ("Description" | "InputDescriptor" | "OutputDescriptor") => {
                let text = markup.text()?;
                // One for the element, so that empty ones end too.
                *description_bytes += 1 + text.len();
                let max = Self::MAX_DESCRIPTION_BYTES;
                if *description_bytes > max {
                    return Err(markup.fail(start.at(), TextProblem::TooMany { what: "bytes of descriptions", max }));
                }
                match name {
                    "Description" => self.descriptions.push(text),
                    "InputDescriptor" => self.input = text,
                    _ => self.output = text,
                }
                Ok(())
            }
            _ => {
                let max = Self::MAX_OPERATIONS;
                if self.ops.len() == max {
                    return Err(markup.fail(start.at(), TextProblem::TooMany { what: "operations", max }));
                }
                self.ops.push(operation::read(markup, start)?);
                Ok(())
            }
        }
    }
}

/// Checks that an operation takes the depth that the one before it gives; `depth` becomes the one that it gives itself.
fn joined(start: &Element, depth: &mut Option<String>) -> Result<(), TextProblem> {
    let (Some(input), Some(output)) = (start.get("inBitDepth"), start.get("outBitDepth")) else { return Ok(()) };
    // Half and single floats are the same numbers here.
    let is_float = |depth: &str| depth.ends_with('f');
    match depth.replace(output.to_owned()) {
        Some(before) if before != input && !(is_float(&before) && is_float(input)) => {
            let found = format!("{} after an operation that gives {}", quoted(input), quoted(&before));
            Err(TextProblem::Unexpected { what: "inBitDepth", found, expected: "the depth of the operation before" })
        }
        _ => Ok(()),
    }
}

/// The Academy's version 3, or SMPTE's namespace or its name for itself.
fn check_version(root: &Element) -> Result<(), TextProblem> {
    match root.get("compCLFversion") {
        Some("3" | "3.0" | "3.0.0" | "ST2136-1:2024") => Ok(()),
        Some(_) => Err(root.bad("compCLFversion", "3")),
        None if root.get("xmlns") == Some(NAMESPACE) => Ok(()),
        None => Err(root.bad("compCLFversion", "3, or the namespace of SMPTE ST 2136-1")),
    }
}
