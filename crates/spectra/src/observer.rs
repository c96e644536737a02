use std::sync::OnceLock;

use nalgebra::Vector3;

use crate::built_in::BuiltInTable;
use crate::distribution::{Light, SpectralDistribution, quantity::Responsivity};
use crate::error::Error;
use crate::shape::SpectralShape;
use crate::tabulated::Extrapolation;

const TABLE: &str = include_str!("../data/cie_1931_2deg_1nm.csv");

/// The CIE 1931 2 degree colour-matching functions on a grid (\[CIE015\]; 1 nm table, linear between its rows, 0 outside
/// 360..830 nm).
///
/// ```
/// use onelight_spectra::{Observer, illuminant, Illuminant, SpectralShape};
/// let eye = Observer::cie_1931();
/// let xyz = eye.xyz(&illuminant(Illuminant::D65, SpectralShape::VISIBLE));
/// assert!((xyz.x / xyz.sum() - 0.3127).abs() < 5e-5);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Observer {
    matching: [SpectralDistribution<Responsivity>; 3],
}

impl Observer {
    /// The observer on 380..780 nm by 1 nm.
    #[must_use]
    pub fn cie_1931() -> &'static Self {
        static OBSERVER: OnceLock<Observer> = OnceLock::new();
        OBSERVER.get_or_init(|| Self::on(SpectralShape::VISIBLE))
    }

    /// The observer on the grid of the light to be seen.
    #[must_use]
    #[expect(clippy::expect_used, reason = "the table is compiled in and a test reads it")]
    pub fn on(shape: SpectralShape) -> Self {
        Self::read(shape).expect("the built-in table is valid")
    }

    fn read(shape: SpectralShape) -> Result<Self, Error> {
        let table = BuiltInTable::parse("cie_1931_2deg_1nm.csv", TABLE)?;
        let column = |name: &str| table.points(name)?.spectrum(shape, Extrapolation::Zero);
        Ok(Self { matching: [column("x_bar")?, column("y_bar")?, column("z_bar")?] })
    }

    /// The three functions: x bar, y bar, z bar.
    #[must_use]
    pub fn matching_functions(&self) -> &[SpectralDistribution<Responsivity>; 3] {
        &self.matching
    }

    /// Tristimulus values: the integral of power times each function over nm, not normalised.
    ///
    /// # Panics
    /// If the light is not on the grid of the observer.
    #[must_use]
    pub fn xyz<L: Light>(&self, light: &SpectralDistribution<L>) -> Vector3<f64> {
        let [x, y, z] = &self.matching;
        Vector3::new(light.response(x), light.response(y), light.response(z))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn table_sums_are_the_published_ones() {
        // [CIE015]: sums over 360..830 nm at 1 nm.
        let shape = SpectralShape::new(360, 830, 1).unwrap();
        let observer = Observer::read(shape).unwrap();
        let sums: Vec<f64> = observer.matching.iter().map(|f| f.values().iter().sum()).collect();
        for (sum, published) in sums.iter().zip([106.865_469, 106.856_917, 106.892_251]) {
            assert_relative_eq!(*sum, published, epsilon = 5e-7);
        }
    }
}
