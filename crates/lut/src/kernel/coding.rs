use fearless_simd::Level;
use fearless_simd::prelude::*;

use super::block::{Block, load_rgb, map_channels, store_rgb, vector_starts};
use super::dispatch::dispatch;
use super::log2_exp2::{exp2s, log2s};
use super::matrix::times;
use crate::coding::PowerNumbers;
use crate::scene_light::Rows;

/// Densities to coded light: 10^-density, a matrix, a coding.
pub(crate) fn decode_density(level: Level, rows: &Rows, coding: &PowerNumbers<f32>, block: &mut Block, count: usize) {
    dispatch!(level, simd => decode_with(simd, rows, coding, block, count));
}

#[inline(always)]
fn decode_with<S: Simd>(simd: S, rows: &Rows, coding: &PowerNumbers<f32>, block: &mut Block, count: usize) {
    for i in vector_starts::<S>(count) {
        let passed = map_channels(
            load_rgb(simd, &block.rgb, i),
            #[inline(always)]
            |density: S::f32s| exp2s(simd, density * -std::f32::consts::LOG2_10),
        );
        let coded = map_channels(
            times(simd, rows, [0.0; 3], passed),
            #[inline(always)]
            |light| code(simd, coding, light),
        );
        store_rgb::<S>(coded, &mut block.rgb, i);
    }
}

/// [`PowerNumbers::encode`] of each lane, for numbers that are not NaN.
#[inline(always)]
pub(super) fn code<S: Simd>(simd: S, coding: &PowerNumbers<f32>, linear: S::f32s) -> S::f32s {
    if coding.is_linear() {
        return linear;
    }
    let v = linear.abs();
    let power = exp2s(simd, log2s(simd, v) * coding.power);
    let power = power.mul_add(coding.scale, S::f32s::splat(simd, -coding.offset));
    let coded = v.simd_le(coding.end).select(v * coding.slope, power);
    coded.copysign(linear)
}
