//! Neighbouring pixels share dye clouds: integer taps that give white noise their correlation.

use std::f64::consts::PI;

use super::aperture::pixel_covariance;

/// What a tap of 1 is in the integer field.
const UNIT: f64 = 256.0;
/// Frequencies between 0 and Nyquist, for the root of the spectrum.
const FREQUENCIES: usize = 512;
/// Furthest pixel whose covariance counts, in standard deviations of the clouds' autocorrelation.
const REACH: f64 = 7.0;

/// Symmetric integer taps along one axis: the tap of the pixel itself, then those at distance 1, 2, and so on.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Correlation(Vec<i32>);

impl Correlation {
    /// For clouds of a Gaussian's standard deviation, integrated by pixels of `pitch_um`. The taps' own correlation is that of the pixels:
    /// their response is the root of its spectrum.
    pub(crate) fn new(pitch_um: f64, cloud_um: f64) -> Self {
        let radius = (REACH * std::f64::consts::SQRT_2 * cloud_um / pitch_um).ceil() as usize + 1;
        let variance = pixel_covariance(pitch_um, cloud_um, 0);
        let correlation: Vec<f64> = (1..=radius).map(|j| pixel_covariance(pitch_um, cloud_um, j) / variance).collect();
        let root = |i: usize| {
            let angle = PI * i as f64 / FREQUENCIES as f64;
            let waves = (1..).zip(&correlation).map(|(j, c)| 2.0 * c * (angle * f64::from(j)).cos());
            (1.0 + waves.sum::<f64>()).max(0.0).sqrt()
        };
        let roots: Vec<f64> = (0..=FREQUENCIES).map(root).collect();
        let tap = |j: usize| {
            let at = |i: usize| roots[i] * (PI * (i * j) as f64 / FREQUENCIES as f64).cos();
            let inner: f64 = (1..FREQUENCIES).map(at).sum();
            (inner + 0.5 * (at(0) + at(FREQUENCIES))) / FREQUENCIES as f64
        };
        let mut taps: Vec<i32> = (0..=radius).map(|j| (UNIT * tap(j)).round() as i32).collect();
        while taps.len() > 1 && taps.last() == Some(&0) {
            taps.pop();
        }
        Self(taps)
    }

    pub(crate) fn taps(&self) -> &[i32] {
        &self.0
    }

    pub(crate) fn radius(&self) -> usize {
        self.0.len() - 1
    }

    /// Root of the sum of squared taps: what the standard deviation of white noise is multiplied by.
    pub(crate) fn gain(&self) -> f64 {
        let square = |tap: &i32| f64::from(*tap).powi(2);
        (square(&self.0[0]) + 2.0 * self.0[1..].iter().map(square).sum::<f64>()).sqrt()
    }

    /// Sum of the taps' magnitudes: what the largest number is multiplied by at most.
    #[cfg(test)]
    pub(crate) fn largest_gain(&self) -> i64 {
        let size = |tap: &i32| i64::from(tap.abs());
        size(&self.0[0]) + 2 * self.0[1..].iter().map(size).sum::<i64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_taps_of_an_independent_implementation() {
        let reference: serde_json::Value = serde_json::from_str(include_str!("../../tests/reference.json")).unwrap();
        let kernels = reference["grain_kernel_int"].as_object().unwrap();
        assert_eq!(kernels.len(), 6);
        for (name, taps) in kernels {
            let number = |key: &str| {
                name.split_whitespace().find_map(|part| part.strip_prefix(key)).unwrap().parse::<f64>().unwrap()
            };
            // The names are rounded.
            let pitch = 24900.0 / (24900.0 / number("pitch=")).round();
            let cloud = if number("s=") > 2.0 { (1.5f64 * 1.5 + 2.5 * 2.5).sqrt() } else { 1.5 };
            let mut expected: Vec<i64> = taps.as_array().unwrap().iter().map(|t| t.as_i64().unwrap()).collect();
            expected.drain(..expected.len() / 2);
            while expected.last() == Some(&0) {
                expected.pop();
            }
            let found: Vec<i64> = Correlation::new(pitch, cloud).taps().iter().map(|t| i64::from(*t)).collect();
            assert_eq!(found, expected, "{name}");
        }
    }
}
