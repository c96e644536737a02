use onelight_film::{PerLayer, Tail};
use onelight_spectra::{Kelvin, SpectralDistribution, SpectralShape, black_body, quantity::Power};

use crate::error::Error;
use crate::filter::{HeatGlass, Wratten};

/// Whether the light between 780 and 1000 nm takes part in printing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Infrared {
    /// Up to 1000 nm.
    #[default]
    On,
    /// Cut at 780 nm.
    Off,
}

/// An additive printer: a 3200 K lamp whose light is split by Wratten 70, 99 and 98 behind a 2B (\[Gotanda2010\], step 5).
///
/// The default is a printer as built; its other settings show what infrared does. With the default tail infrared changes
/// nothing (dE 0.000) and taking the glass away 0.05 dE in the mean; with a held tail and no glass the calibration has no
/// solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct Printer {
    /// Whether infrared takes part.
    pub infrared: Infrared,
    /// The glass that should keep it away.
    pub glass: HeatGlass,
    /// How the print's red layer goes on beyond its published sensitivity.
    pub red_tail: Tail,
}

/// Neutral density in the red, green and blue beam.
const BEAM_DENSITY: [f64; 3] = [0.5, 0.55, 0.9];

impl Printer {
    /// The wavelengths that take part: 400 to 1000 nm by 1 nm, or to 780 nm without infrared.
    #[must_use]
    pub fn shape(self) -> SpectralShape {
        match self.infrared {
            Infrared::On => SpectralShape::by_1_nm::<400, 1000>(),
            Infrared::Off => SpectralShape::by_1_nm::<400, 780>(),
        }
    }

    /// The three beams at unit strength: power relative to the bare lamp at 560 nm.
    ///
    /// # Errors
    /// None for the built-in filters.
    pub fn beams(self) -> Result<PerLayer<SpectralDistribution<Power>>, Error> {
        let shape = self.shape();
        let common = Wratten::No2B.density(shape)?.stacked_on(&self.glass.density(shape)?);
        let lamp = black_body(Kelvin::TUNGSTEN, shape);
        let separation = PerLayer { red: Wratten::No70, green: Wratten::No99, blue: Wratten::No98 };
        separation.zip_map(PerLayer::from(BEAM_DENSITY), |filter, nd| (filter, nd)).try_map(|(filter, nd), _| {
            let grey = SpectralDistribution::from_fn(shape, |_| nd)?;
            Ok(lamp.through(&filter.density(shape)?.stacked_on(&common).stacked_on(&grey).transmittance()))
        })
    }
}

/// Strength of the three beams: what a printing lab sets in points, here as factors on [`Printer::beams`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrinterLights(pub PerLayer<f64>);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn infrared_is_the_range_beyond_780_nm() {
        assert_eq!(Printer::default().shape().last_nm(), 1000.0);
        let cut = Printer { infrared: Infrared::Off, ..Printer::default() };
        assert_eq!((cut.shape().first_nm(), cut.shape().last_nm()), (400.0, 780.0));
    }

    #[test]
    fn each_beam_is_brightest_in_its_colour() {
        let beams = Printer::default().beams().unwrap();
        let peak = |beam: &SpectralDistribution<Power>| beam.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map(|p| p.0);
        assert!(peak(&beams.red).unwrap() > 640.0);
        assert!((520.0..570.0).contains(&peak(&beams.green).unwrap()));
        assert!(peak(&beams.blue).unwrap() < 480.0);
    }
}
