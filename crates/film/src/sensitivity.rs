use std::ops::RangeInclusive;

use onelight_spectra::{Pchip, SpectralDistribution, SpectralShape, TablePoints, quantity::Responsivity};

use crate::error::Error;
use crate::tail;

/// How a layer's sensitivity goes on beyond the longest published wavelength. Films are usually not sensitive there; whether they
/// are decides what infrared light does in a printer.
///
/// ```
/// use onelight_film::{SpectralSensitivity, Tail};
/// use onelight_spectra::TablePoints;
/// let red = SpectralSensitivity::new(TablePoints { x: vec![600.0, 650.0, 700.0], y: vec![0.0, 1.0, -1.0] })?;
/// assert!(red.log10_at(750.0, Tail::LogLinear) < -1.9);
/// assert_eq!(red.log10_at(750.0, Tail::Held), -1.0);
/// # Ok::<(), onelight_film::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Tail {
    /// Falls in a straight line in log10, as the last 12 nm do.
    #[default]
    LogLinear,
    /// Stays as it is: what makes infrared matter in \[Gotanda2010\]; no emulsion does that.
    Held,
}

/// Nodes this near to an end, in nm, give the slope of the tail.
const TAIL_NODES_NM: f64 = 12.0;
/// A tail falls by at least this much log10 per nm.
const LEAST_FALL_PER_NM: f64 = 0.02;
/// No sensitivity is taken to lie further under the peak, in log10.
const DECADES: f64 = 12.0;

/// Spectral sensitivity of a layer (the talk's SSC): log10 of the reciprocal of the radiant exposure in erg/cm^2 (the same
/// number in mJ/m^2) that makes the sheet's criterion density; relative where the sheet gives no unit.
///
/// Between nodes a monotone cubic in log10; below the shortest wavelength a log-linear tail, above the longest a [`Tail`]; never
/// more than 12 below the peak.
///
/// ```
/// use onelight_film::SpectralSensitivity;
/// use onelight_spectra::TablePoints;
/// let green = SpectralSensitivity::new(TablePoints { x: vec![500.0, 550.0, 600.0], y: vec![0.2, 1.4, -0.3] })?;
/// assert_eq!(green.peak().wavelength_nm, 550.0);
/// # Ok::<(), onelight_film::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct SpectralSensitivity {
    log10: Pchip,
    /// Slopes of the tails per nm: at the short end (>= 0) and at the long end (<= 0).
    slopes: (f64, f64),
    peak: SensitivityPeak,
}

/// Where a layer is most sensitive: [`SpectralSensitivity::peak`].
///
/// ```
/// use onelight_film::{SensitivityPeak, SpectralSensitivity};
/// use onelight_spectra::TablePoints;
/// let blue = SpectralSensitivity::new(TablePoints { x: vec![400.0, 450.0, 500.0], y: vec![1.1, 1.4, 0.2] })?;
/// assert_eq!(blue.peak(), SensitivityPeak { wavelength_nm: 450.0, log10: 1.4 });
/// # Ok::<(), onelight_film::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensitivityPeak {
    /// The wavelength of the highest published value in nm.
    pub wavelength_nm: f64,
    /// The published value there: log10, in the unit of the curve.
    pub log10: f64,
}

impl SpectralSensitivity {
    /// From published points: wavelength in nm and log10 of the sensitivity.
    ///
    /// # Errors
    /// If there are fewer than two nodes, or wavelengths do not increase.
    pub fn new(points: TablePoints) -> Result<Self, Error> {
        let log10 = Pchip::new(points.x, points.y)?;
        let (first, last) = log10.range().into_inner();
        let points = || log10.x().iter().copied().zip(log10.y().iter().copied());
        let low: Vec<_> = points().filter(|(nm, _)| nm - first <= TAIL_NODES_NM).collect();
        let high: Vec<_> = points().filter(|(nm, _)| last - nm <= TAIL_NODES_NM).collect();
        let slopes = (tail::slope(&low).max(LEAST_FALL_PER_NM), tail::slope(&high).min(-LEAST_FALL_PER_NM));
        let peak = points().fold((first, f64::NEG_INFINITY), |best, p| if p.1 > best.1 { p } else { best });
        let peak = SensitivityPeak { wavelength_nm: peak.0, log10: peak.1 };
        Ok(Self { log10, slopes, peak })
    }

    /// log10 of the sensitivity at a wavelength, published or not.
    #[must_use]
    pub fn log10_at(&self, wavelength_nm: f64, long_tail: Tail) -> f64 {
        let (first, last) = self.log10.range().into_inner();
        let beyond = match long_tail {
            _ if wavelength_nm < first => self.slopes.0 * (wavelength_nm - first),
            Tail::LogLinear if wavelength_nm > last => self.slopes.1 * (wavelength_nm - last),
            _ => 0.0,
        };
        (self.log10.at(wavelength_nm) + beyond).max(self.peak.log10 - DECADES)
    }

    /// The sensitivity itself (not its log10) on a grid.
    ///
    /// # Errors
    /// If the published numbers are too large for a double.
    pub fn on(&self, shape: SpectralShape, long_tail: Tail) -> Result<SpectralDistribution<Responsivity>, Error> {
        Ok(SpectralDistribution::from_fn(shape, |nm| 10f64.powf(self.log10_at(nm, long_tail)))?)
    }

    /// The published wavelengths in nm, first to last.
    #[must_use]
    pub fn range_nm(&self) -> RangeInclusive<f64> {
        self.log10.range()
    }

    /// The highest published value and its wavelength.
    #[must_use]
    pub fn peak(&self) -> SensitivityPeak {
        self.peak
    }

    /// The wavelengths of the published points in nm, increasing.
    #[must_use]
    pub fn wavelengths_nm(&self) -> &[f64] {
        self.log10.x()
    }

    /// log10 of the sensitivity at [`SpectralSensitivity::wavelengths_nm`].
    #[must_use]
    pub fn log10_values(&self) -> &[f64] {
        self.log10.y()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn sensitivity(y: [f64; 4]) -> SpectralSensitivity {
        let points = TablePoints { x: vec![500.0, 505.0, 510.0, 515.0], y: y.to_vec() };
        SpectralSensitivity::new(points).unwrap()
    }

    #[test]
    fn tails_continue_the_last_nodes() {
        let s = sensitivity([0.0, 1.0, 0.5, 0.0]);
        // Last three nodes fall by 0.1/nm; the first three rise by 0.05/nm on average.
        assert_relative_eq!(s.log10_at(525.0, Tail::LogLinear), -1.0, epsilon = 1e-12);
        assert_relative_eq!(s.log10_at(490.0, Tail::LogLinear), -0.5, epsilon = 1e-12);
        assert_relative_eq!(s.log10_at(990.0, Tail::Held), 0.0);
        assert_relative_eq!(s.log10_at(2000.0, Tail::LogLinear), 1.0 - DECADES);
    }

    #[test]
    fn a_tail_never_rises() {
        let s = sensitivity([1.0, 0.9, 1.0, 1.1]);
        assert_relative_eq!(s.log10_at(565.0, Tail::LogLinear), 1.1 - 1.0, epsilon = 1e-12);
        assert!(s.log10_at(480.0, Tail::LogLinear) < 1.0);
    }
}
