//! From the values of a file to light.

use std::sync::Arc;

/// How a file says that its values were coded: from a value to light.
///
/// ```
/// use onelight_picture::Transfer;
///
/// assert_eq!(Transfer::Power(2.0).light([0.5, 1.0, -0.5]), [0.25, 1.0, -0.25]);
/// let half = Transfer::Srgb.light([0.5; 3])[0];
/// assert!((half - 0.214_041).abs() < 1e-6);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Transfer {
    /// Values are light already.
    Linear,
    /// The piecewise curve of IEC 61966-2-1.
    Srgb,
    /// Light is the value to this power.
    Power(f32),
    /// The camera curve of ITU-R BT.709, undone.
    Bt709,
    /// SMPTE ST 2084: light is relative to a white of 203 cd/m2 (ITU-R BT.2408).
    Pq,
    /// The scene light of Hybrid Log-Gamma (ITU-R BT.2100): 75 % of the signal is white.
    Hlg,
    /// A curve for each of red, green and blue, as an ICC profile has them.
    Curves(Arc<[Curve; 3]>),
}

/// A curve of an ICC profile, from 0..1 to 0..1.
///
/// ```
/// use onelight_picture::Curve;
/// let squares = Curve::Table(vec![0.0, 0.25, 1.0]);
/// assert_eq!(squares.value(0.25), 0.125);
/// let power = Curve::Parametric([2.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
/// assert_eq!(power.value(0.5), 0.25);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub enum Curve {
    /// Values at equal steps, between which lines are drawn: at least two.
    Table(Vec<f32>),
    /// `(a x + b)^g + e` from `d` on, `c x + f` below: the constants g, a, b, c, d, e and f of ICC.1.
    Parametric([f32; 7]),
}

/// Luminance of white, in cd/m2, where a coding has absolute units.
const WHITE_NITS: f64 = 203.0;

impl Transfer {
    /// The light of a colour; negative values mirror positive ones. NaN stays NaN.
    pub fn light(&self, rgb: [f32; 3]) -> [f32; 3] {
        match self {
            Self::Linear => rgb,
            Self::Srgb => rgb.map(|v| mirrored(v, srgb)),
            Self::Power(power) => rgb.map(|v| mirrored(v, |v| v.powf(f64::from(*power)))),
            Self::Bt709 => rgb.map(|v| mirrored(v, bt709)),
            Self::Pq => rgb.map(|v| mirrored(v, pq)),
            Self::Hlg => rgb.map(|v| mirrored(v, hlg)),
            Self::Curves(curves) => {
                let [red, green, blue] = &**curves;
                [red.value(rgb[0]), green.value(rgb[1]), blue.value(rgb[2])]
            }
        }
    }
}

/// `curve` for both signs: an odd function.
fn mirrored(value: f32, curve: impl Fn(f64) -> f64) -> f32 {
    (curve(f64::from(value.abs())) as f32).copysign(value)
}

fn srgb(v: f64) -> f64 {
    if v <= 0.04045 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}

/// The inverse of the curve of BT.709, with BT.2020's exact constants.
fn bt709(v: f64) -> f64 {
    const ALPHA: f64 = 1.099_296_826_809_44;
    const BETA: f64 = 0.018_053_968_510_807;
    if v < 4.5 * BETA { v / 4.5 } else { ((v + ALPHA - 1.0) / ALPHA).powf(1.0 / 0.45) }
}

/// The EOTF of SMPTE ST 2084, in units of white.
fn pq(v: f64) -> f64 {
    const M1: f64 = 2610.0 / 16384.0;
    const M2: f64 = 2523.0 / 4096.0 * 128.0;
    const C1: f64 = 3424.0 / 4096.0;
    const C2: f64 = 2413.0 / 4096.0 * 32.0;
    const C3: f64 = 2392.0 / 4096.0 * 32.0;
    // Beyond 1 the curve has a pole.
    let root = v.min(1.0).powf(1.0 / M2);
    10_000.0 / WHITE_NITS * ((root - C1).max(0.0) / (C2 - C3 * root)).powf(1.0 / M1)
}

/// The inverse OETF of BT.2100's HLG, in units of the light at 75 %.
fn hlg(v: f64) -> f64 {
    const A: f64 = 0.178_832_77;
    const B: f64 = 0.284_668_92;
    const C: f64 = 0.559_910_73;
    let light = |v: f64| if v <= 0.5 { v * v / 3.0 } else { (((v - C) / A).exp() + B) / 12.0 };
    light(v) / light(0.75)
}

impl Curve {
    /// The curve at a value; a table is held at its ends.
    pub fn value(&self, x: f32) -> f32 {
        match self {
            Self::Table(table) => {
                let Some(last) = table.len().checked_sub(1) else { return x };
                let at = x.clamp(0.0, 1.0) * last as f32;
                let below = (at as usize).min(last.saturating_sub(1));
                let part = at - below as f32;
                match (table.get(below), table.get(below + 1)) {
                    (Some(a), Some(b)) => a + part * (b - a),
                    (Some(a), None) => *a,
                    _ => x,
                }
            }
            Self::Parametric([g, a, b, c, d, e, f]) => {
                if x >= *d {
                    (a * x + b).max(0.0).powf(*g) + e
                } else {
                    c * x + f
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of the standards: ST 2084 gives 203 cd/m2 at 58 % (BT.2408, table 1), HLG 1/12 at a half of the signal.
    #[test]
    fn standard_points_are_met() {
        let grey = |transfer: &Transfer, v: f32| f64::from(transfer.light([v; 3])[1]);
        assert!((grey(&Transfer::Pq, 0.580_69) - 1.0).abs() < 1e-3);
        assert!((grey(&Transfer::Pq, 1.0) * WHITE_NITS - 10_000.0).abs() < 0.1);
        assert!((grey(&Transfer::Hlg, 0.75) - 1.0).abs() < 1e-6);
        let peak = grey(&Transfer::Hlg, 1.0);
        assert!((grey(&Transfer::Hlg, 0.5) / peak - 1.0 / 12.0).abs() < 1e-6);
        // BT.709: 18 % of light is coded as 0.409, of three decimals.
        assert!((grey(&Transfer::Bt709, 0.409) - 0.18).abs() < 5e-4);
        assert_eq!(grey(&Transfer::Linear, -3.0), -3.0);
    }

    #[test]
    fn curves_have_no_steps_and_mirror() {
        for (transfer, seam) in [(Transfer::Srgb, 0.04045), (Transfer::Bt709, 0.081_242_86), (Transfer::Hlg, 0.5)] {
            let [below, above] = [seam - 1e-6, seam + 1e-6].map(|v: f32| transfer.light([v; 3])[0]);
            assert!((above - below).abs() < 1e-5, "{transfer:?}: {below} {above}");
            assert_eq!(transfer.light([-0.7; 3])[0], -transfer.light([0.7; 3])[0]);
        }
    }

    #[test]
    fn the_curves_of_a_profile_are_followed() {
        let table = Curve::Table(vec![0.0, 0.25, 1.0]);
        assert_eq!(
            [-1.0, 0.0, 0.25, 0.5, 0.75, 1.0, 2.0].map(|x| table.value(x)),
            [0.0, 0.0, 0.125, 0.25, 0.625, 1.0, 1.0]
        );
        assert_eq!(Curve::Table(vec![0.5]).value(0.3), 0.5);
        // The constants that ICC profiles of sRGB have.
        let srgb = Curve::Parametric([2.4, 1.0 / 1.055, 0.055 / 1.055, 1.0 / 12.92, 0.04045, 0.0, 0.0]);
        for v in [0.0, 0.02, 0.2, 0.5, 1.0] {
            assert!((srgb.value(v) - Transfer::Srgb.light([v; 3])[0]).abs() < 1e-6, "{v}");
        }
    }
}
