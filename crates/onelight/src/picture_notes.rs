//! What a user should know of how a picture is read.

use std::fmt;

/// A sentence about how a picture is read, with the setting that would change it.
///
/// ```
/// use onelight::picture::{Channels, Description, Source};
/// use onelight::{ColourSpaces, InputColours, LightSetting};
/// let picture = Description::new(3, 2, Channels::Rgb, Source::Exr);
/// let notes = InputColours::default().notes(&picture, &ColourSpaces::default());
/// assert_eq!(notes[0].decided_by, Some(LightSetting::Primaries));
/// assert_eq!(notes[0].to_string(), "the file names no primaries: taken for those of srgb");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LightNote {
    /// The sentence, which begins with a small letter and has no full stop.
    pub text: String,
    /// What a program may offer to set, where it is a choice.
    pub decided_by: Option<LightSetting>,
}

impl fmt::Display for LightNote {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// A setting that a [`LightNote`] is about.
///
/// ```
/// use onelight::{Background, CoverageSeen, LightSetting};
/// use onelight::picture::{Channels, Description, Source};
/// let picture = Description::new(3, 2, Channels::Rgba, Source::Exr);
/// let (_, notes) = CoverageSeen::default().decide(&picture, Some(Background::None));
/// assert!(notes.iter().all(|note| note.decided_by != Some(LightSetting::Background)));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LightSetting {
    /// [`InputColours::coding`](crate::InputColours::coding).
    Coding,
    /// [`InputColours::primaries`](crate::InputColours::primaries), and [`ColourSpaces::input_space`](crate::ColourSpaces::input_space) with it.
    Primaries,
    /// The [`Background`](crate::Background) behind a picture with alpha.
    Background,
}
