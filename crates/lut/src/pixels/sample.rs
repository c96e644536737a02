use fearless_simd::prelude::*;
use half::f16;
use half::slice::HalfFloatSliceExt;

use super::half_bits;
use super::raw::Raw;
use super::samples::{Samples, SamplesMut};

/// The number type of a channel: `f32`, `f16`, `u16` or `u8`.
///
/// Integers stand for 0 to 1. What does not fit a type is rounded to the nearest number it has, ends included; NaN becomes 0
/// in an integer.
///
/// ```
/// use onelight_lut::Sample;
/// assert_eq!([u8::from_f32(0.5), u8::from_f32(2.0), u8::from_f32(f32::NAN)], [128, 255, 0]);
/// assert!((51_u8.to_f32() - 0.2).abs() < 1e-7);
/// ```
pub trait Sample: sealed::Sealed + Copy + Default + Send + Sync + 'static {
    /// The value that it stands for.
    fn to_f32(self) -> f32;

    /// The nearest number of this type.
    fn from_f32(value: f32) -> Self;
}

pub(super) mod sealed {
    use super::super::samples::{Samples, SamplesMut};

    /// Forgets the type of samples, so that pixel loops are compiled once for all.
    pub trait Sealed: Sized {
        fn samples(slice: &[Self]) -> Samples<'_>;

        fn samples_mut(slice: &mut [Self]) -> SamplesMut<'_>;
    }
}

/// What pixel loops need of a sample: its bits, and the numbers they stand for, many at once.
pub(super) trait LaneSample: Copy {
    type Raw: Raw;

    fn as_raw(samples: &[Self]) -> &[Self::Raw];

    fn as_raw_mut(samples: &mut [Self]) -> &mut [Self::Raw];

    /// [`Sample::to_f32`] of each lane's bits.
    fn values<L: Simd>(simd: L, bits: L::u32s) -> L::f32s;

    /// The bits of [`Sample::from_f32`] of each lane.
    fn codes<L: Simd>(simd: L, values: L::f32s) -> L::u32s;

    /// The same for alpha: what [`LaneSample::values`] made of a sample comes back bit for bit, NaN and infinities included.
    #[inline(always)]
    fn alphas<L: Simd>(simd: L, values: L::f32s) -> L::u32s {
        Self::codes(simd, values)
    }
}

macro_rules! sealed {
    ($sample:ty, $variant:ident) => {
        impl sealed::Sealed for $sample {
            fn samples(slice: &[Self]) -> Samples<'_> {
                Samples::$variant(slice)
            }

            fn samples_mut(slice: &mut [Self]) -> SamplesMut<'_> {
                SamplesMut::$variant(slice)
            }
        }
    };
}

sealed!(f32, F32);
sealed!(f16, F16);
sealed!(u16, U16);
sealed!(u8, U8);

impl Sample for f32 {
    #[inline]
    fn to_f32(self) -> f32 {
        self
    }

    #[inline]
    fn from_f32(value: f32) -> Self {
        value
    }
}

impl LaneSample for f32 {
    type Raw = Self;

    fn as_raw(samples: &[Self]) -> &[Self] {
        samples
    }

    fn as_raw_mut(samples: &mut [Self]) -> &mut [Self] {
        samples
    }

    #[inline(always)]
    fn values<L: Simd>(_: L, bits: L::u32s) -> L::f32s {
        bits.bitcast()
    }

    #[inline(always)]
    fn codes<L: Simd>(_: L, values: L::f32s) -> L::u32s {
        values.bitcast()
    }
}

impl Sample for f16 {
    #[inline]
    fn to_f32(self) -> f32 {
        half_bits::to_f32(self.to_bits())
    }

    #[inline]
    fn from_f32(value: f32) -> Self {
        // Beyond the largest half float lies infinity, which no picture wants.
        Self::from_bits(half_bits::from_f32(value.clamp(-half_bits::MAX, half_bits::MAX)))
    }
}

impl LaneSample for f16 {
    type Raw = u16;

    fn as_raw(samples: &[Self]) -> &[u16] {
        samples.reinterpret_cast()
    }

    fn as_raw_mut(samples: &mut [Self]) -> &mut [u16] {
        samples.reinterpret_cast_mut()
    }

    #[inline(always)]
    fn values<L: Simd>(_: L, bits: L::u32s) -> L::f32s {
        half_bits::to_f32s::<L>(bits)
    }

    #[inline(always)]
    fn codes<L: Simd>(_: L, values: L::f32s) -> L::u32s {
        half_bits::from_f32s::<L>(values.max(-half_bits::MAX).min(half_bits::MAX))
    }

    #[inline(always)]
    fn alphas<L: Simd>(simd: L, values: L::f32s) -> L::u32s {
        let held = Self::codes(simd, values);
        values.abs().simd_lt(f32::INFINITY).select(held, half_bits::from_f32s::<L>(values))
    }
}

/// Integers that stand for 0 to 1.
macro_rules! integer {
    ($sample:ty) => {
        impl Sample for $sample {
            #[inline]
            fn to_f32(self) -> f32 {
                f32::from(self) * (1.0 / <$sample>::MAX as f32)
            }

            #[inline]
            fn from_f32(value: f32) -> Self {
                // The cast saturates and takes NaN for 0.
                (value * <$sample>::MAX as f32 + 0.5) as Self
            }
        }

        impl LaneSample for $sample {
            type Raw = Self;

            fn as_raw(samples: &[Self]) -> &[Self] {
                samples
            }

            fn as_raw_mut(samples: &mut [Self]) -> &mut [Self] {
                samples
            }

            #[inline(always)]
            fn values<L: Simd>(_: L, bits: L::u32s) -> L::f32s {
                bits.bitcast::<L::i32s>().to_float::<L::f32s>() * (1.0 / <$sample>::MAX as f32)
            }

            #[inline(always)]
            fn codes<L: Simd>(simd: L, values: L::f32s) -> L::u32s {
                unorm::<L>(simd, values, <$sample>::MAX as f32)
            }
        }
    };
}

integer!(u16);
integer!(u8);

/// 0 to 1 as 0 to `most`, rounded; NaN as 0.
#[inline(always)]
fn unorm<L: Simd>(simd: L, values: L::f32s, most: f32) -> L::u32s {
    let half = L::f32s::splat(simd, 0.5);
    // The sum of NaN and anything is NaN, which no comparison lets through.
    let scaled = values.mul_add(most, half).min(most + 0.5);
    scaled.simd_ge(half).select(scaled, half).to_int::<L::i32s>().bitcast()
}
