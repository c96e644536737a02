use nalgebra::{Matrix3, Vector3};

use crate::distribution::{Light, SpectralDistribution, quantity::Power};
use crate::error::Error;
use crate::observer::Observer;
use crate::rgb::{Chromaticity, RgbSpace};

/// Rows that take a reflectance under the white to linear RGB.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sensors {
    pub(super) rows: [Vec<f64>; 3],
    from_xyz: Matrix3<f64>,
    white_y: f64,
}

impl Sensors {
    pub(super) fn new(white: &SpectralDistribution<Power>) -> Result<Self, Error> {
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

    /// Linear RGB of a light on 380..780 nm by 1 nm.
    pub(super) fn rgb<L: Light>(&self, light: &SpectralDistribution<L>) -> [f64; 3] {
        (self.from_xyz * Observer::cie_1931().xyz(light) / self.white_y).into()
    }
}

/// What becomes of red, green and blue (columns) when `rows` see them as `reflectance`.
pub(super) fn round_trip(rows: &[Vec<f64>; 3], reflectance: &[Vec<f64>; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|i, k| rows[i].iter().zip(&reflectance[k]).map(|(a, b)| a * b).sum())
}
