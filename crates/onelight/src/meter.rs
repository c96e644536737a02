//! How bright a picture is, as a photographer meters it.

use crate::scene::MID_GREY;

/// The share of lit pixels that may be highlights.
const HIGHLIGHTS: f64 = 0.02;
/// Stops below the highlights that count in full: about what a print shows.
const FULL_STOPS: f64 = 6.0;
/// Stops below the highlights that count no more.
const NO_STOPS: f64 = 10.0;
/// The least log2 luminance that is told from less, and the steps from there to the largest float.
const LOWEST: f64 = -150.0;
const STEP: f64 = 1.0 / 256.0;
const STEPS: usize = 280 * 256;

/// A light meter for whole pictures.
///
/// Metered is the log average of the pixels that lie not far below the brightest but a few (2 %): they count in full down to 6 stops
/// below these, and less and less down to 10. So a photographer meters what the picture is about: neither a black background,
/// whose noise rules an average of all logarithms, nor lamps and the sun, which rule an average of light. docs/using.md compares
/// them. Pixels are counted in steps of 1/256 stop, so that the result depends on no order.
///
/// ```
/// use onelight::Meter;
/// let mut meter = Meter::default();
/// // Two stops under an 18 % grey card.
/// (0..100).for_each(|_| meter.add(0.045));
/// assert!((meter.exposure() - 2.0).abs() < 0.01);
/// assert_eq!(meter.histogram([-4.0, 4.0], 8), [0, 0, 100, 0, 0, 0, 0, 0]);
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Meter {
    /// Pixels that have luminance.
    lit: u64,
    /// How many of them have each log2 luminance, in steps of [`STEP`] from [`LOWEST`].
    steps: Vec<u64>,
}

impl Meter {
    /// Shows it one pixel of scene-linear light. What is not above 0 or not finite is not lit.
    pub fn add(&mut self, luminance: f64) {
        if luminance > 0.0 && luminance.is_finite() {
            self.add_log2(luminance.log2());
        }
    }

    /// The same by the log2 of its luminance, which is finite.
    pub fn add_log2(&mut self, log2: f64) {
        if self.steps.is_empty() {
            self.steps.resize(STEPS, 0);
        }
        let step = ((log2 - LOWEST) / STEP).round().max(0.0) as usize;
        self.steps[step.min(STEPS - 1)] += 1;
        self.lit += 1;
    }

    /// Stops from mid grey to what is metered; `None` where there is no light.
    #[must_use]
    pub fn stops_off(&self) -> Option<f64> {
        let highlights = (self.lit as f64 * HIGHLIGHTS) as u64;
        let mut above = 0;
        let brightest = self.steps.iter().rposition(|count| {
            above += count;
            above > highlights
        })?;
        let metered = self.steps.iter().enumerate().map(|(step, count)| {
            let below = log2(brightest) - log2(step);
            let weight = ((NO_STOPS - below) / (NO_STOPS - FULL_STOPS)).clamp(0.0, 1.0) * *count as f64;
            (weight, weight * log2(step))
        });
        let (weights, sum) = metered.fold((0.0, 0.0), |(weights, sum), (weight, log)| (weights + weight, sum + log));
        Some(sum / weights - MID_GREY.log2())
    }

    /// The exposure in stops that brings what is metered to mid grey; 0 where there is no light.
    #[must_use]
    pub fn exposure(&self) -> f64 {
        self.stops_off().map_or(0.0, |off| -off)
    }

    /// Lit pixels in `bins` even parts of a range of stops about mid grey; what lies outside is in the first and the last.
    #[must_use]
    pub fn histogram(&self, [low, high]: [f64; 2], bins: usize) -> Vec<u64> {
        let mut counts = vec![0; bins];
        for (step, count) in self.steps.iter().enumerate().filter(|(_, count)| **count > 0) {
            let place = (log2(step) - MID_GREY.log2() - low) / (high - low) * bins as f64;
            if let Some(bin) = counts.get_mut((place.max(0.0) as usize).min(bins.saturating_sub(1))) {
                *bin += count;
            }
        }
        counts
    }
}

/// The log2 luminance of a step.
fn log2(step: usize) -> f64 {
    LOWEST + step as f64 * STEP
}

#[cfg(test)]
mod tests {
    use super::*;

    fn metered(logs: impl Iterator<Item = f64>) -> f64 {
        let mut meter = Meter::default();
        logs.for_each(|log| meter.add_log2(log));
        meter.exposure()
    }

    /// Stops about mid grey, evenly spread.
    fn ramp(count: usize, stops: f64) -> impl Iterator<Item = f64> {
        (0..count).map(move |i| MID_GREY.log2() + stops * (2.0 * (i as f64 + 0.5) / count as f64 - 1.0))
    }

    #[test]
    fn a_grey_card_and_an_even_picture_stay() {
        assert!(metered(ramp(1000, 0.0)).abs() < STEP);
        assert!(metered(ramp(10_000, 3.0)).abs() < 2.0 * STEP);
        assert!((metered(ramp(10_000, 3.0).map(|log| log - 5.0)) - 5.0).abs() < 2.0 * STEP);
        assert_eq!(metered(std::iter::empty()), 0.0);
    }

    #[test]
    fn black_with_noise_and_a_sun_change_little() {
        let lit = || ramp(10_000, 3.0);
        let noise = (0..30_000).map(|i| -16.0 - f64::from(i % 7));
        assert!(metered(lit().chain(noise)).abs() < 1.0);
        let sun = (0..100).map(|_| 16.0);
        assert!(metered(lit().chain(sun)).abs() < 0.5);
    }

    #[test]
    fn the_ends_of_floats_are_counted() {
        let mut meter = Meter::default();
        for value in [0.0, -1.0, f64::NAN, f64::INFINITY, f64::from(f32::from_bits(1)), 4.0 * f64::from(f32::MAX)] {
            meter.add(value);
        }
        assert_eq!(meter.histogram([-1.0, 1.0], 2), [1, 1]);
        assert!(meter.exposure().is_finite());
        assert!(meter.histogram([-1.0, 1.0], 0).is_empty());
    }
}
