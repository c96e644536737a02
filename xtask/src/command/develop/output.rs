//! What kind of picture goes out.

use std::path::Path;

use anyhow::{Result, bail};
use clap::{Args, ValueEnum};
use onelight::{TransferCurve, Word as _};
use onelight_picture::{Dither, PngBits, TiffBits};

/// The picture that goes out.
#[derive(Debug, Args)]
#[command(next_help_heading = "Picture that goes out")]
pub(crate) struct OutputArguments {
    /// Bits of a PNG (8 or 16) or TIFF [default: 8 for PNG, 16 for TIFF]
    #[arg(long, value_name = "8|16|float")]
    bits: Option<Bits>,
    /// Quality of a JPEG [default: 95]
    #[arg(long, value_name = "1-100", value_parser = clap::value_parser!(u8).range(1..=100))]
    quality: Option<u8>,
    /// How values are rounded to 8 bits [default: pattern]
    #[arg(long)]
    dither: Option<DitherChoice>,
    /// What is kept of what the picture that comes in says of its camera, time and place [default: keep]
    #[arg(long)]
    pub(super) metadata: Option<KeptMetadata>,
}

/// What is kept of EXIF and of the attributes of an EXR.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(super) enum KeptMetadata {
    /// What stays true: EXIF in PNG, TIFF and JPEG, the attributes of an EXR in an EXR
    #[default]
    Keep,
    /// Nothing
    None,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Bits {
    #[value(name = "8")]
    Eight,
    #[value(name = "16")]
    Sixteen,
    Float,
}

/// How values are rounded to 8 bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum DitherChoice {
    /// By a fixed pattern that keeps means, so that slow ramps have no steps
    Pattern,
    /// To the nearest code
    None,
}

/// The kind of picture that is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Target {
    /// The display window, display-coded.
    Png(PngBits, Dither),
    /// The same; floats are display-linear and not clipped.
    Tiff(TiffBits, Dither),
    /// The same, of this quality.
    Jpeg(u8, Dither),
    /// The data window, display-linear, 32-bit floats.
    Exr,
}

impl Target {
    /// Whether it holds light, without a curve.
    pub(super) fn is_linear(self) -> bool {
        matches!(self, Self::Exr | Self::Tiff(TiffBits::Float, _))
    }

    /// Whether the display window is written, and not the data window.
    pub(super) fn is_shown(self) -> bool {
        self != Self::Exr
    }
}

impl OutputArguments {
    /// For a file of this name; `notes` gets the options that change nothing.
    pub(super) fn target(&self, path: &Path, notes: &mut Vec<String>) -> Result<Target> {
        let dither = match self.dither {
            Some(DitherChoice::None) => Dither::None,
            Some(DitherChoice::Pattern) | None => Dither::Pattern,
        };
        let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
        let target = match (extension.as_deref(), self.bits) {
            (Some("png"), Some(Bits::Float)) => {
                bail!("{}: a PNG has no floats, expected --bits 8 or 16, or .tif or .exr", path.display())
            }
            (Some("png"), Some(Bits::Sixteen)) => Target::Png(PngBits::Sixteen, Dither::None),
            (Some("png"), _) => Target::Png(PngBits::Eight, dither),
            (Some("tif" | "tiff"), Some(Bits::Eight)) => Target::Tiff(TiffBits::Eight, dither),
            (Some("tif" | "tiff"), Some(Bits::Float)) => Target::Tiff(TiffBits::Float, Dither::None),
            (Some("tif" | "tiff"), _) => Target::Tiff(TiffBits::Sixteen, Dither::None),
            (Some("jpg" | "jpeg"), _) => Target::Jpeg(self.quality.unwrap_or(95), dither),
            (Some("exr"), _) => Target::Exr,
            _ => bail!(
                "{}: the output's name ends in none of .png, .tif, .jpg and .exr, expected one of them",
                path.display()
            ),
        };
        let (kind, takes_bits) = match target {
            Target::Png(..) => ("a PNG", true),
            Target::Tiff(..) => ("a TIFF", true),
            Target::Jpeg(..) => ("a JPEG holds 8-bit codes", false),
            Target::Exr => ("an EXR holds 32-bit floats", false),
        };
        if self.bits.is_some() && !takes_bits {
            notes.push(format!("{kind}: --bits is not used"));
        }
        if self.quality.is_some() && !matches!(target, Target::Jpeg(..)) {
            notes.push("only a JPEG has a quality: --quality is not used".to_owned());
        }
        let rounds =
            matches!(target, Target::Png(PngBits::Eight, _) | Target::Tiff(TiffBits::Eight, _) | Target::Jpeg(..));
        if self.dither.is_some() && !rounds {
            notes.push("only 8 bits are dithered: --dither is not used".to_owned());
        }
        Ok(target)
    }
}

impl OutputArguments {
    /// The target for codes of absolute light: a PNG of 16 bits, which alone says what they are.
    pub(super) fn for_hdr(&self, target: Target, coding: TransferCurve, path: &Path) -> Result<Target> {
        let (name, word) = (path.display(), coding.word());
        match target {
            Target::Png(PngBits::Eight, _) if self.bits.is_some() => {
                bail!("{name}: {word} has visible steps in 8 bits, expected --bits 16")
            }
            Target::Png(..) => Ok(Target::Png(PngBits::Sixteen, Dither::None)),
            _ => bail!(
                "{name}: only a PNG of 16 bits says that it is coded by {word}, expected .png, or .exr for linear light"
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_options_say_what_is_written() {
        let target = |name: &str, bits, dither| {
            let mut notes = Vec::new();
            let arguments = OutputArguments { bits, quality: None, dither, metadata: None };
            arguments.target(Path::new(name), &mut notes).map(|target| (target, notes.len()))
        };
        let png = Target::Png(PngBits::Eight, Dither::Pattern);
        assert_eq!(target("a.png", None, None).unwrap(), (png, 0));
        let plain = Target::Png(PngBits::Eight, Dither::None);
        assert_eq!(target("a.PNG", Some(Bits::Eight), Some(DitherChoice::None)).unwrap(), (plain, 0));
        let tiff = |bits| Target::Tiff(bits, Dither::None);
        assert_eq!(target("a.tif", None, None).unwrap(), (tiff(TiffBits::Sixteen), 0));
        assert_eq!(target("a.tiff", Some(Bits::Float), Some(DitherChoice::None)).unwrap(), (tiff(TiffBits::Float), 1));
        assert_eq!(target("a.exr", Some(Bits::Sixteen), None).unwrap(), (Target::Exr, 1));
        assert_eq!(target("a.jpg", None, None).unwrap().0, Target::Jpeg(95, Dither::Pattern));
        assert!(target("a.png", Some(Bits::Float), None).is_err() && target("a.gif", None, None).is_err());
    }
}
