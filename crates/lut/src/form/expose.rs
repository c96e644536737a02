use crate::error::Error;
use crate::number::Number;
use crate::scene_light::{IDENTITY, LOG_FLOOR, Rows, SCENE_MAX, check_rows, finite_in, times};

/// From scene light to the exposure of each layer: the first step of [`StructuredLut`](crate::StructuredLut) and
/// [`DirectForm`](crate::DirectForm).
///
/// 1. NaN counts as 0, what lies beyond ±[`SCENE_MAX`] as that; the `input` matrix gives `u`
/// 2. with [`NegativeLight::Clip`]: `matrix` times `u` clamped to [0, [`SCENE_MAX`]];
///    with [`NegativeLight::Compress`]: `P exp(-N / P)`, where `P` is `matrix` times what is positive in `u` and `N` is `matrix`
///    times what is negative, its sign turned, and at least 0
/// 3. log2; that of `P` and of what is clipped is of at least [`LOG_FLOOR`]
///
/// ```
/// use onelight_lut::{Expose, IDENTITY, NegativeLight};
/// let clip = Expose::by(IDENTITY);
/// assert_eq!(clip.log2([1.0, 0.25, 8.0]), [0.0, -2.0, 3.0]);
/// // Light outside the primaries still tells one colour from another.
/// let mixed = [[1.0, 0.5, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// let compress = Expose { matrix: mixed, negative: NegativeLight::Compress, ..clip };
/// assert!(compress.log2([1.0, -0.2, 1.0])[0] < compress.log2([1.0, -0.1, 1.0])[0]);
/// assert_eq!(Expose { negative: NegativeLight::Clip, ..compress }.log2([1.0, -0.2, 1.0])[0], 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expose {
    /// From the picture's primaries to those of `matrix`.
    pub input: Rows,
    /// To the exposure of each layer.
    pub matrix: Rows,
    /// What light below 0 in the primaries of `matrix` does.
    pub negative: NegativeLight,
}

/// What light below 0 in the primaries of an exposure matrix does: light of a wider gamut has such channels.
///
/// ```
/// assert_eq!(onelight_lut::NegativeLight::default(), onelight_lut::NegativeLight::Clip);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum NegativeLight {
    /// It counts as 0.
    #[default]
    Clip,
    /// It lowers the exposure of each layer by the factor `exp(-N / P)`: as much as the matrix itself would where it is little,
    /// and never below 0.
    Compress,
}

/// The logarithm to base 2 of e.
pub(crate) const LOG2_E: f32 = std::f32::consts::LOG2_E;

/// The most that `N / P` counts for in [`NegativeLight::Compress`], 127 stops: below any curve, and still a number.
pub(crate) const MOST_NEGATIVE: f32 = 88.0;

impl Expose {
    /// Exposure by a matrix, of a picture in its primaries; light below 0 counts as 0.
    pub fn by(matrix: Rows) -> Self {
        Self { input: IDENTITY, matrix, negative: NegativeLight::Clip }
    }

    /// The same for light so many stops brighter: every exposure rises by as much, and nothing else moves.
    ///
    /// ```
    /// # use onelight_lut::{Expose, IDENTITY};
    /// let pushed = Expose::by(IDENTITY).brighter(1.5);
    /// assert!((pushed.log2([0.18; 3])[0] - Expose::by(IDENTITY).log2([0.18; 3])[0] - 1.5).abs() < 1e-6);
    /// ```
    #[must_use]
    pub fn brighter(self, stops: f32) -> Self {
        let gain = stops.exp2();
        Self { matrix: self.matrix.map(|row| row.map(|v| gain * v)), ..self }
    }

    /// The same for light that goes through a matrix first, in the picture's primaries: a white balance, say.
    ///
    /// ```
    /// # use onelight_lut::{Expose, IDENTITY};
    /// // A lamp that gives half as much blue, made white.
    /// let balanced = Expose::by(IDENTITY).after(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 2.0]]);
    /// assert_eq!(balanced.log2([0.5, 0.5, 0.25]), [-1.0; 3]);
    /// ```
    #[must_use]
    pub fn after(self, balance: &Rows) -> Self {
        let column = |k: usize| times(&self.input, [balance[0][k], balance[1][k], balance[2][k]]);
        let [red, green, blue] = [column(0), column(1), column(2)];
        Self { input: std::array::from_fn(|i| [red[i], green[i], blue[i]]), ..self }
    }

    /// The log2 exposure of each layer, from -167 to 103.
    #[inline]
    pub fn log2(&self, linear: [f32; 3]) -> [f32; 3] {
        self.log2_in(linear)
    }

    /// The one definition of [`Expose::log2`], for float32 and float64.
    #[inline]
    pub(crate) fn log2_in<N: Number>(&self, linear: [N; 3]) -> [N; 3] {
        let max = N::of(SCENE_MAX);
        let light = times(&self.input, linear.map(finite_in));
        let positive = times(&self.matrix, light.map(|v| v.max(N::ZERO).min(max))).map(|e| e.max(N::of(LOG_FLOOR)));
        match self.negative {
            NegativeLight::Clip => positive.map(N::log2),
            NegativeLight::Compress => {
                let negative = times(&self.matrix, light.map(|v| (-v).max(N::ZERO).min(max)));
                std::array::from_fn(|i| {
                    let most = N::of(MOST_NEGATIVE) * positive[i];
                    let share = negative[i].max(N::ZERO).min(most) / positive[i];
                    positive[i].log2() - N::of(LOG2_E) * share
                })
            }
        }
    }

    pub(crate) fn check(&self) -> Result<(), Error> {
        check_rows("input matrix", &self.input)?;
        check_rows("exposure matrix", &self.matrix)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MIXED: Rows = [[0.8, 0.15, 0.05], [0.1, 0.7, 0.2], [0.05, 0.1, 0.85]];

    fn compress() -> Expose {
        Expose { negative: NegativeLight::Compress, ..Expose::by(MIXED) }
    }

    #[test]
    fn moved_light_is_light_that_was_moved_before() {
        let balance = [[1.1, 0.02, 0.0], [0.01, 0.95, 0.03], [0.0, -0.05, 1.3]];
        for expose in [compress(), Expose::by(MIXED), Expose { input: balance, ..compress() }] {
            // In float64, in which the moved numbers' own rounding to float32 is all that differs; a logarithm of float32 near 8 is
            // rounded by half of 1e-6 itself.
            let of = |expose: &Expose, light: [f64; 3]| expose.log2_in(light);
            for light in [[0.18, 0.2, 0.3], [4.0, 0.01, 0.7], [-0.1, 0.5, 0.4], [1e-3, 2e-3, 90.0]] {
                for (found, wanted) in [
                    (of(&expose.brighter(-2.5), light), of(&expose, light.map(|v| v * (-2.5_f64).exp2()))),
                    (of(&expose.after(&balance), light), of(&expose, times(&balance, light))),
                    (of(&expose.brighter(1.0).brighter(-1.0), light), of(&expose, light)),
                ] {
                    for (found, wanted) in found.into_iter().zip(wanted) {
                        assert!((found - wanted).abs() < 1e-6, "{found} {wanted}");
                    }
                }
            }
        }
    }

    #[test]
    fn light_within_the_primaries_is_the_same_to_the_bit() {
        for light in [[0.0, 0.0, 0.0], [0.18, 0.0, 4.0], [1e30, 1e-30, 0.0]] {
            assert_eq!(compress().log2(light), Expose::by(MIXED).log2(light));
        }
    }

    #[test]
    fn compression_begins_as_the_matrix_goes_on() {
        // What the matrix itself makes of a little negative light, to second order.
        for step in [1e-2, 1e-3] {
            let light = [1.0, -step, 0.5];
            let uncut = times(&MIXED, light);
            for (found, uncut) in compress().log2_in(light).into_iter().zip(uncut) {
                assert!((found.exp2() / uncut - 1.0).abs() < 8.0 * step * step, "{step}");
            }
        }
    }

    #[test]
    fn exposure_falls_with_negative_light_and_stays_finite() {
        let mut before = f64::INFINITY;
        for negative in [0.0, 0.1, 1.0, 10.0, 1e6, 1e30, f64::INFINITY] {
            let [red, ..] = compress().log2_in([1.0, -negative, -negative]);
            assert!(red <= before && red > -168.0, "{negative}: {red}");
            before = red;
        }
        for hard in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, -1e-40, f32::MIN] {
            assert!(compress().log2([hard, hard, 0.2]).iter().all(|h| h.is_finite()), "{hard}");
            assert!(compress().log2([hard; 3]).iter().all(|h| h.is_finite()), "{hard}");
        }
    }
}
