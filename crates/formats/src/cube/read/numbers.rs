use crate::error::TextProblem;
use crate::text::number;

/// Exactly `N` finite numbers with white space between them.
pub(super) fn numbers<const N: usize>(what: &'static str, text: &str) -> Result<[f32; N], TextProblem> {
    let mut values = [0.0; N];
    let mut words = text.split_ascii_whitespace();
    for (found, value) in values.iter_mut().enumerate() {
        let Some(word) = words.next() else {
            return Err(TextProblem::NumberCount { what, found, expected: N });
        };
        *value = number(what, word)?;
    }
    match words.count() {
        0 => Ok(values),
        more => Err(TextProblem::NumberCount { what, found: N + more, expected: N }),
    }
}
