use fearless_simd::Level;
use fearless_simd::prelude::*;

use super::block::{
    BLOCK, Block, Plane, Scratch, TERMS_AT_ONCE, load, load_rgb, map_channels, map_plane, store, store_rgb,
};
use super::dispatch::dispatch;
use super::log2_exp2::{exp2s, exp2s_within, log2s};
use crate::exponential_sum::{ExponentialSum, ExponentialTerm};
use crate::scene_light::LOG_FLOOR;

/// Vectors that are summed up together, so that a weight that is loaded serves both.
const VECTORS_AT_ONCE: usize = 2;

/// A sum of exponentials as the loops compute it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Exponentials {
    /// Rates with their sign turned: what 2 is raised to.
    terms: Vec<ExponentialTerm>,
    range: ExponentRange,
}

/// Where the exponents of a sum lie.
#[derive(Clone, Copy, Debug, PartialEq)]
enum ExponentRange {
    /// Where powers of two are normal numbers.
    Normal,
    /// Anywhere: they are held within the ends of [`exp2s`].
    Any,
}

/// The largest exponent of a sum that is not held within the ends, 126: numbers read from a curve may leave its entries by a rounding.
const NORMAL_EXPONENT: f64 = 125.0;

impl Exponentials {
    /// Of variables within these ends.
    pub(crate) fn new(sum: &ExponentialSum, ends: [[f32; 2]; 3]) -> Self {
        let largest = |rate: [f32; 3]| -> f64 {
            let most =
                |(rate, ends): (f32, [f32; 2])| f64::from(rate.abs()) * f64::from(ends[0].abs().max(ends[1].abs()));
            rate.into_iter().zip(ends).map(most).sum()
        };
        let is_normal = sum.terms().iter().all(|term| largest(term.rate) <= NORMAL_EXPONENT);
        let terms = sum.terms().iter().map(|term| ExponentialTerm { rate: term.rate.map(|r| -r), ..*term }).collect();
        Self { terms, range: if is_normal { ExponentRange::Normal } else { ExponentRange::Any } }
    }

    /// The sums at the block's colours, in place of them.
    pub(crate) fn apply(&self, level: Level, Block { rgb, scratch, .. }: &mut Block, count: usize) {
        let Scratch { weight: [sums @ .., _], power, .. } = scratch;
        let mut chunks = self.terms.chunks(TERMS_AT_ONCE);
        let last = chunks.next_back().unwrap_or_default();
        let is_first = chunks.len() == 0;
        if !is_first {
            *sums = [[0.0; BLOCK]; 3];
        }
        for terms in chunks {
            dispatch!(level, simd => powers(simd, terms, self.range, rgb, power, count));
            dispatch!(level, simd => add(simd, terms, power, sums, count));
        }
        dispatch!(level, simd => powers(simd, last, self.range, rgb, power, count));
        *rgb = if is_first { [[0.0; BLOCK]; 3] } else { *sums };
        dispatch!(level, simd => add(simd, last, power, rgb, count));
    }
}

/// The exponential of each term, of each colour.
#[inline(always)]
fn powers<S: Simd>(
    simd: S,
    terms: &[ExponentialTerm],
    range: ExponentRange,
    rgb: &[Plane; 3],
    powers: &mut [Plane; TERMS_AT_ONCE],
    count: usize,
) {
    for (ExponentialTerm { rate, .. }, power) in terms.iter().zip(powers) {
        // Once for all vectors: the compiler cannot know that the loops do not store to where the terms lie.
        let rate = map_channels(
            *rate,
            #[inline(always)]
            |v| S::f32s::splat(simd, v),
        );
        // Two vectors a turn, as in `map_plane`.
        let len = S::f32s::LEN;
        let pairs = (0..count.min(BLOCK)).step_by(2 * len);
        match range {
            ExponentRange::Normal => {
                for i in pairs {
                    store::<S>(exp2s_within(simd, exponents(simd, rate, rgb, i)), power, i);
                    store::<S>(exp2s_within(simd, exponents(simd, rate, rgb, i + len)), power, i + len);
                }
            }
            ExponentRange::Any => {
                for i in pairs {
                    store::<S>(exp2s(simd, exponents(simd, rate, rgb, i)), power, i);
                    store::<S>(exp2s(simd, exponents(simd, rate, rgb, i + len)), power, i + len);
                }
            }
        }
    }
}

#[inline(always)]
fn exponents<S: Simd>(simd: S, rate: [S::f32s; 3], rgb: &[Plane; 3], i: usize) -> S::f32s {
    let [x, y, z] = load_rgb(simd, rgb, i);
    z.mul_add(rate[2], y.mul_add(rate[1], x * rate[0]))
}

/// Adds the weighted exponentials to the sums.
#[inline(always)]
fn add<S: Simd>(
    simd: S,
    terms: &[ExponentialTerm],
    powers: &[Plane; TERMS_AT_ONCE],
    sums: &mut [Plane; 3],
    count: usize,
) {
    let len = S::f32s::LEN;
    for i in (0..count.min(BLOCK)).step_by(VECTORS_AT_ONCE * len) {
        let [mut red, mut green, mut blue] = load_rgb(simd, sums, i);
        let [mut red_far, mut green_far, mut blue_far] = load_rgb(simd, sums, i + len);
        for (ExponentialTerm { weight, .. }, power) in terms.iter().zip(powers) {
            let (near, far) = (load(simd, power, i), load(simd, power, i + len));
            red = near.mul_add(weight[0], red);
            green = near.mul_add(weight[1], green);
            blue = near.mul_add(weight[2], blue);
            red_far = far.mul_add(weight[0], red_far);
            green_far = far.mul_add(weight[1], green_far);
            blue_far = far.mul_add(weight[2], blue_far);
        }
        store_rgb::<S>([red, green, blue], sums, i);
        store_rgb::<S>([red_far, green_far, blue_far], sums, i + len);
    }
}

/// The log2 of the block's colours, of at least [`LOG_FLOOR`].
pub(crate) fn log2_of_light(level: Level, Block { rgb, .. }: &mut Block, count: usize) {
    dispatch!(level, simd => for plane in rgb.iter_mut() {
        map_plane(simd, plane, count,
            #[inline(always)]
            |v: _| log2_above_floor(simd, v));
    });
}

#[inline(always)]
fn log2_above_floor<S: Simd>(simd: S, v: S::f32s) -> S::f32s {
    log2s(simd, v.max(LOG_FLOOR))
}
