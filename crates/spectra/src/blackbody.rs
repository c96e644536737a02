use crate::distribution::{SpectralDistribution, quantity::Power};
use crate::error::{Error, ErrorKind};
use crate::shape::SpectralShape;

/// Second radiation constant hc/k in nm K, from the exact SI constants.
const C2_NM_K: f64 = 1.438_776_877_503_933_8e7;
/// First radiation constant for radiance, 2hc^2: W/(m^2 sr nm) when divided by nm^5.
const C1L: f64 = 1.191_042_972_397_188_4e20;

/// A temperature at which a body glows, 500 K to 100000 K.
///
/// ```
/// use onelight_spectra::Kelvin;
/// assert_eq!(Kelvin::new(3200.0)?.value(), 3200.0);
/// assert!(Kelvin::new(-5.0).is_err());
/// # Ok::<(), onelight_spectra::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct Kelvin(f64);

impl Kelvin {
    /// The white of the model: \[Gotanda2010\] takes the 6500 K black body for white.
    pub const WHITE: Self = Self(6500.0);
    /// The lamp of printers and tungsten studio light.
    pub const TUNGSTEN: Self = Self(3200.0);
    /// The light of a cinema screen.
    pub const THEATRE: Self = Self(5500.0);

    /// A colour temperature of so many kelvin.
    ///
    /// # Errors
    /// Outside 500 K to 100000 K.
    pub fn new(kelvin: f64) -> Result<Self, Error> {
        if (500.0..=100_000.0).contains(&kelvin) {
            Ok(Self(kelvin))
        } else {
            Err(ErrorKind::Temperature { found: kelvin }.into())
        }
    }

    /// The temperature as a number of kelvin, 500 to 100000.
    #[must_use]
    pub fn value(self) -> f64 {
        self.0
    }
}

/// Spectral radiance of a black body in W/(m^2 sr nm), Planck's law with the exact SI constants; 0 for wavelengths that
/// are not above 0.
///
/// ```
/// use onelight_spectra::{Kelvin, planck_radiance};
/// // Wien: the 5000 K body is brightest at 2897.77 um K / 5000 K = 579.6 nm.
/// let t = Kelvin::new(5000.0)?;
/// assert!(planck_radiance(t, 579.6) > planck_radiance(t, 575.0).max(planck_radiance(t, 584.0)));
/// # Ok::<(), onelight_spectra::Error>(())
/// ```
#[must_use]
pub fn planck_radiance(temperature: Kelvin, wavelength_nm: f64) -> f64 {
    let radiance = C1L / wavelength_nm.powi(5) / (C2_NM_K / (wavelength_nm * temperature.0)).exp_m1();
    // The law goes to 0 at both ends of the spectrum, where its factors leave the range of a double.
    if wavelength_nm > 0.0 && radiance.is_finite() { radiance } else { 0.0 }
}

/// Relative power of a black body, 1.0 at 560 nm.
///
/// ```
/// use onelight_spectra::{Kelvin, SpectralShape, black_body};
/// let lamp = black_body(Kelvin::TUNGSTEN, SpectralShape::VISIBLE);
/// assert_eq!(lamp.at(560.0), Some(1.0));
/// assert!(lamp.at(700.0) > Some(1.6), "reddish light");
/// ```
#[must_use]
pub fn black_body(temperature: Kelvin, shape: SpectralShape) -> SpectralDistribution<Power> {
    let reference = planck_radiance(temperature, 560.0);
    let values = shape.wavelengths_nm().map(|nm| planck_radiance(temperature, nm) / reference).collect();
    SpectralDistribution::trusted(shape, values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// CODATA: Wien displacement constant in nm K and Stefan-Boltzmann constant in W/(m^2 K^4).
    const WIEN_NM_K: f64 = 2.897_771_955e6;
    const STEFAN_BOLTZMANN: f64 = 5.670_374_419e-8;

    #[test]
    fn peak_follows_wien() {
        for kelvin in [2000.0, 3200.0, 6500.0, 12000.0] {
            let t = Kelvin::new(kelvin).unwrap();
            let peak = WIEN_NM_K / kelvin;
            let at = |nm: f64| planck_radiance(t, nm);
            // The derivative changes sign within a hundred-thousandth of Wien's wavelength.
            assert!(at(peak * (1.0 - 1e-5)) < at(peak) && at(peak * (1.0 + 1e-5)) < at(peak), "{kelvin} K");
        }
    }

    #[test]
    fn radiance_goes_to_0_at_both_ends() {
        for kelvin in [500.0, 6500.0, 100_000.0] {
            let t = Kelvin::new(kelvin).unwrap();
            let ends =
                [f64::NEG_INFINITY, -560.0, -0.0, 0.0, 5e-324, 1e-70, 1e-3, 1e100, f64::MAX, f64::INFINITY, f64::NAN];
            for nm in ends {
                assert!((0.0..1e-80).contains(&planck_radiance(t, nm)), "{nm} nm");
            }
        }
    }

    #[test]
    fn total_follows_stefan_and_boltzmann() {
        for kelvin in [1000.0, 3200.0, 6500.0] {
            let t = Kelvin::new(kelvin).unwrap();
            // pi * integral of radiance, in ln(wavelength) by the trapezoid rule over 10^1.5 .. 10^8 nm.
            let (from, to, n) = (30f64.ln(), 1e8f64.ln(), 20_000);
            let h = (to - from) / f64::from(n);
            let sum: f64 = (0..=n).map(|i| (from + h * f64::from(i)).exp()).map(|nm| planck_radiance(t, nm) * nm).sum();
            assert_relative_eq!(std::f64::consts::PI * sum * h, STEFAN_BOLTZMANN * kelvin.powi(4), max_relative = 1e-7);
        }
    }
}
