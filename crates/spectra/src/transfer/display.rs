use super::hdr::{self, HDR_WHITE_CD_M2};
use crate::display_linear::DisplayLinear;

/// How linear light becomes the numbers of a finished picture ([`SceneCurve`](crate::SceneCurve) has those of cameras). Each curve
/// is odd: `encode(-v) = -encode(v)`, so that colours outside the gamut survive until a file format clips them.
///
/// ```
/// use onelight_spectra::TransferCurve;
/// assert!((TransferCurve::Srgb.encode(0.18) - 0.461356).abs() < 1e-6);
/// assert_eq!(TransferCurve::Srgb.encode(-0.18), -TransferCurve::Srgb.encode(0.18));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum TransferCurve {
    /// The numbers are linear light.
    Linear,
    /// The curve of sRGB and Display P3 (\[IEC61966-2-1\]).
    #[default]
    Srgb,
    /// A power of 2.4: the studio display of \[BT1886\] with a black of 0.
    Gamma24,
    /// A power of 2.6: digital cinema (\[RP431-2\]).
    Gamma26,
    /// The perceptual quantiser of \[ST2084\], linear 1 being 203 cd/m^2 ([`DisplayCoding`](crate::DisplayCoding) has others). Odd; light above 10000 cd/m^2 has
    /// its code.
    Pq,
    /// Hybrid Log-Gamma (\[BT2100\]) of a grey on a display of 1000 cd/m^2, linear 1 being 203 cd/m^2. Of colours each channel depends on the
    /// others: [`DisplayCoding`](crate::DisplayCoding) knows how.
    Hlg,
}

impl TransferCurve {
    /// Linear light to coded value; NaN stays NaN.
    #[must_use]
    pub fn encode(self, linear: f64) -> f64 {
        let v = linear.abs();
        let coded = match self {
            Self::Linear => v,
            Self::Srgb if v <= SRGB_LINEAR_END => 12.92 * v,
            Self::Srgb => 1.055 * v.powf(1.0 / 2.4) - 0.055,
            Self::Gamma24 => v.powf(1.0 / 2.4),
            Self::Gamma26 => v.powf(1.0 / 2.6),
            Self::Pq => hdr::pq_encode(v),
            Self::Hlg => hdr::hlg_oetf((v * HDR_WHITE_CD_M2 / hdr::HLG_PEAK).powf(1.0 / hdr::HLG_GAMMA)),
        };
        coded.copysign(linear)
    }

    /// Coded value to linear light; NaN stays NaN.
    #[must_use]
    pub fn decode(self, coded: f64) -> f64 {
        let v = coded.abs();
        let linear = match self {
            Self::Linear => v,
            Self::Srgb if v <= 12.92 * SRGB_LINEAR_END => v / 12.92,
            Self::Srgb => ((v + 0.055) / 1.055).powf(2.4),
            Self::Gamma24 => v.powf(2.4),
            Self::Gamma26 => v.powf(2.6),
            Self::Pq => hdr::pq_decode(v),
            Self::Hlg => hdr::hlg_oetf_inverse(v).powf(hdr::HLG_GAMMA) * hdr::HLG_PEAK / HDR_WHITE_CD_M2,
        };
        linear.copysign(coded)
    }

    /// Whether codes are of absolute light: PQ and HLG.
    #[must_use]
    pub const fn is_hdr(self) -> bool {
        matches!(self, Self::Pq | Self::Hlg)
    }

    /// The three channels of [`TransferCurve::encode`].
    #[must_use]
    pub fn encode_rgb(self, rgb: DisplayLinear) -> [f64; 3] {
        rgb.map(|v| self.encode(v))
    }

    /// The three channels of [`TransferCurve::decode`].
    #[must_use]
    pub fn decode_rgb(self, coded: [f64; 3]) -> DisplayLinear {
        DisplayLinear(coded.map(|v| self.decode(v)))
    }
}

/// Where the straight foot of sRGB ends, in linear light (\[IEC61966-2-1\]).
const SRGB_LINEAR_END: f64 = 0.003_130_8;

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn decode_undoes_encode_and_both_are_odd() {
        for curve in [
            TransferCurve::Linear,
            TransferCurve::Srgb,
            TransferCurve::Gamma24,
            TransferCurve::Gamma26,
            TransferCurve::Pq,
            TransferCurve::Hlg,
        ] {
            for i in -4000..=4000 {
                let v = f64::from(i) / 1000.0;
                // The two pieces of sRGB miss each other by 3e-8 at their joint, as the standard rounds them.
                assert_relative_eq!(curve.decode(curve.encode(v)), v, epsilon = 1e-7);
                assert_eq!(curve.encode(-v), -curve.encode(v));
            }
        }
    }

    #[test]
    fn hard_values() {
        assert!(TransferCurve::Srgb.encode(f64::NAN).is_nan());
        assert_eq!(TransferCurve::Srgb.encode(f64::INFINITY), f64::INFINITY);
        assert_eq!(TransferCurve::Gamma24.encode(0.0), 0.0);
    }
}
