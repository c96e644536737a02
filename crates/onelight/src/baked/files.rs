//! What was baked as the files that programs load.

use std::io::Write;

use onelight_formats::{
    ClfProcess, CubeFile, PngDepth, Spi3dConfig, StripGreen, direct_json, hald, ktx2, spi3d, strip,
};
use onelight_lut::{DirectForm, Domain, Interpolation, Lut3d, Storage};

use super::form::{Baked, BakedForm};
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
    /// Pictures of the table in a row: one with green downwards for Unreal, one with green upwards for Unity.
    Strip,
    /// A Hald CLUT of 16 bits.
    Hald,
    /// The numbers and equations of the direct form.
    Json,
}

words! {
    FileFormat, "format":
        FileFormat::Cube = "cube" "look.cube: Resolve's 1D + 3D form for scene light, 3D alone for coded colour",
        FileFormat::Clf = "clf" "look.clf: the Common LUT Format, plain or structured",
        FileFormat::Spi3d = "spi3d" "look.spi3d, with look_spi3d.ocio beside it for scene light",
        FileFormat::Ktx2 = "ktx2" "look.ktx2: a 3D texture of 16-bit floats",
        FileFormat::Strip = "strip" "look_strip_unreal.png (green downwards) and look_strip_unity.png (upwards): 1024x32, or 256x16 with --size 16",
        FileFormat::Hald = "hald" "look_hald.png: a Hald CLUT, 16 bit",
        FileFormat::Json = "json" "look.direct.json: the numbers and equations of the direct form";
}

/// One file of a baked look.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BakedFile {
    /// The name under which the others of its format know it: `look.spi3d`.
    pub name: &'static str,
    /// The whole content of the file.
    pub bytes: Vec<u8>,
}

/// A baked look as a file of it is read back: what a certificate of the file is for.
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
            Self::Json => form == Form::Direct,
            Self::Cube | Self::Spi3d | Self::Ktx2 | Self::Strip | Self::Hald => form == Form::Plain,
        }
    }

    /// Whether its files hold no shaper, so that they take a coding of light only.
    #[must_use]
    pub fn needs_coding(self) -> bool {
        matches!(self, Self::Strip | Self::Hald)
    }

    fn cannot_hold(self, form: Form) -> Error {
        let other = if self == Self::Json { Form::Direct } else { Form::Plain };
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
    /// assert_eq!(files.iter().map(|file| file.name).collect::<Vec<_>>(), ["look.spi3d", "look_spi3d.ocio"]);
    /// # Ok::<(), onelight::Error>(())
    /// ```
    ///
    /// # Errors
    /// If the format cannot hold the form, or needs a table that takes coded light.
    pub fn files(&self, format: FileFormat, comments: &[String]) -> Result<Vec<BakedFile>, Error> {
        let mut bytes = Vec::new();
        let name = match format {
            FileFormat::Cube => {
                self.cube(comments)?.write(&mut bytes)?;
                "look.cube"
            }
            FileFormat::Clf => {
                let clf = match self.form() {
                    BakedForm::Plain(lut) => ClfProcess::from_plain(lut)?,
                    BakedForm::Coded { table, .. } => ClfProcess::from_table(table, Interpolation::Tetrahedral),
                    BakedForm::Structured(lut) => ClfProcess::from_structured(lut)?,
                    BakedForm::Direct(_) => return Err(format.cannot_hold(Form::Direct)),
                };
                clf.with_name(self.name()).with_descriptions(comments).write(&mut bytes)?;
                "look.clf"
            }
            FileFormat::Spi3d => return self.spi3d(comments),
            FileFormat::Ktx2 => {
                ktx2::write(&mut bytes, self.plain_table(format)?, comments)?;
                "look.ktx2"
            }
            FileFormat::Strip => return self.strips(comments),
            FileFormat::Hald => {
                hald::write(&mut bytes, self.coded_table(format)?, PngDepth::Sixteen, comments)?;
                "look_hald.png"
            }
            FileFormat::Json => return self.direct_json(comments),
        };
        Ok(vec![BakedFile { name, bytes }])
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
            FileFormat::Strip => table(strip::read(bytes, StripGreen::Down)?),
            FileFormat::Hald => table(hald::read(bytes)?),
            FileFormat::Json => Read::Direct(Box::new(direct_json::read(bytes)?)),
        };
        Ok(AsWritten { baked: self, read })
    }

    fn cube(&self, comments: &[String]) -> Result<CubeFile, Error> {
        let cube = match self.form() {
            BakedForm::Plain(lut) => CubeFile::from_plain(lut, CubeFile::SHAPER_POINTS)?,
            _ => CubeFile::from_3d(Domain::UNIT, self.plain_table(FileFormat::Cube)?.clone()),
        };
        Ok(cube.with_title(self.name()).with_comments(comments))
    }

    fn spi3d(&self, comments: &[String]) -> Result<Vec<BakedFile>, Error> {
        let mut bytes = Vec::new();
        spi3d::write(&mut bytes, self.plain_table(FileFormat::Spi3d)?)?;
        let mut files = vec![BakedFile { name: "look.spi3d", bytes }];
        if let BakedForm::Plain(lut) = self.form() {
            let mut bytes = Vec::new();
            let config = Spi3dConfig::new(lut, "look.spi3d").with_look(self.name()).with_comments(comments);
            config.write(&mut bytes)?;
            files.push(BakedFile { name: "look_spi3d.ocio", bytes });
        }
        Ok(files)
    }

    fn strips(&self, comments: &[String]) -> Result<Vec<BakedFile>, Error> {
        let table = self.coded_table(FileFormat::Strip)?;
        let of = |(name, green)| {
            let mut bytes = Vec::new();
            strip::write(&mut bytes, table, PngDepth::Sixteen, green, comments)?;
            Ok(BakedFile { name, bytes })
        };
        [("look_strip_unreal.png", StripGreen::Down), ("look_strip_unity.png", StripGreen::Up)]
            .map(of)
            .into_iter()
            .collect()
    }

    fn direct_json(&self, comments: &[String]) -> Result<Vec<BakedFile>, Error> {
        let BakedForm::Direct(direct) = self.form() else {
            return Err(FileFormat::Json.cannot_hold(self.form().kind()));
        };
        let mut bytes = Vec::new();
        direct_json::write(&mut bytes, direct, comments)?;
        Ok(vec![BakedFile { name: "look.direct.json", bytes }])
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
