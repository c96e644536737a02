//! An OpenColorIO configuration around the files of baked looks.

use onelight_formats::{OcioConfig, OcioSpace, OcioView};
use onelight_lut::PowerCoding;
use onelight_spectra::{Chromaticity, RgbSpace, TransferCurve, chromatic_adaptation};

use super::form::{Baked, BakedForm};
use crate::error::{Error, ErrorKind};
use crate::process::ColourSpaces;
use crate::structured::coding;
use crate::word::{Word as _, WorkingSpace};

/// An OpenColorIO 2 configuration in which looks are views, the first of them the usual one: for each, the look and the name of
/// its `.clf` beside the configuration. Looks in other forms than the structured and the plain one are refused.
///
/// ```
/// use onelight::baked::{Form, Recipe, ocio_config};
/// let baked = onelight::Process::default().look()?.baked(&Recipe { size: 9, ..Recipe::of(Form::Structured) })?;
/// let config = ocio_config(&[(&baked, "look.scene-linear.clf")], &["a comment".to_owned()])?;
/// assert!(String::from_utf8_lossy(&config).contains("name: \"kodak-5207_kodak-2383\""));
/// # Ok::<(), onelight::Error>(())
/// ```
///
/// # Errors
/// If there is no look, one does not take scene-linear light, or two have not the same input and output spaces.
pub fn ocio_config(looks: &[(&Baked, &str)], comments: &[String]) -> Result<Vec<u8>, Error> {
    let contradiction = |text: String| Error::from(ErrorKind::Contradiction(text));
    let Some((first, _)) = looks.first() else {
        return Err(contradiction("an OpenColorIO configuration without a look, expected at least one".to_owned()));
    };
    let spaces = first.spaces();
    let mut config = config(spaces)?;
    for (baked, file) in looks {
        if !matches!(baked.form(), BakedForm::Plain(_) | BakedForm::Structured(_)) {
            let what = format!("{} for an OpenColorIO configuration", baked.describe());
            return Err(contradiction(format!("{what}, expected a table that takes scene-linear light")));
        }
        if baked.spaces() != spaces {
            let what = format!("{} beside {} in one OpenColorIO configuration", baked.name(), first.name());
            return Err(contradiction(format!("{what}, expected looks with the same input, output and coding")));
        }
        config = config.with_view(OcioView::of_clf(baked.name(), file));
    }
    let mut bytes = Vec::new();
    config.with_comments(comments).write(&mut bytes)?;
    Ok(bytes)
}

/// A configuration for the spaces of a look, without a view.
pub(super) fn config(spaces: &ColourSpaces) -> Result<OcioConfig, Error> {
    let ColourSpaces { input_space, output_space, output_coding, .. } = *spaces;
    let scene = OcioSpace {
        name: match input_space {
            WorkingSpace::Srgb => "Linear Rec.709",
            WorkingSpace::P3 => "Linear P3-D65",
            WorkingSpace::Rec2020 => "Linear Rec.2020",
            WorkingSpace::AcesCg => "ACEScg",
            WorkingSpace::Aces2065 => "Linear AP0",
            WorkingSpace::DciP3 => "Linear DCI-P3",
            WorkingSpace::AdobeRgb => "Linear Adobe RGB",
            WorkingSpace::ProPhoto => "Linear ProPhoto RGB",
            WorkingSpace::Xyz => "Linear XYZ-E",
        },
        to_xyz: to_xyz_d65(&input_space.space())?,
        coding: PowerCoding::LINEAR,
    };
    let display = OcioSpace {
        name: match (output_space.word(), output_coding) {
            ("srgb", TransferCurve::Srgb) => "sRGB",
            ("srgb", TransferCurve::Gamma24) => "Rec.1886 Rec.709",
            ("p3", TransferCurve::Srgb) => "Display P3",
            ("rec2020", TransferCurve::Gamma24) => "Rec.1886 Rec.2020",
            _ => "film display",
        },
        to_xyz: to_xyz_d65(&output_space.space())?,
        coding: coding(output_coding)?,
    };
    Ok(OcioConfig::new(scene, display))
}

/// Linear RGB to CIE XYZ, its white adapted to D65 by Bradford's cone responses \[Lam1985\].
fn to_xyz_d65(space: &RgbSpace) -> Result<[[f64; 3]; 3], Error> {
    let adapted = chromatic_adaptation(space.white, Chromaticity::D65)? * space.to_xyz()?;
    Ok(std::array::from_fn(|row| std::array::from_fn(|column| adapted[(row, column)])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_is_d65_and_aces_is_adapted_as_opencolorio_does() {
        for space in [RgbSpace::SRGB, RgbSpace::ACESCG, RgbSpace::REC2020] {
            let rows = to_xyz_d65(&space).unwrap();
            let white = Chromaticity::D65.xyz();
            for (row, white) in rows.iter().zip(white.iter()) {
                assert!((row.iter().sum::<f64>() - white).abs() < 1e-9, "{rows:?}");
            }
        }
        // Its UTILITY - ACES-AP1_to_CIE-XYZ-D65_BFD, OpenColorIO 2.6.
        let found = to_xyz_d65(&RgbSpace::ACESCG).unwrap();
        let theirs = AP1_TO_XYZ_D65;
        for (found, theirs) in found.iter().flatten().zip(theirs.iter().flatten()) {
            assert!((found - theirs).abs() < 2e-6, "{found} for {theirs}");
        }
    }

    const AP1_TO_XYZ_D65: [[f64; 3]; 3] =
        [[0.6522375, 0.1282361, 0.1699823], [0.2676722, 0.6743400, 0.0579878], [-0.0053818, 0.0013691, 1.0930705]];
}
