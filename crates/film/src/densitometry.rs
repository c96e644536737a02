use std::sync::OnceLock;

use onelight_spectra::quantity::Transmittance;
use onelight_spectra::{Illuminant, Observer, SpectralDistribution, SpectralShape, illuminant, quantity::Responsivity};

use crate::error::Error;
use crate::layer::PerLayer;
use crate::quantity::Density;
use crate::table::NumberTable;

/// Which densitometer a density was read with (\[ISO5-3\]): the same film has other densities by another.
///
/// ```
/// use onelight_film::Densitometry;
/// // Status M looks for red further up the spectrum than status A.
/// let red = |which: Densitometry| which.responses().red.iter().map(|(nm, weight)| nm * weight).sum::<f64>();
/// assert!(red(Densitometry::StatusM) > red(Densitometry::StatusA));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Densitometry {
    /// Status M: for negatives, which are to be printed.
    StatusM,
    /// Status A: for prints and reversal film, which are to be looked at.
    StatusA,
    /// Visual: for silver. The eye of the CIE in the light of illuminant A, the same in all three channels.
    Visual,
}

impl Densitometry {
    /// Red, green and blue density of a film: D = -log10(sum R T / sum R).
    ///
    /// ```
    /// use onelight_film::Densitometry;
    /// use onelight_spectra::{SpectralDistribution, SpectralShape, quantity::OpticalDensity};
    /// let neutral = SpectralDistribution::<OpticalDensity>::from_fn(SpectralShape::VISIBLE, |_| 0.7)?;
    /// let d = Densitometry::StatusA.density(&neutral.transmittance());
    /// assert!((d.green.0 - 0.7).abs() < 1e-12);
    /// # Ok::<(), onelight_spectra::Error>(())
    /// ```
    ///
    /// # Panics
    /// If the film is not on 380..780 nm by 1 nm.
    #[must_use]
    pub fn density(self, film: &SpectralDistribution<Transmittance>) -> PerLayer<Density> {
        assert_eq!(film.shape(), SpectralShape::VISIBLE, "densitometry needs the visible grid");
        self.responses().as_ref().map(|r| {
            let passed: f64 = r.values().iter().zip(film.values()).map(|(r, t)| r * t).sum();
            Density(-passed.max(f64::MIN_POSITIVE).log10())
        })
    }

    /// The three spectral responses on 380..780 nm by 1 nm, each summing to 1; linear in log10 between the nodes of the
    /// standard's table, 0 outside it.
    #[must_use]
    pub fn responses(self) -> &'static PerLayer<SpectralDistribution<Responsivity>> {
        static M: OnceLock<PerLayer<SpectralDistribution<Responsivity>>> = OnceLock::new();
        static A: OnceLock<PerLayer<SpectralDistribution<Responsivity>>> = OnceLock::new();
        static VISUAL: OnceLock<PerLayer<SpectralDistribution<Responsivity>>> = OnceLock::new();
        let (kept, source, text) = match self {
            Self::StatusM => (&M, "status_m_log10.csv", include_str!("../data/status_m_log10.csv")),
            Self::StatusA => (&A, "status_a_log10.csv", include_str!("../data/status_a_log10.csv")),
            #[expect(clippy::expect_used, reason = "the tables are compiled in and a test reads them")]
            Self::Visual => return VISUAL.get_or_init(|| visual().expect("the built-in tables are valid")),
        };
        #[expect(clippy::expect_used, reason = "the tables are compiled in and a test reads both")]
        kept.get_or_init(|| read(source, text).expect("the built-in tables are valid"))
    }
}

/// Luminous efficiency times the power of illuminant A.
fn visual() -> Result<PerLayer<SpectralDistribution<Responsivity>>, Error> {
    let shape = SpectralShape::VISIBLE;
    let light = illuminant(Illuminant::A, shape);
    let [_, y, _] = Observer::cie_1931().matching_functions();
    let seen: Vec<f64> = y.values().iter().zip(light.values()).map(|(y, light)| y * light).collect();
    let sum: f64 = seen.iter().sum();
    let seen: SpectralDistribution<Responsivity> =
        SpectralDistribution::from_fn(shape, |nm| seen[(nm - shape.first_nm()) as usize] / sum)?;
    Ok(PerLayer::all(seen))
}

fn read(source: &str, text: &str) -> Result<PerLayer<SpectralDistribution<Responsivity>>, Error> {
    let table = NumberTable::parse(source, text)?;
    PerLayer::all(()).try_map(|(), layer| {
        let points = table.points("wavelength_nm", layer)?;
        let response = |nm: f64| points.at(nm).map_or(0.0, |log10| 10f64.powf(log10));
        let sum: f64 = SpectralShape::VISIBLE.wavelengths_nm().map(response).sum();
        Ok(SpectralDistribution::from_fn(SpectralShape::VISIBLE, |nm| response(nm) / sum)?)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use onelight_spectra::quantity::OpticalDensity;

    #[test]
    fn a_neutral_filter_adds_its_density() {
        let shape = SpectralShape::VISIBLE;
        let film = SpectralDistribution::<OpticalDensity>::from_fn(shape, |nm| (nm / 90.0).sin().abs()).unwrap();
        let grey = SpectralDistribution::<OpticalDensity>::from_fn(shape, |_| 1.5).unwrap();
        for kind in [Densitometry::StatusM, Densitometry::StatusA, Densitometry::Visual] {
            let alone = kind.density(&film.transmittance());
            let both = kind.density(&film.stacked_on(&grey).transmittance());
            for (a, b) in alone.to_array().into_iter().zip(both.to_array()) {
                assert_relative_eq!(a.0 + 1.5, b.0, epsilon = 1e-12);
            }
        }
    }

    #[test]
    fn each_channel_sees_its_own_third_of_the_spectrum() {
        for kind in [Densitometry::StatusM, Densitometry::StatusA] {
            let mean = kind.responses().as_ref().map(|r| r.iter().map(|(nm, v)| nm * v).sum::<f64>());
            assert!(mean.red > 610.0 && (510.0..570.0).contains(&mean.green) && mean.blue < 470.0, "{mean:?}");
        }
    }
}
