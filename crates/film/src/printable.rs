/// The beginning of a text that somebody else wrote, as part of a one-line message: at most `most_characters`, control characters as
/// spaces.
///
/// ```
/// assert_eq!(onelight_film::printable("exposure\tindex\nand more", 16), "exposure index a");
/// ```
#[must_use]
pub fn printable(text: &str, most_characters: usize) -> String {
    text.chars().take(most_characters).map(|c| if c.is_control() { ' ' } else { c }).collect()
}
