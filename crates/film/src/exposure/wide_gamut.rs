use nalgebra::{Matrix3, Vector3};

/// What light outside the sRGB primaries does to a film: light with a channel below 0 there, such as that of most colours near
/// the primaries of Rec.2020 or of a camera.
///
/// Spectra are made of the sRGB primaries' own, which cannot be negative. With the exposure matrix K, the positive part of the
/// light p and the negative part n (its sign turned), each layer is exposed by
///
/// ```text
/// Compress:  P exp(-N / P)    P = K p, N = K n, at least 0
/// Clip:      P
/// ```
///
/// ```
/// assert_eq!(onelight_film::WideGamut::default(), onelight_film::WideGamut::Compress);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum WideGamut {
    /// Negative light lowers the exposure of each layer: at first as the matrix itself goes on, and never to 0 or below. Light
    /// within the primaries keeps its exposure to the last bit, whatever space it came in; light that has no positive part
    /// exposes nothing.
    #[default]
    Compress,
    /// Negative light counts as 0: colours beyond the primaries are those on their edge.
    Clip,
}

/// More than this many times the positive exposure counts for no more: exp(-88) of it is black on any film. The compiled forms
/// end there too.
const MOST_NEGATIVE: f64 = 88.0;

impl WideGamut {
    /// The exposures that `matrix` makes of light in sRGB primaries.
    pub(super) fn expose(self, matrix: &Matrix3<f64>, light: [f64; 3]) -> [f64; 3] {
        let part = |sign: f64| matrix * Vector3::from(light.map(|v| (sign * v).max(0.0)));
        let positive = part(1.0);
        match self {
            Self::Clip => positive.into(),
            Self::Compress if light.iter().all(|&v| v >= 0.0) => positive.into(),
            Self::Compress => positive
                .zip_map(&part(-1.0), |p, n| if p > 0.0 { p * (-(n / p).clamp(0.0, MOST_NEGATIVE)).exp() } else { 0.0 })
                .into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix() -> Matrix3<f64> {
        Matrix3::new(0.8, 0.15, 0.05, 0.1, 0.7, 0.2, 0.05, 0.1, 0.85)
    }

    #[test]
    fn light_within_the_primaries_is_the_same_to_the_bit() {
        for light in [[0.0; 3], [0.18, 0.0, 4.0], [1e30, 1e-30, 0.0]] {
            assert_eq!(WideGamut::Compress.expose(&matrix(), light), WideGamut::Clip.expose(&matrix(), light));
        }
    }

    #[test]
    fn it_goes_on_as_the_matrix_and_stays_above_0() {
        for step in [1e-2, 1e-3, 1e-4] {
            let light = [1.0, -step, 0.5];
            let uncut = matrix() * Vector3::from(light);
            for (found, uncut) in WideGamut::Compress.expose(&matrix(), light).into_iter().zip(uncut.iter()) {
                // exp(-z) is 1 - z to half of z^2.
                assert!((found / uncut - 1.0).abs() < 8.0 * step * step, "{step}");
            }
        }
        let mut before = f64::INFINITY;
        for negative in [0.0, 0.1, 1.0, 10.0, 1e6, 1e30] {
            let [red, ..] = WideGamut::Compress.expose(&matrix(), [1.0, -negative, -negative]);
            assert!(red > 0.0 && red <= before, "{negative}: {red}");
            before = red;
        }
        assert_eq!(WideGamut::Compress.expose(&matrix(), [-1.0, 0.0, -0.5]), [0.0; 3]);
    }
}
