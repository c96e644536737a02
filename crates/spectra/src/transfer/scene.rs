use super::camera_curves as cameras;
use super::camera_log::CameraLog;
use super::display::TransferCurve;
use super::hdr;
use crate::rgb::RgbSpace;

/// How a scene-linear value becomes the coded value that cameras, grading programs and HDR files carry.
///
/// 0.18 is mid grey wherever the curve's maker says so. Every curve is monotone and [`SceneCurve::decode`] undoes
/// [`SceneCurve::encode`]. Codes are of full range: 10-bit codes are these times 1023.
///
/// Constants are the makers' own, held against OpenColorIO 2.6 and colour-science 0.4.7: DaVinci Intermediate, F-Log, F-Log2, N-Log and D-Log, which
/// OpenColorIO has not, against colour-science alone.
///
/// ```
/// use onelight_spectra::SceneCurve;
/// assert!((SceneCurve::LogC4.encode(0.18) - 0.2783958).abs() < 1e-7);
/// assert!((SceneCurve::LogC4.decode(1.0) - 469.8).abs() < 1e-9);
/// assert!((SceneCurve::Hlg.decode(0.75) - 1.0).abs() < 1e-9);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum SceneCurve {
    /// ACEScct (\[S2016-001\]). The toe goes on below 0; 65504 is coded 1.468, the published upper end, and nothing is
    /// cut there.
    AcesCct,
    /// ARRI LogC4 (\[ArriLogC4\]): codes 0..1 are -0.01806..469.8; the toe goes on below.
    LogC4,
    /// Sony S-Log3 (\[SonySLog3\]), full range, code value / 1023: 0 is coded 95, 0.18 is 420; the toe goes on below 0.
    SLog3,
    /// The same curve with the wider primaries S-Gamut3, the other pair of Sony's cameras (\[SonySLog3\]).
    SLog3SGamut3,
    /// DaVinci Intermediate (\[DaVinciIntermediate\]): codes 0..1 are 0..100; the toe goes on below 0.
    DaVinciIntermediate,
    /// ARRI LogC3 at exposure index 800 (\[ArriLogC3\]): 0.18 is coded 0.391; the toe goes on below 0.
    LogC3,
    /// Panasonic V-Log (\[PanasonicVLog\]): 0.18 is coded 0.423; the toe goes on below 0.
    VLog,
    /// Canon Log 2 (\[CanonLog\]): 0.18 is coded 0.398; odd about the code of 0.
    CLog2,
    /// Canon Log 3 (\[CanonLog\]): 0.18 is coded 0.343; odd about the code of 0.
    CLog3,
    /// Fujifilm F-Log (\[FujiFLog\]): 0.18 is coded 0.459; the toe goes on below 0.
    FLog,
    /// Fujifilm F-Log2 (\[FujiFLog2\]): 0.18 is coded 0.391; the toe goes on below 0.
    FLog2,
    /// Nikon N-Log (\[NikonNLog\]): 0.18 is coded 0.364; the cube root of its toe goes on below -0.0075, where it is 0.
    NLog,
    /// RED Log3G10 (\[RedLog3G10\]): 0.18 is coded 1/3, -0.01 is coded 0; the toe goes on below.
    Log3G10,
    /// Apple Log (\[AppleLog\]): 0.18 is coded 0.488. Light below -0.0564, code 0, has that code too, and codes below 0 are read as
    /// it.
    AppleLog,
    /// DJI D-Log (\[DjiDLog\]): 0.18 is coded 0.399; the toe goes on below 0.
    DLog,
    /// The camera's curve of Hybrid Log-Gamma (\[BT2100\]), scaled so that diffuse white, linear 1.0, is coded 0.75 and 0.18 is coded
    /// 0.378 (\[BT2408\]); odd. OpenColorIO's scales 0.18 to 0.424 instead.
    Hlg,
    /// The perceptual quantiser of \[ST2084\], with linear 1.0 = 203 cd/m^2, diffuse white of \[BT2408\]: codes 0..1 are 0..49.3. It
    /// has no codes beyond these: negative light is coded as 0 is (7.3e-7), light over 49.3 as 49.3, and codes outside 0..1 are
    /// read as 0 and 1.
    Pq,
    /// The curve of sRGB (\[IEC61966-2-1\]) for 0..1; odd, and going on above 1.
    Srgb,
    /// Video as a studio display shows it: a power of 2.4 (\[BT1886\] with a black of 0) for 0..1; odd, and going on above 1.
    Rec709Display,
}

impl SceneCurve {
    /// All curves: those of cameras and grading programs first.
    pub const ALL: [Self; 19] = [
        Self::AcesCct,
        Self::LogC4,
        Self::LogC3,
        Self::SLog3,
        Self::SLog3SGamut3,
        Self::DaVinciIntermediate,
        Self::VLog,
        Self::CLog2,
        Self::CLog3,
        Self::FLog,
        Self::FLog2,
        Self::NLog,
        Self::Log3G10,
        Self::AppleLog,
        Self::DLog,
        Self::Hlg,
        Self::Pq,
        Self::Srgb,
        Self::Rec709Display,
    ];

    /// Its name as its maker writes it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::AcesCct => "ACEScct",
            Self::LogC4 => "ARRI LogC4",
            Self::SLog3 | Self::SLog3SGamut3 => "S-Log3",
            Self::DaVinciIntermediate => "DaVinci Intermediate",
            Self::LogC3 => "ARRI LogC3 (EI 800)",
            Self::VLog => "V-Log",
            Self::CLog2 => "Canon Log 2",
            Self::CLog3 => "Canon Log 3",
            Self::FLog => "F-Log",
            Self::FLog2 => "F-Log2",
            Self::NLog => "N-Log",
            Self::Log3G10 => "Log3G10",
            Self::AppleLog => "Apple Log",
            Self::DLog => "D-Log",
            Self::Hlg => "HLG",
            Self::Pq => "PQ",
            Self::Srgb => "sRGB",
            Self::Rec709Display => "BT.1886 video",
        }
    }

    /// Linear light to coded value. Finite for input within ±1e300; NaN stays NaN. Infinities stay infinite but where a curve
    /// ends: both in PQ, the negative one in Apple Log.
    #[must_use]
    pub fn encode(self, linear: f64) -> f64 {
        match (self, self.camera_log()) {
            (_, Some(log)) => log.encode(linear),
            _ if linear.is_nan() => linear,
            (Self::CLog2, _) => cameras::c_log2_encode(linear),
            (Self::CLog3, _) => cameras::c_log3_encode(linear),
            (Self::NLog, _) => cameras::n_log_encode(linear),
            (Self::AppleLog, _) => cameras::apple_log_encode(linear),
            (Self::Hlg, _) => hdr::hlg_encode(linear),
            (Self::Pq, _) => hdr::pq_encode(linear),
            (Self::Rec709Display, _) => TransferCurve::Gamma24.encode(linear),
            _ => TransferCurve::Srgb.encode(linear),
        }
    }

    /// Coded value to linear light, the inverse of [`SceneCurve::encode`]. NaN stays NaN; codes far above 1 (58 in
    /// ACEScct) may overflow to infinity, in PQ never.
    #[must_use]
    pub fn decode(self, coded: f64) -> f64 {
        match (self, self.camera_log()) {
            (_, Some(log)) => log.decode(coded),
            _ if coded.is_nan() => coded,
            (Self::CLog2, _) => cameras::c_log2_decode(coded),
            (Self::CLog3, _) => cameras::c_log3_decode(coded),
            (Self::NLog, _) => cameras::n_log_decode(coded),
            (Self::AppleLog, _) => cameras::apple_log_decode(coded),
            (Self::Hlg, _) => hdr::hlg_decode(coded),
            (Self::Pq, _) => hdr::pq_decode(coded),
            (Self::Rec709Display, _) => TransferCurve::Gamma24.decode(coded),
            _ => TransferCurve::Srgb.decode(coded),
        }
    }

    /// The parameters of a curve that is a logarithm with a straight toe; `None` for others.
    #[must_use]
    pub const fn camera_log(self) -> Option<CameraLog> {
        match self {
            Self::AcesCct => Some(CameraLog::ACES_CCT),
            Self::LogC4 => Some(CameraLog::LOG_C4),
            Self::SLog3 | Self::SLog3SGamut3 => Some(CameraLog::S_LOG3),
            Self::DaVinciIntermediate => Some(CameraLog::DAVINCI_INTERMEDIATE),
            Self::LogC3 => Some(CameraLog::LOG_C3),
            Self::VLog => Some(CameraLog::V_LOG),
            Self::FLog => Some(CameraLog::F_LOG),
            Self::FLog2 => Some(CameraLog::F_LOG2),
            Self::Log3G10 => Some(CameraLog::LOG3G10),
            Self::DLog => Some(CameraLog::D_LOG),
            Self::CLog2
            | Self::CLog3
            | Self::NLog
            | Self::AppleLog
            | Self::Hlg
            | Self::Pq
            | Self::Srgb
            | Self::Rec709Display => None,
        }
    }

    /// The primaries that belong to the curve. F-Log, F-Log2, N-Log, Apple Log, HLG and PQ have BT.2020's.
    #[must_use]
    pub const fn space(self) -> RgbSpace {
        match self {
            Self::AcesCct => RgbSpace::ACESCG,
            Self::LogC4 => RgbSpace::ARRI_WIDE_GAMUT_4,
            Self::SLog3 => RgbSpace::S_GAMUT3_CINE,
            Self::SLog3SGamut3 => RgbSpace::S_GAMUT3,
            Self::DaVinciIntermediate => RgbSpace::DAVINCI_WIDE_GAMUT,
            Self::LogC3 => RgbSpace::ARRI_WIDE_GAMUT_3,
            Self::VLog => RgbSpace::V_GAMUT,
            Self::CLog2 | Self::CLog3 => RgbSpace::CINEMA_GAMUT,
            Self::Log3G10 => RgbSpace::RED_WIDE_GAMUT,
            Self::DLog => RgbSpace::D_GAMUT,
            Self::FLog | Self::FLog2 | Self::NLog | Self::AppleLog | Self::Hlg | Self::Pq => RgbSpace::REC2020,
            Self::Srgb | Self::Rec709Display => RgbSpace::SRGB,
        }
    }

    /// What people call the primaries of [`SceneCurve::space`], such as `ARRI Wide Gamut 4`.
    #[must_use]
    pub const fn space_name(self) -> &'static str {
        match self {
            Self::AcesCct => "AP1",
            Self::LogC4 => "ARRI Wide Gamut 4",
            Self::LogC3 => "ARRI Wide Gamut 3",
            Self::SLog3 => "S-Gamut3.Cine",
            Self::SLog3SGamut3 => "S-Gamut3",
            Self::DaVinciIntermediate => "DaVinci Wide Gamut",
            Self::VLog => "V-Gamut",
            Self::CLog2 | Self::CLog3 => "Cinema Gamut",
            Self::FLog | Self::FLog2 => "F-Gamut, BT.2020",
            Self::NLog => "N-Gamut, BT.2020",
            Self::Log3G10 => "REDWideGamutRGB",
            Self::DLog => "D-Gamut",
            Self::AppleLog | Self::Hlg | Self::Pq => "BT.2020",
            Self::Srgb => "sRGB",
            Self::Rec709Display => "BT.709",
        }
    }

    /// The curve with the primaries that belong to it.
    #[must_use]
    pub const fn coded_space(self) -> CodedSpace {
        CodedSpace { curve: self, space: self.space() }
    }
}

/// What the numbers of a coded picture mean: primaries, white and the curve on each channel.
///
/// ```
/// use onelight_spectra::{RgbSpace, SceneCurve};
/// let camera = SceneCurve::SLog3SGamut3.coded_space();
/// assert_eq!(camera.space, RgbSpace::S_GAMUT3);
/// let coded = camera.encode([0.18, 0.0, 0.9]).map(|v| (v * 1023.0).round());
/// assert_eq!(coded, [420.0, 95.0, 598.0]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CodedSpace {
    /// The curve on each channel.
    pub curve: SceneCurve,
    /// The primaries and white of the linear values.
    pub space: RgbSpace,
}

impl CodedSpace {
    /// Linear RGB of [`CodedSpace::space`] to coded values.
    #[must_use]
    pub fn encode(&self, linear: [f64; 3]) -> [f64; 3] {
        linear.map(|v| self.curve.encode(v))
    }

    /// Coded values to linear RGB of [`CodedSpace::space`].
    #[must_use]
    pub fn decode(&self, coded: [f64; 3]) -> [f64; 3] {
        coded.map(|v| self.curve.decode(v))
    }
}

#[cfg(test)]
mod tests;
