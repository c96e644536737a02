use std::ops::RangeInclusive;

use crate::error::{Error, ErrorKind};
use crate::split_mix64::SplitMix64;

/// An endless, repeatable sequence of scene-linear colours for comparing maps.
///
/// The law of one colour, each draw independent and uniform:
/// - stops `e` in the given range; the largest channel is `0.18 * 2^e`;
/// - saturation `s` in `[0, 1)`; the smallest channel is the largest times `1 - s`;
/// - position `f` in `[0, 1)`; the remaining channel is `smallest + f * (largest - smallest)`;
/// - which channel is which: one of the six orders, as a hue would have it.
///
/// Numbers come from [`SplitMix64`], so the same seed gives the same colours on every machine.
///
/// ```
/// # use onelight_lut::SceneSampler;
/// let colours: Vec<[f64; 3]> = SceneSampler::new(-8.0..=6.0)?.take(1000).collect();
/// assert!(colours.iter().flatten().all(|&u| (0.0..=0.18 * 64.0).contains(&u)));
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct SceneSampler {
    low: f64,
    high: f64,
    numbers: SplitMix64,
}

impl SceneSampler {
    /// Mid grey, scene-linear, about which stops are counted.
    pub const MID_GREY: f64 = 0.18;

    /// The order of channels, largest first, in each sixth of the hue circle.
    pub(crate) const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 0, 2], [1, 2, 0], [2, 1, 0], [2, 0, 1], [0, 2, 1]];

    /// Colours whose largest channel lies within a range of stops about mid grey, from the usual seed.
    ///
    /// # Errors
    ///
    /// If the range runs backwards or leaves -64 to 64 stops.
    pub fn new(stops: RangeInclusive<f64>) -> Result<Self, Error> {
        Self::with_seed(stops, 0)
    }

    /// [`SceneSampler::new`] from another seed, for a sequence of its own.
    ///
    /// # Errors
    ///
    /// The same as those of [`SceneSampler::new`].
    pub fn with_seed(stops: RangeInclusive<f64>, seed: u64) -> Result<Self, Error> {
        let [low, high] = [*stops.start(), *stops.end()];
        for (what, found) in [("lowest stop of a scene sampler", low), ("highest stop of a scene sampler", high)] {
            if !(-64.0..=64.0).contains(&found) {
                return Err(ErrorKind::Parameter { what, found, expected: "a number from -64 to 64" }.into());
            }
        }
        if low > high {
            return Err(ErrorKind::Parameter {
                what: "highest minus lowest stop of a scene sampler",
                found: high - low,
                expected: "a number not below 0",
            }
            .into());
        }
        Ok(Self { low, high, numbers: SplitMix64::new(seed) })
    }
}

impl Iterator for SceneSampler {
    type Item = [f64; 3];

    fn next(&mut self) -> Option<[f64; 3]> {
        let stops = self.low + (self.high - self.low) * self.numbers.next_unit();
        let largest = Self::MID_GREY * stops.exp2();
        let smallest = largest * (1.0 - self.numbers.next_unit());
        let middle = smallest + (largest - smallest) * self.numbers.next_unit();
        let [first, second, third] = Self::ORDERS[(self.numbers.next_unit() * 6.0) as usize % 6];
        let mut rgb = [0.0; 3];
        rgb[first] = largest;
        rgb[second] = middle;
        rgb[third] = smallest;
        Some(rgb)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_abs_diff_eq;

    const COUNT: usize = 60_000;

    /// Five standard errors of the mean of that many uniform numbers, 5 / sqrt(12 COUNT).
    const MEAN: f64 = 6e-3;

    /// Kolmogorov-Smirnov distance that uniform numbers exceed once in a million such sets: 2.7 / sqrt(COUNT).
    const UNIFORM: f64 = 0.011;

    fn distance_from_uniform(mut values: Vec<f64>) -> f64 {
        values.sort_unstable_by(f64::total_cmp);
        let n = values.len() as f64;
        let gaps = values.iter().enumerate().map(|(i, v)| (v - i as f64 / n).abs());
        gaps.fold(0.0, f64::max)
    }

    #[test]
    fn draws_follow_the_stated_law() {
        let colours: Vec<_> = SceneSampler::new(-8.0..=6.0).unwrap().take(COUNT).collect();
        let [mut stops, mut saturation, mut position] = [const { Vec::new() }; 3];
        let mut orders = [0_usize; 9];
        for rgb in &colours {
            let mut sorted = *rgb;
            sorted.sort_unstable_by(f64::total_cmp);
            let [low, mid, high] = sorted;
            stops.push(((high / 0.18).log2() + 8.0) / 14.0);
            saturation.push(1.0 - low / high);
            position.push((mid - low) / (high - low));
            let at = |v| rgb.iter().position(|&u| u == v).unwrap();
            orders[3 * at(high) + at(low)] += 1;
        }
        for values in [stops, saturation, position] {
            assert!(values.iter().all(|v| (-1e-9..=1.0 + 1e-9).contains(v)));
            assert_abs_diff_eq!(values.iter().sum::<f64>() / COUNT as f64, 0.5, epsilon = MEAN);
            assert!(distance_from_uniform(values) < UNIFORM);
        }
        for (pair, &count) in orders.iter().enumerate() {
            let share = count as f64 / COUNT as f64;
            let want = if pair % 4 == 0 { 0.0 } else { 1.0 / 6.0 };
            assert_abs_diff_eq!(share, want, epsilon = 0.01);
        }
    }

    #[test]
    fn a_seed_repeats_and_another_differs() {
        let take = |seed| SceneSampler::with_seed(-4.0..=4.0, seed).unwrap().take(50).collect::<Vec<_>>();
        assert_eq!(take(7), take(7));
        assert_ne!(take(7), take(8));
    }

    #[test]
    fn ranges_are_checked() {
        assert!(SceneSampler::new(1.0..=-1.0).is_err());
        assert!(SceneSampler::new(f64::NAN..=1.0).is_err());
        assert!(SceneSampler::new(0.0..=f64::INFINITY).is_err());
        let fixed = SceneSampler::new(1.0..=1.0).unwrap().next().unwrap();
        assert_abs_diff_eq!(fixed.into_iter().fold(0.0, f64::max), 0.36, epsilon = 1e-15);
    }
}
