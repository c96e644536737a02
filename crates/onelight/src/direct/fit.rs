//! A few exponentials for the sum of many.

use std::f64::consts::LN_2;

use nalgebra::{DMatrix, DVector, Vector3};
use rayon::prelude::*;

use super::sum::{Sum, Term};
use super::training::Sample;

/// Numbers of one term: three rates, three weights.
const NUMBERS: usize = 6;
/// Samples of one task. Sums over tasks run in the order of the samples: threads do not matter.
const BLOCK: usize = 128;
/// Starts: exponents of what a wavelength adds when wavelengths are shared out among the terms.
const STARTS: [f64; 4] = [1.0, 0.7, 0.5, 0.3];
/// The norm of misses that is made small, and for how many steps at most: first of all starts, then of the best one.
const BROAD: (i32, usize) = (2, 24);
const FINE: [(i32, usize); 3] = [(2, 8), (4, 10), (12, 20)];
/// The same where a sum is nearly there.
const NEAR: [(i32, usize); 2] = [(4, 3), (12, 4)];
/// The norm by which the best start is chosen, and of how many samples starts are fitted to one.
const CHOICE: i32 = 12;
const CHOICE_EVERY: usize = 3;
/// Levenberg and Marquardt's damping: at first, divided and multiplied by this after a step that did or did not help.
const DAMPING: f64 = 1e-3;
const DAMPING_DOWN: f64 = 5.0;
const DAMPING_UP: f64 = 4.0;
/// Dampings tried for a step; a step that gains less than this part is the last.
const TRIES: usize = 6;
const LEAST_GAIN: f64 = 1e-4;

/// The sum of `count` exponentials nearest to `full` as seen by `samples`: neither rates nor weights need belong to a wavelength.
/// Bound to wavelengths, as many terms miss two to six times as much: 8 for the projection of Velvia 50 by 0.16 dE instead of
/// 0.03, 4 for the duplication of 5207 by 0.42 instead of 0.06.
///
/// Levenberg and Marquardt's method (\[Marquardt1963\]) on the p-norm of the misses, with the power p raised in steps: few
/// large misses count for more and more.
pub(super) fn fit(full: &Sum, samples: &[Sample], count: usize) -> Sum {
    if full.is_rule() {
        return full.clone();
    }
    let some: Vec<Sample> = samples.iter().copied().step_by(CHOICE_EVERY).collect();
    let starts = STARTS.par_iter().map(|&exponent| descend(shared_out(full, count, exponent), &some, &[BROAD]));
    let starts: Vec<(f64, Sum)> = starts.map(|sum| (norm(&misses(&sum, samples), CHOICE), sum)).collect();
    let best = starts.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or_else(|| full.clone(), |(_, sum)| descend(sum, samples, &FINE))
}

/// The same from a sum that is nearly there, by few steps.
pub(super) fn refine(near: Sum, samples: &[Sample]) -> Sum {
    descend(near, samples, &NEAR)
}

/// The difference (CIEDE2000) by which a sum may miss a colour before it takes another term, or is fitted from the beginning.
pub(super) const LARGEST_MISS: f64 = 0.1;

/// How far a sum misses each sample, in the unit of colour differences.
pub(super) fn misses(sum: &Sum, samples: &[Sample]) -> Vec<f64> {
    samples.par_iter().with_min_len(BLOCK).map(|s| (s.seen * (sum.at(&s.at) - s.target)).norm()).collect()
}

/// Wavelengths in `count` groups of neighbours that add about the same, each group as one term.
fn shared_out(full: &Sum, count: usize, exponent: f64) -> Sum {
    let most = full.0.iter().fold(Vector3::repeat(f64::MIN_POSITIVE), |sum, term| sum + term.weight.abs());
    let adds = |term: &Term| term.weight.abs().component_div(&most).sum().powf(exponent);
    let all: f64 = full.0.iter().map(adds).sum();
    let mut terms = vec![Term { rate: Vector3::zeros(), weight: Vector3::zeros() }; count];
    let mut masses = vec![f64::MIN_POSITIVE; count];
    let mut before = 0.0;
    for term in &full.0 {
        let mass = adds(term) / all;
        let group = (((before + 0.5 * mass) * count as f64) as usize).min(count - 1);
        before += mass;
        terms[group].rate += term.rate * mass;
        terms[group].weight += term.weight;
        masses[group] += mass;
    }
    terms.iter_mut().zip(masses).for_each(|(term, mass)| term.rate /= mass);
    Sum(terms)
}

fn descend(mut sum: Sum, samples: &[Sample], powers: &[(i32, usize)]) -> Sum {
    let mut damping = DAMPING;
    for &(power, steps) in powers {
        let mut least = norm(&misses(&sum, samples), power);
        for _ in 0..steps {
            let normal = Normal::new(&sum, samples, power);
            let before = least;
            for _ in 0..TRIES {
                let trial = normal.step(&sum, damping);
                let found = trial.as_ref().map_or(f64::INFINITY, |trial| norm(&misses(trial, samples), power));
                if let Some(trial) = trial.filter(|_| found < least) {
                    (sum, least) = (trial, found);
                    damping /= DAMPING_DOWN;
                    break;
                }
                damping *= DAMPING_UP;
            }
            if least > before * (1.0 - LEAST_GAIN) {
                break;
            }
        }
        damping = damping.clamp(1e-9, DAMPING);
    }
    sum
}

/// The p-norm of misses, as a mean.
fn norm(misses: &[f64], power: i32) -> f64 {
    let most = misses.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let sum: f64 = misses.iter().map(|miss| (miss / most).powi(power)).sum();
    most * (sum / misses.len().max(1) as f64).powf(1.0 / f64::from(power))
}

/// The normal equations of one step.
struct Normal {
    square: DMatrix<f64>,
    product: DVector<f64>,
}

impl Normal {
    /// Each sample with the weight that makes squares of misses their powers.
    fn new(sum: &Sum, samples: &[Sample], power: i32) -> Self {
        let n = sum.0.len() * NUMBERS;
        let misses = misses(sum, samples);
        let most = misses.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
        let blocks = samples.par_chunks(BLOCK).zip(misses.par_chunks(BLOCK)).map(|(samples, misses)| {
            let mut rows = DMatrix::zeros(n, 3 * samples.len());
            let mut residual = DVector::zeros(3 * samples.len());
            for (i, (sample, miss)) in samples.iter().zip(misses).enumerate() {
                let mine = &mut rows.as_mut_slice()[3 * i * n..][..3 * n];
                let found = derivatives(sum, sample, (miss / most).powi(power / 2 - 1), mine);
                residual.fixed_rows_mut::<3>(3 * i).copy_from_slice(&found);
            }
            (&rows * rows.transpose(), rows * residual)
        });
        let blocks: Vec<_> = blocks.collect();
        let zero = Self { square: DMatrix::zeros(n, n), product: DVector::zeros(n) };
        blocks
            .into_iter()
            .fold(zero, |all, (square, product)| Self { square: all.square + square, product: all.product + product })
    }

    /// The sum after a step; `None` if rounding leaves nothing to solve.
    fn step(&self, sum: &Sum, damping: f64) -> Option<Sum> {
        let mut square = self.square.clone();
        // Terms that have become one need a little of the others' diagonal.
        let floor = 1e-14 * square.trace() / square.nrows() as f64;
        for i in 0..square.nrows() {
            square[(i, i)] += damping * square[(i, i)] + floor;
        }
        let step = square.cholesky()?.solve(&self.product);
        let moved = sum.0.iter().zip(step.as_slice().chunks_exact(NUMBERS)).map(|(term, step)| Term {
            rate: term.rate + Vector3::from_column_slice(&step[..3]),
            weight: term.weight + Vector3::from_column_slice(&step[3..]),
        });
        Some(Sum(moved.collect()))
    }
}

/// What is left to the sample, and in `rows` (one for each direction) what a small change of each number adds: all as seen.
fn derivatives(sum: &Sum, sample: &Sample, weight: f64, rows: &mut [f64]) -> [f64; 3] {
    let n = sum.0.len() * NUMBERS;
    let seen = sample.seen * weight;
    let mut value = Vector3::zeros();
    for (t, term) in sum.0.iter().enumerate() {
        let e = term.exponential(&sample.at);
        value += term.weight * e;
        let slope = seen * term.weight * (-LN_2 * e);
        for i in 0..3 {
            let row = &mut rows[i * n + t * NUMBERS..][..NUMBERS];
            for k in 0..3 {
                row[k] = slope[i] * sample.at[k];
                row[3 + k] = seen[(i, k)] * e;
            }
        }
    }
    (seen * (sample.target - value)).into()
}
