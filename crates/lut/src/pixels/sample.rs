use half::f16;

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

mod sealed {
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for half::f16 {}
    impl Sealed for u16 {}
    impl Sealed for u8 {}
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

impl Sample for f16 {
    #[inline]
    fn to_f32(self) -> f32 {
        self.to_f32()
    }

    #[inline]
    fn from_f32(value: f32) -> Self {
        // Beyond the largest half float lies infinity, which no picture wants.
        Self::from_f32(value.clamp(Self::MIN.to_f32(), Self::MAX.to_f32()))
    }
}

impl Sample for u16 {
    #[inline]
    fn to_f32(self) -> f32 {
        f32::from(self) / 65535.0
    }

    #[inline]
    fn from_f32(value: f32) -> Self {
        // The cast saturates and takes NaN for 0.
        (value * 65535.0 + 0.5) as Self
    }
}

impl Sample for u8 {
    #[inline]
    fn to_f32(self) -> f32 {
        f32::from(self) / 255.0
    }

    #[inline]
    fn from_f32(value: f32) -> Self {
        (value * 255.0 + 0.5) as Self
    }
}
