mod content;
mod element;
mod markup;
mod operation;
mod parameters;

use std::io::Read;

use super::ClfProcess;
use crate::error::{Error, TextProblem};
use crate::text::read_text;
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
        let mut description_bytes = 0;
        loop {
            match markup.next_part()? {
                (_, Part::End) => break,
                (_, Part::Start(start)) => process.read_child(&mut markup, &start, &mut description_bytes)?,
                (at, part) => return Err(markup.unexpected(at, "content of <ProcessList>", &part, "an element")),
            }
        }
        markup.end()?;
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

fn check_version(root: &Element) -> Result<(), TextProblem> {
    match root.required("compCLFversion", "3")? {
        "3" | "3.0" => Ok(()),
        _ => Err(root.bad("compCLFversion", "3")),
    }
}
