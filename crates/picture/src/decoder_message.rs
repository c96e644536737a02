//! What decoders say, as part of a sentence.

/// Most characters that are repeated of a decoder's message, which may list what a damaged file has thousands of.
const MAX_CHARACTERS: usize = 160;

/// A decoder's message, or a name from a file, on one line, without control characters, and cut short.
pub(crate) fn one_line(message: &str) -> String {
    let plain = |c: char| if c.is_control() { ' ' } else { c };
    match message.char_indices().nth(MAX_CHARACTERS) {
        Some((end, _)) => message[..end].chars().map(plain).chain("...".chars()).collect(),
        None => message.chars().map(plain).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_is_one_short_line() {
        assert_eq!(one_line("a\nb\u{7}"), "a b ");
        assert_eq!(one_line(&"\u{e4}".repeat(161)), format!("{}...", "\u{e4}".repeat(160)));
        assert_eq!(one_line(&"x".repeat(160)), "x".repeat(160));
    }
}
