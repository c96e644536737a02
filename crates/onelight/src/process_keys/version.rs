use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

/// The version of `look.toml` that a description was written in. This crate reads both and writes the newest.
///
/// ```
/// use onelight::{FormatVersion, ProcessKeys};
/// let old = ProcessKeys::from_toml("look.toml", "version = 1\n")?;
/// assert_eq!(old.version, FormatVersion::One);
/// // What it left unsaid is what it meant.
/// assert!(old.to_toml().contains("white = \"lamp\""));
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FormatVersion {
    /// Without the keys `interimage`, `white`, `gamut`, `print_curves` and those of a film format: a film by its sheet alone, seen by the bare lamp, light
    /// outside the sRGB primaries clipped.
    One,
    /// The newest: with these keys.
    #[default]
    Two,
}

/// The newest version's number.
pub(super) const NEWEST: i64 = 2;

impl Serialize for FormatVersion {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_i64(NEWEST)
    }
}

impl<'de> Deserialize<'de> for FormatVersion {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match i64::deserialize(deserializer)? {
            1 => Ok(Self::One),
            NEWEST => Ok(Self::Two),
            found => Err(de::Error::custom(format!("version: found {found}, expected 1 or {NEWEST}"))),
        }
    }
}
