//! What error messages repeat of a user's text: short, on one line, with the nearest name that exists.

/// More characters of a name than a message repeats or a slip of the finger can account for.
const NAME_CHARACTERS: usize = 64;
/// Names less alike than this have nothing to do with each other: unrelated words reach 0.6 in Jaro and Winkler's measure.
const ALIKE: f64 = 0.72;
/// Fewer characters than this are found inside of many names.
pub(crate) const PART_CHARACTERS: usize = 3;
/// Most characters of a sentence that another reader wrote: it may repeat a whole value. Ours are shorter.
const SENTENCE_CHARACTERS: usize = 500;

/// The beginning of what a user wrote, for messages.
pub(crate) fn cut(found: &str) -> String {
    found.chars().take(NAME_CHARACTERS).collect()
}

/// A sentence on one line and no longer than a message should be.
pub(crate) fn one_line(sentence: &str) -> String {
    onelight_film::printable(sentence, SENTENCE_CHARACTERS)
}

/// The candidate that looks most like `found`, if any looks like it: by its letters, or because `found` is part of it.
pub(crate) fn nearest<'a>(found: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let found = cut(found).to_lowercase();
    let similarity = |candidate: &str| {
        let part = found.chars().count() >= PART_CHARACTERS && candidate.contains(&found);
        strsim::jaro_winkler(&found, candidate) + if part { 1.0 } else { 0.0 }
    };
    let scored =
        candidates.map(|candidate| (similarity(candidate), candidate)).filter(|(similarity, _)| *similarity >= ALIKE);
    scored.max_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, candidate)| candidate)
}
