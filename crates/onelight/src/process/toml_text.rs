//! `look.toml`.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

use super::{Process, default_print};
use crate::error::{Error, Kind};
use crate::stocks::nearest;

/// The version of the format that this crate reads and writes: 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FormatVersion;

const VERSION: u32 = 1;

impl Serialize for FormatVersion {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_u32(VERSION)
    }
}

impl<'de> Deserialize<'de> for FormatVersion {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match u32::deserialize(deserializer)? {
            VERSION => Ok(Self),
            found => Err(de::Error::custom(format!("version: found {found}, expected {VERSION}"))),
        }
    }
}

/// More text than any description needs.
const MAX_BYTES: usize = 64 * 1024;

/// Every key, for messages; a test holds it against the struct.
const KEYS: [&str; 14] = [
    "version",
    "camera",
    "print",
    "aim",
    "dyes",
    "matching",
    "reconstruction",
    "infrared",
    "glass",
    "red_tail",
    "projector",
    "input_space",
    "output_space",
    "output_coding",
];

impl Process {
    /// Reads a description; `file` is the name that messages carry. Keys left out have their default, `print` the one
    /// that goes with the camera film; `version` is needed.
    ///
    /// # Errors
    /// If it is no TOML, has an unknown key or word (the message names line and nearest), or another version.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, Error> {
        let at = |line: usize, problem: String| Error::from(Kind::Look { file: file.to_owned(), line, problem });
        if text.len() > MAX_BYTES {
            return Err(at(1, format!("{} bytes, expected at most {MAX_BYTES}", text.len())));
        }
        let refuse = |error: &toml::de::Error| {
            let span = error.span().unwrap_or(0..0);
            let line = text[..span.start].matches('\n').count() + 1;
            let message = error.message();
            let problem = if message.starts_with("unknown field") {
                unknown_key(&text[span])
            } else {
                message.lines().next().unwrap_or_default().to_owned()
            };
            at(line, problem)
        };
        let table: toml::Table = toml::from_str(text).map_err(|error| refuse(&error))?;
        let mut process: Self = toml::from_str(text).map_err(|error| refuse(&error))?;
        if table.get("version").is_none() {
            return Err(at(1, format!("no version, expected `version = {VERSION}`")));
        }
        if !table.contains_key("print") {
            process.print = default_print(&process.camera)?;
        }
        Ok(process)
    }

    /// The description as `look.toml`: every key, with its default or not.
    #[must_use]
    pub fn to_toml(&self) -> String {
        // Serialising strings and one number cannot fail; were it to, an empty file would be refused on reading.
        toml::to_string(self).unwrap_or_default()
    }
}

fn unknown_key(span: &str) -> String {
    let found: String = span.split(['=', '\n']).next().unwrap_or_default().trim().chars().take(64).collect();
    let meant = nearest(&found, KEYS.into_iter()).unwrap_or_default();
    format!("unknown key {found:?}, did you mean {meant:?}?")
}

/// `print`: an id, or `"none"`.
pub(super) mod print {
    use serde::{Deserialize, Deserializer, Serializer};

    #[expect(clippy::ref_option, reason = "the signature serde asks for")]
    pub(crate) fn serialize<S: Serializer>(print: &Option<String>, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(print.as_deref().unwrap_or("none"))
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<String>, D::Error> {
        let print = String::deserialize(deserializer)?;
        Ok(if print == "none" { None } else { Some(print) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        Process::from_toml("look.toml", text).unwrap_err().to_string()
    }

    #[test]
    fn all_keys_are_known() {
        let table: toml::Table = toml::from_str(&Process::default().to_toml()).unwrap();
        let mut keys: Vec<&str> = table.keys().map(String::as_str).collect();
        let mut known = KEYS.to_vec();
        keys.sort_unstable();
        known.sort_unstable();
        assert_eq!(keys, known);
    }

    #[test]
    fn mistakes_are_named() {
        assert_eq!(
            message("version = 1\ncamra = \"kodak-5207\"\n"),
            "look.toml:2: unknown key \"camra\", did you mean \"camera\"?"
        );
        assert_eq!(message("camera = \"kodak-5207\"\n"), "look.toml:1: no version, expected `version = 1`");
        assert_eq!(message("version = 2\n"), "look.toml:1: version: found 2, expected 1");
        assert!(message("version = 1\n\naim = \"netral\"\n").starts_with("look.toml:3: aim: found \"netral\""));
        assert!(message("version = 1\naim = 7\n").starts_with("look.toml:2: "));
        assert!(message("version = \n").starts_with("look.toml:1: "));
        assert!(message("version = 1\ncamera = \"kodak-52007\"\n").contains("kodak-5207"));
        assert!(message(&"#\n".repeat(1 << 20)).contains("expected at most"));
    }

    #[test]
    fn print_follows_the_camera() {
        let print = |text: &str| Process::from_toml("look.toml", text).unwrap().print;
        assert_eq!(print("version = 1\ncamera = \"fuji-velvia-50\"\n"), None);
        assert_eq!(print("version = 1\n").as_deref(), Some("kodak-2383"));
        assert_eq!(print("version = 1\nprint = \"none\"\n"), None);
    }
}
