//! OpenColorIO configurations in which looks are views.

use std::fmt::{self, Display};
use std::io::{BufWriter, Write};

use onelight_lut::{Interpolation, PlainLut, PowerCoding, ShaperKind};

use crate::error::{Error, ErrorKind};
use crate::text::one_line;

/// An OpenColorIO 2 configuration with scene-linear light, one display, and looks as views of it.
///
/// It loads as it is in programs that use OpenColorIO: all roles of the library and of Blender are there, with sRGB and ACEScct
/// for what is painted and graded, and the interchange spaces by which two configurations are brought together. A look is a
/// colour space that takes the scene's light to display codes, and a view that shows it: not a look in OpenColorIO's sense,
/// which would go before a view's own coding and be coded twice.
///
/// ```
/// use onelight_formats::{OcioConfig, OcioSpace, OcioView};
/// use onelight_lut::PowerCoding;
///
/// // Rows of the matrix from Rec.709 light to CIE XYZ, white D65.
/// let to_xyz = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];
/// let scene = OcioSpace { name: "Linear Rec.709", to_xyz, coding: PowerCoding::LINEAR };
/// let display = OcioSpace { name: "sRGB", coding: PowerCoding::new(2.4, 0.055)?, ..scene };
/// let mut config = Vec::new();
/// OcioConfig::new(scene, display).with_view(OcioView::of_clf("my film", "look.clf")).write(&mut config)?;
/// assert!(String::from_utf8_lossy(&config).contains("- !<View> {name: \"my film\", colorspace: \"my film\"}"));
/// # Ok::<(), onelight_formats::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct OcioConfig {
    scene: OcioSpace,
    display: OcioSpace,
    views: Vec<OcioView>,
    comments: Vec<String>,
}

/// An RGB space of a configuration.
///
/// ```
/// use onelight_formats::{OcioConfig, OcioSpace, OcioView};
/// use onelight_lut::PowerCoding;
/// let space = |name| OcioSpace { name, to_xyz: [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]], coding: PowerCoding::LINEAR };
/// let config = OcioConfig::new(space("Linear Rec.709"), space("sRGB")).with_view(OcioView::of_clf("Portra on 2383", "portra.clf"));
/// let mut text = Vec::new();
/// config.write(&mut text)?;
/// assert!(String::from_utf8_lossy(&text).contains("Linear Rec.709"));
/// # Ok::<(), onelight_formats::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OcioSpace {
    /// What the programs call it.
    pub name: &'static str,
    /// Rows of the matrix from its linear light to CIE XYZ, adapted to the white of D65.
    pub to_xyz: [[f64; 3]; 3],
    /// How its numbers are coded.
    pub coding: PowerCoding,
}

/// A look in a file beside the configuration, which a program lists by its name.
///
/// ```
/// use onelight_formats::{OcioConfig, OcioSpace, OcioView};
/// use onelight_lut::PowerCoding;
/// let space = |name| OcioSpace { name, to_xyz: [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]], coding: PowerCoding::LINEAR };
/// let config = OcioConfig::new(space("Linear Rec.709"), space("sRGB")).with_view(OcioView::of_clf("Portra on 2383", "portra.clf"));
/// let mut text = Vec::new();
/// config.write(&mut text)?;
/// assert!(String::from_utf8_lossy(&text).contains("portra.clf"));
/// # Ok::<(), onelight_formats::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct OcioView {
    name: String,
    file: String,
    interpolation: Interpolation,
    /// Offset and maximum of the log2 shaper before the file, where the file has none.
    shaper: Option<(f64, f64)>,
}

impl OcioView {
    /// A look whose file takes scene-linear light itself.
    #[must_use]
    pub fn of_clf(name: &str, file: &str) -> Self {
        Self { name: name.to_owned(), file: file.to_owned(), interpolation: Interpolation::Tetrahedral, shaper: None }
    }

    /// A look whose file, such as an `.spi3d`, holds the table of `lut` alone: the configuration has the shaper.
    ///
    /// # Errors
    ///
    /// If the shaper is no [`ShaperKind::Log2Offset`], which is the only one today.
    pub fn of_table(name: &str, file: &str, lut: &PlainLut) -> Result<Self, Error> {
        let ShaperKind::Log2Offset { offset, max } = lut.shaper().kind() else {
            return Err(ErrorKind::Shaper { found: lut.shaper().kind() }.into());
        };
        let interpolation = lut.interpolation();
        Ok(Self { interpolation, shaper: Some((offset, max)), ..Self::of_clf(name, file) })
    }
}

impl OcioConfig {
    /// A configuration whose reference is the linear light of `scene`, for one display.
    #[must_use]
    pub fn new(scene: OcioSpace, display: OcioSpace) -> Self {
        Self { scene, display, views: Vec::new(), comments: Vec::new() }
    }

    /// The same with one more look; the first is the view that programs show at once.
    ///
    /// Looks of one name are told apart by a number; control characters become spaces.
    #[must_use]
    pub fn with_view(mut self, view: OcioView) -> Self {
        let base = one_line(&view.name).trim().to_owned();
        let base = if base.is_empty() { "look".to_owned() } else { base };
        let taken = |name: &str, views: &[OcioView]| {
            let own = [self.scene.name, self.display.name, XYZ, ACES, ACES_CCT, DATA];
            own.iter().any(|own| own.eq_ignore_ascii_case(name)) || views.iter().any(|view| view.name == name)
        };
        let numbered = (2..).map(|number| format!("{base} {number}"));
        let name = std::iter::once(base.clone()).chain(numbered).find(|name| !taken(name, &self.views));
        self.views.push(OcioView { name: name.unwrap_or(base), ..view });
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
    /// If the writer fails.
    pub fn write(&self, writer: impl Write) -> Result<(), Error> {
        let mut out = BufWriter::new(writer);
        writeln!(out, "ocio_profile_version: 2")?;
        for comment in &self.comments {
            writeln!(out, "# {}", one_line(comment))?;
        }
        let (scene, display) = (self.scene.name, self.display.name);
        writeln!(out, "search_path: .\nstrictparsing: true\nluma: [{}]", Listed(&self.scene.to_xyz[1]))?;
        writeln!(out, "roles:")?;
        for role in ["default", "default_float", "reference", "rendering", "scene_linear"] {
            writeln!(out, "  {role}: {}", Quoted(scene))?;
        }
        for role in ["color_picking", "default_byte", "default_sequencer", "matte_paint", "texture_paint"] {
            writeln!(out, "  {role}: {}", Quoted(display))?;
        }
        for (role, space) in [
            ("color_timing", ACES_CCT),
            ("compositing_log", ACES_CCT),
            ("data", DATA),
            ("aces_interchange", ACES),
            ("cie_xyz_d65_interchange", XYZ),
            ("XYZ", XYZ),
        ] {
            writeln!(out, "  {role}: {}", Quoted(space))?;
        }
        writeln!(
            out,
            "file_rules:\n  - !<Rule> {{name: Default, colorspace: default}}\ndisplays:\n  {}:",
            Quoted(display)
        )?;
        let views = self.views.iter().map(|view| (view.name.as_str(), view.name.as_str()));
        for (view, space) in views.chain([("Standard", display), ("Raw", DATA)]) {
            writeln!(out, "    - !<View> {{name: {}, colorspace: {}}}", Quoted(view), Quoted(space))?;
        }
        writeln!(out, "active_displays: [{}]", Quoted(display))?;
        writeln!(out, "colorspaces:")?;
        self.write_spaces(&mut out)?;
        for view in &self.views {
            write_view(&mut out, view)?;
        }
        out.flush()?;
        Ok(())
    }

    fn write_spaces(&self, out: &mut impl Write) -> Result<(), Error> {
        let scene_to_xyz = format!("!<MatrixTransform> {{matrix: [{}]}}", Listed(&padded(&self.scene.to_xyz)));
        space(out, self.scene.name, "scene-linear", &[])?;
        let mut steps = vec![scene_to_xyz.clone()];
        let from_xyz = Listed(&padded(&self.display.to_xyz)).to_string();
        steps.push(format!("!<MatrixTransform> {{matrix: [{from_xyz}], direction: inverse}}"));
        let (exponent, offset) = (self.display.coding.exponent(), self.display.coding.offset());
        if offset > 0.0 {
            steps.push(format!(
                "!<ExponentWithLinearTransform> {{gamma: {exponent}, offset: {offset}, direction: inverse}}"
            ));
        } else if exponent != 1.0 {
            steps.push(format!("!<ExponentTransform> {{value: {exponent}, style: mirror, direction: inverse}}"));
        }
        space(out, self.display.name, "sdr-video", &steps)?;
        space(out, XYZ, "scene-linear", std::slice::from_ref(&scene_to_xyz))?;
        let to_aces = format!("!<BuiltinTransform> {{style: {ACES_TO_XYZ}, direction: inverse}}");
        space(out, ACES, "scene-linear", &[scene_to_xyz.clone(), to_aces.clone()])?;
        let to_log = "!<BuiltinTransform> {style: ACEScct_to_ACES2065-1, direction: inverse}".to_owned();
        space(out, ACES_CCT, "log", &[scene_to_xyz, to_aces, to_log])?;
        let name = Quoted(DATA);
        writeln!(
            out,
            "  - !<ColorSpace>\n    name: {name}\n    aliases: [Raw, Generic Data]\n    isdata: true\n    encoding: data"
        )?;
        Ok(())
    }
}

/// OpenColorIO's own names of the spaces by which configurations are brought together.
const XYZ: &str = "CIE XYZ-D65";
const ACES: &str = "ACES2065-1";
const ACES_CCT: &str = "ACEScct";
/// Numbers that are no colours; Blender looks for this name.
const DATA: &str = "Non-Color";
/// A transform that OpenColorIO brings, with the adaptation of Bradford.
const ACES_TO_XYZ: &str = "UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD";

/// A colour space with the steps that lead from the reference to it.
fn space(out: &mut impl Write, name: &str, encoding: &str, steps: &[String]) -> Result<(), Error> {
    writeln!(out, "  - !<ColorSpace>\n    name: {}\n    encoding: {encoding}", Quoted(name))?;
    if !steps.is_empty() {
        writeln!(out, "    from_scene_reference: !<GroupTransform>\n      children:")?;
    }
    for step in steps {
        writeln!(out, "        - {step}")?;
    }
    Ok(())
}

fn write_view(out: &mut impl Write, view: &OcioView) -> Result<(), Error> {
    let interpolation = match view.interpolation {
        Interpolation::Trilinear => "linear",
        Interpolation::Tetrahedral => "tetrahedral",
    };
    let mut steps = Vec::new();
    if let Some((offset, max)) = view.shaper {
        steps.push(format!(
            "!<RangeTransform> {{min_in_value: 0, max_in_value: {max}, min_out_value: 0, max_out_value: {max}}}"
        ));
        let (slope, per_offset) = (1.0 / (1.0 + max / offset).log2(), 1.0 / offset);
        steps.push(format!(
            "!<LogAffineTransform> {{base: 2, log_side_slope: {slope}, lin_side_slope: {per_offset}, lin_side_offset: 1}}"
        ));
    }
    steps.push(format!("!<FileTransform> {{src: {}, interpolation: {interpolation}}}", Quoted(&view.file)));
    space(out, &view.name, "sdr-video", &steps)
}

/// A 3x3 matrix as OpenColorIO has it, with alpha.
fn padded(rows: &[[f64; 3]; 3]) -> [f64; 16] {
    std::array::from_fn(|i| match (i / 4, i % 4) {
        (row @ 0..3, column @ 0..3) => rows[row][column],
        (3, 3) => 1.0,
        _ => 0.0,
    })
}

/// Numbers between commas.
struct Listed<'a>(&'a [f64]);

impl Display for Listed<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, number) in self.0.iter().enumerate() {
            write!(f, "{}{number}", if i == 0 { "" } else { ", " })?;
        }
        Ok(())
    }
}

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
