use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::log2_exp2::{exp2, log2};

/// What a form is computed in, so that one definition serves both: `f32`, as pixels are mapped, and `f64`, which shows what
/// the rounding of `f32` costs.
pub(crate) trait Number:
    Copy
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    const ZERO: Self;
    const ONE: Self;

    /// From a number of a compiled form: exact.
    fn of(value: f32) -> Self;

    /// From a parameter, rounded once.
    fn rounded(value: f64) -> Self;

    /// From an index or a count below 2^24: exact.
    fn of_index(index: usize) -> Self;

    /// The whole part of a number from 0 to 2^24.
    fn to_index(self) -> usize;

    /// The larger of the two; the other where one is NaN.
    fn max(self, other: Self) -> Self;

    /// The smaller of the two; the other where one is NaN.
    fn min(self, other: Self) -> Self;

    fn abs(self) -> Self;

    fn copysign(self, sign: Self) -> Self;

    fn total_cmp(&self, other: &Self) -> Ordering;

    /// The logarithm to base 2 of a normal positive number.
    fn log2(self) -> Self;

    /// 2 to the power of this number.
    fn exp2(self) -> Self;

    /// A positive number to a power.
    fn pow(self, exponent: Self) -> Self;

    /// The share of light that passes through this density: 10 to the negative power of it.
    fn transmittance(self) -> Self;
}

/// What `std` names alike for both types.
macro_rules! arithmetic {
    ($number:ty) => {
        const ZERO: Self = 0.0;
        const ONE: Self = 1.0;

        #[inline]
        fn of(value: f32) -> Self {
            value.into()
        }

        #[inline]
        fn rounded(value: f64) -> Self {
            value as Self
        }

        // By way of `u32`: from and to 64 bits without a sign a processor needs several instructions and a branch.
        #[inline]
        fn of_index(index: usize) -> Self {
            index as u32 as Self
        }

        #[inline]
        fn to_index(self) -> usize {
            self as u32 as usize
        }

        #[inline]
        fn max(self, other: Self) -> Self {
            <$number>::max(self, other)
        }

        #[inline]
        fn min(self, other: Self) -> Self {
            <$number>::min(self, other)
        }

        #[inline]
        fn abs(self) -> Self {
            <$number>::abs(self)
        }

        #[inline]
        fn copysign(self, sign: Self) -> Self {
            <$number>::copysign(self, sign)
        }

        #[inline]
        fn total_cmp(&self, other: &Self) -> Ordering {
            <$number>::total_cmp(self, other)
        }
    };
}

/// Logarithm and power by the polynomials of the pixel loops.
impl Number for f32 {
    arithmetic!(f32);

    #[inline]
    fn log2(self) -> Self {
        log2(self)
    }

    #[inline]
    fn exp2(self) -> Self {
        exp2(self)
    }

    #[inline]
    fn pow(self, exponent: Self) -> Self {
        exp2(log2(self) * exponent)
    }

    #[inline]
    fn transmittance(self) -> Self {
        exp2(-std::f32::consts::LOG2_10 * self)
    }
}

impl Number for f64 {
    arithmetic!(f64);

    #[inline]
    fn log2(self) -> Self {
        self.log2()
    }

    #[inline]
    fn exp2(self) -> Self {
        self.exp2()
    }

    #[inline]
    fn pow(self, exponent: Self) -> Self {
        self.powf(exponent)
    }

    #[inline]
    fn transmittance(self) -> Self {
        10_f64.powf(-self)
    }
}
