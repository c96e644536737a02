//! Spectra for RGB values: step 3 of \[Gotanda2010\].

mod boxes;
#[cfg(test)]
mod programme;
mod slope;

use std::sync::OnceLock;

use nalgebra::{Matrix3, Vector3};

use crate::blackbody::{Kelvin, black_body};
use crate::distribution::{SpectralDistribution, quantity::Power};
use crate::error::Error;
use crate::observer::Observer;
use crate::rgb::{Chromaticity, RgbSpace};
use crate::shape::SpectralShape;

/// How a spectrum is made for an RGB value (sRGB primaries about the 6500 K white). All are linear.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Reconstruction {
    /// The smoothest reflectances that are nowhere negative and reproduce the RGB exactly, in the manner of
    /// \[MallettYuksel2019\]. The standard.
    #[default]
    Smooth,
    /// The smoothest that reproduce the RGB exactly, negative lobes allowed: 1.7 to 2.3 dE from the standard in the
    /// mean.
    PseudoInverse,
    /// Three boxes mixed so that the RGB is reproduced exactly: 0.8 to 1.0 dE from the standard in the mean.
    BoxesBalanced,
    /// Three plain boxes, split at 490 and 585 nm: the "color balance not adjusted properly" of \[Gotanda2010\].
    BoxesRaw,
}

impl Reconstruction {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Smooth, Self::PseudoInverse, Self::BoxesBalanced, Self::BoxesRaw];
}

/// Three spectra, one for each of red, green and blue: reflectances under the 6500 K white, on 380..780 nm by 1 nm.
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
    /// If `primary > 2`.
    #[must_use]
    pub fn reflectance(&self, primary: usize) -> &[f64] {
        &self.reflectance[primary]
    }

    /// The white of the scene: 6500 K black body, 1.0 at 560 nm.
    #[must_use]
    pub fn white(&self) -> &SpectralDistribution<Power> {
        &self.white
    }

    /// Light for a scene RGB (not negative for physical light; the pseudo-inverse may still go below 0), relative to
    /// the white at 560 nm.
    #[must_use]
    pub fn spectrum(&self, rgb: [f64; 3]) -> SpectralDistribution<Power> {
        let [r, g, b] = &self.reflectance;
        let mix = (0..r.len()).map(|i| self.white.values()[i] * (rgb[0] * r[i] + rgb[1] * g[i] + rgb[2] * b[i]));
        SpectralDistribution::trusted(SpectralShape::VISIBLE, mix.collect())
    }

    /// The RGB of a light on 380..780 nm by 1 nm: (1, 1, 1) is the white.
    ///
    /// # Panics
    /// If the light is on another grid.
    #[must_use]
    pub fn rgb_of(&self, light: &SpectralDistribution<Power>) -> Vector3<f64> {
        self.sensors.rgb(light)
    }

    /// What becomes of red, green and blue through the spectrum and back: identity for the exact reconstructions.
    #[must_use]
    pub fn round_trip(&self) -> Matrix3<f64> {
        round_trip(&self.sensors.rows, &self.reflectance)
    }
}

/// Rows that take a reflectance under the white to linear RGB.
#[derive(Debug, Clone, PartialEq)]
struct Sensors {
    rows: [Vec<f64>; 3],
    from_xyz: Matrix3<f64>,
    white_y: f64,
}

impl Sensors {
    fn new(white: &SpectralDistribution<Power>) -> Result<Self, Error> {
        let observer = Observer::cie_1931();
        let from_xyz = RgbSpace::SRGB.with_white(Chromaticity::black_body_6500_k()).from_xyz()?;
        let white_y = observer.xyz(white).y;
        let [x, y, z] = observer.matching_functions();
        let weights: Vec<f64> = white.shape().trapezoid_weights_nm().collect();
        let row = |k: usize| {
            (0..weights.len())
                .map(|i| {
                    let rgb = from_xyz * Vector3::new(x.values()[i], y.values()[i], z.values()[i]);
                    rgb[k] * weights[i] * white.values()[i] / white_y
                })
                .collect()
        };
        Ok(Self { rows: [row(0), row(1), row(2)], from_xyz, white_y })
    }

    fn rgb(&self, light: &SpectralDistribution<Power>) -> Vector3<f64> {
        self.from_xyz * Observer::cie_1931().xyz(light) / self.white_y
    }
}

fn round_trip(rows: &[Vec<f64>; 3], reflectance: &[Vec<f64>; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|i, k| rows[i].iter().zip(&reflectance[k]).map(|(a, b)| a * b).sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn exact_reconstructions_reproduce_rgb() {
        for kind in [Reconstruction::Smooth, Reconstruction::PseudoInverse, Reconstruction::BoxesBalanced] {
            let basis = Basis::new(kind).unwrap();
            assert_relative_eq!(basis.round_trip(), Matrix3::identity(), epsilon = 1e-9);
            let rgb = basis.rgb_of(&basis.spectrum([0.3, 0.05, 2.0]));
            assert_relative_eq!(rgb, Vector3::new(0.3, 0.05, 2.0), epsilon = 1e-9);
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
}
