use crate::error::{Error, ErrorKind};
use rayon::prelude::*;

/// How far one map lies from another over a set of samples, in the unit of the difference that was given.
///
/// ```
/// use onelight_lut::deviation;
/// let samples = [[0.1; 3], [0.5; 3]];
/// let halved = |rgb: [f64; 3]| rgb.map(|v| v / 2.0);
/// let found = deviation(&samples, |rgb| rgb, halved, |a, b| (a[0] - b[0]).abs())?;
/// assert_eq!((found.count, found.max, found.worst), (2, 0.25, [0.5; 3]));
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Deviation {
    /// The number of samples that were compared.
    pub count: usize,
    /// The arithmetic mean of the differences.
    pub mean: f64,
    /// The 95th percentile by nearest rank: the smallest difference that at least 95 % of the samples do not
    /// exceed.
    pub p95: f64,
    /// The 99th percentile by nearest rank.
    pub p99: f64,
    /// The largest difference, that of `worst`.
    pub max: f64,
    /// The sample with the largest difference; the first of them, if several share it.
    pub worst: [f64; 3],
}

/// Compares `candidate` with `reference` at every sample, on all threads.
///
/// `difference` takes the reference's value first. The result does not depend on the number of threads: sums
/// run in the order of the samples.
///
/// ```
/// # use onelight_lut::deviation;
/// let samples: Vec<[f64; 3]> = (1..=100).map(|i| [f64::from(i); 3]).collect();
/// let found = deviation(
///     &samples,
///     |rgb| rgb,
///     |rgb| [rgb[0], rgb[1], 0.0],
///     |a, b| (a[2] - b[2]).abs(),
/// )?;
/// assert_eq!((found.mean, found.p95, found.max), (50.5, 95.0, 100.0));
/// # Ok::<(), onelight_lut::Error>(())
/// ```
///
/// # Errors
///
/// If there are no samples, or a difference is not finite; the error names the first such sample.
pub fn deviation<Colour>(
    samples: &[[f64; 3]],
    reference: impl Fn([f64; 3]) -> Colour + Sync,
    candidate: impl Fn([f64; 3]) -> Colour + Sync,
    difference: impl Fn(&Colour, &Colour) -> f64 + Sync,
) -> Result<Deviation, Error> {
    measured(samples, &|sample| difference(&reference(sample), &candidate(sample)))
}

/// Compiled once, whatever is measured.
fn measured(samples: &[[f64; 3]], difference: &(dyn Fn([f64; 3]) -> f64 + Sync)) -> Result<Deviation, Error> {
    Deviation::of(samples, samples.par_iter().map(|&sample| difference(sample)).collect())
}

impl Deviation {
    /// Sums up differences that were measured elsewhere, one for each sample, in the same order.
    ///
    /// ```
    /// # use onelight_lut::Deviation;
    /// let found = Deviation::of(&[[0.1; 3], [0.2; 3]], vec![1.0, 3.0])?;
    /// assert_eq!((found.mean, found.worst), (2.0, [0.2; 3]));
    /// assert!(Deviation::of(&[[0.1; 3], [0.2; 3]], vec![1.0]).is_err());
    /// # Ok::<(), onelight_lut::Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// If there are no samples, not as many differences, or a difference is not finite; the error names the first such sample.
    pub fn of(samples: &[[f64; 3]], differences: Vec<f64>) -> Result<Self, Error> {
        Self::with_worst_index(samples, differences).map(|(deviation, _)| deviation)
    }

    /// [`Deviation::of`], and which sample is the worst.
    pub(crate) fn with_worst_index(samples: &[[f64; 3]], mut differences: Vec<f64>) -> Result<(Self, usize), Error> {
        if samples.len() != differences.len() {
            return Err(ErrorKind::DifferenceCount { found: differences.len(), expected: samples.len() }.into());
        }
        let mut sum = 0.0;
        let mut largest: Option<(f64, usize)> = None;
        for (index, (&found, &sample)) in differences.iter().zip(samples).enumerate() {
            if !found.is_finite() {
                return Err(ErrorKind::Difference { index, sample, found }.into());
            }
            sum += found;
            if largest.is_none_or(|(max, _)| found > max) {
                largest = Some((found, index));
            }
        }
        let Some((max, worst_index)) = largest else {
            return Err(ErrorKind::NoSamples.into());
        };
        differences.par_sort_unstable_by(f64::total_cmp);
        let count = differences.len();
        let deviation = Self {
            count,
            mean: sum / count as f64,
            p95: differences[nearest_rank(count, 95)],
            p99: differences[nearest_rank(count, 99)],
            max,
            worst: samples[worst_index],
        };
        Ok((deviation, worst_index))
    }
}

/// The index, among `count` (1 and more) sorted values, of a percentile from 1 to 100: ceil(percent * count) - 1.
fn nearest_rank(count: usize, percent: usize) -> usize {
    // In parts, so that no count overflows.
    let [hundreds, rest] = [count / 100, count % 100];
    hundreds * percent + (rest * percent).div_ceil(100) - 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn red(a: &[f64; 3], b: &[f64; 3]) -> f64 {
        (a[0] - b[0]).abs()
    }

    #[test]
    fn a_uniform_error_has_its_known_moments() {
        // |x^2 - x^2 - x| = x, uniform in (0, 1]: mean 1/2 (1 + 1/n), percentiles themselves. Order shuffled by 7919.
        let n = 10_000_u32;
        let samples: Vec<_> = (0..n).map(|i| [f64::from((i * 7919) % n + 1) / f64::from(n), 0.0, 0.0]).collect();
        let found = deviation(&samples, |[x, y, z]| [x * x, y, z], |[x, y, z]| [x * x + x, y, z], red).unwrap();
        assert_eq!(found.count, 10_000);
        assert_relative_eq!(found.mean, 0.50005, epsilon = 1e-12);
        assert_relative_eq!(found.p95, 0.95, epsilon = 1e-12);
        assert_relative_eq!(found.p99, 0.99, epsilon = 1e-12);
        assert_relative_eq!(found.max, 1.0, epsilon = 1e-12);
        assert_eq!(found.worst, [1.0, 0.0, 0.0]);
    }

    #[test]
    fn nearest_rank_is_the_smallest_that_covers() {
        for count in 1..500 {
            for percent in [1, 50, 95, 99, 100] {
                let index = nearest_rank(count, percent);
                assert!(index < count);
                assert!((index + 1) * 100 >= percent * count);
                assert!(index * 100 < percent * count);
            }
        }
    }

    #[test]
    fn the_first_worst_is_named() {
        let samples = [[1.0, 0.0, 0.0], [3.0, 1.0, 0.0], [3.0, 2.0, 0.0]];
        let found = deviation(&samples, |rgb| rgb, |_| [0.0; 3], red).unwrap();
        assert_eq!(found.worst, [3.0, 1.0, 0.0]);
        assert_eq!((found.p95, found.p99), (3.0, 3.0));
    }

    #[test]
    fn threads_do_not_matter() {
        let samples: Vec<_> = crate::SceneSampler::new(-8.0..=6.0).unwrap().take(30_000).collect();
        let measure_on = |threads| {
            rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap()
                .install(|| deviation(&samples, |rgb| rgb, |_| [0.1; 3], red).unwrap())
        };
        assert_eq!(measure_on(1), measure_on(5));
    }

    #[test]
    fn nothing_and_nan_are_errors() {
        assert!(deviation(&[], |rgb| rgb, |rgb| rgb, red).is_err());
        let samples = [[1.0; 3], [0.0; 3]];
        let error = deviation(&samples, |rgb| rgb, |rgb| rgb.map(|u| u / u), red).unwrap_err();
        assert_eq!(error.to_string(), "difference at sample 1, [0.0, 0.0, 0.0]: found NaN, expected a finite number");
    }
}
