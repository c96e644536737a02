//! The words of `look.toml` and of the command line: one list for both.

use onelight_film::{DyeModel, Matching, PrintCurves, Tail, WideGamut};
use onelight_lut::Storage;
use onelight_printing::{Aim, HeatGlass, Infrared, PrinterLight, Projector, White, Wratten};
use onelight_spectra::{Reconstruction, RgbSpace, TransferCurve};

use crate::error::{Error, ErrorKind};
use crate::message::{cut, nearest};

/// A choice that has a word for each of its values.
///
/// ```
/// use onelight::{Aim, Word};
/// assert_eq!(Aim::parse("sheet")?.word(), "sheet");
/// assert!(Aim::parse("seet").unwrap_err().to_string().contains("sheet"));
/// # Ok::<(), onelight::Error>(())
/// ```
pub trait Word: Copy + PartialEq + 'static {
    /// What is chosen: the key in `look.toml`.
    const KEY: &'static str;
    /// Every value with its word and what it does.
    const ALL: &'static [(Self, &'static str, &'static str)];

    /// The word for this value.
    fn word(self) -> &'static str {
        Self::ALL.iter().find(|(value, _, _)| *value == self).map_or("", |(_, word, _)| word)
    }

    /// The value for a word.
    ///
    /// # Errors
    /// If there is no such word; the message lists all, and the nearest if one is near.
    fn parse(word: &str) -> Result<Self, Error> {
        if let Some((value, _, _)) = Self::ALL.iter().find(|(_, candidate, _)| *candidate == word) {
            return Ok(*value);
        }
        let words: Vec<&str> = Self::ALL.iter().map(|(_, word, _)| *word).collect();
        let meant = nearest(word, words.iter().copied()).map(|meant| format!(" (did you mean {meant:?}?)"));
        let expected = format!("one of {}{}", words.join(", "), meant.unwrap_or_default());
        Err(ErrorKind::Word { what: Self::KEY, found: cut(word), expected }.into())
    }
}

/// Gives choices their words, each with a line of help.
macro_rules! words {
    ($($type:ty, $key:literal: $($value:path = $word:literal $help:literal),+;)*) => {
        $(impl $crate::word::Word for $type {
            const KEY: &'static str = $key;
            const ALL: &'static [(Self, &'static str, &'static str)] = &[$(($value, $word, $help)),+];
        })*
    };
}
pub(crate) use words;

/// The RGB spaces that pictures come and go in: primaries only, (1, 1, 1) is always white.
///
/// ```
/// use onelight::{Word, WorkingSpace};
/// let wide = WorkingSpace::parse("rec2020")?;
/// assert!(wide.space().primaries[0].x > WorkingSpace::Srgb.space().primaries[0].x);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum WorkingSpace {
    /// sRGB's, which are those of BT.709 (\[IEC61966-2-1\]).
    #[default]
    Srgb,
    /// Display P3's: those of film projection with a display's white.
    P3,
    /// BT.2020's, for ultra high definition television.
    Rec2020,
    /// ACEScg's (AP1), wide enough for rendering.
    AcesCg,
    /// ACES2065-1's (AP0), for exchange and archives.
    Aces2065,
    /// P3's with the white of film projection, which counts where white is taken absolutely.
    DciP3,
    /// Adobe RGB's (1998).
    AdobeRgb,
    /// ProPhoto's, which are those of ROMM RGB.
    ProPhoto,
    /// CIE XYZ.
    Xyz,
}

impl WorkingSpace {
    /// Its primaries, with the white of its standard.
    #[must_use]
    pub fn space(self) -> RgbSpace {
        match self {
            Self::Srgb => RgbSpace::SRGB,
            Self::P3 => RgbSpace::DISPLAY_P3,
            Self::Rec2020 => RgbSpace::REC2020,
            Self::AcesCg => RgbSpace::ACESCG,
            Self::Aces2065 => RgbSpace::ACES2065_1,
            Self::DciP3 => RgbSpace::DCI_P3,
            Self::AdobeRgb => RgbSpace::ADOBE_RGB,
            Self::ProPhoto => RgbSpace::PROPHOTO,
            Self::Xyz => RgbSpace::XYZ,
        }
    }
}

words! {
    Aim, "aim":
        Aim::Neutral = "neutral" "18 % grey becomes exactly neutral, display-linear 10^-0.7",
        Aim::Sheet = "sheet" "the aim densities of the print's sheet; a reversal film's own exposure";
    DyeModel, "dyes":
        DyeModel::Wedge = "wedge" "amounts that give the sheet's densities together",
        DyeModel::Literal = "literal" "each density is its own dye's amount, as the talk reads",
        DyeModel::Constants = "constants" "the talk's formula with a matching constant for each dye of a negative";
    Matching, "matching":
        Matching::Grey = "grey" "18 % grey under 6500 K lands on the mid grey of the curves",
        Matching::Absolute = "absolute" "the sheet's own units decide, casts included";
    WideGamut, "gamut":
        WideGamut::Compress = "compress" "light outside the sRGB primaries lowers exposures, smoothly and never to 0",
        WideGamut::Clip = "clip" "its negative channels count as 0, as the talk has it";
    White, "white":
        White::Film = "film" "clear film is the display's white: a viewer adapts to it",
        White::Lamp = "lamp" "the projector's bare lamp is, as the talk has it";
    PrintCurves, "print_curves":
        PrintCurves::Neutral = "neutral" "the sheet's three curves are one neutral scale",
        PrintCurves::Principal = "principal" "each curve holds the dye of its own layer alone";
    Reconstruction, "reconstruction":
        Reconstruction::Smooth = "smooth" "smoothest reflectances >= 0, exact",
        Reconstruction::PseudoInverse = "pseudo-inverse" "smoothest with negative lobes, exact",
        Reconstruction::BoxesBalanced = "boxes-balanced" "three boxes, exact",
        Reconstruction::BoxesRaw = "boxes-raw" "three boxes, colours not balanced";
    PrinterLight, "light":
        PrinterLight::Separations = "separations" "three beams behind Wratten 70, 99 and 98",
        PrinterLight::White = "white" "one white beam, balanced for each layer by itself",
        PrinterLight::ColourHead = "colour-head" "an enlarger's cyan, magenta and yellow dichroic filters";
    Wratten, "filters":
        Wratten::No70 = "70" "red separation",
        Wratten::No99 = "99" "green separation",
        Wratten::No98 = "98" "blue separation",
        Wratten::No2B = "2b" "absorbs ultraviolet";
    Infrared, "infrared":
        Infrared::On = "on" "the printer's light counts to 1000 nm",
        Infrared::Off = "off" "cut at 780 nm";
    HeatGlass, "glass":
        HeatGlass::No2043 = "no-2043" "the stand-in for Kodak No. 2043",
        HeatGlass::Weak = "weak" "a weaker glass",
        HeatGlass::None = "none" "no heat glass";
    Tail, "red_tail":
        Tail::LogLinear = "log-linear" "the print's red sensitivity falls on beyond its sheet",
        Tail::Held = "held" "it stays as it is at the end of the sheet";
    Projector, "projector":
        Projector::Display = "display" "6500 K; D50 for paper and instant film",
        Projector::Theatre = "theatre" "5500 K, the eye adapted to it",
        Projector::TheatreUnadapted = "theatre-unadapted" "5500 K beside a 6500 K display",
        Projector::Xenon = "xenon" "a cinema's xenon lamp, the eye adapted to it",
        Projector::ViewingBooth = "booth" "D50, the eye adapted to it: what display means for paper";
    Storage, "storage":
        Storage::F32 = "f32" "32-bit float",
        Storage::F16 = "f16" "16-bit float",
        Storage::Unorm16 = "unorm16" "16-bit integers over the range of the entries",
        Storage::Unorm10 = "unorm10" "10-bit integers",
        Storage::Unorm8 = "unorm8" "8-bit integers";
    WorkingSpace, "space":
        WorkingSpace::Srgb = "srgb" "sRGB primaries",
        WorkingSpace::P3 = "p3" "Display P3 primaries",
        WorkingSpace::Rec2020 = "rec2020" "BT.2020 primaries",
        WorkingSpace::AcesCg = "acescg" "ACEScg primaries",
        WorkingSpace::Aces2065 = "aces2065-1" "ACES2065-1 primaries (AP0)",
        WorkingSpace::DciP3 = "dci-p3" "P3 primaries, white of film projection",
        WorkingSpace::AdobeRgb = "adobe-rgb" "Adobe RGB (1998) primaries",
        WorkingSpace::ProPhoto = "prophoto" "ProPhoto (ROMM RGB) primaries",
        WorkingSpace::Xyz = "xyz" "CIE XYZ as primaries: (1, 1, 1) is white";
    TransferCurve, "output_coding":
        TransferCurve::Srgb = "srgb" "the sRGB curve",
        TransferCurve::Gamma24 = "gamma24" "a power of 2.4",
        TransferCurve::Gamma26 = "gamma26" "a power of 2.6: digital cinema",
        TransferCurve::Pq = "pq" "PQ, white at --white-luminance, in rec2020 or p3",
        TransferCurve::Hlg = "hlg" "HLG for a display of 1000 cd/m2, white at --white-luminance, in rec2020 or p3",
        TransferCurve::Linear = "linear" "light itself";
}

/// Choices as their words in text, by `#[serde(with = "word::text")]`.
pub(crate) mod text {
    use serde::{Deserialize, Deserializer, Serializer, de};

    use crate::word::Word;

    pub(crate) fn serialize<T: Word, S: Serializer>(value: &T, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(value.word())
    }

    pub(crate) fn deserialize<'de, T: Word, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
        T::parse(&String::deserialize(deserializer)?).map_err(de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Approach, Entries, InputCoding, TableCoding, baked};

    fn complete<T: Word + std::fmt::Debug>() {
        for (value, word, help) in T::ALL {
            assert_eq!(T::parse(word).unwrap(), *value);
            assert_eq!(value.word(), *word);
            assert!(!help.is_empty());
        }
        let far = T::parse("").unwrap_err().to_string();
        assert!(far.contains("one of") && !far.contains("did you mean"), "{far}");
    }

    #[test]
    fn words_go_there_and_back() {
        complete::<Approach>();
        complete::<PrinterLight>();
        complete::<Wratten>();
        complete::<Aim>();
        complete::<DyeModel>();
        complete::<Matching>();
        complete::<Reconstruction>();
        complete::<Infrared>();
        complete::<HeatGlass>();
        complete::<Tail>();
        complete::<Projector>();
        complete::<WideGamut>();
        complete::<White>();
        complete::<PrintCurves>();
        complete::<Entries>();
        complete::<TableCoding>();
        complete::<Storage>();
        complete::<WorkingSpace>();
        complete::<TransferCurve>();
        complete::<InputCoding>();
        complete::<baked::Form>();
        complete::<baked::ShaperChoice>();
    }
}
