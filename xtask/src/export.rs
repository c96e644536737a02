//! A baked look as the files that programs load.

use anyhow::{Result, anyhow, bail};
use clap::ValueEnum;
use onelight::Word as _;
use onelight::baked::{Baked, BakedForm, Form};
use onelight::lut::{
    ClfProcess, CubeFile, Domain, Interpolation, Lut3d, PngDepth, Spi3dConfig, Storage, StripGreen, read_hald,
    read_spi3d, read_strip, write_hald, write_ktx2, write_spi3d, write_strip,
};

use crate::atomic_file::WholeSet;
use crate::direct_file;

/// The file formats of a baked look.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// look.cube: Resolve's 1D + 3D form for scene light, 3D alone for coded colour
    Cube,
    /// look.clf: the Common LUT Format, plain or structured
    Clf,
    /// look.spi3d, with look_spi3d.ocio beside it for scene light
    Spi3d,
    /// look.ktx2: a 3D texture of 16-bit floats
    Ktx2,
    /// look_strip_unreal.png (green downwards) and look_strip_unity.png (upwards): 1024x32, or 256x16 with --size 16
    Strip,
    /// look_hald.png: a Hald CLUT, 16 bit
    Hald,
    /// look.direct.json: the numbers and equations of the direct form
    Json,
}

impl Format {
    /// The format that is written where none is named.
    pub(crate) fn usual(form: Form) -> Self {
        match form {
            Form::Plain => Self::Cube,
            Form::Structured => Self::Clf,
            Form::Direct => Self::Json,
        }
    }

    /// Whether its files can hold a form.
    pub(crate) fn holds(self, form: Form) -> bool {
        match self {
            Self::Clf => form != Form::Direct,
            Self::Json => form == Form::Direct,
            Self::Cube | Self::Spi3d | Self::Ktx2 | Self::Strip | Self::Hald => form == Form::Plain,
        }
    }

    /// The sentence for a form that a format does not hold.
    pub(crate) fn cannot_hold(self, form: Form) -> anyhow::Error {
        let other = if self == Self::Json { Form::Direct } else { Form::Plain };
        anyhow!(
            "--format {} cannot hold the {} form, expected {}, or --form {}",
            self.word(),
            form.word(),
            Self::usual(form).word(),
            other.word()
        )
    }

    /// Its name on the command line.
    pub(crate) fn word(self) -> String {
        self.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
    }
}

/// A map from scene-linear RGB of the look's input space to display-coded RGB.
pub(crate) type Applied<'a> = Box<dyn Fn([f32; 3]) -> [f32; 3] + Sync + 'a>;

/// What goes into the files.
pub(crate) struct Export<'a> {
    pub(crate) baked: &'a Baked,
    /// Name, input and output, certificate: lines for formats that hold comments.
    pub(crate) comments: Vec<String>,
}

impl Export<'_> {
    /// Adds the files of one format.
    pub(crate) fn add(&self, format: Format, files: &mut WholeSet) -> Result<()> {
        for (name, bytes) in self.files(format)? {
            files.add(name, bytes);
        }
        Ok(())
    }

    /// What the files of a format make of scene-linear RGB, their numbers read back: that is what a certificate is for.
    pub(crate) fn as_written(&self, format: Format) -> Result<Applied<'_>> {
        let files = self.files(format)?;
        let bytes = files.first().map_or(&[][..], |(_, bytes)| bytes);
        let table = match format {
            Format::Cube => {
                let cube = CubeFile::read(bytes)?;
                let apply = move |rgb| cube.apply(rgb, Interpolation::Tetrahedral);
                return Ok(Box::new(move |rgb| apply(self.baked.coordinates_for_file(rgb))));
            }
            Format::Clf => {
                let clf = ClfProcess::read(bytes)?;
                return Ok(Box::new(move |rgb| clf.apply(self.baked.coordinates_for_file(rgb))));
            }
            Format::Json => {
                let direct = direct_file::read(bytes)?;
                return Ok(Box::new(move |rgb| direct.apply(rgb)));
            }
            Format::Spi3d => read_spi3d(bytes)?,
            Format::Ktx2 => Storage::F16.stored(self.table(format)?)?,
            Format::Strip => read_strip(bytes, StripGreen::Down)?,
            Format::Hald => read_hald(bytes)?,
        };
        let baked = self.baked.with_table(table);
        Ok(Box::new(move |rgb| baked.apply(rgb)))
    }

    /// Names and contents of the files of one format.
    fn files(&self, format: Format) -> Result<Vec<(&'static str, Vec<u8>)>> {
        let mut bytes = Vec::new();
        let mut files = Vec::new();
        match format {
            Format::Cube => {
                let cube = match self.baked.form() {
                    BakedForm::Plain(lut) => CubeFile::from_plain(lut, CubeFile::SHAPER_POINTS)?,
                    _ => CubeFile::from_3d(Domain::UNIT, self.table(format)?.clone()),
                };
                cube.with_title(self.baked.name()).with_comments(&self.comments).write(&mut bytes)?;
                files.push(("look.cube", bytes));
            }
            Format::Clf => {
                let clf = match self.baked.form() {
                    BakedForm::Plain(lut) => ClfProcess::from_plain(lut)?,
                    BakedForm::Coded { table, .. } => ClfProcess::from_table(table, Interpolation::Tetrahedral),
                    BakedForm::Structured(lut) => ClfProcess::from_structured(lut)?,
                    BakedForm::Direct(_) => return Err(format.cannot_hold(Form::Direct)),
                };
                clf.with_name(self.baked.name()).with_descriptions(&self.comments).write(&mut bytes)?;
                files.push(("look.clf", bytes));
            }
            Format::Spi3d => {
                write_spi3d(&mut bytes, self.table(format)?)?;
                files.push(("look.spi3d", bytes));
                if let BakedForm::Plain(lut) = self.baked.form() {
                    let mut config = Vec::new();
                    let name = self.baked.name();
                    Spi3dConfig::new(lut, "look.spi3d")
                        .with_look(name)
                        .with_comments(&self.comments)
                        .write(&mut config)?;
                    files.push(("look_spi3d.ocio", config));
                }
            }
            Format::Ktx2 => {
                write_ktx2(&mut bytes, self.table(format)?, &self.comments)?;
                files.push(("look.ktx2", bytes));
            }
            Format::Strip => {
                for (name, green) in
                    [("look_strip_unreal.png", StripGreen::Down), ("look_strip_unity.png", StripGreen::Up)]
                {
                    let mut bytes = Vec::new();
                    write_strip(&mut bytes, self.coded(format)?, PngDepth::Sixteen, green, &self.comments)?;
                    files.push((name, bytes));
                }
            }
            Format::Hald => {
                write_hald(&mut bytes, self.coded(format)?, PngDepth::Sixteen, &self.comments)?;
                files.push(("look_hald.png", bytes));
            }
            Format::Json => match self.baked.form() {
                BakedForm::Direct(direct) => {
                    files.push(("look.direct.json", direct_file::write(direct, &self.comments)?));
                }
                other => return Err(format.cannot_hold(other.kind())),
            },
        }
        Ok(files)
    }

    /// The table of a plain form.
    fn table(&self, format: Format) -> Result<&Lut3d> {
        match (self.baked.form().kind(), self.baked.table()) {
            (Form::Plain, Some(table)) => Ok(table),
            (form, _) => Err(format.cannot_hold(form)),
        }
    }

    /// The table of a form that takes coded colour: pictures hold no shaper.
    fn coded(&self, format: Format) -> Result<&Lut3d> {
        match self.baked.form() {
            BakedForm::Coded { table, .. } => Ok(table),
            _ => bail!(
                "--format {} holds no shaper for scene-linear light, expected a coding such as --shaper srgb",
                format.word()
            ),
        }
    }
}
