mod read;
mod write;

use onelight_lut::{Domain, Interpolation, Lut1d, Lut3d, PlainLut};

use crate::error::{Error, ErrorKind};
use crate::text::one_line;

/// The most bytes of a title or comment that are written, so that lines stay within the 250 bytes of the
/// format's specification \[AdobeCube2013\].
const TEXT_BYTES: usize = 200;

/// What a `.cube` file holds: a 1D table, a 3D table, or a 1D table that leads into a 3D one.
///
/// | Tables | Keywords written | Also read |
/// |---|---|---|
/// | 1D | `LUT_1D_SIZE`, `DOMAIN_MIN`, `DOMAIN_MAX` | `LUT_1D_INPUT_RANGE` |
/// | 3D | `LUT_3D_SIZE`, `DOMAIN_MIN`, `DOMAIN_MAX` | `LUT_3D_INPUT_RANGE` |
/// | 1D, then 3D (Resolve's form) | `LUT_1D_SIZE`, `LUT_1D_INPUT_RANGE`, `LUT_3D_SIZE`, `LUT_3D_INPUT_RANGE` | |
///
/// The domain is left out of a file with one table where it is 0 to 1. Entries are `f32`, as most programs
/// hold them, and a file read back equals the one written, bit for bit.
///
/// ```
/// use onelight_formats::CubeFile;
/// use onelight_lut::Interpolation;
///
/// let file = CubeFile::parse("LUT_1D_SIZE 2\nDOMAIN_MAX 2 2 2\n0 0 0\n1 1 0.5\n")?;
/// assert_eq!(file.apply([1.0, 3.0, 1.0], Interpolation::Tetrahedral), [0.5, 1.0, 0.25]);
/// # Ok::<(), onelight_formats::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct CubeFile {
    title: String,
    comments: Vec<String>,
    /// At least one of the two is there.
    lut1d: Option<Lut1d>,
    lut3d: Option<(Domain, Lut3d)>,
}

impl CubeFile {
    /// Entries of the 1D table that stands for a shaper.
    ///
    /// A 1D table has equal steps in the input, so it needs many to follow a logarithm near 0. A log2 shaper
    /// read linearly from `n` entries over `[0, max]` is wrong by at most
    /// `(max / (n - 1) / offset)^2 / (8 ln(1 + max / offset))` of the coordinate: with offset 0.02 and maximum
    /// 4 that is 2e-7 at 65536 entries, and 6e-5 at 4096.
    pub const SHAPER_POINTS: usize = 65_536;

    /// The most bytes of one line that are read.
    pub const MAX_LINE_BYTES: usize = 4096;

    /// The most lines without data (keywords, comments, blank lines) that are read.
    pub const MAX_OTHER_LINES: usize = 1 << 17;

    /// The most bytes that all comments of a file that is read may have.
    pub const MAX_COMMENT_BYTES: usize = 1 << 20;

    /// A file with one curve for each channel and no 3D table.
    pub fn from_1d(lut: Lut1d) -> Self {
        Self::with_tables(Some(lut), None)
    }

    /// A file with a 3D table only, whose coordinates 0 and 1 stand for the ends of `domain`.
    pub fn from_3d(domain: Domain, lut: Lut3d) -> Self {
        Self::with_tables(None, Some((domain, lut)))
    }

    /// A file in Resolve's form: the 1D table's output is the 3D table's input, over `domain`.
    ///
    /// # Errors
    ///
    /// If one of the two domains differs among channels: this form has one range for all.
    pub fn from_both(lut1d: Lut1d, domain: Domain, lut3d: Lut3d) -> Result<Self, Error> {
        for (what, domain) in [("1D table", lut1d.domain()), ("3D table", &domain)] {
            if domain.as_common().is_none() {
                return Err(ErrorKind::DomainsDiffer { what, min: domain.min(), max: domain.max() }.into());
            }
        }
        Ok(Self::with_tables(Some(lut1d), Some((domain, lut3d))))
    }

    /// A compiled LUT in Resolve's form, with its shaper as a 1D table of `shaper_points` entries over
    /// `[0, max]`; [`CubeFile::SHAPER_POINTS`] is a good number.
    ///
    /// # Errors
    ///
    /// If `shaper_points` is out of bounds (see [`Lut1d`]).
    ///
    /// ```
    /// use onelight_formats::CubeFile;
    /// use onelight_lut::{Interpolation, PlainLut, Shaper, bake};
    ///
    /// let shaper = Shaper::log2(0.02, 4.0)?;
    /// let table = bake(17, &shaper, |rgb| rgb.map(|v| v / (v + 0.18)), |_nodes_done| {})?;
    /// let lut = PlainLut::new(shaper, table, Interpolation::Tetrahedral);
    /// let mut file = Vec::new();
    /// CubeFile::from_plain(&lut, CubeFile::SHAPER_POINTS)?
    ///     .with_title("toy")
    ///     .with_comments(["input: scene-linear, 1 is diffuse white"])
    ///     .write(&mut file)?;
    /// assert!(file.starts_with(b"# TITLE \"toy\"\n"));
    /// # Ok::<(), onelight_formats::Error>(())
    /// ```
    pub fn from_plain(lut: &PlainLut, shaper_points: usize) -> Result<Self, Error> {
        let shaper = lut.shaper();
        let table = Lut1d::sample(shaper_points, [0.0, shaper.max()], |u| shaper.encode(u))?;
        Self::from_both(table, Domain::UNIT, lut.table().clone())
    }

    /// The same tables under a title.
    ///
    /// Other programs read one short line between double quotes, so control characters become spaces, double
    /// quotes single ones, surrounding space goes, and what exceeds 200 bytes is cut off.
    #[must_use]
    pub fn with_title(mut self, title: &str) -> Self {
        let title = one_line(title).replace('"', "'");
        let title = title.trim();
        self.title = title[..floor_boundary(title, TEXT_BYTES)].trim_end().to_owned();
        self
    }

    /// The same tables under other comment lines, without their leading `#`.
    ///
    /// A text with line ends becomes as many comments, one beyond 200 bytes is split, other control characters
    /// become spaces.
    #[must_use]
    pub fn with_comments<S: AsRef<str>>(mut self, comments: impl IntoIterator<Item = S>) -> Self {
        self.comments.clear();
        for text in comments {
            for line in text.as_ref().split('\n') {
                let line = one_line(line);
                let mut rest = line.trim_end();
                while rest.len() > TEXT_BYTES {
                    let (head, tail) = rest.split_at(floor_boundary(rest, TEXT_BYTES));
                    self.comments.push(head.trim_end().to_owned());
                    rest = tail;
                }
                self.comments.push(rest.to_owned());
            }
        }
        self
    }

    /// The title, empty if there is none.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// The comment lines, without the leading `#` and one space after it.
    pub fn comments(&self) -> &[String] {
        &self.comments
    }

    /// The 1D table, which comes first.
    pub fn lut1d(&self) -> Option<&Lut1d> {
        self.lut1d.as_ref()
    }

    /// The 3D table, which reads what the 1D table gave where there is one.
    pub fn lut3d(&self) -> Option<&Lut3d> {
        self.lut3d.as_ref().map(|(_, lut)| lut)
    }

    /// The values that the coordinates 0 and 1 of the 3D table stand for.
    pub fn domain3d(&self) -> Option<&Domain> {
        self.lut3d.as_ref().map(|(domain, _)| domain)
    }

    /// What the file's numbers say about one colour: linear in the 1D table, then as asked in the 3D one.
    ///
    /// Inputs outside a domain read its ends; NaN reads the first.
    pub fn apply(&self, rgb: [f32; 3], interpolation: Interpolation) -> [f32; 3] {
        let shaped = match &self.lut1d {
            Some(lut) => lut.apply(rgb),
            None => rgb,
        };
        match &self.lut3d {
            Some((domain, lut)) => lut.apply(domain.normalise(shaped), interpolation),
            None => shaped,
        }
    }

    fn with_tables(lut1d: Option<Lut1d>, lut3d: Option<(Domain, Lut3d)>) -> Self {
        Self { title: String::new(), comments: Vec::new(), lut1d, lut3d }
    }
}

/// The most bytes, up to `limit`, that end between two characters.
fn floor_boundary(text: &str, limit: usize) -> usize {
    if text.len() <= limit {
        return text.len();
    }
    (0..=limit).rev().find(|&end| text.is_char_boundary(end)).unwrap_or(0)
}
