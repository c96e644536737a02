//! What the numbers of a picture that comes in are coded by.

use onelight_spectra::{RgbSpace, SceneCurve, TransferCurve};

use crate::cineon;
use crate::word::Word;

/// How the numbers of a picture become scene-linear light: by the curve of a display or by a camera's, which has primaries of its own.
///
/// ```
/// use onelight::{InputCoding, Word};
/// let log = InputCoding::parse("logc3")?;
/// assert!((log.decode(0.391007) - 0.18).abs() < 1e-5);
/// assert!(log.space().is_some() && InputCoding::parse("srgb")?.space().is_none());
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum InputCoding {
    /// A curve of finished pictures, in whatever primaries.
    Display(TransferCurve),
    /// A curve with primaries of its own: those of cameras and grading programs, PQ, HLG and video.
    Scene(SceneCurve),
    /// Codes of a scanned negative, for a print without a camera film ([`PrintAlone`](crate::PrintAlone)).
    Cineon,
}

impl Word for InputCoding {
    const KEY: &'static str = "input_coding";
    const ALL: &'static [(Self, &'static str, &'static str)] = &[
        (Self::Display(TransferCurve::Srgb), "srgb", "the sRGB curve"),
        (Self::Display(TransferCurve::Gamma24), "gamma24", "a power of 2.4"),
        (Self::Display(TransferCurve::Linear), "linear", "light itself"),
        (Self::Scene(SceneCurve::AcesCct), "acescct", "ACEScct (AP1 primaries)"),
        (Self::Scene(SceneCurve::LogC4), "logc4", "ARRI LogC4 (ARRI Wide Gamut 4)"),
        (Self::Scene(SceneCurve::LogC3), "logc3", "ARRI LogC3, EI 800 (ARRI Wide Gamut 3)"),
        (Self::Scene(SceneCurve::SLog3), "slog3", "Sony S-Log3 (S-Gamut3.Cine)"),
        (Self::Scene(SceneCurve::SLog3SGamut3), "slog3-sgamut3", "Sony S-Log3 (S-Gamut3)"),
        (Self::Scene(SceneCurve::DaVinciIntermediate), "intermediate", "DaVinci Intermediate (DaVinci Wide Gamut)"),
        (Self::Scene(SceneCurve::VLog), "vlog", "Panasonic V-Log (V-Gamut)"),
        (Self::Scene(SceneCurve::CLog2), "clog2", "Canon Log 2 (Cinema Gamut)"),
        (Self::Scene(SceneCurve::CLog3), "clog3", "Canon Log 3 (Cinema Gamut)"),
        (Self::Scene(SceneCurve::FLog), "flog", "Fujifilm F-Log (F-Gamut)"),
        (Self::Scene(SceneCurve::FLog2), "flog2", "Fujifilm F-Log2 (F-Gamut)"),
        (Self::Scene(SceneCurve::NLog), "nlog", "Nikon N-Log (N-Gamut)"),
        (Self::Scene(SceneCurve::Log3G10), "log3g10", "RED Log3G10 (REDWideGamutRGB)"),
        (Self::Scene(SceneCurve::AppleLog), "apple-log", "Apple Log (BT.2020)"),
        (Self::Scene(SceneCurve::DLog), "dlog", "DJI D-Log (D-Gamut)"),
        (Self::Scene(SceneCurve::Hlg), "hlg", "HLG (BT.2020), scene 1.0 at 75 %"),
        (Self::Scene(SceneCurve::Pq), "pq", "PQ (BT.2020), scene 1.0 at 203 cd/m^2"),
        (Self::Scene(SceneCurve::Rec709Display), "rec709-display", "video as a display of gamma 2.4 shows it (BT.709)"),
        (Self::Cineon, "cineon", "Cineon codes of a scanned negative, 0 to 1023: with --camera none"),
    ];
}

impl InputCoding {
    /// From a code, 1 at the top of full range, to light; NaN stays NaN.
    #[must_use]
    pub fn decode(self, coded: f64) -> f64 {
        match self {
            Self::Display(curve) => curve.decode(coded),
            Self::Scene(curve) => curve.decode(coded),
            Self::Cineon => cineon::light(coded),
        }
    }

    /// The primaries that belong to the coding; `None` where it comes with any.
    #[must_use]
    pub fn space(self) -> Option<RgbSpace> {
        match self {
            Self::Display(_) | Self::Cineon => None,
            Self::Scene(curve) => Some(curve.space()),
        }
    }

    /// Its name for people, such as `ARRI LogC4 in ARRI Wide Gamut 4`.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Display(_) => self.word().to_owned(),
            Self::Cineon => "Cineon codes".to_owned(),
            Self::Scene(curve) => format!("{} in {}", curve.name(), curve.space_name()),
        }
    }
}
