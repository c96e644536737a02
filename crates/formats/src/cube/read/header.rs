use super::numbers::numbers;
use crate::cube::CubeFile;
use crate::error::{Error, TextProblem};
use crate::text::quoted;
use onelight_lut::{Domain, Lut1d, Lut3d};

/// What the keywords said so far.
#[derive(Default)]
pub(super) struct Header {
    title: Option<String>,
    size1d: Option<usize>,
    size3d: Option<usize>,
    range1d: Option<Domain>,
    range3d: Option<Domain>,
    domain_min: Option<[f32; 3]>,
    domain_max: Option<[f32; 3]>,
}

/// The tables that a complete header announces, each with its size and domain.
pub(super) enum Layout {
    One(usize, Domain),
    Three(usize, Domain),
    Both([usize; 2], [Domain; 2]),
}

impl Header {
    /// Takes a line that is neither data nor comment, and returns the keyword it knew.
    pub(super) fn keyword(&mut self, text: &str) -> Result<&'static str, TextProblem> {
        let (word, rest) = text.split_once(|c: char| c.is_ascii_whitespace()).unwrap_or((text, ""));
        let rest = rest.trim();
        match word.to_ascii_uppercase().as_str() {
            "TITLE" => set(&mut self.title, "TITLE", unquoted(rest).to_owned()),
            "LUT_1D_SIZE" => {
                let bounds = [Lut1d::MIN_SIZE, Lut1d::MAX_SIZE];
                let size = size("LUT_1D_SIZE", rest, bounds)?;
                set(&mut self.size1d, "LUT_1D_SIZE", size)
            }
            "LUT_3D_SIZE" => {
                let bounds = [Lut3d::MIN_SIZE, Lut3d::MAX_SIZE];
                let size = size("LUT_3D_SIZE", rest, bounds)?;
                set(&mut self.size3d, "LUT_3D_SIZE", size)
            }
            "LUT_1D_INPUT_RANGE" => {
                let range = range("LUT_1D_INPUT_RANGE", rest)?;
                set(&mut self.range1d, "LUT_1D_INPUT_RANGE", range)
            }
            "LUT_3D_INPUT_RANGE" => {
                let range = range("LUT_3D_INPUT_RANGE", rest)?;
                set(&mut self.range3d, "LUT_3D_INPUT_RANGE", range)
            }
            "DOMAIN_MIN" => {
                let ends = numbers("DOMAIN_MIN", rest)?;
                set(&mut self.domain_min, "DOMAIN_MIN", ends)
            }
            "DOMAIN_MAX" => {
                let ends = numbers("DOMAIN_MAX", rest)?;
                set(&mut self.domain_max, "DOMAIN_MAX", ends)
            }
            // DaVinci Resolve's words for codes 64 to 940 of 1023: without them the numbers mean something else.
            "LUT_IN_VIDEO_RANGE" | "LUT_OUT_VIDEO_RANGE" => Err(TextProblem::Unexpected {
                what: "range of codes",
                found: quoted(word),
                expected: "a table of full range, 0 to 1; export it so",
            }),
            _ => Err(TextProblem::UnknownKeyword { found: quoted(word) }),
        }
    }

    pub(super) fn title(&self) -> Option<String> {
        self.title.clone()
    }

    /// The tables, now that no keyword may follow.
    pub(super) fn layout(&self) -> Result<Layout, TextProblem> {
        match (self.size1d, self.size3d) {
            (None, None) => Err(TextProblem::DataBeforeSize),
            (Some(size), None) => {
                self.forbid_range(self.range3d, "LUT_3D_INPUT_RANGE", "no range of a 3D table in a file without one")?;
                Ok(Layout::One(size, self.domain_or(self.range1d)?))
            }
            (None, Some(size)) => {
                self.forbid_range(self.range1d, "LUT_1D_INPUT_RANGE", "no range of a 1D table in a file without one")?;
                Ok(Layout::Three(size, self.domain_or(self.range3d)?))
            }
            (Some(size1d), Some(size3d)) => {
                if self.domain_min.is_some() || self.domain_max.is_some() {
                    return Err(TextProblem::Misplaced {
                        keyword: "DOMAIN_MIN or DOMAIN_MAX",
                        expected: "LUT_1D_INPUT_RANGE and LUT_3D_INPUT_RANGE in a file with two tables",
                    });
                }
                let ranges = [self.range1d, self.range3d].map(|r| r.unwrap_or(Domain::UNIT));
                Ok(Layout::Both([size1d, size3d], ranges))
            }
        }
    }

    fn forbid_range(
        &self,
        range: Option<Domain>,
        keyword: &'static str,
        expected: &'static str,
    ) -> Result<(), TextProblem> {
        match range {
            Some(_) => Err(TextProblem::Misplaced { keyword, expected }),
            None => Ok(()),
        }
    }

    /// The domain of a file's only table: from either pair of keywords, not from both.
    fn domain_or(&self, range: Option<Domain>) -> Result<Domain, TextProblem> {
        match (range, self.domain_min, self.domain_max) {
            (Some(range), None, None) => Ok(range),
            (Some(_), _, _) => Err(TextProblem::Misplaced {
                keyword: "an INPUT_RANGE beside DOMAIN_MIN or DOMAIN_MAX",
                expected: "one of the two",
            }),
            (None, min, max) => {
                let min = min.unwrap_or(Domain::UNIT.min());
                let max = max.unwrap_or(Domain::UNIT.max());
                domain("DOMAIN_MIN and DOMAIN_MAX", min, max)
            }
        }
    }
}

impl Layout {
    pub(super) fn data_lines(&self) -> usize {
        match *self {
            Self::One(size, _) => size,
            Self::Three(size, _) => size.pow(3),
            Self::Both([size1d, size3d], _) => size1d + size3d.pow(3),
        }
    }

    /// The file, from all its data lines.
    pub(super) fn file(self, mut entries: Vec<[f32; 3]>) -> Result<CubeFile, Error> {
        match self {
            Self::One(_, domain) => Ok(CubeFile::from_1d(Lut1d::new(domain, entries)?)),
            Self::Three(size, domain) => Ok(CubeFile::from_3d(domain, Lut3d::new(size, entries)?)),
            Self::Both([size1d, size3d], [domain1d, domain3d]) => {
                let cube = entries.split_off(size1d.min(entries.len()));
                let lut1d = Lut1d::new(domain1d, entries)?;
                CubeFile::from_both(lut1d, domain3d, Lut3d::new(size3d, cube)?)
            }
        }
    }
}

fn set<T>(slot: &mut Option<T>, keyword: &'static str, value: T) -> Result<&'static str, TextProblem> {
    match slot.replace(value) {
        None => Ok(keyword),
        Some(_) => Err(TextProblem::RepeatedKeyword { keyword }),
    }
}

fn size(keyword: &'static str, text: &str, [min, max]: [usize; 2]) -> Result<usize, TextProblem> {
    match text.parse() {
        Ok(size) if (min..=max).contains(&size) => Ok(size),
        _ => Err(TextProblem::Size { keyword, found: quoted(text), min, max }),
    }
}

fn range(keyword: &'static str, text: &str) -> Result<Domain, TextProblem> {
    let [min, max] = numbers(keyword, text)?;
    domain(keyword, [min; 3], [max; 3])
}

fn domain(what: &'static str, min: [f32; 3], max: [f32; 3]) -> Result<Domain, TextProblem> {
    Domain::new(min, max).map_err(|_| TextProblem::Domain { what, min, max })
}

fn unquoted(text: &str) -> &str {
    let inner = text.strip_prefix('"').unwrap_or(text);
    inner.strip_suffix('"').unwrap_or(inner)
}
