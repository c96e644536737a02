use std::ops::RangeInclusive;

use onelight_spectra::Pchip;

use super::direction::Direction;
use super::isotonic::isotonic;
use crate::error::Error;
use crate::quantity::{DyeAmount, LogExposure};

/// Amount of one dye over the log exposure of its layer: monotone, flat outside its nodes.
///
/// ```
/// use onelight_film::{AmountCurve, Direction, DyeAmount, LogExposure};
/// let curve = AmountCurve::new(vec![-1.0, 0.0, 1.0], &[0.0, 0.5, 1.2], Direction::Rising)?;
/// assert_eq!(curve.amount(LogExposure(0.0)), DyeAmount(0.5));
/// assert_eq!(curve.log_exposure(DyeAmount(1.3)), None, "no exposure makes so much");
/// # Ok::<(), onelight_film::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct AmountCurve(Pchip);

impl AmountCurve {
    /// Isotonic regression of the points, then a monotone cubic.
    ///
    /// # Errors
    /// If the points are fewer than two, not finite, or their log exposures do not increase.
    pub fn new(log_exposure: Vec<f64>, amount: &[f64], direction: Direction) -> Result<Self, Error> {
        Ok(Self(Pchip::new(log_exposure, isotonic(amount, direction))?))
    }

    /// The amount of dye that an exposure of the layer makes.
    #[must_use]
    pub fn amount(&self, h: LogExposure) -> DyeAmount {
        DyeAmount(self.0.at(h.0))
    }

    /// The exposure that makes an amount, `None` if no exposure does.
    #[must_use]
    pub fn log_exposure(&self, amount: DyeAmount) -> Option<LogExposure> {
        self.0.solve(amount.0).map(LogExposure)
    }

    /// The log exposures between which the amount changes: first to last node.
    #[must_use]
    pub fn range(&self) -> RangeInclusive<LogExposure> {
        let (first, last) = self.0.range().into_inner();
        LogExposure(first)..=LogExposure(last)
    }

    /// From the lowest amount to the highest.
    #[must_use]
    pub fn amount_range(&self) -> RangeInclusive<DyeAmount> {
        let (first, last) = (self.0.y()[0], self.0.y()[self.0.y().len() - 1]);
        DyeAmount(first.min(last))..=DyeAmount(first.max(last))
    }

    /// The log exposures of the nodes, increasing.
    #[must_use]
    pub fn log_exposures(&self) -> &[f64] {
        self.0.x()
    }

    /// The amounts at the nodes, in the order of [`AmountCurve::log_exposures`].
    #[must_use]
    pub fn amounts(&self) -> &[f64] {
        self.0.y()
    }
}
