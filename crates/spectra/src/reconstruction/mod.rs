//! Spectra for RGB values: step 3 of \[Gotanda2010\].

mod boxes;
#[cfg(test)]
mod optimality;
mod sensors;
mod slope;

use std::sync::OnceLock;

use nalgebra::Matrix3;

use crate::blackbody::{Kelvin, black_body};
use crate::distribution::{Light, SpectralDistribution, quantity::Power, quantity::SignedPower};
use crate::error::Error;
use crate::scene_value::finite;
use crate::shape::SpectralShape;
use sensors::{Sensors, round_trip};

/// How a spectrum is made for an RGB value (sRGB primaries about the 6500 K white). All are linear: the spectrum of a sum is the
/// sum of the spectra. How far colours on film differ by them is in docs/talk.md.
///
/// ```
/// use onelight_spectra::{Basis, Reconstruction};
/// // Reflectances that are physical, and the smoothest of all, which dip below 0.
/// let least = |which| -> Result<f64, onelight_spectra::Error> {
///     Ok(Basis::new(which)?.reflectance(0).iter().copied().fold(1.0, f64::min))
/// };
/// assert!(least(Reconstruction::Smooth)? >= 0.0 && least(Reconstruction::PseudoInverse)? < 0.0);
/// # Ok::<(), onelight_spectra::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Reconstruction {
    /// The smoothest reflectances that are nowhere negative and reproduce the RGB exactly, in the manner of
    /// \[MallettYuksel2019\]. The standard.
    #[default]
    Smooth,
    /// The smoothest that reproduce the RGB exactly, negative lobes allowed.
    PseudoInverse,
    /// Three boxes, split at 490 and 585 nm, mixed so that the RGB is reproduced exactly.
    BoxesBalanced,
    /// Three plain boxes, split at 490 and 585 nm: the "color balance not adjusted properly" of \[Gotanda2010\]. The RGB is
    /// not reproduced exactly.
    BoxesRaw,
}

impl Reconstruction {
    /// All four methods, the default first.
    pub const ALL: [Self; 4] = [Self::Smooth, Self::PseudoInverse, Self::BoxesBalanced, Self::BoxesRaw];
}

/// Three spectra, one for each of red, green and blue: reflectances under the 6500 K white, on 380..780 nm by 1 nm.
///
/// ```
/// use onelight_spectra::{Basis, Reconstruction};
/// let basis = Basis::new(Reconstruction::Smooth)?;
/// let [red, ..] = basis.rgb_of(&basis.spectrum([0.4, 0.2, 0.1]));
/// assert!((red - 0.4).abs() < 1e-9);
/// # Ok::<(), onelight_spectra::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Basis {
    /// Reflectance of each primary; the three sum to 1 at every wavelength.
    reflectance: [Vec<f64>; 3],
    white: SpectralDistribution<Power>,
    sensors: Sensors,
}

impl Basis {
    /// The basis of a reconstruction. The standard one is a table.
    ///
    /// # Errors
    /// If the solver finds no basis; none of the reconstructions here fails.
    pub fn new(reconstruction: Reconstruction) -> Result<Self, Error> {
        let white = black_body(Kelvin::WHITE, SpectralShape::VISIBLE);
        let sensors = Sensors::new(&white)?;
        let reflectance = match reconstruction {
            Reconstruction::Smooth => {
                static SMOOTH: OnceLock<Result<[Vec<f64>; 3], Error>> = OnceLock::new();
                SMOOTH.get_or_init(slope::least_non_negative).clone()?
            }
            Reconstruction::PseudoInverse => slope::least(&sensors.rows)?,
            Reconstruction::BoxesBalanced => boxes::balanced(&sensors.rows)?,
            Reconstruction::BoxesRaw => boxes::raw(),
        };
        Ok(Self { reflectance, white, sensors })
    }

    /// The reflectance that stands for one primary: 0 red, 1 green, 2 blue; 401 values, 380..780 nm.
    ///
    /// # Panics
    /// If `primary` is above 2: there are three, 0 to 2.
    #[must_use]
    pub fn reflectance(&self, primary: usize) -> &[f64] {
        &self.reflectance[primary]
    }

    /// The white of the scene: 6500 K black body, 1.0 at 560 nm.
    #[must_use]
    pub fn white(&self) -> &SpectralDistribution<Power> {
        &self.white
    }

    /// Light for a scene RGB, relative to the white at 560 nm. It may be negative at some wavelengths: for negative RGB, and
    /// with the pseudo-inverse for any; `SpectralDistribution::<Power>::try_from` tells. NaN counts as 0, infinities as
    /// ±[`SCENE_MAX`](crate::SCENE_MAX).
    #[must_use]
    pub fn spectrum(&self, scene_linear: [f64; 3]) -> SpectralDistribution<SignedPower> {
        let ([r, g, b], rgb) = (&self.reflectance, scene_linear.map(finite));
        let mix = (0..r.len()).map(|i| self.white.values()[i] * (rgb[0] * r[i] + rgb[1] * g[i] + rgb[2] * b[i]));
        SpectralDistribution::trusted(SpectralShape::VISIBLE, mix.collect())
    }

    /// The RGB of a light on 380..780 nm by 1 nm: (1, 1, 1) is the white.
    ///
    /// # Panics
    /// If the light is on another grid.
    #[must_use]
    pub fn rgb_of<L: Light>(&self, light: &SpectralDistribution<L>) -> [f64; 3] {
        self.sensors.rgb(light)
    }

    /// What becomes of red, green and blue through the spectrum and back: identity for the exact reconstructions.
    #[must_use]
    pub fn round_trip(&self) -> Matrix3<f64> {
        round_trip(&self.sensors.rows, &self.reflectance)
    }
}

#[cfg(test)]
mod tests {
    use super::optimality::Distance;
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn exact_reconstructions_reproduce_rgb() {
        for kind in [Reconstruction::Smooth, Reconstruction::PseudoInverse, Reconstruction::BoxesBalanced] {
            let basis = Basis::new(kind).unwrap();
            assert_relative_eq!(basis.round_trip(), Matrix3::identity(), epsilon = 1e-9);
            let rgb = basis.rgb_of(&basis.spectrum([0.3, 0.05, 2.0]));
            assert_relative_eq!(rgb[..], [0.3, 0.05, 2.0][..], epsilon = 1e-9);
        }
    }

    #[test]
    fn reflectances_sum_to_white() {
        for kind in Reconstruction::ALL {
            let basis = Basis::new(kind).unwrap();
            for i in 0..401 {
                let sum: f64 = (0..3).map(|k| basis.reflectance(k)[i]).sum();
                assert_relative_eq!(sum, 1.0, epsilon = 1e-9);
            }
        }
    }

    #[test]
    fn the_standard_is_physical_and_smoothest_among_neighbours() {
        let basis = Basis::new(Reconstruction::Smooth).unwrap();
        assert!((0..3).all(|k| basis.reflectance(k).iter().all(|&v| (0.0..=1.0).contains(&v))));
        let roughness = |basis: &Basis| -> f64 {
            (0..3).flat_map(|k| basis.reflectance(k).windows(2)).map(|p| (p[1] - p[0]).powi(2)).sum()
        };
        // Without the sign constraint the optimum can only be smoother; boxes can only be rougher.
        let free = Basis::new(Reconstruction::PseudoInverse).unwrap();
        let boxes = Basis::new(Reconstruction::BoxesBalanced).unwrap();
        assert!(roughness(&free) <= roughness(&basis) && roughness(&basis) < roughness(&boxes));
    }

    #[test]
    fn raw_boxes_miss_by_the_stated_matrix() {
        // Measured elsewhere in float64 at 1 nm; three decimals.
        let expected = Matrix3::new(1.121, -0.133, 0.012, 0.012, 1.037, -0.049, -0.024, -0.036, 1.060);
        assert_relative_eq!(Basis::new(Reconstruction::BoxesRaw).unwrap().round_trip(), expected, epsilon = 6e-4);
    }

    /// What the interior-point solver that made the table leaves, with a margin for machines that round otherwise: 9e-12 and 1.2e-12
    /// were found, in a sum of squares of 0.076.
    const LARGEST_GAP: f64 = 2e-11;
    const LARGEST_SLOPE: f64 = 5e-12;

    #[test]
    fn the_table_of_the_smooth_basis_is_the_solution() {
        let basis = Basis::new(Reconstruction::Smooth).unwrap();
        let sensors = &basis.sensors.rows;
        let found = Distance::of(sensors, &basis.reflectance).unwrap();
        assert!((0.0..LARGEST_GAP).contains(&found.gap) && found.slope < LARGEST_SLOPE, "{found:?}");
        // Feasible as well: the tests above hold sum, bounds and round trip.

        // The conditions find what is no solution: one value moved by 1e-8, a low hill, and other bases.
        let moved = |by: &dyn Fn(usize) -> f64| {
            let [mut red, green, mut blue] = basis.reflectance.clone();
            for (i, (red, blue)) in red.iter_mut().zip(&mut blue).enumerate() {
                (*red, *blue) = (*red + by(i), *blue - by(i));
            }
            Distance::of(sensors, &[red, green, blue]).unwrap()
        };
        let spike = moved(&|i| if i == 60 { 1e-8 } else { 0.0 });
        let hill = moved(&|i| 1e-7 * (-(i as f64 - 60.0).powi(2) / 800.0).exp());
        assert!(spike.slope > LARGEST_SLOPE && hill.slope > LARGEST_SLOPE, "{spike:?} {hill:?}");
        let boxes = Basis::new(Reconstruction::BoxesBalanced).unwrap();
        assert!(Distance::of(sensors, &boxes.reflectance).unwrap().gap > 0.1);
    }

    #[test]
    fn hard_scene_values_have_finite_spectra() {
        let basis = Basis::new(Reconstruction::PseudoInverse).unwrap();
        let hard = basis.spectrum([f64::NAN, f64::INFINITY, f64::NEG_INFINITY]);
        assert!(hard.values().iter().all(|v| v.is_finite()));
        assert_eq!(hard, basis.spectrum([0.0, 1e30, -1e30]));
        assert!(SpectralDistribution::<Power>::try_from(hard).unwrap_err().is_value());
    }
}
