//! The colours of picture files as looks have them.

use onelight_picture::{Chromaticities, ColourTag, OutputTransfer};
use onelight_spectra::{Chromaticity, RgbSpace, TransferCurve};

use crate::process::ColourSpaces;

/// The space of chromaticities as a file gives them; that of a standard where they are its own, rounded.
///
/// ```
/// use onelight::picture::Chromaticities;
/// use onelight::{space_of, spectra::RgbSpace};
/// assert_eq!(space_of(&Chromaticities::BT2020), RgbSpace::REC2020);
/// ```
#[must_use]
pub fn space_of(c: &Chromaticities) -> RgbSpace {
    let standards = [
        (Chromaticities::BT709, RgbSpace::SRGB),
        (Chromaticities::P3_D65, RgbSpace::DISPLAY_P3),
        (Chromaticities::BT2020, RgbSpace::REC2020),
        (Chromaticities::AP1, RgbSpace::ACESCG),
        (Chromaticities::AP0, RgbSpace::ACES2065_1),
        (Chromaticities::P3_DCI, RgbSpace::DCI_P3),
        (Chromaticities::ADOBE_RGB, RgbSpace::ADOBE_RGB),
        (Chromaticities::XYZ, RgbSpace::XYZ),
    ];
    if let Some((_, space)) = standards.iter().find(|(standard, _)| standard.is_near(c)) {
        return *space;
    }
    let xy = |[x, y]: [f32; 2]| (f64::from(x), f64::from(y));
    let white = Chromaticity::new(f64::from(c.white[0]), f64::from(c.white[1]));
    RgbSpace::new([xy(c.red), xy(c.green), xy(c.blue)], white)
}

/// What a file with a look's output says of its colours.
///
/// ```
/// use onelight::{ColourSpaces, colour_tag, picture::{Chromaticities, OutputTransfer}};
/// let tag = colour_tag(&ColourSpaces::default());
/// assert!(tag.primaries.is_near(&Chromaticities::BT709) && tag.transfer == OutputTransfer::Srgb);
/// ```
#[must_use]
pub fn colour_tag(spaces: &ColourSpaces) -> ColourTag {
    let space = spaces.output_space.space();
    let xy = |c: Chromaticity| [c.x as f32, c.y as f32];
    let [red, green, blue] = space.primaries.map(xy);
    let transfer = match spaces.output_coding {
        TransferCurve::Srgb => OutputTransfer::Srgb,
        TransferCurve::Gamma24 => OutputTransfer::Gamma24,
        TransferCurve::Gamma26 => OutputTransfer::Gamma26,
        TransferCurve::Pq => OutputTransfer::Pq,
        TransferCurve::Hlg => OutputTransfer::Hlg,
        TransferCurve::Linear => OutputTransfer::Linear,
    };
    ColourTag { transfer, primaries: Chromaticities { red, green, blue, white: xy(space.white) } }
}
