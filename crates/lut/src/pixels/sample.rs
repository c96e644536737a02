use fearless_simd::prelude::*;
use half::f16;
use half::slice::HalfFloatSliceExt;

use super::half_bits;

/// The number type of a channel: `f32`, `f16`, `u16` or `u8`.
///
/// Integers stand for 0 to 1. What does not fit a type is rounded to the nearest number it has, ends included; NaN becomes 0
/// in an integer.
pub trait Sample: sealed::Sealed + Copy + Default + Send + Sync + 'static {
    /// The value.
    fn to_f32(self) -> f32;

    /// The nearest number of this type.
    fn from_f32(value: f32) -> Self;
}

pub(super) mod sealed {
    use fearless_simd::prelude::*;

    use super::super::raw::Raw;

    /// What pixel loops need of a sample: its bits, and those of many at once.
    pub trait Sealed: Sized {
        type Raw: Raw;

        fn as_raw(samples: &[Self]) -> &[Self::Raw];

        fn as_raw_mut(samples: &mut [Self]) -> &mut [Self::Raw];

        /// [`Sample::to_f32`](super::Sample::to_f32) of each lane's bits.
        fn values<L: Simd>(simd: L, bits: L::u32s) -> L::f32s;

        /// The bits of [`Sample::from_f32`](super::Sample::from_f32) of each lane.
        fn codes<L: Simd>(simd: L, values: L::f32s) -> L::u32s;

        /// The same for alpha: what [`Sealed::values`] made of a sample comes back bit for bit, NaN and infinities included.
        #[inline(always)]
        fn alphas<L: Simd>(simd: L, values: L::f32s) -> L::u32s {
            Self::codes(simd, values)
        }

        /// The samples as RGBA pixels, where they are the loops' own type.
        fn as_pixels(_samples: &mut [Self]) -> Option<&mut [[f32; 4]]> {
            None
        }
    }
}

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

impl sealed::Sealed for f32 {
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

    fn as_pixels(samples: &mut [Self]) -> Option<&mut [[f32; 4]]> {
        Some(samples.as_chunks_mut().0)
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

impl sealed::Sealed for f16 {
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

        impl sealed::Sealed for $sample {
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
