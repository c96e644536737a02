use crate::distribution::{Quantity, SpectralDistribution};
use crate::error::Error;
use crate::linear::linear_at;
use crate::shape::SpectralShape;

/// How a table of values over wavelength goes on beyond its first and last wavelength.
///
/// ```
/// use onelight_spectra::{Extrapolation, SpectralShape, TablePoints, quantity::Power};
/// let lamp = TablePoints { x: vec![400.0, 700.0], y: vec![2.0, 5.0] };
/// let held = lamp.spectrum::<Power>(SpectralShape::VISIBLE, Extrapolation::Held)?;
/// let zero = lamp.spectrum::<Power>(SpectralShape::VISIBLE, Extrapolation::Zero)?;
/// assert_eq!((held.at(780.0), zero.at(780.0)), (Some(5.0), Some(0.0)));
/// # Ok::<(), onelight_spectra::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extrapolation {
    /// As 0: what the table leaves out is taken to be nothing.
    Zero,
    /// As the value at the nearer end.
    Held,
}

/// Points of a measured or published curve, such as two columns of a table.
///
/// ```
/// use onelight_spectra::TablePoints;
/// let points = TablePoints { x: vec![400.0, 500.0, 600.0], y: vec![1.0, 0.0, 4.0] };
/// assert_eq!((points.at(450.0), points.at(601.0)), (Some(0.5), None));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct TablePoints {
    /// Abscissae, which must increase: wavelengths in nm, or log10 exposures.
    pub x: Vec<f64>,
    /// Ordinates, one for each abscissa, in the unit of the table.
    pub y: Vec<f64>,
}

impl TablePoints {
    /// The value at `x`, linear between the points, `None` outside them.
    #[must_use]
    pub fn at(&self, x: f64) -> Option<f64> {
        // As many as have both: the fields are open.
        linear_at(|i| self.x[i], &self.y[..self.y.len().min(self.x.len())], x)
    }

    /// The points brought to a wavelength grid, `x` being nm: linear between them, as the CIE prescribes for its illuminants
    /// and colour-matching functions.
    ///
    /// # Errors
    /// If a value is not allowed for `Q`.
    pub fn spectrum<Q: Quantity>(
        &self,
        shape: SpectralShape,
        extrapolation: Extrapolation,
    ) -> Result<SpectralDistribution<Q>, Error> {
        let held = |nm: f64| match (self.x.first(), &self.y[..]) {
            (Some(&first), [low, ..]) if nm < first => *low,
            (_, [.., high]) => *high,
            _ => 0.0,
        };
        SpectralDistribution::from_fn(shape, |nm| match (self.at(nm), extrapolation) {
            (Some(value), _) => value,
            (None, Extrapolation::Zero) => 0.0,
            (None, Extrapolation::Held) => held(nm),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distribution::quantity::Power;

    fn nodes(x: &[f64], y: &[f64]) -> TablePoints {
        TablePoints { x: x.to_vec(), y: y.to_vec() }
    }

    #[test]
    fn a_line_through_uneven_nodes_stays_a_line() {
        let line = nodes(&[0.0, 1.0, 1.5, 7.0, 8.0], &[3.0, 5.0, 6.0, 17.0, 19.0]);
        for i in 0..=80 {
            let x = f64::from(i) / 10.0;
            assert!((line.at(x).unwrap() - (3.0 + 2.0 * x)).abs() < 1e-12, "{x}");
        }
        assert_eq!([line.at(-1e-9), line.at(8.1), line.at(f64::NAN)], [None; 3]);
    }

    #[test]
    fn corners_lie_at_the_nodes() {
        let bent = nodes(&[400.0, 500.0, 600.0], &[1.0, 0.0, 4.0]);
        assert_eq!([400.0, 450.0, 500.0, 525.0, 600.0].map(|x| bent.at(x)), [1.0, 0.5, 0.0, 1.0, 4.0].map(Some));
        assert_eq!(nodes(&[5.0], &[2.0]).at(5.0), Some(2.0));
        assert_eq!(nodes(&[], &[]).at(5.0), None);
        assert_eq!(nodes(&[1.0, 2.0, 3.0], &[7.0, 9.0]).at(2.5), None);
    }

    #[test]
    fn beyond_the_ends_is_what_is_asked_for() {
        let table = nodes(&[400.0, 700.0], &[2.0, 5.0]);
        let on =
            |extrapolation| table.spectrum::<Power>(SpectralShape::VISIBLE, extrapolation).unwrap().values().to_vec();
        let (zero, held) = (on(Extrapolation::Zero), on(Extrapolation::Held));
        assert_eq!((zero[0], zero[20], zero[320], zero[400]), (0.0, 2.0, 5.0, 0.0));
        assert_eq!((held[0], held[20], held[320], held[400]), (2.0, 2.0, 5.0, 5.0));
    }
}
