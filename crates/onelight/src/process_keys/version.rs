use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

/// The version of `look.toml` that this crate reads and writes: 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FormatVersion;

pub(super) const VERSION: i64 = 1;

impl Serialize for FormatVersion {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_i64(VERSION)
    }
}

impl<'de> Deserialize<'de> for FormatVersion {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match i64::deserialize(deserializer)? {
            VERSION => Ok(Self),
            found => Err(de::Error::custom(format!("version: found {found}, expected {VERSION}"))),
        }
    }
}
