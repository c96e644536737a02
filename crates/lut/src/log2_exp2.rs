//! Logarithm and power to base 2 in float32 by polynomials, the same on every machine. The pixel loops have them lane by lane
//! in `kernel::log2_exp2`.

/// The bits of 1 as a float.
pub(crate) const ONE: i32 = 0x3f80_0000;

/// The bits of a number that hold its mantissa.
pub(crate) const MANTISSA: i32 = 0x007f_ffff;

/// `log2(1 + f) / f` on [0, 1], least largest absolute error of the logarithm among those that are 1 at 1, so that the
/// logarithm has no step where its exponent changes: 3.3e-7, and 3.5e-7 with these roundings.
pub(crate) const LOG2: [f32; 7] =
    [1.442_666_4, -0.720_554_23, 0.473_324_18, -0.325_140_18, 0.193_029_66, -0.078_534_97, 0.015_209_109];

/// `(2^f - 1) / f` on [-1/2, 1/2], least largest relative error of the power: 9.2e-8.
#[allow(clippy::approx_constant, reason = "a coefficient near ln 2, not ln 2")]
pub(crate) const EXP2: [f32; 5] = [0.693_147, 0.240_222_42, 0.055_507_336, 0.009_671_513, 0.001_326_472_7];

/// Exponents are held within these ends, so that powers are normal numbers.
pub(crate) const EXP2_ENDS: [f32; 2] = [-126.0, 126.0];

/// 1.5 2^23: what is added to it loses its fraction, rounded to the nearest.
pub(crate) const ROUNDER: f32 = 12_582_912.0;

/// The logarithm to base 2 of a normal positive number, or infinity (128), within 5e-7 and the rounding of the result.
#[inline]
pub(crate) fn log2(x: f32) -> f32 {
    let bits = x.to_bits().cast_signed();
    let exponent = (bits - ONE) >> 23;
    let f = f32::from_bits((bits & MANTISSA | ONE).cast_unsigned()) - 1.0;
    let quotient = LOG2.iter().rev().skip(1).fold(LOG2[6], |sum, &c| sum * f + c);
    quotient * f + exponent as f32
}

/// 2 to the power of `x`, held within [-126, 126]; NaN is taken for -126. Within 2.5e-7 of the result.
#[inline]
pub(crate) fn exp2(x: f32) -> f32 {
    let [low, high] = EXP2_ENDS;
    let x = if x > low { x.min(high) } else { low };
    let rounded = x + ROUNDER;
    let f = x - (rounded - ROUNDER);
    let quotient = EXP2.iter().rev().skip(1).fold(EXP2[4], |sum, &c| sum * f + c);
    f32::from_bits((quotient * f + 1.0).to_bits().wrapping_add(rounded.to_bits() << 23))
}
