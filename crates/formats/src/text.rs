use std::io::Read;
use std::str::FromStr;

use crate::error::{Error, Kind, TextProblem};

/// Entries reserved at once: a size in a header is a claim until its numbers have come.
pub(super) const RESERVED: usize = 1 << 16;

/// The most bytes of a word of a file that an error repeats.
const QUOTED_BYTES: usize = 40;

/// The most bytes of another crate's message.
const TOLD_BYTES: usize = 160;

/// All of a text of at most `max` bytes; bytes that are not UTF-8 are replaced.
pub(super) fn read_text(input: impl Read, max: u64) -> Result<String, Error> {
    let mut bytes = Vec::new();
    input.take(max + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > max {
        return Err(Kind::TextBytes { max }.into());
    }
    let text = String::from_utf8(bytes).unwrap_or_else(|bad| String::from_utf8_lossy(bad.as_bytes()).into_owned());
    Ok(match text.strip_prefix('\u{feff}') {
        Some(rest) => rest.to_owned(),
        None => text,
    })
}

/// A number that is finite in its type.
pub(super) fn number<T: FromStr + Copy + Into<f64>>(what: &'static str, word: &str) -> Result<T, TextProblem> {
    let number: T = word.parse().map_err(|_| TextProblem::NotANumber { what, found: shortened(word) })?;
    let wide: f64 = number.into();
    if wide.is_finite() { Ok(number) } else { Err(TextProblem::NotFinite { what, found: shortened(word) }) }
}

/// A word as an error repeats it.
pub(super) fn shortened(word: &str) -> String {
    cut(word, QUOTED_BYTES)
}

/// What another crate says, as part of a sentence: it may repeat a whole file.
pub(super) fn told(message: &str) -> String {
    cut(message, TOLD_BYTES)
}

fn cut(text: &str, most: usize) -> String {
    let plain = |text: &str| text.replace(char::is_control, " ");
    match text.char_indices().find(|&(at, _)| at > most) {
        Some((at, _)) => format!("{}...", plain(&text[..at])),
        None => plain(text),
    }
}

/// Text without control characters, but for line ends.
pub(super) fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() && c != '\n' { ' ' } else { c }).collect()
}
