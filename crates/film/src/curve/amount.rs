use onelight_spectra::Pchip;

use super::isotonic::isotonic;
use super::{Direction, DyeAmount, LogExposure};
use crate::error::Error;

/// Amount of one dye over the log exposure of its layer: monotone, flat outside its nodes.
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

    /// Amount at an exposure.
    #[must_use]
    pub fn amount(&self, h: LogExposure) -> DyeAmount {
        DyeAmount(self.0.at(h.0))
    }

    /// The exposure that makes an amount, `None` if no exposure does.
    #[must_use]
    pub fn log_exposure(&self, amount: DyeAmount) -> Option<LogExposure> {
        self.0.solve(amount.0).map(LogExposure)
    }

    /// First and last log exposure of the nodes.
    #[must_use]
    pub fn range(&self) -> (LogExposure, LogExposure) {
        let (first, last) = self.0.range();
        (LogExposure(first), LogExposure(last))
    }

    /// The nodes: log exposures and amounts.
    #[must_use]
    pub fn nodes(&self) -> (&[f64], &[f64]) {
        (self.0.x(), self.0.y())
    }

    /// Lowest and highest amount.
    #[must_use]
    pub fn amounts(&self) -> (DyeAmount, DyeAmount) {
        let (first, last) = (self.0.y()[0], self.0.y()[self.0.y().len() - 1]);
        (DyeAmount(first.min(last)), DyeAmount(first.max(last)))
    }
}
