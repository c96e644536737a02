//! Which picture of a file that holds several.

use std::fmt;

/// Which picture is read of a file that holds several; by default the one that is likeliest meant.
///
/// ```
/// use onelight_picture::{PartChoice, Selection};
///
/// let albedo = Selection { layer: Some("albedo".to_owned()), ..Selection::default() };
/// let second = Selection { part: Some(PartChoice::Number(2)), ..Selection::default() };
/// # assert_ne!(albedo, second);
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Selection {
    /// The layer of an OpenEXR file: its whole name, or the last word of it, in capital or small letters.
    pub layer: Option<String>,
    /// The part of an OpenEXR file.
    pub part: Option<PartChoice>,
}

/// A part of an OpenEXR file.
///
/// ```
/// use onelight_picture::PartChoice;
///
/// assert_eq!(PartChoice::from("2"), PartChoice::Number(2));
/// assert_eq!(PartChoice::from("beauty"), PartChoice::Name("beauty".to_owned()));
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PartChoice {
    /// Its place in the file, counted from 1.
    Number(usize),
    /// Its name, in capital or small letters.
    Name(String),
}

impl From<&str> for PartChoice {
    fn from(text: &str) -> Self {
        text.parse().map_or_else(|_| Self::Name(text.to_owned()), Self::Number)
    }
}

impl fmt::Display for PartChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => number.fmt(f),
            Self::Name(name) => f.write_str(name),
        }
    }
}
