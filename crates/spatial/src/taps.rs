use std::f64::consts::PI;

use crate::constant::checked;
use crate::error::Error;
use crate::mtf::gaussian_response;

/// Below this many pixels a Gaussian changes nothing that a pixel can show.
const NEGLIGIBLE: f64 = 0.05;
/// Standard deviations that are worked with, in pixels.
const SIGMAS: [f64; 2] = [0.0, 250.0];
/// Taps reach this many standard deviations.
const REACH: f64 = 4.0;
/// Intervals of Simpson's rule over a quarter period and more of the fastest cosine.
const INTERVALS: usize = 1024;

/// A symmetric blur along one axis: weights of the pixels at distance 1, 2, and so on; that of the pixel itself is what makes the sum 1.
///
/// A Gaussian's taps are not its samples. They are not negative, so that no exposure becomes negative, and among such taps those whose
/// response is nearest to the Gaussian's up to Nyquist, in least squares. Because cosines are orthogonal there, that is the point of a
/// simplex next to the Gaussian's Fourier coefficients.
///
/// ```
/// use onelight_spatial::Taps;
/// let taps = Taps::gaussian(1.4)?;
/// assert!((taps.response(0.0) - 1.0).abs() < 1e-12 && taps.side().iter().all(|tap| *tap >= 0.0));
/// assert!((taps.response(0.2) - (-2.0 * (std::f64::consts::PI * 1.4 * 0.2f64).powi(2)).exp()).abs() < 0.001);
/// # Ok::<(), onelight_spatial::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Taps(Vec<f64>);

impl Taps {
    /// For a Gaussian with a standard deviation in pixels; none below 0.05 pixels.
    ///
    /// # Errors
    /// If the standard deviation is not 0 to 250 pixels.
    pub fn gaussian(sigma_pixels: f64) -> Result<Self, Error> {
        Ok(Self::of(checked("standard deviation of a Gaussian", sigma_pixels, SIGMAS, " pixels")?))
    }

    /// For a Gaussian whose standard deviation is that of a film in checked pixels.
    pub(crate) fn of(sigma_pixels: f64) -> Self {
        if sigma_pixels < NEGLIGIBLE {
            return Self(Vec::new());
        }
        let radius = (REACH * sigma_pixels).ceil() as usize;
        let wanted: Vec<f64> = (0..=radius).map(|distance| coefficient(sigma_pixels, distance)).collect();
        let excess = excess(&wanted);
        let mut side: Vec<f64> = wanted[1..].iter().map(|c| (c - excess).max(0.0)).collect();
        while side.last() == Some(&0.0) {
            side.pop();
        }
        Self(side)
    }

    /// Weights of the pixels at distance 1, 2, and so on, on either side.
    #[must_use]
    pub fn side(&self) -> &[f64] {
        &self.0
    }

    /// Weight of the pixel itself.
    #[must_use]
    pub fn centre(&self) -> f64 {
        1.0 - 2.0 * self.0.iter().sum::<f64>()
    }

    /// Response to a sine wave of so many cycles per pixel.
    #[must_use]
    pub fn response(&self, cycles_per_pixel: f64) -> f64 {
        let waves = (1..).zip(&self.0).map(|(j, tap)| 2.0 * tap * (2.0 * PI * cycles_per_pixel * f64::from(j)).cos());
        self.centre() + waves.sum::<f64>()
    }

    /// The weights as the pixel loops use them.
    pub(crate) fn rounded(&self) -> Vec<f32> {
        self.0.iter().map(|tap| *tap as f32).collect()
    }
}

/// Fourier coefficient of a Gaussian's response, cut at Nyquist.
fn coefficient(sigma: f64, distance: usize) -> f64 {
    let at = |i: usize| {
        let cycles = 0.5 * i as f64 / INTERVALS as f64;
        gaussian_response(sigma * cycles) * (2.0 * PI * cycles * distance as f64).cos()
    };
    let inner: f64 = (1..INTERVALS).map(|i| if i % 2 == 1 { 4.0 * at(i) } else { 2.0 * at(i) }).sum();
    (at(0) + inner + at(INTERVALS)) / (3.0 * INTERVALS as f64)
}

/// What must be taken from every coefficient so that the positive ones that are left sum to 1.
fn excess(wanted: &[f64]) -> f64 {
    let mut all: Vec<f64> = wanted.iter().chain(&wanted[1..]).copied().collect();
    all.sort_by(|a, b| b.total_cmp(a));
    let (mut sum, mut excess) = (0.0, 0.0);
    for (count, tap) in (1..).zip(&all) {
        sum += tap;
        let candidate = (sum - 1.0) / f64::from(count);
        if *tap > candidate {
            excess = candidate;
        }
    }
    excess
}
