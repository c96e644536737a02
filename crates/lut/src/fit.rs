use rayon::prelude::*;

use crate::error::{Error, ErrorKind};
use crate::interpolate::{Interpolation, Weights, weights};
use crate::lut3d::Lut3d;

/// A place in a table and the value it should read there: what [`fit`] takes, with an example there.
///
/// ```
/// use onelight_lut::FitSample;
/// // A table over square roots should read light there.
/// let sample = |light: f32| FitSample { coordinates: [light.sqrt(); 3], target: [light; 3] };
/// assert_eq!(sample(0.25).coordinates, [0.5; 3]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitSample {
    /// Where the table is read: coordinates from 0 to 1.
    pub coordinates: [f32; 3],
    /// The value that the table should read there.
    pub target: [f32; 3],
}

/// How [`fit`] goes about it.
///
/// ```
/// use onelight_lut::FitSettings;
/// let plain_least_squares = FitSettings { rounds: 1, ..FitSettings::default() };
/// assert!(plain_least_squares.rounds < FitSettings::default().rounds);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitSettings {
    /// Weight, in samples, that holds each entry to where it starts: what keeps entries that no sample sees.
    pub hold: f64,
    /// How often samples are weighed anew by their difference; 1 is plain least squares.
    pub rounds: usize,
    /// Steps of the conjugate gradients in each round.
    pub steps: usize,
}

impl Default for FitSettings {
    /// What serves all films best: p99 and the largest difference fall with the rounds, the mean rises by a tenth.
    fn default() -> Self {
        Self { hold: 0.02, rounds: 4, steps: 15 }
    }
}

/// A sample's weight grows by this power of its difference over the mean difference, in each round.
const SHARPNESS: f64 = 0.5;
/// Added to that ratio, so that no sample is forgotten.
const SHARE: f64 = 0.3;

/// Moves the entries of a table so that it reads the targets between its nodes as nearly as it can: weighted least squares,
/// weights raised where `difference` is large, round by round.
///
/// `difference(sample, value)` says how far a value read at a sample lies from what is wanted, in the unit that counts (such
/// as CIEDE2000 after decoding). The result does not depend on the number of threads.
///
/// ```
/// use onelight_lut::{FitSample, FitSettings, Interpolation, Lut3d, fit};
/// // Sampled at its two nodes, a parabola is read too high everywhere between them.
/// let sampled = Lut3d::new(2, (0..8).map(|i| [if i & 1 == 1 { 1.0 } else { 0.0 }; 3]).collect())?;
/// let samples: Vec<FitSample> = (0..1000)
///     .map(|i| [i % 10, i / 10 % 10, i / 100].map(|k| k as f32 / 9.0))
///     .map(|c| FitSample { coordinates: c, target: [c[0] * c[0]; 3] })
///     .collect();
/// let miss = |i: usize, v: [f32; 3]| f64::from((v[0] - samples[i].target[0]).abs());
/// let fitted = fit(&sampled, Interpolation::Trilinear, &samples, miss, FitSettings::default())?;
/// let worst = |lut: &Lut3d| {
///     let read = |s: &FitSample| (lut.apply(s.coordinates, Interpolation::Trilinear)[0] - s.target[0]).abs();
///     samples.iter().map(read).fold(0.0, f32::max)
/// };
/// assert!(worst(&fitted) < 0.6 * worst(&sampled));
/// # Ok::<(), onelight_lut::Error>(())
/// ```
///
/// # Errors
/// If there are no samples, the hold is not a number from 0 to 1e12, or an entry of the result is not finite.
pub fn fit(
    start: &Lut3d,
    interpolation: Interpolation,
    samples: &[FitSample],
    difference: impl Fn(usize, [f32; 3]) -> f64 + Sync,
    settings: FitSettings,
) -> Result<Lut3d, Error> {
    fit_by(start, interpolation, samples, &difference, settings)
}

/// Compiled once, whatever is fitted.
fn fit_by(
    start: &Lut3d,
    interpolation: Interpolation,
    samples: &[FitSample],
    difference: &(dyn Fn(usize, [f32; 3]) -> f64 + Sync),
    settings: FitSettings,
) -> Result<Lut3d, Error> {
    if samples.is_empty() {
        return Err(ErrorKind::NoSamples.into());
    }
    if !(0.0..=1e12).contains(&settings.hold) {
        let (found, expected) = (settings.hold, "a number from 0 to 1e12");
        return Err(ErrorKind::Parameter { what: "hold of a fit", found, expected }.into());
    }
    let system = System::new(start, interpolation, samples, settings.hold);
    let mut importance = vec![1.0; samples.len()];
    let mut entries: Vec<[f64; 3]> = start.entries().map(|e| e.map(f64::from)).collect();
    for round in 0..settings.rounds.max(1) {
        system.solve(&mut entries, &importance, settings.steps);
        if round + 1 < settings.rounds {
            let read = system.read(&entries);
            let found: Vec<f64> =
                (0..samples.len()).into_par_iter().map(|i| difference(i, read[i].map(|v| v as f32))).collect();
            weigh(&mut importance, &found);
        }
    }
    Lut3d::new(start.size(), entries.into_iter().map(|e| e.map(|v| v as f32)).collect())
}

/// Raises the importance of samples that differ much; the mean stays 1.
fn weigh(importance: &mut [f64], differences: &[f64]) {
    let count = importance.len() as f64;
    let mean = (differences.iter().sum::<f64>() / count).max(f64::MIN_POSITIVE);
    for (weight, found) in importance.iter_mut().zip(differences) {
        *weight = (*weight * (SHARE + found / mean).powf(SHARPNESS)).min(1e4);
    }
    let level = importance.iter().sum::<f64>() / count;
    importance.iter_mut().for_each(|weight| *weight /= level);
}

/// The normal equations, never written out: A' W A + hold.
struct System<'a> {
    rows: Vec<Weights<f32>>,
    /// For each entry, the samples it takes part in and its weight there: `columns[first[e]..first[e + 1]]`.
    columns: Vec<(u32, f32)>,
    first: Vec<usize>,
    samples: &'a [FitSample],
    start: Vec<[f64; 3]>,
    hold: f64,
}

impl<'a> System<'a> {
    fn new(start: &Lut3d, how: Interpolation, samples: &'a [FitSample], hold: f64) -> Self {
        let rows: Vec<Weights<f32>> = samples.par_iter().map(|s| weights(s.coordinates, start.size(), how)).collect();
        let mut first = vec![0; start.entries().len() + 1];
        let used = |row: &Weights<f32>| {
            row.map(|(entry, weight)| (entry as usize, weight)).into_iter().filter(|(_, w)| *w != 0.0)
        };
        for (entry, _) in rows.iter().flat_map(used) {
            first[entry + 1] += 1;
        }
        for entry in 0..start.entries().len() {
            first[entry + 1] += first[entry];
        }
        let mut next = first.clone();
        let mut columns = vec![(0, 0.0); first[start.entries().len()]];
        for (sample, row) in (0..).zip(&rows) {
            for (entry, weight) in used(row) {
                columns[next[entry]] = (sample, weight);
                next[entry] += 1;
            }
        }
        let start = start.entries().map(|e| e.map(f64::from)).collect();
        Self { rows, columns, first, samples, start, hold }
    }

    /// What the entries read at the samples: A x.
    fn read(&self, entries: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let value = |row: &Weights<f32>| {
            let mut sum = [0.0; 3];
            for &(entry, weight) in row {
                add(&mut sum, f64::from(weight), &entries[entry as usize]);
            }
            sum
        };
        self.rows.par_iter().map(value).collect()
    }

    /// A' (importance values) + hold entries.
    fn gather(&self, values: &[[f64; 3]], importance: &[f64], entries: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let value = |(entry, held): (usize, &[f64; 3])| {
            let mut sum = held.map(|v| self.hold * v);
            for &(sample, weight) in &self.columns[self.first[entry]..self.first[entry + 1]] {
                add(&mut sum, f64::from(weight) * importance[sample as usize], &values[sample as usize]);
            }
            sum
        };
        entries.par_iter().enumerate().map(value).collect()
    }

    /// Conjugate gradients from `entries`, the three channels side by side. Norms are squared.
    fn solve(&self, entries: &mut [[f64; 3]], importance: &[f64], steps: usize) {
        let targets: Vec<[f64; 3]> = self.samples.iter().map(|s| s.target.map(f64::from)).collect();
        let wanted = self.gather(&targets, importance, &self.start);
        let found = self.gather(&self.read(entries), importance, entries);
        let mut residual: Vec<[f64; 3]> =
            wanted.iter().zip(&found).map(|(w, f)| std::array::from_fn(|c| w[c] - f[c])).collect();
        let mut direction = residual.clone();
        let mut residual_norm = dot(&residual, &residual);
        for _ in 0..steps {
            let a_direction = self.gather(&self.read(&direction), importance, &direction);
            let alpha = ratio(residual_norm, dot(&direction, &a_direction));
            let updates = entries.iter_mut().zip(&mut residual).zip(direction.iter().zip(&a_direction));
            for ((entry, residual), (direction, a_direction)) in updates {
                for c in 0..3 {
                    entry[c] += alpha[c] * direction[c];
                    residual[c] -= alpha[c] * a_direction[c];
                }
            }
            let next_norm = dot(&residual, &residual);
            let beta = ratio(next_norm, residual_norm);
            for (direction, residual) in direction.iter_mut().zip(&residual) {
                *direction = std::array::from_fn(|c| residual[c] + beta[c] * direction[c]);
            }
            residual_norm = next_norm;
        }
    }
}

fn add(sum: &mut [f64; 3], factor: f64, value: &[f64; 3]) {
    for c in 0..3 {
        sum[c] += factor * value[c];
    }
}

/// Channel by channel, in the order of the entries: no thread's timing shows.
fn dot(a: &[[f64; 3]], b: &[[f64; 3]]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (a, b) in a.iter().zip(b) {
        for c in 0..3 {
            sum[c] += a[c] * b[c];
        }
    }
    sum
}

/// 0 where there is nothing left to divide.
fn ratio(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|c| if b[c] > 0.0 { a[c] / b[c] } else { 0.0 })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SceneSampler;

    const BOTH: [Interpolation; 2] = [Interpolation::Trilinear, Interpolation::Tetrahedral];

    fn samples(count: usize) -> Vec<FitSample> {
        let curved = |[x, y, z]: [f32; 3]| [x * x + 0.3 * y * z, (3.0 * y).sin() * (1.0 - 0.5 * x), (z + 0.1).sqrt()];
        let colours = SceneSampler::new(-2.0..=2.0).unwrap().take(count);
        colours
            .map(|rgb| rgb.map(|u| (u / 0.72) as f32))
            .map(|c| FitSample { coordinates: c, target: curved(c) })
            .collect()
    }

    #[test]
    fn weights_are_those_of_reading() {
        for how in BOTH {
            let lut =
                Lut3d::new(5, (0..125).map(|i| [i as f32, (i * i % 17) as f32, (i % 7) as f32]).collect()).unwrap();
            for sample in samples(2000) {
                let read = lut.apply(sample.coordinates, how);
                let mut mixed = [0.0; 3];
                let entries: Vec<_> = lut.entries().collect();
                for (entry, weight) in weights(sample.coordinates, 5, how) {
                    add(&mut mixed, f64::from(weight), &entries[entry as usize].map(f64::from));
                }
                assert!(mixed.iter().zip(read).all(|(a, b)| (a - f64::from(b)).abs() < 2e-4));
            }
        }
    }

    #[test]
    fn a_table_that_already_reads_its_targets_stays() {
        for how in BOTH {
            let identity = Lut3d::identity(9).unwrap();
            let exact: Vec<FitSample> =
                samples(4000).into_iter().map(|s| FitSample { target: s.coordinates, ..s }).collect();
            let fitted = fit(&identity, how, &exact, |_, _| 1.0, FitSettings::default()).unwrap();
            for (a, b) in fitted.entries().flatten().zip(identity.entries().flatten()) {
                assert!((a - b).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn rounds_lower_the_largest_difference() {
        let samples = samples(20_000);
        let miss =
            |i: usize, v: [f32; 3]| (0..3).map(|c| f64::from((v[c] - samples[i].target[c]).abs())).fold(0.0, f64::max);
        let start = Lut3d::identity(5).unwrap();
        let largest = |rounds| {
            let settings = FitSettings { rounds, ..FitSettings::default() };
            let lut = fit(&start, Interpolation::Tetrahedral, &samples, miss, settings).unwrap();
            let read = |s: &FitSample| lut.apply(s.coordinates, Interpolation::Tetrahedral);
            samples.iter().enumerate().map(|(i, s)| miss(i, read(s))).fold(0.0, f64::max)
        };
        assert!(largest(6) < 0.9 * largest(1));
    }

    #[test]
    fn entries_without_samples_stay_where_they_were() {
        let near: Vec<FitSample> = samples(500)
            .into_iter()
            .map(|s| FitSample { coordinates: s.coordinates.map(|c| 0.2 * c.min(1.0)), target: [9.0; 3] })
            .collect();
        let start = Lut3d::identity(9).unwrap();
        let fitted = fit(&start, Interpolation::Trilinear, &near, |_, _| 1.0, FitSettings::default()).unwrap();
        assert_eq!(fitted.entry([8; 3]), start.entry([8; 3]));
        assert!(fit(&start, Interpolation::Trilinear, &[], |_, _| 1.0, FitSettings::default()).is_err());
    }

    #[test]
    fn threads_do_not_matter() {
        let samples = samples(5000);
        let on = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let start = Lut3d::identity(7).unwrap();
            pool.install(|| {
                fit(
                    &start,
                    Interpolation::Tetrahedral,
                    &samples,
                    |i, v| f64::from(v[i % 3].abs()),
                    FitSettings::default(),
                )
                .unwrap()
            })
        };
        assert_eq!(on(1), on(5));
    }
}
