//! What a file says of its colours, in the words of its format.

use crate::{
    description::{Chromaticities, Description},
    transfer::Transfer,
};

/// The space of a picture's values and their curve, as far as one part of a file tells.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct FileColours {
    pub(crate) primaries: Option<Chromaticities>,
    pub(crate) transfer: Option<Transfer>,
    /// The part of the file that says so, as a noun: "the `sRGB` chunk".
    pub(crate) said_by: String,
}

impl FileColours {
    /// What a description holds of it.
    pub(crate) fn describe(self, description: &mut Description) {
        description.primaries = self.primaries;
        description.transfer = self.transfer;
        description.colours_said_by = (!self.said_by.is_empty()).then_some(self.said_by);
    }
}

const D65: [f32; 2] = [0.3127, 0.3290];
/// The white of ACES (Academy TB-2014-004).
const ACES_WHITE: [f32; 2] = [0.32168, 0.33767];

impl Chromaticities {
    /// BT.709 and sRGB.
    pub const BT709: Self = Self { red: [0.64, 0.33], green: [0.30, 0.60], blue: [0.15, 0.06], white: D65 };
    /// Display P3 (SMPTE EG 432-1 with the white D65).
    pub const P3_D65: Self = Self { red: [0.680, 0.320], green: [0.265, 0.690], blue: [0.150, 0.060], white: D65 };
    /// P3 with the white of film projection (SMPTE RP 431-2).
    pub const P3_DCI: Self = Self { white: [0.314, 0.351], ..Self::P3_D65 };
    /// BT.2020 and BT.2100.
    pub const BT2020: Self = Self { red: [0.708, 0.292], green: [0.170, 0.797], blue: [0.131, 0.046], white: D65 };
    /// Adobe RGB (1998).
    pub const ADOBE_RGB: Self = Self { red: [0.64, 0.33], green: [0.21, 0.71], blue: [0.15, 0.06], white: D65 };
    /// `ACEScg` (Academy S-2014-004).
    pub const AP1: Self = Self { red: [0.713, 0.293], green: [0.165, 0.830], blue: [0.128, 0.044], white: ACES_WHITE };
    /// ACES2065-1 (SMPTE ST 2065-1).
    pub const AP0: Self = Self { red: [0.7347, 0.2653], green: [0.0, 1.0], blue: [0.0001, -0.077], white: ACES_WHITE };
    /// The CIE 1931 XYZ of light, of which (1, 1, 1) has equal energy.
    pub const XYZ: Self = Self { red: [1.0, 0.0], green: [0.0, 1.0], blue: [0.0, 0.0], white: [1.0 / 3.0, 1.0 / 3.0] };

    /// Whether all eight numbers are the same to half of the last of the three decimals that standards give.
    pub fn is_near(&self, other: &Self) -> bool {
        let numbers = |c: &Self| [c.red, c.green, c.blue, c.white];
        let near = |a: f32, b: f32| (a - b).abs() < 5e-4;
        let (own, other) = (numbers(self), numbers(other));
        own.as_flattened().iter().zip(other.as_flattened()).all(|(a, b)| near(*a, *b))
    }
}

/// What code points of ITU-T H.273 mean; `None` where one is unknown or says that it does not tell.
pub(crate) fn of_code_points(primaries: u8, transfer: u8) -> (Option<Chromaticities>, Option<Transfer>) {
    let primaries = match primaries {
        1 => Some(Chromaticities::BT709),
        9 => Some(Chromaticities::BT2020),
        10 => Some(Chromaticities::XYZ),
        11 => Some(Chromaticities::P3_DCI),
        12 => Some(Chromaticities::P3_D65),
        _ => None,
    };
    let transfer = match transfer {
        1 | 6 | 14 | 15 => Some(Transfer::Bt709),
        4 => Some(Transfer::Power(2.2)),
        5 => Some(Transfer::Power(2.8)),
        8 => Some(Transfer::Linear),
        13 => Some(Transfer::Srgb),
        16 => Some(Transfer::Pq),
        // ST 428-1: CIE XYZ by a power of 2.6, of which 48 cd/m2 are white.
        17 => Some(Transfer::Power(2.6)),
        18 => Some(Transfer::Hlg),
        _ => None,
    };
    (primaries, transfer)
}

/// What the names of the Color Interop Forum say, such as `lin_ap1_scene` or `srgb_p3d65_display`; `None` for others, among
/// them `data` and `unknown`.
pub(crate) fn of_interop_id(name: &str) -> Option<(Chromaticities, Transfer)> {
    // A prefix names who else defined it.
    let name = name.rsplit(':').next().unwrap_or(name);
    let mut words = name.split('_');
    let transfer = match words.next()? {
        "lin" => Transfer::Linear,
        "srgb" | "srgbe" | "srgbx" => Transfer::Srgb,
        "g18" => Transfer::Power(1.8),
        "g22" => Transfer::Power(2.2),
        "g24" => Transfer::Power(2.4),
        "g26" => Transfer::Power(2.6),
        "pq" => Transfer::Pq,
        "hlg" => Transfer::Hlg,
        _ => return None,
    };
    let primaries = match words.next()? {
        "rec709" => Chromaticities::BT709,
        "p3d65" => Chromaticities::P3_D65,
        "rec2020" => Chromaticities::BT2020,
        "adobergb" => Chromaticities::ADOBE_RGB,
        "ap1" => Chromaticities::AP1,
        "ap0" => Chromaticities::AP0,
        "ciexyzd65" => Chromaticities::XYZ,
        _ => return None,
    };
    Some((primaries, transfer))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_the_interop_forum_are_known() {
        assert_eq!(of_interop_id("lin_rec709_scene"), Some((Chromaticities::BT709, Transfer::Linear)));
        assert_eq!(of_interop_id("srgb_p3d65_display"), Some((Chromaticities::P3_D65, Transfer::Srgb)));
        assert_eq!(of_interop_id("ocio:lin_ap1_scene"), Some((Chromaticities::AP1, Transfer::Linear)));
        for other in ["data", "unknown", "", "lin", "lin_", "lin_mars_scene", "log_ap1"] {
            assert_eq!(of_interop_id(other), None, "{other}");
        }
    }

    #[test]
    fn code_points_that_say_nothing_say_nothing() {
        assert_eq!(of_code_points(9, 16), (Some(Chromaticities::BT2020), Some(Transfer::Pq)));
        assert_eq!(of_code_points(2, 2), (None, None));
        assert_eq!(of_code_points(12, 255), (Some(Chromaticities::P3_D65), None));
    }
}
