//! Choices on the command line: the words of look.toml.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use onelight::Word;

/// Takes the words of a choice, and lists them in the help.
pub(crate) fn words<T: Word + Send + Sync>() -> impl TypedValueParser<Value = T> {
    let words = T::ALL.iter().map(|(_, word, help)| PossibleValue::new(*word).help(*help));
    PossibleValuesParser::new(words).try_map(|word| T::parse(&word))
}
