use std::ops::RangeInclusive;

use onelight_spectra::{Pchip, SpectralDistribution, SpectralShape, TablePoints, quantity::OpticalDensity};

use crate::error::{Error, ErrorKind};
use crate::layer::PerLayer;
use crate::quantity::DyeAmount;
use crate::tail;

/// Nodes nearer than this to the long end, in nm, give the slope of the tail.
const TAIL_NODES_NM: f64 = 25.0;
/// A tail falls by at least this much in ln per nm.
const LEAST_FALL_PER_NM: f64 = 0.01;

/// Spectral density of one unit of a dye (the talk's SDC), or of a film's base.
///
/// Between nodes a monotone cubic, clamped at 0. A dye goes on beyond its longest published wavelength with an
/// exponential tail and holds its value below the shortest; a base holds at both ends.
///
/// ```
/// use onelight_film::DyeDensity;
/// use onelight_spectra::TablePoints;
/// let published = TablePoints { x: vec![600.0, 650.0, 700.0], y: vec![0.62, 1.05, 0.55] };
/// // The sheet's curve contains 0.05 of the film's base.
/// let cyan = DyeDensity::dye(published, 0.05)?;
/// assert!((cyan.at(650.0) - 1.0).abs() < 1e-12 && cyan.at(780.0) < 0.3);
/// # Ok::<(), onelight_film::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct DyeDensity {
    density: Pchip,
    /// Slope of ln(density) per nm beyond the last node; 0 holds the value.
    tail: f64,
}

impl DyeDensity {
    /// An image dye from published points (nm, density), less the `base` that the published curve contains.
    ///
    /// # Errors
    /// If there are fewer than two nodes, or wavelengths do not increase.
    pub fn dye(points: TablePoints, base: f64) -> Result<Self, Error> {
        let y: Vec<f64> = points.y.iter().map(|d| (d - base).max(0.0)).collect();
        // The cubic goes through the published values; only its result is clamped.
        let density = Pchip::new(points.x, points.y.iter().map(|d| d - base).collect())?;
        let last = *density.range().end();
        let end = density.x().iter().copied().zip(y).filter(|&(nm, d)| last - nm < TAIL_NODES_NM && d > 0.0);
        let end: Vec<(f64, f64)> = end.map(|(nm, d)| (nm, d.ln())).collect();
        Ok(Self { density, tail: tail::slope(&end).min(-LEAST_FALL_PER_NM) })
    }

    /// The density of processed, unexposed film.
    ///
    /// # Errors
    /// If there are fewer than two nodes, or wavelengths do not increase.
    pub fn base(points: TablePoints) -> Result<Self, Error> {
        Ok(Self { density: Pchip::new(points.x, points.y)?, tail: 0.0 })
    }

    /// Density at a wavelength, published or not; never negative.
    #[must_use]
    pub fn at(&self, wavelength_nm: f64) -> f64 {
        let beyond = (wavelength_nm - self.density.range().end()).max(0.0);
        self.density.at(wavelength_nm).max(0.0) * (self.tail * beyond).exp()
    }

    /// Density at the wavelengths of a grid.
    ///
    /// # Errors
    /// If a node's density lies beyond what a density may be.
    pub fn on(&self, shape: SpectralShape) -> Result<SpectralDistribution<OpticalDensity>, Error> {
        Ok(SpectralDistribution::from_fn(shape, |nm| self.at(nm))?)
    }

    /// The published wavelengths in nm, first to last.
    #[must_use]
    pub fn range_nm(&self) -> RangeInclusive<f64> {
        self.density.range()
    }

    /// The wavelengths of the published points in nm, increasing.
    #[must_use]
    pub fn wavelengths_nm(&self) -> &[f64] {
        self.density.x()
    }

    /// The densities at [`DyeDensity::wavelengths_nm`], less the base; reading noise may leave some a little below 0.
    #[must_use]
    pub fn densities(&self) -> &[f64] {
        self.density.y()
    }
}

/// The dyes of a film on one wavelength grid: cyan is made by the red layer, magenta by the green, yellow by the blue.
///
/// ```
/// use onelight_film::{DyeAmount, Dyes, PerLayer};
/// use onelight_spectra::{SpectralDistribution, SpectralShape};
/// let density = |d: f64| SpectralDistribution::from_fn(SpectralShape::VISIBLE, move |_nm| d);
/// let dyes = Dyes::new(PerLayer { red: density(0.2)?, green: density(0.3)?, blue: density(0.1)? }, Some(density(0.05)?))?;
/// let film = dyes.density(PerLayer { red: DyeAmount(1.0), green: DyeAmount(0.0), blue: DyeAmount(2.0) });
/// assert!((film.values()[0] - (0.05 + 0.2 + 2.0 * 0.1)).abs() < 1e-12);
/// # Ok::<(), onelight_film::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Dyes {
    dyes: PerLayer<SpectralDistribution<OpticalDensity>>,
    d_min: Option<SpectralDistribution<OpticalDensity>>,
}

impl Dyes {
    /// The density of one unit of each dye, and of the film without any; `None` for films whose curves are total densities
    /// (print, reversal).
    ///
    /// # Errors
    /// If they are not on one wavelength grid.
    pub fn new(
        dyes: PerLayer<SpectralDistribution<OpticalDensity>>,
        d_min: Option<SpectralDistribution<OpticalDensity>>,
    ) -> Result<Self, Error> {
        let expected = dyes.red.shape();
        for found in [&dyes.green, &dyes.blue].into_iter().chain(&d_min).map(SpectralDistribution::shape) {
            if found != expected {
                return Err(ErrorKind::Grids { found, expected }.into());
            }
        }
        Ok(Self { dyes, d_min })
    }

    /// Spectral density of one unit of each dye.
    #[must_use]
    pub fn dyes(&self) -> PerLayer<&SpectralDistribution<OpticalDensity>> {
        self.dyes.as_ref()
    }

    /// Spectral density of the film without any dye; `None` where the dyes' curves are total densities.
    #[must_use]
    pub fn d_min(&self) -> Option<&SpectralDistribution<OpticalDensity>> {
        self.d_min.as_ref()
    }

    /// The one wavelength grid of dyes and base.
    #[must_use]
    pub fn shape(&self) -> SpectralShape {
        self.dyes.red.shape()
    }

    /// Spectral density of a film that holds these amounts.
    #[must_use]
    pub fn density(&self, amounts: PerLayer<DyeAmount>) -> SpectralDistribution<OpticalDensity> {
        let [c, m, y] = self.dyes.as_ref().zip_map(amounts, |dye, amount| dye.scaled(amount.0)).to_array();
        let sum = c.stacked_on(&m).stacked_on(&y);
        match &self.d_min {
            Some(base) => sum.stacked_on(base),
            None => sum,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn nodes(y: &[f64]) -> TablePoints {
        let x = (0..y.len()).map(|i| 600.0 + 5.0 * i as f64).collect();
        TablePoints { x, y: y.to_vec() }
    }

    #[test]
    fn dyes_and_base_share_a_grid() {
        let on = |shape| SpectralDistribution::<OpticalDensity>::from_fn(shape, |_| 0.3).unwrap();
        let (visible, other) = (on(SpectralShape::VISIBLE), on(SpectralShape::by_1_nm::<400, 1000>()));
        let dyes = Dyes::new(PerLayer::all(visible.clone()), Some(visible.clone())).unwrap();
        assert_eq!(dyes.density(PerLayer::all(DyeAmount(2.0))).values()[0], 3.0 * 0.6 + 0.3);
        let mixed = PerLayer { blue: other.clone(), ..PerLayer::all(visible.clone()) };
        let message = "dyes and base of a film: found 400..1000 nm by 1 beside 380..780 nm by 1, expected one grid";
        assert_eq!(Dyes::new(mixed, None).unwrap_err().to_string(), message);
        assert_eq!(Dyes::new(PerLayer::all(visible), Some(other)).unwrap_err().to_string(), message);
    }

    #[test]
    fn an_exponential_goes_on_as_one() {
        let y: Vec<f64> = (0..9).map(|i| (-0.1 * f64::from(i)).exp()).collect();
        let dye = DyeDensity::dye(nodes(&y), 0.0).unwrap();
        assert_relative_eq!(dye.at(740.0), (-2.8f64).exp(), max_relative = 1e-9);
        assert_eq!(dye.at(500.0), 1.0);
    }

    #[test]
    fn a_tail_never_rises_and_density_is_never_negative() {
        let dye = DyeDensity::dye(nodes(&[-0.02, 0.5, 0.3, 0.4, 0.5]), 0.0).unwrap();
        assert_relative_eq!(dye.at(720.0), 0.5 * (-1.0f64).exp(), max_relative = 1e-12);
        assert_eq!(dye.at(600.0), 0.0);
        let base = DyeDensity::base(nodes(&[0.2, 0.1])).unwrap();
        assert_eq!(base.at(900.0), 0.1);
    }
}
