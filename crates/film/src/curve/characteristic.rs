use std::ops::RangeInclusive;

use onelight_spectra::Pchip;

use super::direction::Direction;
use super::isotonic::isotonic;
use crate::error::Error;
use crate::quantity::{Density, LogExposure};

/// A characteristic (H-D) curve: density over log exposure, monotone, flat outside the published range.
///
/// ```
/// use onelight_film::{CharacteristicCurve, Density, Direction, LogExposure};
/// let curve = CharacteristicCurve::new(vec![-1.0, 0.0, 1.0], &[0.1, 0.6, 1.3], Direction::Rising)?;
/// let h = curve.log_exposure(Density(0.8)).ok_or("beyond the curve")?;
/// assert!((curve.density(h).0 - 0.8).abs() < 1e-12);
/// assert_eq!(curve.density(LogExposure(-9.0)).0, 0.1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct CharacteristicCurve {
    curve: Pchip,
    direction: Direction,
}

impl CharacteristicCurve {
    /// Isotonic regression of the points, because reading noise makes curves bend back, then a monotone cubic.
    ///
    /// # Errors
    /// If the points are fewer than two, not finite, or their log exposures do not increase.
    pub fn new(log_exposure: Vec<f64>, density: &[f64], direction: Direction) -> Result<Self, Error> {
        Ok(Self { curve: Pchip::new(log_exposure, isotonic(density, direction))?, direction })
    }

    /// The density that an exposure of the layer makes.
    #[must_use]
    pub fn density(&self, h: LogExposure) -> Density {
        Density(self.curve.at(h.0))
    }

    /// The exposure that makes a density, `None` if no exposure does.
    #[must_use]
    pub fn log_exposure(&self, density: Density) -> Option<LogExposure> {
        self.curve.solve(density.0).map(LogExposure)
    }

    /// Density per unit of log10 exposure: the gamma of the straight part; 0 outside the published range.
    #[must_use]
    pub fn slope(&self, h: LogExposure) -> f64 {
        self.curve.slope_at(h.0)
    }

    /// From the first published log exposure to the last.
    #[must_use]
    pub fn range(&self) -> RangeInclusive<LogExposure> {
        let (first, last) = self.curve.range().into_inner();
        LogExposure(first)..=LogExposure(last)
    }

    /// The lowest published density: that of the film without image.
    #[must_use]
    pub fn d_min(&self) -> Density {
        Density(self.curve.y().iter().copied().fold(f64::INFINITY, f64::min))
    }

    /// The highest published density; a film may reach more beyond the sheet.
    #[must_use]
    pub fn d_max(&self) -> Density {
        Density(self.curve.y().iter().copied().fold(f64::NEG_INFINITY, f64::max))
    }

    /// Whether density rises or falls with exposure.
    #[must_use]
    pub fn direction(&self) -> Direction {
        self.direction
    }

    /// The log exposures of the published points, increasing.
    #[must_use]
    pub fn log_exposures(&self) -> &[f64] {
        self.curve.x()
    }

    /// The densities at [`CharacteristicCurve::log_exposures`], monotone.
    #[must_use]
    pub fn densities(&self) -> &[f64] {
        self.curve.y()
    }
}
