//! One name for many pictures: `shot.####.exr`, `shot.@@@@.exr`, `shot.$F4.exr`, `shot.%04d.exr`, `*.exr`.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};

/// A path whose file name has one place where pictures differ.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Pattern {
    pub(super) folder: PathBuf,
    before: String,
    pub(super) place: Place,
    after: String,
}

/// What stands where pictures differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    /// The number of a frame, with zeros up to so many digits, or so many characters with the sign.
    Number { digits: usize, minus: Minus },
    /// A `*`: any letters, the same in both names.
    Name,
}

/// Where the sign of a frame before 0 stands. Programs write both.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Minus {
    /// `-0005` for four digits, as Blender has it.
    BeforeDigits,
    /// `-005` for four characters, as C's `printf` and Nuke have it.
    AmongDigits,
}

impl Minus {
    fn other(self) -> Self {
        match self {
            Self::BeforeDigits => Self::AmongDigits,
            Self::AmongDigits => Self::BeforeDigits,
        }
    }

    /// A number with zeros.
    fn padded(self, number: i32, digits: usize) -> String {
        let width = digits + usize::from(number < 0 && self == Self::BeforeDigits);
        format!("{number:0width$}")
    }
}

/// What one picture has in that place.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Piece {
    Number(i32),
    Name(String),
}

/// The largest number of a frame, and the smallest without its sign.
pub(super) const MAX_FRAME: i32 = 999_999_999;

impl Pattern {
    /// The pattern in a path; `None` where it names one picture. `%04d` stands before `$F4`, and that before `#` and `*`; a name
    /// that has one of them has the others as they are. Each `#` is a digit, as is each `@`, of which one alone counts between
    /// dots only: `logo@2x.png` is one picture.
    ///
    /// # Errors
    /// If several parts of the name differ between pictures.
    pub(super) fn in_path(path: &Path) -> Result<Option<Self>> {
        let Some(name) = path.file_name().and_then(|name| name.to_str()) else { return Ok(None) };
        let mut parts = printf_places(name);
        if parts.is_empty() {
            parts = houdini_places(name);
        }
        let digits = |(at, digits)| (at, digits, Place::Number { digits, minus: Minus::BeforeDigits });
        if parts.is_empty() {
            parts = runs(name, '#').map(digits).collect();
            parts.extend(name.match_indices('*').map(|(at, star)| (at, star.len(), Place::Name)));
        }
        if parts.is_empty() {
            let counts = |at: usize, length: usize| {
                length > 1 || (name[..at].ends_with('.') && name[at + length..].starts_with('.'))
            };
            parts = runs(name, '@').filter(|(at, length)| counts(*at, *length)).map(digits).collect();
        }
        match parts[..] {
            [] => Ok(None),
            [(at, length, place)] => Ok(Some(Self {
                folder: path.parent().unwrap_or(Path::new("")).to_owned(),
                before: name[..at].to_owned(),
                place,
                after: name[at + length..].to_owned(),
            })),
            _ => bail!(
                "{}: has {} parts that differ between pictures, expected one (####, @@@@, $F4 or %04d for a frame's number, * for a name)",
                path.display(),
                parts.len()
            ),
        }
    }

    /// The picture that has `piece` in the place.
    pub(super) fn path(&self, piece: &Piece) -> PathBuf {
        let piece = match (piece, self.place) {
            (Piece::Number(number), Place::Number { digits, minus }) => minus.padded(*number, digits),
            (Piece::Number(number), Place::Name) => number.to_string(),
            (Piece::Name(name), _) => name.clone(),
        };
        self.folder.join(format!("{}{piece}{}", self.before, self.after))
    }

    /// The same with the sign of its number in the other place, if that is another name.
    pub(super) fn other_path(&self, piece: &Piece) -> Option<PathBuf> {
        let Place::Number { digits, minus } = self.place else { return None };
        let other = Self { place: Place::Number { digits, minus: minus.other() }, ..self.clone() }.path(piece);
        (other != self.path(piece)).then_some(other)
    }

    /// What the file `name` has in the place, if it is one of these pictures. A star does not stand for a dot at the
    /// beginning, as in shells.
    pub(super) fn piece_of(&self, name: &str) -> Option<Piece> {
        let piece = name.strip_prefix(&self.before)?.strip_suffix(&self.after)?;
        match self.place {
            Place::Name if self.before.is_empty() && piece.starts_with('.') => None,
            Place::Name if piece.is_empty() => None,
            Place::Name => Some(Piece::Name(piece.to_owned())),
            Place::Number { digits, minus } => {
                let number =
                    piece.parse().ok().filter(|number: &i32| number.unsigned_abs() <= MAX_FRAME.unsigned_abs())?;
                // No plus, and neither more nor fewer zeros.
                let is_written = |minus: Minus| piece == minus.padded(number, digits);
                (is_written(minus) || is_written(minus.other())).then_some(Piece::Number(number))
            }
        }
    }
}

/// Where `%d` and `%04d` stand, how long they are and what they say.
fn printf_places(name: &str) -> Vec<(usize, usize, Place)> {
    let place = |at: usize| {
        let rest = &name[at + 1..];
        let digits = &rest[..rest.find('d')?];
        let count = match digits.strip_prefix('0') {
            None if digits.is_empty() => 1,
            Some(count) if count.len() == 1 => count.parse().ok().filter(|count| *count > 0)?,
            _ => return None,
        };
        Some((at, digits.len() + 2, Place::Number { digits: count, minus: Minus::AmongDigits }))
    };
    name.match_indices('%').filter_map(|(at, _)| place(at)).collect()
}

/// Where Houdini's `$F` and `$F4` stand.
fn houdini_places(name: &str) -> Vec<(usize, usize, Place)> {
    let place = |at: usize| {
        let rest = &name[at + 2..];
        let digits = rest.chars().next().and_then(|digit| digit.to_digit(10)).filter(|digits| *digits > 0);
        let after = &rest[usize::from(digits.is_some())..];
        let ends = !after.starts_with(|c: char| c.is_alphanumeric());
        let length = 2 + usize::from(digits.is_some());
        ends.then_some((at, length, Place::Number { digits: digits.unwrap_or(1) as usize, minus: Minus::BeforeDigits }))
    };
    name.match_indices("$F").filter_map(|(at, _)| place(at)).collect()
}

/// Where runs of a letter begin, and their lengths.
fn runs(name: &str, letter: char) -> impl Iterator<Item = (usize, usize)> {
    let begins = move |at: usize| name[at..].starts_with(letter) && !name[..at].ends_with(letter);
    let length = move |at: usize| name[at..].chars().take_while(|c| *c == letter).count();
    name.match_indices(letter).map(|(at, _)| at).filter(move |at| begins(*at)).map(move |at| (at, length(at)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pattern(path: &str) -> Pattern {
        Pattern::in_path(Path::new(path)).unwrap().unwrap()
    }

    #[test]
    fn every_way_to_write_a_number_gives_the_same_names() {
        for (path, number, expected) in [
            ("a/shot.####.exr", 7, "a/shot.0007.exr"),
            ("a/shot.%04d.exr", 7, "a/shot.0007.exr"),
            ("shot.####.exr", 12345, "shot.12345.exr"),
            ("shot_#.exr", 7, "shot_7.exr"),
            ("shot_%d.exr", 12, "shot_12.exr"),
            ("####", 0, "0000"),
            ("take#2.%03d.exr", 5, "take#2.005.exr"),
            ("100%.####.exr", 5, "100%.0005.exr"),
            ("ünï.##.exr", 5, "ünï.05.exr"),
            ("shot.@@@@.exr", 7, "shot.0007.exr"),
            ("shot.@.exr", 12, "shot.12.exr"),
            ("shot.$F4.exr", 7, "shot.0007.exr"),
            ("shot_$F.exr", 7, "shot_7.exr"),
            ("take@2.####.exr", 5, "take@2.0005.exr"),
            ("shot.####.exr", -5, "shot.-0005.exr"),
            ("shot.%04d.exr", -5, "shot.-005.exr"),
            ("shot.$F4.exr", -12_345, "shot.-12345.exr"),
            ("shot_#.exr", -5, "shot_-5.exr"),
        ] {
            let pattern = pattern(path);
            let found = pattern.path(&Piece::Number(number));
            assert_eq!(found, Path::new(expected));
            let name = found.file_name().unwrap().to_str().unwrap();
            assert_eq!(pattern.piece_of(name), Some(Piece::Number(number)), "{path}");
        }
    }

    #[test]
    fn one_picture_is_no_pattern() {
        for path in [
            "shot.exr",
            "a#1/shot.exr",
            "a*/shot.exr",
            "100%.exr",
            "logo@2x.png",
            "$Frame.exr",
            "$FF.exr",
            "$F4x.exr",
            "%4d.exr",
            "%00d",
            "%10d",
            "..",
            "/",
            "%",
        ] {
            assert_eq!(Pattern::in_path(Path::new(path)).unwrap(), None, "{path}");
        }
    }

    #[test]
    fn several_places_are_refused() {
        for path in ["####.##.exr", "*.*", "shot*.####.exr", "%04d.%04d.exr"] {
            let message = Pattern::in_path(Path::new(path)).unwrap_err().to_string();
            assert!(message.starts_with(path) && message.contains("2 parts"), "{message}");
        }
    }

    /// Each number has one name, so that no two pictures have one output.
    #[test]
    fn only_whole_numbers_of_the_right_width_are_frames() {
        let frames = pattern("shot.####.exr");
        for name in [
            "shot.007.exr",
            "shot.00007.exr",
            "shot.+007.exr",
            "shot.-07.exr",
            "shot.-0000.exr",
            "shot.abcd.exr",
            "shot..exr",
        ] {
            assert_eq!(frames.piece_of(name), None, "{name}");
        }
        for name in
            ["shot.0007.png", "Shot.0007.exr", "shot.99999999999.exr", "shot.1000000000.exr", "shot.0007.exr.part"]
        {
            assert_eq!(frames.piece_of(name), None, "{name}");
        }
        assert_eq!(frames.piece_of("shot.999999999.exr"), Some(Piece::Number(MAX_FRAME)));
        // The sign of frames before 0 is written in two ways.
        for name in ["shot.-007.exr", "shot.-0007.exr"] {
            assert_eq!(frames.piece_of(name), Some(Piece::Number(-7)), "{name}");
        }
        assert_eq!(frames.other_path(&Piece::Number(-7)).unwrap(), Path::new("shot.-007.exr"));
        assert_eq!(frames.other_path(&Piece::Number(7)), None);
        // Begin and end may not share letters.
        assert_eq!(pattern("aa#aa").piece_of("aaa"), None);
    }

    #[test]
    fn a_star_stands_for_a_name() {
        let names = pattern("in/*.exr");
        let piece = names.piece_of("tree.v2.exr").unwrap();
        assert_eq!(pattern("out/*_film.png").path(&piece), Path::new("out/tree.v2_film.png"));
        assert_eq!(names.piece_of(".exr"), None);
        assert_eq!(names.piece_of(".hidden.exr"), None);
        assert_eq!(pattern("a*").piece_of("a.exr"), Some(Piece::Name(".exr".to_owned())));
    }
}
