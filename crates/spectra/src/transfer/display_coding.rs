use super::display::TransferCurve;
use super::hdr::{self, HDR_WHITE_CD_M2};
use crate::display_linear::DisplayLinear;

/// The coding of a finished picture: a curve, and for those of absolute light where white lies.
///
/// HLG codes are what a display of 1000 cd/m^2 shows with the nominal system gamma of 1.2 (\\[BT2100\\]): the gamma is of luminance, so that a
/// channel's code depends on all three.
///
/// ```
/// use onelight_spectra::{DisplayCoding, DisplayLinear, TransferCurve};
/// let pq = DisplayCoding { curve: TransferCurve::Pq, white_cd_m2: 100.0, ..DisplayCoding::default() };
/// assert!((pq.encode_rgb(DisplayLinear([1.0; 3]))[0] - 0.508_078).abs() < 1e-6);
/// let hlg = DisplayCoding { curve: TransferCurve::Hlg, ..DisplayCoding::default() };
/// assert!((hlg.encode_rgb(DisplayLinear([1.0; 3]))[0] - 0.75).abs() < 1e-3);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DisplayCoding {
    /// The curve.
    pub curve: TransferCurve,
    /// Luminance of (1, 1, 1) in cd/m^2, above 0; only PQ and HLG ask for it.
    pub white_cd_m2: f64,
    /// Weights of red, green and blue in luminance, by the primaries; only HLG asks for them.
    pub luminance: [f64; 3],
}

impl Default for DisplayCoding {
    /// sRGB; white at 203 cd/m^2 and the weights of BT.2020 for those that ask.
    fn default() -> Self {
        Self { curve: TransferCurve::default(), white_cd_m2: HDR_WHITE_CD_M2, luminance: [0.2627, 0.6780, 0.0593] }
    }
}

/// The part of the brightest channel that luminance is at least, where channels are negative.
const LEAST_LUMINANCE: f64 = 1e-3;

impl DisplayCoding {
    /// Linear light to codes; NaN stays NaN. Colours outside the gamut keep their sign.
    #[must_use]
    pub fn encode_rgb(&self, rgb: DisplayLinear) -> [f64; 3] {
        match self.curve {
            TransferCurve::Pq => {
                let scale = self.white_cd_m2 / HDR_WHITE_CD_M2;
                rgb.map(|v| self.curve.encode(v * scale))
            }
            TransferCurve::Hlg => {
                let shown = rgb.map(|v| v * self.white_cd_m2 / hdr::HLG_PEAK);
                let gain = self.luminance_of(shown).map_or(0.0, |y| y.powf(1.0 / hdr::HLG_GAMMA - 1.0));
                shown.map(|v| hdr::hlg_oetf(v * gain))
            }
            curve => curve.encode_rgb(rgb),
        }
    }

    /// Codes to linear light: the inverse of [`DisplayCoding::encode_rgb`].
    #[must_use]
    pub fn decode_rgb(&self, coded: [f64; 3]) -> DisplayLinear {
        match self.curve {
            TransferCurve::Pq => {
                let scale = HDR_WHITE_CD_M2 / self.white_cd_m2;
                DisplayLinear(coded.map(|v| self.curve.decode(v) * scale))
            }
            TransferCurve::Hlg => {
                let scene = coded.map(hdr::hlg_oetf_inverse);
                let gain = self.luminance_of(scene).map_or(0.0, |y| y.powf(hdr::HLG_GAMMA - 1.0));
                DisplayLinear(scene.map(|v| v * gain * hdr::HLG_PEAK / self.white_cd_m2))
            }
            curve => curve.decode_rgb(coded),
        }
    }

    /// Luminance, at least a thousandth of the brightest channel; `None` of black.
    fn luminance_of(&self, rgb: [f64; 3]) -> Option<f64> {
        let most = rgb.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let sum: f64 = rgb.iter().zip(self.luminance).map(|(v, weight)| v * weight).sum();
        (most > 0.0 || sum.is_nan()).then(|| if sum.is_nan() { sum } else { sum.max(LEAST_LUMINANCE * most) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn coding(curve: TransferCurve, white_cd_m2: f64) -> DisplayCoding {
        DisplayCoding { curve, white_cd_m2, ..DisplayCoding::default() }
    }

    /// Luminances in cd/m^2 and their codes by colour-science 0.4.7: `eotf_inverse_ST2084`, `eotf_inverse_BT2100_HLG`.
    #[test]
    fn codes_of_absolute_light_are_those_of_colour_science() {
        let pq = coding(TransferCurve::Pq, 1.0);
        for (nits, code) in [(1.0, 0.149_945_732), (18.0, 0.347_966_662), (203.0, 0.580_688_881), (10_000.0, 1.0)] {
            assert_relative_eq!(pq.encode_rgb(DisplayLinear([nits; 3]))[0], code, epsilon = 1e-8);
        }
        let hlg = coding(TransferCurve::Hlg, 1.0);
        let grey = hlg.encode_rgb(DisplayLinear([203.0; 3]));
        let colour = hlg.encode_rgb(DisplayLinear([100.0, 50.0, 20.0]));
        for (found, expected) in grey.into_iter().chain(colour).zip([0.749_877_365; 3].into_iter().chain([
            0.646_854_954,
            0.488_717_109,
            0.309_091_839,
        ])) {
            assert!((found - expected).abs() < 1e-6, "{found} {expected}");
        }
    }

    #[test]
    fn decode_undoes_encode() {
        for curve in [TransferCurve::Pq, TransferCurve::Hlg, TransferCurve::Gamma26] {
            for white in [48.0, 203.0, 1000.0] {
                let coding = coding(curve, white);
                for rgb in [[0.0; 3], [1.0; 3], [0.2, 0.01, 0.9], [0.5, 0.4, -0.02], [1e-4, 2e-4, 0.0]] {
                    let back = coding.decode_rgb(coding.encode_rgb(DisplayLinear(rgb)));
                    for c in 0..3 {
                        assert!((back[c] - rgb[c]).abs() < 1e-9, "{curve:?} {white}: {back:?} {rgb:?}");
                    }
                }
            }
        }
        let hlg = coding(TransferCurve::Hlg, 203.0);
        assert!(hlg.encode_rgb(DisplayLinear([f64::NAN, 0.5, 0.5])).iter().all(|v| v.is_nan()));
    }
}
