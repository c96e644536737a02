use super::camera_log::CameraLog;
use super::display::TransferCurve;
use crate::rgb::RgbSpace;

/// How a scene-linear value becomes the coded value that cameras, grading programs and HDR files carry.
///
/// Unlike a [`TransferCurve`] none of these is a coding of the finished picture. 0.18 is mid grey wherever the curve's
/// maker says so. Every curve is monotone and [`SceneCurve::decode`] undoes [`SceneCurve::encode`].
///
/// ```
/// use onelight_spectra::SceneCurve;
/// assert!((SceneCurve::LogC4.encode(0.18) - 0.2783958).abs() < 1e-7);
/// assert!((SceneCurve::LogC4.decode(1.0) - 469.8).abs() < 1e-9);
/// assert!((SceneCurve::Pq.decode(1.0) - 100.0).abs() < 1e-9);
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
    /// DaVinci Intermediate (\[DaVinciIntermediate\]): codes 0..1 are 0..100; the toe goes on below 0.
    DaVinciIntermediate,
    /// The perceptual quantiser of \[ST2084\], with linear 1.0 = 100 cd/m^2, so that codes 0..1 are 0..100. It has no
    /// codes beyond these: negative light is coded as 0 is (7.3e-7), light over 100 as 100, and codes outside 0..1
    /// are read as 0 and 1.
    Pq,
    /// The curve of sRGB (\[IEC61966-2-1\]) for 0..1; odd, and going on above 1.
    Srgb,
}

impl SceneCurve {
    /// The six curves: those of cameras and grading programs first.
    pub const ALL: [Self; 6] =
        [Self::AcesCct, Self::LogC4, Self::SLog3, Self::DaVinciIntermediate, Self::Pq, Self::Srgb];

    /// Its name as its maker writes it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::AcesCct => "ACEScct",
            Self::LogC4 => "ARRI LogC4",
            Self::SLog3 => "S-Log3",
            Self::DaVinciIntermediate => "DaVinci Intermediate",
            Self::Pq => "PQ",
            Self::Srgb => "sRGB",
        }
    }

    /// Linear light to coded value. Finite for input within ±1e300; NaN stays NaN. Infinities stay infinite but in PQ, where
    /// they are coded as its ends.
    #[must_use]
    pub fn encode(self, linear: f64) -> f64 {
        match (self, self.camera_log()) {
            (_, Some(log)) => log.encode(linear),
            (Self::Pq, _) => pq_encode(linear),
            _ => TransferCurve::Srgb.encode(linear),
        }
    }

    /// Coded value to linear light, the inverse of [`SceneCurve::encode`]. NaN stays NaN; codes far above 1 (58 in
    /// ACEScct) may overflow to infinity, in PQ never.
    #[must_use]
    pub fn decode(self, coded: f64) -> f64 {
        match (self, self.camera_log()) {
            (_, Some(log)) => log.decode(coded),
            (Self::Pq, _) => pq_decode(coded),
            _ => TransferCurve::Srgb.decode(coded),
        }
    }

    /// The parameters of a curve that is a logarithm with a straight toe; `None` for PQ and sRGB.
    #[must_use]
    pub const fn camera_log(self) -> Option<CameraLog> {
        match self {
            Self::AcesCct => Some(CameraLog::ACES_CCT),
            Self::LogC4 => Some(CameraLog::LOG_C4),
            Self::SLog3 => Some(CameraLog::S_LOG3),
            Self::DaVinciIntermediate => Some(CameraLog::DAVINCI_INTERMEDIATE),
            Self::Pq | Self::Srgb => None,
        }
    }

    /// The primaries that belong to the curve: AP1, ARRI Wide Gamut 4, S-Gamut3.Cine (S-Log3 also comes with
    /// [`RgbSpace::S_GAMUT3`]), DaVinci Wide Gamut, BT.2020, sRGB.
    #[must_use]
    pub const fn space(self) -> RgbSpace {
        match self {
            Self::AcesCct => RgbSpace::ACESCG,
            Self::LogC4 => RgbSpace::ARRI_WIDE_GAMUT_4,
            Self::SLog3 => RgbSpace::S_GAMUT3_CINE,
            Self::DaVinciIntermediate => RgbSpace::DAVINCI_WIDE_GAMUT,
            Self::Pq => RgbSpace::REC2020,
            Self::Srgb => RgbSpace::SRGB,
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
/// use onelight_spectra::{CodedSpace, RgbSpace, SceneCurve};
/// let camera = CodedSpace { space: RgbSpace::S_GAMUT3, ..SceneCurve::SLog3.coded_space() };
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

/// Linear light of PQ's code 1: 10000 cd/m^2 in units of 100.
const PQ_PEAK: f64 = 100.0;
// The constants of [ST2084] under its names.
const PQ_M1: f64 = 2610.0 / 16384.0;
const PQ_M2: f64 = 2523.0 / 4096.0 * 128.0;
const PQ_C1: f64 = 3424.0 / 4096.0;
const PQ_C2: f64 = 2413.0 / 4096.0 * 32.0;
const PQ_C3: f64 = 2392.0 / 4096.0 * 32.0;

fn pq_encode(linear: f64) -> f64 {
    let power = (linear.clamp(0.0, PQ_PEAK) / PQ_PEAK).powf(PQ_M1);
    ((PQ_C1 + PQ_C2 * power) / (1.0 + PQ_C3 * power)).powf(PQ_M2)
}

fn pq_decode(coded: f64) -> f64 {
    let power = coded.clamp(0.0, 1.0).powf(1.0 / PQ_M2);
    // The code of 0 may round to just under c1. max() would make 0 of NaN.
    let above = if power < PQ_C1 { 0.0 } else { power - PQ_C1 };
    PQ_PEAK * (above / (PQ_C2 - PQ_C3 * power)).powf(1.0 / PQ_M1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Light from 2^-20 to the top of the curve, 1000 values to the stop, and its negatives where they have codes.
    fn light(curve: SceneCurve) -> Vec<f64> {
        let top = if curve == SceneCurve::Pq { 6.643 } else { 30.0 };
        let positive =
            || (0..50_000).map(|i| (f64::from(i) / 1000.0 - 20.0).exp2()).take_while(move |v| v.log2() < top);
        let mut light: Vec<f64> = positive().collect();
        if curve != SceneCurve::Pq {
            light.extend(positive().map(|v| -v));
            light.push(0.0);
        }
        light.sort_by(f64::total_cmp);
        light
    }

    #[test]
    fn decode_undoes_encode() {
        for curve in SceneCurve::ALL {
            for v in light(curve) {
                // Near 0 a toe's offset costs digits: one part in 1e16 of the offset's light.
                assert_relative_eq!(curve.decode(curve.encode(v)), v, max_relative = 1e-9, epsilon = 1e-16);
            }
        }
    }

    #[test]
    fn encode_undoes_decode() {
        for curve in SceneCurve::ALL {
            for i in 1..=10_000 {
                let coded = f64::from(i) / 10_000.0;
                assert_relative_eq!(curve.encode(curve.decode(coded)), coded, epsilon = 1e-12);
            }
        }
    }

    #[test]
    fn every_curve_rises() {
        for curve in SceneCurve::ALL {
            for pair in light(curve).windows(2) {
                assert!(curve.encode(pair[0]) < curve.encode(pair[1]), "{curve:?} at {pair:?}");
            }
        }
    }

    #[test]
    fn published_code_values() {
        let ten_bit = |code: f64| code / 1023.0;
        for (curve, linear, coded, tolerance) in [
            // [S2016-001]: the joint, grey and the largest half.
            (SceneCurve::AcesCct, 0.007_812_5, 0.155_251_141_552_511, 1e-15),
            (SceneCurve::AcesCct, 0.0, 0.072_905_534_195_835_5, 1e-15),
            (SceneCurve::AcesCct, 0.18, 0.413_588_4, 5e-8),
            (SceneCurve::AcesCct, 65504.0, 1.467_996_3, 5e-8),
            // [ArriLogC4]
            (SceneCurve::LogC4, -0.018_056_996_1, 0.0, 1e-9),
            (SceneCurve::LogC4, 0.0, ten_bit(95.0), 1e-12),
            (SceneCurve::LogC4, 0.18, 0.278_395_8, 5e-8),
            (SceneCurve::LogC4, 469.8, 1.0, 1e-12),
            // [SonySLog3]; that of 0.9 is rounded to whole codes.
            (SceneCurve::SLog3, 0.0, ten_bit(95.0), 1e-15),
            (SceneCurve::SLog3, 0.18, ten_bit(420.0), 1e-15),
            (SceneCurve::SLog3, 0.9, ten_bit(598.0), ten_bit(0.5)),
            // [DaVinciIntermediate], its table.
            (SceneCurve::DaVinciIntermediate, 0.0, 0.0, 0.0),
            (SceneCurve::DaVinciIntermediate, 0.18, 0.336_043, 5e-7),
            (SceneCurve::DaVinciIntermediate, 1.0, 0.513_837, 5e-7),
            (SceneCurve::DaVinciIntermediate, 10.0, 0.756_599, 5e-7),
            (SceneCurve::DaVinciIntermediate, 40.0, 0.903_125, 6e-7),
            (SceneCurve::DaVinciIntermediate, 100.0, 1.0, 5e-7),
            // [ST2084]: 100 and 10000 cd/m^2.
            (SceneCurve::Pq, 1.0, 0.508_078_4, 5e-8),
            (SceneCurve::Pq, 100.0, 1.0, 0.0),
            (SceneCurve::Srgb, 0.18, 0.461_356, 5e-7),
        ] {
            let found = curve.encode(linear);
            assert!((found - coded).abs() <= tolerance, "{curve:?} {linear}: {found}, expected {coded}");
        }
    }

    #[test]
    fn hard_values() {
        for curve in SceneCurve::ALL {
            assert!(curve.encode(f64::NAN).is_nan() && curve.decode(f64::NAN).is_nan(), "{curve:?}");
            for v in [-1e300, -1e30, -0.0, f64::MIN_POSITIVE, 1e30, 1e300] {
                assert!(curve.encode(v).is_finite(), "{curve:?} at {v}");
            }
            if curve != SceneCurve::Pq {
                assert_eq!(curve.encode(f64::INFINITY), f64::INFINITY);
                assert_eq!(curve.encode(f64::NEG_INFINITY), f64::NEG_INFINITY);
            }
        }
        let pq = SceneCurve::Pq;
        assert_eq!(pq.encode(-1.0), pq.encode(0.0));
        assert_eq!([pq.encode(101.0), pq.encode(f64::INFINITY)], [1.0, 1.0]);
        assert_eq!([pq.decode(-1.0), pq.decode(0.0), pq.decode(pq.encode(0.0))], [0.0; 3]);
        assert_eq!([pq.decode(2.0), pq.decode(f64::INFINITY)], [pq.decode(1.0); 2]);
    }
}
