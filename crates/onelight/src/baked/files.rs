//! What was baked as the files that programs load.

use std::io::Write;

use onelight_formats::{
    ClfProcess, CubeFile, OcioView, PngDepth, StripGreen, dctl, direct_json, hald, ktx2, lut_3dl, spi3d, strip, vlt,
};
use onelight_lut::{DirectForm, Domain, Interpolation, Lut3d, Storage};

use super::form::{Baked, BakedForm};
use super::ocio;
use super::recipe::Form;
use crate::error::{Error, ErrorKind};
use crate::word::{Word as _, words};

/// The file formats of a baked look.
///
/// ```
/// use onelight::baked::{FileFormat, Form};
/// assert_eq!(FileFormat::usual(Form::Structured), FileFormat::Clf);
/// assert!(!FileFormat::Cube.holds(Form::Direct));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FileFormat {
    /// Resolve's 1D + 3D form for scene light, 3D alone for coded colour.
    Cube,
    /// The Common LUT Format, plain or structured.
    Clf,
    /// `.spi3d`, with an OpenColorIO configuration beside it for scene light.
    Spi3d,
    /// A 3D texture of 16-bit floats.
    Ktx2,
    /// A picture of the table in a row of tiles, green downwards, for Unreal.
    Unreal,
    /// The same, green upwards, for Unity.
    Unity,
    /// The same, green downwards, for Godot.
    Godot,
    /// A Hald CLUT of 16 bits.
    Hald,
    /// Autodesk's text of a table, codes of 12 bits.
    ThreeDl,
    /// The table of Panasonic's cameras, 17 nodes a side, codes of 12 bits.
    Vlt,
    /// The numbers and equations of the direct form.
    Json,
    /// The direct form as a program for Resolve.
    Dctl,
}

words! {
    FileFormat, "format":
        FileFormat::Cube = "cube" "look.scene-linear.resolve.cube, Resolve's 1D + 3D form, or of a coding look.CODING.cube, 3D alone",
        FileFormat::Clf = "clf" "look.INPUT.clf: the Common LUT Format, plain or structured",
        FileFormat::Spi3d = "spi3d" "look.INPUT.spi3d, with an OpenColorIO configuration beside it for scene light",
        FileFormat::Ktx2 = "ktx2" "look.INPUT.ktx2: a 3D texture of 16-bit floats",
        FileFormat::Unreal = "unreal" "look.CODING.unreal.png: tiles in a row, green downwards; 256x16 with --size 16",
        FileFormat::Unity = "unity" "look.CODING.unity.png: tiles in a row, green upwards; 1024x32 with --size 32",
        FileFormat::Godot = "godot" "look.CODING.godot.png: tiles in a row, green downwards; 4096x64 with --size 64",
        FileFormat::Hald = "hald" "look.CODING.hald.png: a Hald CLUT, 16 bit",
        FileFormat::ThreeDl = "3dl" "look.CODING.3dl: Autodesk's text, 33^3, 12 bit",
        FileFormat::Vlt = "vlt" "look.CODING.vlt: for Panasonic's cameras, 17^3, 12 bit",
        FileFormat::Json = "json" "look.direct.json: the numbers and equations of the direct form",
        FileFormat::Dctl = "dctl" "look.INPUT.dctl: the direct form as a program for Resolve, for all light";
}

/// One file of a baked look.
///
/// ```
/// use onelight::baked::{FileFormat, Recipe};
/// let baked = onelight::Process::default().look()?.baked(&Recipe::cube(17))?;
/// let files = baked.files(FileFormat::Cube, &["5207 on 2383".to_owned()])?;
/// assert_eq!(files[0].name, "look.scene-linear.resolve.cube");
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BakedFile {
    /// Its name, which says what it takes: `look.logc4.cube`.
    pub name: String,
    /// The whole content of the file.
    pub bytes: Vec<u8>,
}

/// A baked look as a file of it is read back: what a certificate of the file is for.
///
/// ```
/// use onelight::baked::{FileFormat, Recipe};
/// let baked = onelight::Process::default().look()?.baked(&Recipe::cube(17))?;
/// let read_back = baked.as_written(FileFormat::Cube)?;
/// let (file, memory) = (read_back.apply([0.18; 3]), baked.apply([0.18; 3]));
/// assert!((file[0] - memory[0]).abs() < 1e-4);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug)]
pub struct AsWritten<'a> {
    baked: &'a Baked,
    read: Read,
}

#[derive(Debug)]
enum Read {
    Cube(CubeFile),
    Clf(ClfProcess),
    Table(Box<Baked>),
    Direct(Box<DirectForm>),
}

impl FileFormat {
    /// The format that programs read a form from.
    #[must_use]
    pub fn usual(form: Form) -> Self {
        match form {
            Form::Plain => Self::Cube,
            Form::Structured => Self::Clf,
            Form::Direct => Self::Json,
        }
    }

    /// Whether its files can hold a form.
    #[must_use]
    pub fn holds(self, form: Form) -> bool {
        match self {
            Self::Clf => form != Form::Direct,
            Self::Json | Self::Dctl => form == Form::Direct,
            Self::Cube
            | Self::Spi3d
            | Self::Ktx2
            | Self::Unreal
            | Self::Unity
            | Self::Godot
            | Self::Hald
            | Self::ThreeDl
            | Self::Vlt => form == Form::Plain,
        }
    }

    /// Whether its files hold no shaper, so that they take a coding of light only.
    #[must_use]
    pub fn needs_coding(self) -> bool {
        self.strip_green().is_some() || matches!(self, Self::Hald | Self::ThreeDl | Self::Vlt)
    }

    /// Nodes along each side that its programs expect, where they expect a number.
    #[must_use]
    pub fn usual_size(self) -> Option<usize> {
        match self {
            Self::Unreal => Some(16),
            Self::Unity => Some(32),
            Self::Godot | Self::Hald => Some(64),
            Self::ThreeDl => Some(33),
            Self::Vlt => Some(vlt::SIZE),
            Self::Cube | Self::Clf | Self::Spi3d | Self::Ktx2 | Self::Json | Self::Dctl => None,
        }
    }

    /// Which way green runs in the tiles of a strip.
    fn strip_green(self) -> Option<StripGreen> {
        match self {
            Self::Unreal | Self::Godot => Some(StripGreen::Down),
            Self::Unity => Some(StripGreen::Up),
            Self::Cube
            | Self::Clf
            | Self::Spi3d
            | Self::Ktx2
            | Self::Hald
            | Self::ThreeDl
            | Self::Vlt
            | Self::Json
            | Self::Dctl => None,
        }
    }

    fn cannot_hold(self, form: Form) -> Error {
        let other = if self.holds(Form::Direct) { Form::Direct } else { Form::Plain };
        let (own, form, usual, other) = (self.word(), form.word(), Self::usual(form).word(), other.word());
        ErrorKind::Contradiction(format!("{own} cannot hold the {form} form, expected {usual}, or the {other} form"))
            .into()
    }
}

impl Baked {
    /// Writes the look as a `.cube` file, its name and how it was made in comments.
    ///
    /// ```
    /// use onelight::baked::Recipe;
    /// let baked = onelight::Process::default().look()?.baked(&Recipe::cube(9))?;
    /// let mut file = Vec::new();
    /// baked.write_cube(&mut file)?;
    /// assert!(String::from_utf8_lossy(&file).contains("LUT_3D_SIZE 9"));
    /// # Ok::<(), onelight::Error>(())
    /// ```
    ///
    /// # Errors
    /// If the form is not the plain one, or the writer fails.
    pub fn write_cube(&self, to: impl Write) -> Result<(), Error> {
        self.cube(&self.comments(None))?.write(to)?;
        Ok(())
    }

    /// The files of one format, `comments` in those that hold some ([`Baked::comments`] has the usual ones).
    ///
    /// ```
    /// use onelight::baked::{FileFormat, Recipe};
    /// let baked = onelight::Process::default().look()?.baked(&Recipe::cube(9))?;
    /// let files = baked.files(FileFormat::Spi3d, &baked.comments(None))?;
    /// assert_eq!(files[0].name, "look.log2-shaper.spi3d");
    /// assert_eq!(files[1].name, "look.scene-linear.ocio");
    /// # Ok::<(), onelight::Error>(())
    /// ```
    ///
    /// # Errors
    /// If the format cannot hold the form, or needs a table that takes coded light.
    pub fn files(&self, format: FileFormat, comments: &[String]) -> Result<Vec<BakedFile>, Error> {
        let mut bytes = Vec::new();
        let kind = match format {
            FileFormat::Cube => {
                self.cube(comments)?.write(&mut bytes)?;
                if self.coordinate().is_some() { "cube" } else { "resolve.cube" }
            }
            FileFormat::Clf => {
                self.clf(comments)?.write(&mut bytes)?;
                "clf"
            }
            FileFormat::Spi3d => return self.spi3d(comments),
            FileFormat::Ktx2 => {
                ktx2::write(&mut bytes, self.plain_table(format)?, comments)?;
                return Ok(vec![BakedFile { name: format!("look.{}.ktx2", self.table_word()), bytes }]);
            }
            FileFormat::Unreal | FileFormat::Unity | FileFormat::Godot => {
                let green = format.strip_green().unwrap_or(StripGreen::Down);
                strip::write(&mut bytes, self.coded_table(format)?, PngDepth::Sixteen, green, comments)?;
                return Ok(vec![BakedFile { name: self.file_name(&format!("{}.png", format.word())), bytes }]);
            }
            FileFormat::Hald => {
                hald::write(&mut bytes, self.coded_table(format)?, PngDepth::Sixteen, comments)?;
                "hald.png"
            }
            FileFormat::ThreeDl => {
                lut_3dl::write(&mut bytes, self.coded_table(format)?, comments)?;
                "3dl"
            }
            FileFormat::Vlt => {
                vlt::write(&mut bytes, self.coded_table(format)?)?;
                "vlt"
            }
            FileFormat::Json => {
                let BakedForm::Direct(direct) = self.form() else { return Err(format.cannot_hold(self.form().kind())) };
                self.expect_power(format)?;
                direct_json::write(&mut bytes, direct, comments)?;
                // The file itself says what goes in, and nothing else has its name.
                return Ok(vec![BakedFile { name: "look.direct.json".to_owned(), bytes }]);
            }
            FileFormat::Dctl => {
                let BakedForm::Direct(direct) = self.form() else { return Err(format.cannot_hold(self.form().kind())) };
                self.expect_power(format)?;
                dctl::write(&mut bytes, direct, comments)?;
                "dctl"
            }
        };
        Ok(vec![BakedFile { name: self.file_name(kind), bytes }])
    }

    /// What the files of a format make of scene-linear RGB, their numbers read back.
    ///
    /// # Errors
    /// The same as those of [`Baked::files`].
    pub fn as_written(&self, format: FileFormat) -> Result<AsWritten<'_>, Error> {
        let files = self.files(format, &[])?;
        let bytes = files.first().map_or(&[][..], |file| &file.bytes);
        let table = |table| Read::Table(Box::new(self.with_table(table)));
        let read = match format {
            FileFormat::Cube => Read::Cube(CubeFile::read(bytes)?),
            FileFormat::Clf => Read::Clf(ClfProcess::read(bytes)?),
            FileFormat::Spi3d => table(spi3d::read(bytes)?),
            // 16-bit floats are all that the format changes.
            FileFormat::Ktx2 => table(Storage::F16.stored(self.plain_table(format)?)?),
            FileFormat::Unreal | FileFormat::Unity | FileFormat::Godot => {
                table(strip::read(bytes, format.strip_green().unwrap_or(StripGreen::Down))?)
            }
            FileFormat::Hald => table(hald::read(bytes)?),
            // Codes of 12 bits are all that these formats change.
            FileFormat::ThreeDl | FileFormat::Vlt => table(in_twelve_bits(self.coded_table(format)?)?),
            FileFormat::Json => Read::Direct(Box::new(direct_json::read(bytes)?)),
            // Numbers and equations are those of the form.
            FileFormat::Dctl => match self.form() {
                BakedForm::Direct(direct) => Read::Direct(direct.clone()),
                _ => return Err(format.cannot_hold(self.form().kind())),
            },
        };
        Ok(AsWritten { baked: self, read })
    }

    /// Refuses what a file of the direct form does not code by.
    fn expect_power(&self, format: FileFormat) -> Result<(), Error> {
        let (curve, format) = (self.coding().curve, format.word());
        if !curve.is_hdr() {
            return Ok(());
        }
        let sentence = format!(
            "{format} codes by a power and not by {}, expected output_coding linear, or a plain table",
            curve.word()
        );
        Err(ErrorKind::Contradiction(sentence).into())
    }

    fn cube(&self, comments: &[String]) -> Result<CubeFile, Error> {
        let cube = match self.form() {
            BakedForm::Plain(lut) => CubeFile::from_plain(lut, CubeFile::SHAPER_POINTS)?,
            _ => CubeFile::from_3d(Domain::UNIT, self.plain_table(FileFormat::Cube)?.clone()),
        };
        Ok(cube.with_title(&self.title()).with_comments(comments))
    }

    fn clf(&self, comments: &[String]) -> Result<ClfProcess, Error> {
        let clf = match self.form() {
            BakedForm::Plain(lut) => ClfProcess::from_plain(lut)?,
            BakedForm::Coded { table, .. } => ClfProcess::from_table(table, Interpolation::Tetrahedral),
            BakedForm::Structured(lut) => ClfProcess::from_structured(lut)?,
            BakedForm::Direct(_) => return Err(FileFormat::Clf.cannot_hold(Form::Direct)),
        };
        let clf = clf.with_name(&self.title()).with_descriptions(comments);
        Ok(clf.with_descriptors(&self.input_in_words(), &self.output_in_words()))
    }

    /// The name of a file that takes what the look takes.
    fn file_name(&self, kind: &str) -> String {
        format!("look.{}.{kind}", self.input_word())
    }

    /// What a table takes that lies in a file without its shaper.
    fn table_word(&self) -> String {
        self.coordinate().map_or_else(|| "log2-shaper".to_owned(), |taken| taken.word().to_owned())
    }

    fn spi3d(&self, comments: &[String]) -> Result<Vec<BakedFile>, Error> {
        let mut bytes = Vec::new();
        spi3d::write(&mut bytes, self.plain_table(FileFormat::Spi3d)?)?;
        let name = format!("look.{}.spi3d", self.table_word());
        let mut files = vec![BakedFile { name: name.clone(), bytes }];
        if let BakedForm::Plain(lut) = self.form() {
            let mut bytes = Vec::new();
            let view = OcioView::of_table(self.name(), &name, lut)?;
            ocio::config(self.spaces())?.with_view(view).with_comments(comments).write(&mut bytes)?;
            files.push(BakedFile { name: self.file_name("ocio"), bytes });
        }
        Ok(files)
    }

    /// The table of a plain form.
    fn plain_table(&self, format: FileFormat) -> Result<&Lut3d, Error> {
        match (self.form().kind(), self.table()) {
            (Form::Plain, Some(table)) => Ok(table),
            (form, _) => Err(format.cannot_hold(form)),
        }
    }

    /// The table of a form that takes coded colour: pictures hold no shaper.
    fn coded_table(&self, format: FileFormat) -> Result<&Lut3d, Error> {
        match self.form() {
            BakedForm::Coded { table, .. } => Ok(table),
            _ => Err(ErrorKind::Contradiction(format!(
                "{} holds no shaper for scene-linear light, expected a table that takes a coding, such as sRGB's",
                format.word()
            ))
            .into()),
        }
    }
}

fn in_twelve_bits(table: &Lut3d) -> Result<Lut3d, Error> {
    const MAX: f32 = 4095.0;
    let entry = |rgb: [f32; 3]| rgb.map(|v| (v.clamp(0.0, 1.0) * MAX).round() / MAX);
    Ok(Lut3d::new(table.size(), table.entries().map(entry).collect())?)
}

impl AsWritten<'_> {
    /// Scene-linear RGB of the look's input space to display-coded RGB.
    #[must_use]
    pub fn apply(&self, linear: [f32; 3]) -> [f32; 3] {
        match &self.read {
            Read::Cube(cube) => cube.apply(self.baked.coordinates_for_file(linear), Interpolation::Tetrahedral),
            Read::Clf(clf) => clf.apply(self.baked.coordinates_for_file(linear)),
            Read::Table(baked) => baked.apply(linear),
            Read::Direct(direct) => direct.apply(linear),
        }
    }
}
