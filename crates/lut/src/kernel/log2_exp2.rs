use fearless_simd::prelude::*;

use crate::log2_exp2::{EXP2, EXP2_ENDS, LOG2, MANTISSA, ONE, ROUNDER};

/// The same as [`log2`](crate::log2_exp2::log2) for each lane of a vector.
#[inline(always)]
pub(super) fn log2s<S: Simd>(simd: S, x: S::f32s) -> S::f32s {
    let bits: S::i32s = x.bitcast();
    let exponent = (bits - ONE) >> 23;
    let mantissa: S::f32s = (bits & MANTISSA | ONE).bitcast();
    let f = mantissa - 1.0;
    let mut quotient = S::f32s::splat(simd, LOG2[6]);
    for c in LOG2.into_iter().rev().skip(1) {
        quotient = quotient.mul_add(f, c);
    }
    quotient.mul_add(f, exponent.to_float::<S::f32s>())
}

/// [`exp2`](crate::log2_exp2::exp2) of each lane, for exponents that are not NaN.
#[inline(always)]
pub(super) fn exp2s<S: Simd>(simd: S, x: S::f32s) -> S::f32s {
    let [low, high] = EXP2_ENDS;
    exp2s_within(simd, x.max(low).min(high))
}

/// [`exp2s`] of exponents that lie within its ends, -126 and 126. A little below them it is 0 or nearly so, a little above it is still
/// a number: logarithms of floats are in range.
#[inline(always)]
pub(super) fn exp2s_within<S: Simd>(simd: S, x: S::f32s) -> S::f32s {
    let rounded = x + ROUNDER;
    let f = x - (rounded - ROUNDER);
    let mut quotient = S::f32s::splat(simd, EXP2[4]);
    for c in EXP2.into_iter().rev().skip(1) {
        quotient = quotient.mul_add(f, c);
    }
    let power = quotient.mul_add(f, S::f32s::splat(simd, 1.0));
    let shift: S::i32s = rounded.bitcast();
    (power.bitcast::<S::i32s>() + (shift << 23)).bitcast()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::levels;
    use crate::log2_exp2::{exp2, log2};
    use fearless_simd::{Level, dispatch};

    /// The error of the polynomial, 3.5e-7, and the roundings of two numbers below 1.44, before the exponent is added with a
    /// rounding of its own.
    const LOG2_ERROR: f64 = 5e-7;

    /// The error of the polynomial, 9.2e-8, and a rounding of the exponent's fraction, of the product and of the sum.
    const EXP2_ERROR: f64 = 2.5e-7;

    /// Positive numbers of all magnitudes, and of every mantissa near 1.
    fn positive() -> impl Iterator<Item = f32> {
        let all = (f32::MIN_POSITIVE.to_bits()..f32::INFINITY.to_bits()).step_by(4099).map(f32::from_bits);
        all.chain((0x3f30_0000..0x3fc0_0000).step_by(97).map(f32::from_bits))
    }

    fn log2_holds(x: f32, found: f32) {
        let exact = f64::from(x).log2();
        let rounding = f64::from(f32::EPSILON) / 2.0 * exact.abs();
        assert!((f64::from(found) - exact).abs() <= LOG2_ERROR + rounding, "{x:e}: {found}, expected {exact}");
    }

    fn exp2_holds(x: f32, found: f32) {
        let exact = f64::from(x.clamp(-126.0, 126.0)).exp2();
        assert!((f64::from(found) / exact - 1.0).abs() <= EXP2_ERROR, "{x}: {found:e}, expected {exact:e}");
    }

    fn on_level(level: Level, f: Of, xs: &[f32; 16]) -> [f32; 16] {
        let mut out = *xs;
        dispatch!(level, simd => each_of(simd, f, &mut out));
        out
    }

    #[derive(Clone, Copy)]
    enum Of {
        Log2,
        Exp2,
    }

    #[inline(always)]
    fn each_of<S: Simd>(simd: S, f: Of, values: &mut [f32]) {
        for vector in values.chunks_exact_mut(S::f32s::LEN) {
            let x = S::f32s::from_slice(simd, vector);
            match f {
                Of::Log2 => log2s(simd, x),
                Of::Exp2 => exp2s(simd, x),
            }
            .store_slice(vector);
        }
    }

    fn sixteens(values: impl Iterator<Item = f32>) -> Vec<[f32; 16]> {
        values.collect::<Vec<_>>().as_chunks().0.to_vec()
    }

    #[test]
    fn log2_is_the_logarithm() {
        for xs in sixteens(positive()) {
            xs.iter().for_each(|&x| log2_holds(x, log2(x)));
            for level in levels() {
                xs.iter().zip(on_level(level, Of::Log2, &xs)).for_each(|(&x, found)| log2_holds(x, found));
            }
        }
        assert_eq!([0.25, 1.0, 8.0, f32::INFINITY].map(log2), [-2.0, 0.0, 3.0, 128.0]);
    }

    #[test]
    fn exp2_is_the_power() {
        for xs in sixteens((-1_300_000..1_300_000).map(|i| i as f32 * 1e-4)) {
            xs.iter().for_each(|&x| exp2_holds(x, exp2(x)));
            for level in levels() {
                xs.iter().zip(on_level(level, Of::Exp2, &xs)).for_each(|(&x, found)| exp2_holds(x, found));
            }
        }
        let ends = [-126.0, 0.0, 1.0, 126.0].map(f32::exp2);
        assert_eq!([f32::NEG_INFINITY, 0.0, 1.0, f32::INFINITY].map(exp2), ends);
        assert_eq!(exp2(f32::NAN), ends[0]);
    }
}
