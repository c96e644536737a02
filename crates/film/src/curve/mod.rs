//! Curves over log exposure: density ([`CharacteristicCurve`]) and amount of dye ([`AmountCurve`]).

mod amount;
mod characteristic;
mod isotonic;

pub use amount::AmountCurve;
pub use characteristic::CharacteristicCurve;

/// Whether more light makes more density (negative, print) or less (reversal).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// More light, more density.
    Rising,
    /// More light, less density.
    Falling,
}

impl Direction {
    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Rising => 1.0,
            Self::Falling => -1.0,
        }
    }
}

/// A log10 exposure; on absolute axes the exposure is in lux s.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct LogExposure(pub f64);

/// A density as a densitometer reads it: -log10 of a weighted transmittance.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct Density(pub f64);

/// How much of a dye there is, in units of its published curve.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct DyeAmount(pub f64);

/// Exposures at or below this count as this much: no logarithm of 0.
pub const EXPOSURE_FLOOR: f64 = 1e-12;

impl LogExposure {
    /// The logarithm of an exposure, floored at [`EXPOSURE_FLOOR`]; NaN gives the floor.
    #[must_use]
    pub fn of(exposure: f64) -> Self {
        Self(exposure.max(EXPOSURE_FLOOR).log10())
    }

    /// The exposure itself.
    #[must_use]
    pub fn exposure(self) -> f64 {
        10f64.powf(self.0)
    }
}
