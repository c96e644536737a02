//! Half floats by integer arithmetic without branches, alone and many at once.

use fearless_simd::prelude::*;

/// The largest finite half float.
pub(super) const MAX: f32 = 65504.0;

/// From the exponent's bias of a half float to that of a float, in place.
const BIAS: u32 = (127 - 15) << 23;

/// The float whose last bit has the value of the last bit of a subnormal half float: a smaller float added to it is rounded as a
/// half float is.
const SUBNORMAL: u32 = (127 - 15 + (23 - 10) + 1) << 23;

/// Exact; the bits of a NaN move along.
#[inline(always)]
pub(super) fn to_f32(half: u16) -> f32 {
    let half = u32::from(half);
    let sign = (half & 0x8000) << 16;
    let magnitude = half & 0x7fff;
    let moved = magnitude << 13;
    let normal = moved + BIAS;
    let subnormal = (f32::from_bits(moved + BIAS + (1 << 23)) - f32::from_bits(BIAS + (1 << 23))).to_bits();
    let endless = normal + BIAS;
    let bits = if magnitude < 0x0400 { subnormal } else { normal };
    f32::from_bits(sign | if magnitude >= 0x7c00 { endless } else { bits })
}

/// The nearest half float, ties to even; infinity stays. The leading bits of a NaN move along.
#[inline(always)]
pub(super) fn from_f32(value: f32) -> u16 {
    let bits = value.to_bits();
    let sign = (bits >> 16) & 0x8000;
    let magnitude = bits & 0x7fff_ffff;
    let odd = (magnitude >> 13) & 1;
    let normal = magnitude.wrapping_add(odd + 0xfff).wrapping_sub(BIAS) >> 13;
    let subnormal = (f32::from_bits(magnitude) + f32::from_bits(SUBNORMAL)).to_bits().wrapping_sub(SUBNORMAL);
    let endless = 0x7c00 | (magnitude >> 13 & 0x3ff);
    let finite = if magnitude < 113 << 23 { subnormal } else { normal };
    (sign | if magnitude >= 0x7f80_0000 { endless } else { finite }) as u16
}

/// The same as [`to_f32`] for each lane of a vector, to the last bit.
#[inline(always)]
pub(super) fn to_f32s<L: Simd>(half: L::u32s) -> L::f32s {
    let sign = (half & 0x8000) << 16;
    let magnitude = half & 0x7fff;
    let normal = (magnitude << 13) + BIAS;
    let raised: L::f32s = (normal + (1 << 23)).bitcast();
    let subnormal: L::u32s = (raised - f32::from_bits(BIAS + (1 << 23))).bitcast();
    let bits = magnitude.simd_lt(0x0400).select(subnormal, normal);
    let bits = magnitude.simd_ge(0x7c00).select(normal + BIAS, bits);
    (sign | bits).bitcast()
}

/// The same as [`from_f32`] for each lane of a vector, to the last bit.
#[inline(always)]
pub(super) fn from_f32s<L: Simd>(value: L::f32s) -> L::u32s {
    let bits: L::u32s = value.bitcast();
    let sign = (bits >> 16) & 0x8000;
    let magnitude = bits & 0x7fff_ffff;
    let odd = (magnitude >> 13) & 1;
    let normal = (magnitude + odd + 0xfff_u32.wrapping_sub(BIAS)) >> 13;
    let raised = magnitude.bitcast::<L::f32s>() + f32::from_bits(SUBNORMAL);
    let subnormal = raised.bitcast::<L::u32s>() - SUBNORMAL;
    let endless = ((magnitude >> 13) & 0x3ff) | 0x7c00;
    let finite = magnitude.simd_lt(113 << 23).select(subnormal, normal);
    sign | magnitude.simd_ge(0x7f80_0000).select(endless, finite)
}

#[cfg(test)]
mod tests {
    use super::*;
    use half::f16;

    #[test]
    fn every_half_float_becomes_its_float_and_comes_back() {
        for bits in 0..=u16::MAX {
            let (ours, theirs) = (to_f32(bits), f16::from_bits(bits).to_f32());
            assert!(ours == theirs || ours.is_nan() && theirs.is_nan(), "{bits:#x}");
            assert_eq!(from_f32(ours), bits);
        }
    }

    #[test]
    fn floats_round_as_the_half_crate_has_it() {
        for bits in (0..=u32::MAX).step_by(9973) {
            let value = f32::from_bits(bits);
            // NaN apart, whose bits may differ; beyond 65504 the callers hold it.
            if value.abs() <= MAX {
                assert_eq!(from_f32(value), f16::from_f32(value).to_bits(), "{value:e}");
            }
        }
        assert_eq!(from_f32(f32::NEG_INFINITY), f16::NEG_INFINITY.to_bits());
    }
}
