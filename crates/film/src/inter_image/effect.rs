use std::ops::RangeInclusive;

use super::strength::InterImage;
use crate::curve::CharacteristicCurve;
use crate::layer::PerLayer;
use crate::quantity::LogExposure;
use crate::stock::Stock;

/// The inter-image effect of one film, exposed one way: log exposures to those at which the layers' own curves are read.
///
/// For the log10 exposures `h` of the three layers and those of a grey card `r`,
///
/// ```text
/// h'_i = h_i + sum over j of C_ij (q(h_i - r_i) - q(h_j - r_j)),    q(t) = mean over j of |D_j(r_j + t) - D_j(unexposed)|
/// ```
///
/// with the densities D of the sheet's characteristic curves. `q` never falls and is flat beyond the curves, so for any
/// strength: greys keep their place; a layer's `h'` rises with its own exposure at least as fast as without the effect, and
/// falls with its neighbours'; no two colours become one; and the shift is bounded.
///
/// ```
/// use onelight_film::{InterImage, InterImageEffect, LogExposure, PerLayer, SheetText, Stock};
/// # let files = onelight_stocks::find("kodak-5207").ok_or("no such stock")?;
/// # let stock = Stock::parse(&SheetText { id: files.id, stock_toml: files.stock_toml,
/// #     sensitivity_csv: files.sensitivity_csv, characteristic_csv: files.characteristic_csv,
/// #     dye_density_csv: files.dye_density_csv })?;
/// let grey = PerLayer::all(stock.mid_grey()?);
/// let effect = InterImageEffect::new(&stock, InterImage::NEGATIVE, grey);
/// assert_eq!(effect.effective(grey), grey);
/// // Red light: the green-sensitive layer below it is held back.
/// let red = PerLayer { red: LogExposure(0.3), green: LogExposure(-1.0), blue: LogExposure(-1.0) };
/// let shifted = effect.effective(red);
/// assert!(shifted.red.0 > red.red.0 && shifted.green.0 < red.green.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct InterImageEffect {
    strength: InterImage,
    curves: PerLayer<CharacteristicCurve>,
    /// Densities of unexposed film, which every colour is measured from.
    unexposed: PerLayer<f64>,
    grey: PerLayer<LogExposure>,
}

impl InterImageEffect {
    /// The effect of this strength in a film whose grey card lies at `grey`.
    #[must_use]
    pub fn new(stock: &Stock, strength: InterImage, grey: PerLayer<LogExposure>) -> Self {
        let curves = stock.characteristic().map(Clone::clone);
        let unexposed = curves.as_ref().map(|curve| curve.density(LogExposure(f64::NEG_INFINITY)).0);
        Self { strength, curves, unexposed, grey }
    }

    /// Its strength.
    #[must_use]
    pub fn strength(&self) -> InterImage {
        self.strength
    }

    /// Where a grey card lies.
    #[must_use]
    pub fn grey(&self) -> PerLayer<LogExposure> {
        self.grey
    }

    /// `q`: the density that grey light develops `offset` log10 above a grey card, above unexposed film; the mean of the
    /// layers. Never falls; flat beyond the curves; 0 for NaN.
    #[must_use]
    pub fn developed(&self, offset: f64) -> f64 {
        let offset = if offset.is_nan() { f64::NEG_INFINITY } else { offset };
        let at = self.curves.as_ref().zip_map(self.grey, |curve, grey| curve.density(LogExposure(grey.0 + offset)).0);
        let layers = at.zip_map(self.unexposed, |density, unexposed| (density - unexposed).abs());
        layers.to_array().iter().sum::<f64>() / 3.0
    }

    /// The largest value of [`InterImageEffect::developed`]; a layer moves by at most this times the sum of its row's
    /// couplings.
    #[must_use]
    pub fn most_developed(&self) -> f64 {
        self.developed(f64::INFINITY)
    }

    /// The offsets from a grey card, in log10, between which [`InterImageEffect::developed`] changes.
    #[must_use]
    pub fn offsets(&self) -> RangeInclusive<f64> {
        let ends = self.curves.as_ref().zip_map(self.grey, |curve, grey| {
            let (first, last) = curve.range().into_inner();
            (first.0 - grey.0, last.0 - grey.0)
        });
        let [a, b, c] = ends.to_array();
        a.0.min(b.0).min(c.0)..=a.1.max(b.1).max(c.1)
    }

    /// The log exposures at which the layers' own curves are to be read.
    #[must_use]
    pub fn effective(&self, h: PerLayer<LogExposure>) -> PerLayer<LogExposure> {
        if self.strength.is_none() {
            return h;
        }
        let q = h.zip_map(self.grey, |h, grey| self.developed(h.0 - grey.0)).to_array();
        let (near, far) = (self.strength.near(), self.strength.far());
        // Differences of q, not a matrix of them: where all are equal nothing moves, to the last bit.
        let [red_green, green_blue, red_blue] = [q[0] - q[1], q[1] - q[2], q[0] - q[2]];
        let shift =
            [near * red_green + far * red_blue, near * (green_blue - red_green), -near * green_blue - far * red_blue];
        h.zip_map(PerLayer::from(shift), |h, shift| LogExposure(h.0 + shift))
    }
}
