//! The programs that a look is baked for, and the files that each loads best.

use onelight_spectra::TransferCurve;

use super::files::FileFormat;
use super::recipe::{Form, Recipe, ShaperChoice};
use crate::word::words;

/// A program, or a kind of program, that loads baked looks.
///
/// ```
/// use onelight::baked::{FileFormat, ShaperChoice, Target};
/// let tables = Target::Ffmpeg.tables();
/// assert_eq!((tables[0].format, tables[0].recipe.shaper), (FileFormat::Cube, ShaperChoice::Srgb));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Target {
    /// DaVinci Resolve.
    Resolve,
    /// Whatever reads an OpenColorIO 2 configuration.
    Ocio,
    /// Blender, by an OpenColorIO configuration.
    Blender,
    /// Nuke, by an OpenColorIO configuration.
    Nuke,
    /// ffmpeg's `lut3d`, and what is built on it.
    Ffmpeg,
    /// darktable's module lut 3D.
    Darktable,
    /// `RawTherapee`'s film simulation.
    Rawtherapee,
    /// Bevy's tone-mapping table.
    Bevy,
    /// Unreal's colour grading table.
    Unreal,
    /// Unity's lookup texture.
    Unity,
    /// Godot's colour correction.
    Godot,
    /// three.js.
    Three,
    /// Cameras and monitors that take a `.cube` for log pictures.
    Camera,
}

words! {
    Target, "for":
        Target::Resolve = "resolve" "DaVinci Resolve: .cube for an Intermediate timeline and for a scene-linear one",
        Target::Ocio = "ocio" "OpenColorIO 2: a structured CLF and a configuration with it as a view",
        Target::Blender = "blender" "Blender: the same",
        Target::Nuke = "nuke" "Nuke: the same",
        Target::Ffmpeg = "ffmpeg" "ffmpeg: a .cube for display-coded pictures",
        Target::Darktable = "darktable" "darktable: a .cube for its module lut 3D",
        Target::Rawtherapee = "rawtherapee" "RawTherapee: a Hald CLUT for its film simulation",
        Target::Bevy = "bevy" "Bevy: a KTX2 texture in place of its Blender Filmic",
        Target::Unreal = "unreal" "Unreal: a strip of 16 tiles",
        Target::Unity = "unity" "Unity: a strip of 32 tiles",
        Target::Godot = "godot" "Godot: a strip of 64 tiles",
        Target::Three = "three" "three.js: a .cube for LUTCubeLoader",
        Target::Camera = "camera" "Cameras and monitors: a 33^3 .cube for LogC4, or for the log that --shaper names";
}

/// A table that a target loads.
///
/// ```
/// use onelight::baked::{FileFormat, Target};
/// let tables = Target::Ffmpeg.tables();
/// assert_eq!(tables[0].format, FileFormat::Cube);
/// println!("{}", tables[0].load);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct TargetTable {
    /// How it is baked.
    pub recipe: Recipe,
    /// The file it lies in.
    pub format: FileFormat,
    /// How the program loads it, in a line.
    pub load: &'static str,
}

impl Target {
    /// The tables that it loads, the usual one first.
    #[must_use]
    pub fn tables(self) -> Vec<TargetTable> {
        let srgb = Recipe::taking(ShaperChoice::Srgb);
        let strip = |format: FileFormat| Recipe { size: format.usual_size().unwrap_or(srgb.size), ..srgb };
        let table = |recipe, format, load| TargetTable { recipe, format, load };
        match self {
            Self::Resolve => vec![
                table(
                    Recipe::taking(ShaperChoice::Intermediate),
                    FileFormat::Cube,
                    "a LUT on the last node of a timeline in DaVinci Wide Gamut / Intermediate, colour management off after it",
                ),
                table(Recipe::cube(33), FileFormat::Cube, "a LUT on a node of a scene-linear timeline"),
            ],
            Self::Ocio => vec![table(
                Recipe::of(Form::Structured),
                FileFormat::Clf,
                "oiiotool --colorconfig look.ocio IN --ociodisplay sRGB VIEW -o OUT; or a FileTransform from scene-linear light",
            )],
            Self::Blender => vec![table(
                Recipe::of(Form::Structured),
                FileFormat::Clf,
                "OCIO=look.ocio blender, then Render / Color Management / View",
            )],
            Self::Nuke => vec![table(
                Recipe::of(Form::Structured),
                FileFormat::Clf,
                "Project Settings / Color / OpenColorIO Config: look.ocio, then the viewer's list; or an OCIOFileTransform",
            )],
            Self::Ffmpeg => {
                vec![table(
                    srgb,
                    FileFormat::Cube,
                    "ffmpeg -i IN -vf format=gbrp16le,lut3d=FILE:interp=tetrahedral OUT",
                )]
            }
            Self::Darktable => {
                vec![table(srgb, FileFormat::Cube, "module lut 3D, application colour space sRGB, tetrahedral")]
            }
            Self::Rawtherapee => vec![table(
                strip(FileFormat::Hald),
                FileFormat::Hald,
                "put it into the folder of Preferences / Image Processing / HaldCLUT, then Color / Film Simulation",
            )],
            Self::Bevy => vec![table(
                Recipe::taking(ShaperChoice::Bevy),
                FileFormat::Ktx2,
                "TonemappingLuts::blender_filmic, with Tonemapping::BlenderFilmic",
            )],
            Self::Unreal => vec![table(
                strip(FileFormat::Unreal),
                FileFormat::Unreal,
                "texture group ColorLookupTable, no mip maps; Post Process Volume / Color Grading LUT",
            )],
            Self::Unity => vec![table(
                strip(FileFormat::Unity),
                FileFormat::Unity,
                "sRGB off, no mip maps, no compression; Color Lookup / Lookup Texture",
            )],
            Self::Godot => vec![table(
                strip(FileFormat::Godot),
                FileFormat::Godot,
                "import as Texture3D, 64 horizontal slices; Environment / Adjustments / Color Correction",
            )],
            Self::Three => {
                vec![table(srgb, FileFormat::Cube, "LUTCubeLoader, then LUTPass after OutputPass")]
            }
            Self::Camera => vec![table(
                Recipe { size: 33, ..Recipe::taking(ShaperChoice::Logc4) },
                FileFormat::Cube,
                "load it as a user LUT or look over a log picture of full range",
            )],
        }
    }

    /// Whether it loads an OpenColorIO configuration ([`ocio_config`](super::ocio_config)) around its tables.
    #[must_use]
    pub fn takes_ocio_config(self) -> bool {
        matches!(self, Self::Ocio | Self::Blender | Self::Nuke)
    }

    /// The display coding that its pictures usually have, where that is not sRGB's.
    #[must_use]
    pub fn usual_coding(self) -> Option<TransferCurve> {
        match self {
            Self::Resolve | Self::Camera => Some(TransferCurve::Gamma24),
            Self::Bevy => Some(TransferCurve::Linear),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::word::Word as _;

    #[test]
    fn two_tables_of_one_file_are_one_table() {
        let mut tables = Vec::new();
        for (target, ..) in Target::ALL {
            for table in target.tables() {
                assert!(table.format.holds(table.recipe.form), "{target:?}");
                assert!(!table.format.needs_coding() || table.recipe.shaper.is_coding(), "{target:?}");
                tables.push((table.format, table.recipe, target.usual_coding()));
            }
        }
        for (format, recipe, coding) in &tables {
            for other in tables.iter().filter(|(f, r, _)| f == format && r.shaper == recipe.shaper) {
                assert_eq!((&other.1, &other.2), (recipe, coding), "{format:?}");
            }
        }
    }
}
