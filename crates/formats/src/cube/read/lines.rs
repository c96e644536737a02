use std::borrow::Cow;
use std::io::{BufRead, Read};

use crate::cube::CubeFile;
use crate::error::{Error, TextProblem};

/// Lines of bounded length from a reader, counted from 1.
pub(super) struct Lines<R> {
    input: R,
    bytes: Vec<u8>,
    number: usize,
}

/// One line, its end included; bytes that are not UTF-8 (titles of old files) are replaced.
pub(super) struct Line<'a> {
    pub(super) number: usize,
    pub(super) text: Cow<'a, str>,
}

impl<R: BufRead> Lines<R> {
    pub(super) fn new(input: R) -> Self {
        Self { input, bytes: Vec::new(), number: 0 }
    }

    pub(super) fn next_line(&mut self) -> Result<Option<Line<'_>>, Error> {
        let max = CubeFile::MAX_LINE_BYTES;
        self.bytes.clear();
        self.input.by_ref().take(max as u64 + 1).read_until(b'\n', &mut self.bytes)?;
        if self.bytes.is_empty() {
            return Ok(None);
        }
        self.number += 1;
        if self.bytes.len() > max {
            return Err(Error::text(self.number, TextProblem::LineTooLong { max }));
        }
        let mut bytes = self.bytes.as_slice();
        if self.number == 1 {
            const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";
            bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
        }
        Ok(Some(Line { number: self.number, text: String::from_utf8_lossy(bytes) }))
    }

    /// The number of the line read last; 1 for an empty input.
    pub(super) fn last_number(&self) -> usize {
        self.number.max(1)
    }
}
