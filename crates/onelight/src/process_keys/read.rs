//! Descriptions of looks as the text of `look.toml`.

use super::keys::ProcessKeys;
use super::version::{FormatVersion, NEWEST};
use crate::error::{Error, ErrorKind};
use crate::message::{cut, nearest, one_line};
use crate::process::{Approach, NO_CAMERA, Process, default_print};

/// More text than any description needs.
const MAX_BYTES: usize = 64 * 1024;

/// Every key, for messages; a test holds it against the struct.
const KEYS: [&str; 36] = [
    "version",
    "approach",
    "camera",
    "print",
    "aim",
    "neutral_density",
    "overexposure",
    "dyes",
    "matching",
    "interimage",
    "reconstruction",
    "gamut",
    "print_curves",
    "light",
    "filters",
    "beam_density",
    "calibration",
    "points",
    "infrared",
    "glass",
    "red_tail",
    "projector",
    "white",
    "ev",
    "scene_white",
    "film_format",
    "grain",
    "sharpness",
    "halation",
    "antihalation",
    "seed",
    "input_space",
    "output_space",
    "output_coding",
    "white_luminance",
    "first",
];
/// The keys that version 1 did not have.
const NEW_KEYS: [&str; 13] = [
    "interimage",
    "gamut",
    "print_curves",
    "white",
    "ev",
    "scene_white",
    "white_luminance",
    "film_format",
    "grain",
    "sharpness",
    "halation",
    "antihalation",
    "seed",
];
/// The keys of the table `[first]`.
const FIRST_KEYS: [&str; 5] = ["contrast", "brightness", "temperature", "saturation", "curve"];
/// The keys that only data sheets of one's own need.
const SHEET_KEYS: [&str; 4] = ["camera_sheet", "camera_sha256", "print_sheet", "print_sha256"];

impl ProcessKeys {
    /// Reads a `look.toml` of at most 64 KiB; `file` is the name that messages carry. Keys left out have their default, `print` the
    /// one that goes with the camera film; `version` is needed, and what a file of version 1 could not say is what it meant
    /// ([`FormatVersion`]). Whether the keys go together is not looked at yet.
    ///
    /// # Errors
    /// If it is no TOML, has an unknown key or word (the message names line and nearest), or another version.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, Error> {
        let at = |line: usize, problem: String| {
            Error::from(ErrorKind::Look { file: file.to_owned(), line, problem: one_line(&problem) })
        };
        if text.len() > MAX_BYTES {
            return Err(at(1, format!("{} bytes, expected at most {MAX_BYTES}", text.len())));
        }
        let line_of = |error: &toml::de::Error| {
            let start = error.span().map_or(0, |span| span.start);
            text.bytes().take(start).filter(|byte| *byte == b'\n').count() + 1
        };
        let first_line = |error: &toml::de::Error| error.message().lines().next().unwrap_or_default().to_owned();
        let table: toml::Table = toml::from_str(text).map_err(|error| at(line_of(&error), first_line(&error)))?;
        let mut keys: Self = toml::from_str(text).map_err(|error| {
            let line = line_of(&error);
            let problem = match error.message().split('`').collect::<Vec<_>>()[..] {
                ["unknown field ", key, ..] => unknown_key(key),
                [start, ..] if start.starts_with("invalid type") => {
                    let written = text.lines().nth(line - 1).unwrap_or_default();
                    wrong_type(&table, written).unwrap_or_else(|| first_line(&error))
                }
                _ => first_line(&error),
            };
            at(line, problem)
        })?;
        if table.get("version").is_none() {
            return Err(at(1, format!("no version, expected `version = {NEWEST}`")));
        }
        if keys.version == FormatVersion::One {
            if let Some(key) = NEW_KEYS.into_iter().find(|key| table.contains_key(*key)) {
                let line = text.lines().position(|line| line.trim_start().starts_with(key)).map_or(1, |line| line + 1);
                let problem =
                    format!("{key} is a key of version 2, found `version = 1`, expected `version = {NEWEST}`");
                return Err(at(line, problem));
            }
            // What it meant before there were such keys; other approaches have none of them.
            if keys.approach == Approach::Second {
                keys.set_talk();
            }
        }
        if !table.contains_key("print") {
            if keys.camera_sheet.is_some() {
                let problem = "no print beside camera_sheet, expected the id of a print film, or none";
                return Err(at(1, problem.to_owned()));
            }
            // A scan is printed on the usual film, which is the default.
            if keys.camera != NO_CAMERA {
                keys.print = default_print(&keys.camera)?.map(str::to_owned);
            }
        }
        Ok(keys)
    }

    /// The keys as `look.toml`: all of them, with their default or not, and those of own sheets where there are any.
    #[must_use]
    pub fn to_toml(&self) -> String {
        // Writing words and numbers to a string cannot fail; were it to, an empty file would be refused on reading.
        toml::to_string(self).unwrap_or_default()
    }
}

impl Process {
    /// Reads a description of at most 64 KiB; `file` is the name that messages carry. Keys left out have their default, `print` the
    /// one that goes with the camera film; `version` is needed. For a look with data sheets of one's own see
    /// [`ProcessKeys::process_with`].
    ///
    /// # Errors
    /// If it is no TOML, has an unknown key or word (the message names line and nearest), another version, or a key that
    /// changes nothing.
    pub fn from_toml(file: &str, text: &str) -> Result<Self, Error> {
        ProcessKeys::from_toml(file, text)?.process()
    }

    /// The description as `look.toml`: every key, with its default or not.
    #[must_use]
    pub fn to_toml(&self) -> String {
        ProcessKeys::from(self).to_toml()
    }
}

fn unknown_key(found: &str) -> String {
    let key = cut(found);
    match nearest(found, KEYS.into_iter().chain(FIRST_KEYS).chain(SHEET_KEYS)) {
        Some(meant) => format!("unknown key {key:?}, did you mean {meant:?}?"),
        None => format!("unknown key {key:?}, expected one of {}", KEYS.join(", ")),
    }
}

/// What the line `written`, whose value is of the wrong type, should have held.
fn wrong_type(table: &toml::Table, written: &str) -> Option<String> {
    let key = written.split(['=', '.']).next()?.trim_matches(|c: char| c.is_whitespace() || "\"'[]".contains(c));
    let first = table.get("first").and_then(toml::Value::as_table);
    let found = match table.get(key).or_else(|| first?.get(key))? {
        toml::Value::String(_) => "a word in quotes",
        toml::Value::Integer(_) | toml::Value::Float(_) => "a number",
        toml::Value::Boolean(_) => "true or false",
        toml::Value::Datetime(_) => "a date or time",
        toml::Value::Array(_) => "a list",
        toml::Value::Table(_) => "a table",
    };
    let expected = match key {
        "version" => "1 or 2",
        "neutral_density" | "overexposure" | "ev" | "white_luminance" | "contrast" | "brightness" | "temperature"
        | "saturation" => "a number",
        "seed" => "a whole number from 0 to 4294967295",
        "points" | "beam_density" => "three numbers, red, green, blue",
        "filters" => "a list of words in quotes",
        "curve" => "a list of pairs: stops about mid grey, display-coded value",
        "first" => "a table",
        _ => "a word in quotes",
    };
    Some(format!("{key}: found {found}, expected {expected}"))
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

    /// A look of nothing but a version, the keys' default, and the default of every type that a setting has of its own.
    #[test]
    fn what_is_left_out_is_the_default_of_the_library() {
        use onelight_printing::{EquivalentNeutralDensity, Printer};

        use crate::{ColourSpaces, DEFAULT_CAMERA, FilmProcess, FirstProcess, Printing, ToneProcess};

        let look = |text: &str| Process::from_toml("look.toml", &format!("version = 2\n{text}")).unwrap();
        assert_eq!(look(""), Process::default());
        assert_eq!(ProcessKeys::default().process().unwrap(), Process::default());
        assert_eq!(ProcessKeys::from(&Process::default()), ProcessKeys::default());
        assert_eq!(Process::default(), FilmProcess::default().into());
        assert_eq!(FilmProcess::for_camera(DEFAULT_CAMERA).unwrap(), FilmProcess::default());
        assert_eq!(look("approach = \"first\""), FirstProcess::default().into());
        assert_eq!(look("approach = \"reinhard\""), ToneProcess::default().into());

        let FilmProcess { print, aim, neutral_density, overexposure, dyes, .. } = FilmProcess::default();
        assert_eq!((overexposure, aim, dyes), Default::default());
        assert_eq!(neutral_density, EquivalentNeutralDensity::default().value());
        let FilmProcess { matching, inter_image, reconstruction, gamut, projector, white, spaces, .. } =
            FilmProcess::default();
        assert_eq!((matching, inter_image, reconstruction), Default::default());
        assert_eq!((gamut, projector, white), Default::default());
        let ColourSpaces { ev, scene_white, input_space, output_space, output_coding, white_luminance } = spaces;
        assert_eq!(white_luminance, 203.0);
        assert_eq!((ev, scene_white), (0.0, None));
        assert_eq!((input_space, output_space, output_coding), Default::default());
        let print = print.unwrap();
        assert_eq!((print.curves, print.calibration), Default::default());
        assert_eq!((print.printer(), print.points), (Printer::default(), [0.0; 3]));
        assert_eq!(print, Printing::default());
    }

    #[test]
    fn switches_go_there_and_back() {
        use onelight_printing::{Calibration, Filters, Wratten};
        let look = ProcessKeys {
            filters: Filters::of(&[Wratten::No99, Wratten::No70]),
            calibration: Calibration::Iterations(2),
            points: [1.0, -2.5, 0.0],
            first: crate::FirstControls { curve: vec![[-1.0, 0.3], [0.5, 0.6]], ..Default::default() },
            ..ProcessKeys::default()
        };
        let text = look.to_toml();
        assert!(text.contains("filters = [\"70\", \"99\"]") && text.contains("calibration = \"2\""), "{text}");
        assert_eq!(ProcessKeys::from_toml("look.toml", &text).unwrap(), look);
        let short = "version = 2\nneutral_density = 1\n[first]\ncontrast = 2\n";
        let look = ProcessKeys::from_toml("look.toml", short).unwrap();
        assert_eq!((look.neutral_density, look.first.contrast, look.first.saturation), (1.0, 2.0, 1.0));
        assert!(message("version = 2\ncalibration = \"31\"\n").contains("exact, or 0 to 30"));
        assert!(message("version = 2\nfilters = [\"71\"]\n").contains("one of 70, 99, 98, 2b"));
        assert!(message("version = 2\n[first]\ncontrats = 2\n").contains("did you mean \"contrast\""));
    }

    #[test]
    fn mistakes_are_named() {
        assert_eq!(
            message("version = 2\ncamra = \"kodak-5207\"\n"),
            "look.toml:2: unknown key \"camra\", did you mean \"camera\"?"
        );
        assert_eq!(message("camera = \"kodak-5207\"\n"), "look.toml:1: no version, expected `version = 2`");
        assert_eq!(message("version = 3\n"), "look.toml:1: version: found 3, expected 1 or 2");
        assert!(message("version = 2\n\naim = \"netral\"\n").starts_with("look.toml:3: aim: found \"netral\""));
        assert_eq!(
            message("version = 2\n\"camera x\" = 3\n"),
            "look.toml:2: unknown key \"camera x\", did you mean \"camera\"?"
        );
        let far = message("version = 2\nzzz = 3\n");
        assert!(far.starts_with("look.toml:2: unknown key \"zzz\", expected one of version, approach,"), "{far}");
        assert!(message(&format!("version = 2\n{} = 3\n", "z".repeat(1000))).len() < 550);
        assert_eq!(
            message("version = 2\nprint = \"NONE\"\n"),
            "look.toml:2: print: found \"NONE\", expected the id of a print film, or none (did you mean \"none\"?)"
        );
        assert!(message("version = \n").starts_with("look.toml:1: "));
        assert!(message("version = 2\ncamera = \"kodak-52007\"\n").contains("kodak-5207"));
        assert!(message(&"#\n".repeat(1 << 20)).contains("expected at most"));
    }

    #[test]
    fn wrong_types_are_named_in_our_words() {
        for (line, expected) in [
            ("aim = 7", "aim: found a number, expected a word in quotes"),
            ("  \"aim\" = 7.5 # a comment", "aim: found a number, expected a word in quotes"),
            ("print = false", "print: found true or false, expected a word in quotes"),
            ("camera = [\n\"kodak-5207\"]", "camera: found a list, expected a word in quotes"),
            ("dyes = { a = 1 }", "dyes: found a table, expected a word in quotes"),
            ("glass.thick = 3", "glass: found a table, expected a word in quotes"),
            ("[projector]\nlamp = 1", "projector: found a table, expected a word in quotes"),
            ("matching = 2026-01-01", "matching: found a date or time, expected a word in quotes"),
            ("overexposure = \"1\"", "overexposure: found a word in quotes, expected a number"),
            ("points = 3", "points: found a number, expected three numbers, red, green, blue"),
            ("filters = \"70\"", "filters: found a word in quotes, expected a list of words in quotes"),
            ("first = 3", "first: found a number, expected a table"),
        ] {
            assert_eq!(message(&format!("version = 2\n{line}\n")), format!("look.toml:2: {expected}"));
        }
        assert_eq!(message("version = \"1\"\n"), "look.toml:1: version: found a word in quotes, expected 1 or 2");
        assert_eq!(message("version = 1.0\n"), "look.toml:1: version: found a number, expected 1 or 2");
        assert_eq!(message("version = -3\n"), "look.toml:1: version: found -3, expected 1 or 2");
    }

    #[test]
    fn version_1_means_what_it_meant() {
        use onelight_printing::White;
        let old = ProcessKeys::from_toml("look.toml", "version = 1\ncamera = \"kodak-5219\"\n").unwrap();
        assert_eq!((old.version, old.white), (FormatVersion::One, White::Lamp));
        let Process::Film(film) = old.process().unwrap() else { panic!("a film") };
        assert_eq!(film.clone().as_in_the_talk(), film);
        // It is written as version 2, and means the same.
        let written = ProcessKeys::from_toml("look.toml", &old.to_toml()).unwrap();
        assert_eq!(written.process().unwrap(), Process::Film(film));
        assert_eq!(
            message("version = 1\naim = \"sheet\"\nwhite = \"film\"\n"),
            "look.toml:3: white is a key of version 2, found `version = 1`, expected `version = 2`"
        );
        for approach in ["first", "reinhard"] {
            assert!(Process::from_toml("look.toml", &format!("version = 1\napproach = \"{approach}\"\n")).is_ok());
        }
    }

    #[test]
    fn a_message_is_one_short_line() {
        let value = "v\u{7}".repeat(9000);
        for text in [
            format!("version = '{}'\n", "v".repeat(9000)),
            format!("version = 2\naim = {value}\n"),
            format!("version = 2\n[first]\ncurve = '{}'\n", "v".repeat(9000)),
            format!("version = 2\ncalibration = \"{}\"\n", "\\n".repeat(9000)),
        ] {
            let sentence = message(&text);
            assert!(sentence.len() < 600 && !sentence.contains(char::is_control), "{sentence}");
        }
        assert!(message(&"version = 2\n".repeat(1_000_000)).contains("12000000 bytes, expected at most 65536"));
    }

    #[test]
    fn print_follows_the_camera() {
        let print = |text: &str| ProcessKeys::from_toml("look.toml", text).unwrap().print;
        assert_eq!(print("version = 2\ncamera = \"fuji-velvia-50\"\n"), None);
        assert_eq!(print("version = 2\n").as_deref(), Some("kodak-2383"));
        assert_eq!(print("version = 2\nprint = \"none\"\n"), None);
    }
}
