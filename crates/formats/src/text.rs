#[cfg(any(feature = "clf", feature = "spi3d", feature = "direct-json"))]
use std::io::Read;
use std::str::FromStr;

use crate::error::TextProblem;
#[cfg(any(feature = "clf", feature = "spi3d", feature = "direct-json"))]
use crate::error::{Error, ErrorKind};

/// Entries reserved at once: a size in a header is a claim until its numbers have come.
pub(crate) const RESERVED: usize = 1 << 16;

/// The most bytes of a word of a file that an error repeats.
const WORD_BYTES: usize = 40;

/// The most bytes of another crate's message that an error repeats.
const MESSAGE_BYTES: usize = 160;

/// All of a text of at most `max` bytes; bytes that are not UTF-8 are replaced.
#[cfg(any(feature = "clf", feature = "spi3d", feature = "direct-json"))]
pub(crate) fn read_text(input: impl Read, max: u64) -> Result<String, Error> {
    let mut bytes = Vec::new();
    input.take(max.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > max {
        return Err(ErrorKind::TextBytes { max }.into());
    }
    let text = String::from_utf8(bytes).unwrap_or_else(|bad| String::from_utf8_lossy(bad.as_bytes()).into_owned());
    Ok(match text.strip_prefix('\u{feff}') {
        Some(rest) => rest.to_owned(),
        None => text,
    })
}

/// A number that is finite in its type.
pub(crate) fn number<T: FromStr + Copy + Into<f64>>(what: &'static str, word: &str) -> Result<T, TextProblem> {
    let number: T = word.parse().map_err(|_| TextProblem::NotANumber { what, found: quoted(word) })?;
    let wide: f64 = number.into();
    if wide.is_finite() { Ok(number) } else { Err(TextProblem::NotFinite { what, found: quoted(word) }) }
}

/// A word of a file as an error repeats it: on one line, cut where it is long.
pub(crate) fn quoted(word: &str) -> String {
    excerpt(word, WORD_BYTES)
}

/// What another crate says, as part of a sentence: it may repeat a whole file.
pub(crate) fn foreign_message(message: &str) -> String {
    excerpt(message, MESSAGE_BYTES)
}

fn excerpt(text: &str, most: usize) -> String {
    match text.char_indices().find(|&(at, _)| at > most) {
        Some((at, _)) => format!("{}...", one_line(&text[..at])),
        None => one_line(text),
    }
}

/// Text with spaces instead of control characters, line ends among them.
pub(crate) fn one_line(text: &str) -> String {
    text.replace(char::is_control, " ")
}

/// Text with spaces instead of control characters other than line ends.
pub(crate) fn printable(text: &str) -> String {
    text.replace(|c: char| c.is_control() && c != '\n', " ")
}
