use onelight_film::NumberTable;
use onelight_spectra::{Pchip, SpectralDistribution, SpectralShape, quantity::OpticalDensity};

use crate::error::Error;

/// A Kodak Wratten gelatin filter (\[KodakB3\]).
///
/// ```
/// use onelight_printing::Wratten;
/// use onelight_spectra::SpectralShape;
/// let red = Wratten::No70.density(SpectralShape::VISIBLE)?;
/// assert!(red.at(690.0) < Some(0.5) && red.at(550.0) > Some(2.0));
/// # Ok::<(), onelight_printing::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Wratten {
    /// No. 70: the red separation filter for printing.
    No70,
    /// No. 99: the green separation filter for printing.
    No99,
    /// No. 98: the blue separation filter for printing.
    No98,
    /// No. 2B: absorbs ultraviolet light, which films are sensitive to.
    No2B,
}

/// Density of the cells that the chart leaves blank between a filter's first and last value: the chart ends there.
const CHART_LIMIT: f64 = 3.0;

impl Wratten {
    /// The four filters of a printer: red, green, blue, ultraviolet.
    pub const ALL: [Self; 4] = [Self::No70, Self::No99, Self::No98, Self::No2B];

    fn column(self) -> &'static str {
        match self {
            Self::No70 => "W70",
            Self::No99 => "W99",
            Self::No98 => "W98",
            Self::No2B => "W2B",
        }
    }

    /// Density on a wavelength grid: monotone cubic through the chart's values, 3.0 where it stops, end values held outside
    /// 300..895 nm.
    ///
    /// # Errors
    /// None for the built-in chart; a test reads all of it.
    pub fn density(self, shape: SpectralShape) -> Result<SpectralDistribution<OpticalDensity>, Error> {
        let text = include_str!("../data/wratten_printing_set.csv");
        let table = NumberTable::parse("wratten_printing_set.csv", text)?;
        // The chart's values, and its limit wherever it is blank between the first and the last of them.
        let published = table.points("wavelength_nm", self.column())?;
        let ends = published.x[0]..=published.x[published.x.len() - 1];
        let chart = table.column("wavelength_nm")?.iter().zip(table.column(self.column())?);
        let chart = chart.filter_map(|(nm, density)| Some((*nm.as_ref()?, density.unwrap_or(CHART_LIMIT))));
        let (nm, density) = chart.filter(|(nm, _)| ends.contains(nm)).unzip();
        let curve = Pchip::new(nm, density)?;
        Ok(SpectralDistribution::from_fn(shape, |nm| curve.at(nm))?)
    }
}

/// Heat-absorbing glass between lamp and film. The curve of Kodak's No. 2043 is not published; these are stand-ins with
/// T = 0.001 + 0.899 / (1 + exp((nm - edge) / 8)).
///
/// ```
/// use onelight_printing::HeatGlass;
/// use onelight_spectra::SpectralShape;
/// let glass = HeatGlass::No2043.density(SpectralShape::by_1_nm::<400, 1000>())?;
/// assert!(glass.at(550.0) < Some(0.05) && glass.at(900.0) > Some(2.9));
/// # Ok::<(), onelight_printing::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum HeatGlass {
    /// None: the lamp's infrared reaches the film.
    None,
    /// A weaker glass, edge at 760 nm.
    Weak,
    /// The stand-in for No. 2043, edge at 725 nm.
    #[default]
    No2043,
}

impl HeatGlass {
    /// Density of the glass on a wavelength grid; 0 without one.
    ///
    /// # Errors
    /// None; the signature is that of the distribution.
    pub fn density(self, shape: SpectralShape) -> Result<SpectralDistribution<OpticalDensity>, Error> {
        let edge_nm = match self {
            Self::None => return Ok(SpectralDistribution::from_fn(shape, |_| 0.0)?),
            Self::Weak => 760.0,
            Self::No2043 => 725.0,
        };
        let transmittance = |nm: f64| 0.001 + 0.899 / (1.0 + ((nm - edge_nm) / 8.0).exp());
        Ok(SpectralDistribution::from_fn(shape, |nm| -transmittance(nm).log10())?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn separation_filters_pass_their_own_third() {
        let shape = SpectralShape::new(400, 1000, 1).unwrap();
        let passes = |filter: Wratten, nm: f64| filter.density(shape).unwrap().at(nm).unwrap() < 1.0;
        assert!(passes(Wratten::No70, 690.0) && !passes(Wratten::No70, 600.0));
        assert!(passes(Wratten::No99, 545.0) && !passes(Wratten::No99, 450.0) && !passes(Wratten::No99, 650.0));
        assert!(passes(Wratten::No98, 440.0) && !passes(Wratten::No98, 550.0));
        // The gelatins open again in the infrared: why heat glass is needed.
        assert!(passes(Wratten::No98, 850.0) && passes(Wratten::No99, 850.0));
        for filter in Wratten::ALL {
            assert!(filter.density(shape).unwrap().values().iter().all(|d| (0.0..=CHART_LIMIT).contains(d)));
        }
    }
}
