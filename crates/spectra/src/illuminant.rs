use crate::built_in::BuiltInTable;
use crate::distribution::{SpectralDistribution, quantity::Power};
use crate::error::{Error, ErrorKind};
use crate::shape::SpectralShape;
use crate::tabulated::Extrapolation;

/// A light tabulated by the CIE (\[CIE015\]).
///
/// ```
/// use onelight_spectra::{Illuminant, SpectralShape, illuminant};
/// let [tungsten, daylight] = [Illuminant::A, Illuminant::D65].map(|which| illuminant(which, SpectralShape::VISIBLE));
/// assert!(tungsten.at(450.0) < daylight.at(450.0) && tungsten.at(700.0) > daylight.at(700.0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Illuminant {
    /// Incandescent light, about 2856 K.
    A,
    /// Daylight of about 5000 K.
    D50,
    /// Daylight of about 5500 K.
    D55,
    /// Daylight of about 6500 K.
    D65,
}

impl Illuminant {
    /// The four illuminants, from the warmest to the coolest.
    pub const ALL: [Self; 4] = [Self::A, Self::D50, Self::D55, Self::D65];

    fn table(self) -> (&'static str, &'static str) {
        match self {
            Self::A => ("illuminant_a_5nm.csv", include_str!("../data/illuminant_a_5nm.csv")),
            Self::D50 => ("illuminant_d50_5nm.csv", include_str!("../data/illuminant_d50_5nm.csv")),
            Self::D55 => ("illuminant_d55_5nm.csv", include_str!("../data/illuminant_d55_5nm.csv")),
            Self::D65 => ("illuminant_d65_5nm.csv", include_str!("../data/illuminant_d65_5nm.csv")),
        }
    }
}

/// Relative power of a CIE illuminant, 1.0 at 560 nm; 5 nm table, linear between its rows as the CIE prescribes, end
/// values held beyond 300..780 nm.
///
/// ```
/// use onelight_spectra::{Illuminant, SpectralShape, illuminant};
/// let daylight = illuminant(Illuminant::D50, SpectralShape::VISIBLE);
/// assert!((daylight.values()[0] - 0.245).abs() < 0.001, "at 380 nm");
/// ```
#[must_use]
#[expect(clippy::expect_used, reason = "the tables are compiled in and a test reads them all")]
pub fn illuminant(which: Illuminant, shape: SpectralShape) -> SpectralDistribution<Power> {
    read(which, shape).expect("the built-in tables are valid")
}

fn read(which: Illuminant, shape: SpectralShape) -> Result<SpectralDistribution<Power>, Error> {
    let (source, text) = which.table();
    let mut points = BuiltInTable::parse(source, text)?.points("relative_power")?;
    // The tables are 100 at 560 nm.
    points.y.iter_mut().for_each(|v| *v /= 100.0);
    points.spectrum(shape, Extrapolation::Held)
}

/// Relative power of a cinema's xenon projector, 1.0 at 560 nm: a Kinoton 75P as measured, about 6340 K; 2 nm table, linear
/// between its rows, end values held beyond 380..780 nm.
///
/// ```
/// use onelight_spectra::{SpectralShape, xenon_lamp};
/// assert_eq!(xenon_lamp(SpectralShape::VISIBLE).at(560.0), Some(1.0));
/// ```
#[must_use]
#[expect(clippy::expect_used, reason = "the table is compiled in and a test reads it")]
pub fn xenon_lamp(shape: SpectralShape) -> SpectralDistribution<Power> {
    read_xenon(shape).expect("the built-in table is valid")
}

fn read_xenon(shape: SpectralShape) -> Result<SpectralDistribution<Power>, Error> {
    let (source, text) = ("xenon_projector_kinoton_75p.csv", include_str!("../data/xenon_projector_kinoton_75p.csv"));
    let mut points = BuiltInTable::parse(source, text)?.points("relative_power")?;
    let missing = || ErrorKind::Table { source, line: 1, problem: "no value at 560 nm".to_owned() };
    let reference = points.at(560.0).ok_or_else(missing)?;
    points.y.iter_mut().for_each(|v| *v /= reference);
    points.spectrum(shape, Extrapolation::Held)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Observer;
    use approx::assert_relative_eq;

    #[test]
    fn white_points_are_the_published_ones() {
        // [CIE015], 2 degree observer. D65 to four digits; the 380..780 nm grid leaves A and D50 one digit less.
        let published = [(0.44758, 0.40745), (0.34567, 0.35851), (0.33243, 0.34744), (0.31271, 0.32902)];
        for (which, (x, y)) in Illuminant::ALL.into_iter().zip(published) {
            let xyz = Observer::cie_1931().xyz(&read(which, SpectralShape::VISIBLE).unwrap());
            assert_relative_eq!(xyz.x / xyz.sum(), x, epsilon = 5e-5);
            assert_relative_eq!(xyz.y / xyz.sum(), y, epsilon = 5e-5);
        }
    }

    #[test]
    fn xenon_is_a_little_warmer_than_daylight() {
        let lamp = read_xenon(SpectralShape::VISIBLE).unwrap();
        let xyz = Observer::cie_1931().xyz(&lamp);
        // Computed from the same table elsewhere.
        assert_relative_eq!(xyz.x / xyz.sum(), 0.3153, epsilon = 1e-4);
        assert_relative_eq!(xyz.y / xyz.sum(), 0.3329, epsilon = 1e-4);
        assert_relative_eq!(lamp.at(560.0).unwrap(), 1.0);
    }

    #[test]
    fn unit_at_560_nm() {
        for which in Illuminant::ALL {
            assert_relative_eq!(illuminant(which, SpectralShape::VISIBLE).at(560.0).unwrap(), 1.0, epsilon = 1e-4);
        }
    }
}
