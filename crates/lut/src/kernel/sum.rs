use fearless_simd::Level;
use fearless_simd::prelude::*;

use super::block::{BLOCK, Block, load_rgb, map_channels, store_rgb};
use super::coding::code;
use super::dispatch::dispatch;
use super::log2_exp2::{exp2s, log2s};
use crate::coding::PowerNumbers;
use crate::exponential_sum::ExponentialTerm;
use crate::scene_light::LOG_FLOOR;

/// Vectors that go through a sum together: what one waits for, the other uses.
const VECTORS_AT_ONCE: usize = 2;

/// A sum of exponentials, and the log2 of it.
pub(crate) fn log2_of_sum(level: Level, terms: &[ExponentialTerm], block: &mut Block, count: usize) {
    dispatch!(level, simd => sum_with(simd, terms, block, count, 
        #[inline(always)]
        |v: _| log2s(simd, at_least_floor(simd, v))));
}

/// A sum of exponentials, and its coding.
pub(crate) fn coded_sum(
    level: Level,
    terms: &[ExponentialTerm],
    coding: &PowerNumbers<f32>,
    block: &mut Block,
    count: usize,
) {
    dispatch!(level, simd => sum_with(simd, terms, block, count, 
        #[inline(always)]
        |v| code(simd, coding, v)));
}

/// Not so low that it has no logarithm.
#[inline(always)]
fn at_least_floor<S: Simd>(_: S, v: S::f32s) -> S::f32s {
    v.max(LOG_FLOOR)
}

#[inline(always)]
fn sum_with<S: Simd>(
    simd: S,
    terms: &[ExponentialTerm],
    block: &mut Block,
    count: usize,
    then: impl Fn(S::f32s) -> S::f32s + Copy,
) {
    let len = S::f32s::LEN;
    for i in (0..count.min(BLOCK)).step_by(VECTORS_AT_ONCE * len) {
        let zero = S::f32s::splat(simd, 0.0);
        let mut x = [[zero; 3]; VECTORS_AT_ONCE];
        for (k, x) in x.iter_mut().enumerate() {
            let [red, green, blue] = load_rgb(simd, &block.rgb, i + k * len);
            *x = [-red, -green, -blue];
        }
        let mut sums = [[zero; 3]; VECTORS_AT_ONCE];
        for ExponentialTerm { rate, weight } in terms {
            for (sum, x) in sums.iter_mut().zip(&x) {
                let exponent = x[2].mul_add(rate[2], x[1].mul_add(rate[1], x[0] * rate[0]));
                let power = exp2s(simd, exponent);
                for (sum, weight) in sum.iter_mut().zip(weight) {
                    *sum = power.mul_add(*weight, *sum);
                }
            }
        }
        for (k, sum) in sums.into_iter().enumerate() {
            store_rgb::<S>(map_channels(sum, then), &mut block.rgb, i + k * len);
        }
    }
}
