use std::fmt::{self, Display};
use std::io::{BufWriter, Write};

use onelight_lut::{Interpolation, PlainLut, ShaperKind};

use crate::error::{Error, ErrorKind};
use crate::text::one_line;

/// An OpenColorIO configuration with two colour spaces: scene-linear, and the look that an `.spi3d` file holds.
///
/// The table knows no shaper, so the configuration does: a clamp to the shaper's range, a `LogAffineTransform` to
/// coordinates from 0 to 1, then the file. It loads as it is; to use the look in a configuration of one's own, copy its colour
/// space.
///
/// ```
/// use onelight_formats::{Spi3dConfig, spi3d};
/// use onelight_lut::{Interpolation, Lut3d, PlainLut, Shaper};
///
/// let lut = PlainLut::new(Shaper::log2(0.02, 4.0)?, Lut3d::identity(5)?, Interpolation::Tetrahedral);
/// let [mut table, mut config] = [Vec::new(), Vec::new()];
/// spi3d::write(&mut table, lut.table())?;
/// Spi3dConfig::new(&lut, "look.spi3d").with_look("my look").write(&mut config)?;
/// assert!(String::from_utf8_lossy(&config).contains("!<FileTransform> {src: \"look.spi3d\", interpolation: tetrahedral}"));
/// # Ok::<(), onelight_formats::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Spi3dConfig {
    shaper: ShaperKind,
    interpolation: Interpolation,
    file: String,
    look: String,
    comments: Vec<String>,
}

impl Spi3dConfig {
    /// The configuration for the table of `lut`, which lies beside it in a file called `file`.
    pub fn new(lut: &PlainLut, file: &str) -> Self {
        Self {
            shaper: lut.shaper().kind(),
            interpolation: lut.interpolation(),
            file: file.to_owned(),
            look: "look".to_owned(),
            comments: Vec::new(),
        }
    }

    /// The same with another name for the look's colour space.
    ///
    /// The name of the scene's is "scene-linear"; a look of that name, or of none, keeps "look".
    #[must_use]
    pub fn with_look(mut self, name: &str) -> Self {
        let name = name.trim();
        if !name.is_empty() && !name.eq_ignore_ascii_case(SCENE) {
            self.look = name.to_owned();
        }
        self
    }

    /// The same under other comment lines, without their leading `#`.
    #[must_use]
    pub fn with_comments<S: AsRef<str>>(mut self, comments: impl IntoIterator<Item = S>) -> Self {
        let lines = |text: S| text.as_ref().lines().map(str::to_owned).collect::<Vec<_>>();
        self.comments = comments.into_iter().flat_map(lines).collect();
        self
    }

    /// Writes the configuration as text.
    ///
    /// # Errors
    ///
    /// If the writer fails, or the shaper is no [`ShaperKind::Log2Offset`], which is the only one today.
    pub fn write(&self, writer: impl Write) -> Result<(), Error> {
        let mut out = BufWriter::new(writer);
        let ShaperKind::Log2Offset { offset, max } = self.shaper else {
            return Err(ErrorKind::Shaper { found: self.shaper }.into());
        };
        let stops = (1.0 + max / offset).log2();
        let interpolation = match self.interpolation {
            Interpolation::Trilinear => "linear",
            Interpolation::Tetrahedral => "tetrahedral",
        };
        let (file, look) = (Quoted(&self.file), Quoted(&self.look));
        writeln!(out, "ocio_profile_version: 2")?;
        for comment in &self.comments {
            writeln!(out, "# {}", one_line(comment))?;
        }
        write!(
            out,
            r"search_path: .
roles:
  default: {SCENE}
  scene_linear: {SCENE}
file_rules:
  - !<Rule> {{name: Default, colorspace: default}}
displays:
  film:
    - !<View> {{name: look, colorspace: {look}}}
colorspaces:
  - !<ColorSpace>
    name: {SCENE}
    encoding: scene-linear
  - !<ColorSpace>
    name: {look}
    encoding: sdr-video
    from_scene_reference: !<GroupTransform>
      children:
        - !<RangeTransform> {{min_in_value: 0, max_in_value: {max}, min_out_value: 0, max_out_value: {max}}}
        - !<LogAffineTransform> {{base: 2, log_side_slope: {slope}, lin_side_slope: {per_offset}, lin_side_offset: 1}}
        - !<FileTransform> {{src: {file}, interpolation: {interpolation}}}
",
            slope = 1.0 / stops,
            per_offset = 1.0 / offset,
        )?;
        out.flush()?;
        Ok(())
    }
}

/// The name of the scene's colour space.
const SCENE: &str = "scene-linear";

/// A scalar of YAML between double quotes.
struct Quoted<'a>(&'a str);

impl Display for Quoted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("\"")?;
        for c in one_line(self.0).chars() {
            match c {
                '"' | '\\' => write!(f, "\\{c}")?,
                c => write!(f, "{c}")?,
            }
        }
        f.write_str("\"")
    }
}
