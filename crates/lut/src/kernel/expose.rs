use fearless_simd::Level;
use fearless_simd::prelude::*;

use super::block::{Block, load_rgb, map_channels, store_rgb, vector_starts};
use super::dispatch::dispatch;
use super::log2_exp2::log2s;
use super::matrix::{above_zero, times, zero_for_nan};
use crate::scene_light::{IDENTITY, LOG_FLOOR, Rows, SCENE_MAX};

/// Scene light to the log2 exposure of each layer: the first steps of the structured and the direct form.
pub(crate) fn expose(level: Level, input: &Rows, exposure: &Rows, block: &mut Block, count: usize) {
    dispatch!(level, simd => expose_with(simd, input, exposure, block, count));
}

#[inline(always)]
fn expose_with<S: Simd>(simd: S, input: &Rows, exposure: &Rows, block: &mut Block, count: usize) {
    let is_identity = *input == IDENTITY;
    for i in vector_starts::<S>(count) {
        let mut colour = load_rgb(simd, &block.rgb, i);
        if !is_identity {
            colour = map_channels(
                colour,
                #[inline(always)]
                |v| zero_for_nan(simd, v).max(-SCENE_MAX).min(SCENE_MAX),
            );
            colour = times(simd, input, [0.0; 3], colour);
        }
        let scene = map_channels(
            colour,
            #[inline(always)]
            |v| above_zero(simd, v).min(SCENE_MAX),
        );
        let log2 = map_channels(
            times(simd, exposure, [0.0; 3], scene),
            #[inline(always)]
            |e: S::f32s| log2s(simd, e.max(LOG_FLOOR)),
        );
        store_rgb::<S>(log2, &mut block.rgb, i);
    }
}

/// A matrix and an offset.
pub(crate) fn affine(level: Level, rows: &Rows, offset: [f32; 3], block: &mut Block, count: usize) {
    dispatch!(level, simd => affine_with(simd, rows, offset, block, count));
}

#[inline(always)]
fn affine_with<S: Simd>(simd: S, rows: &Rows, offset: [f32; 3], block: &mut Block, count: usize) {
    for i in vector_starts::<S>(count) {
        let colour = load_rgb(simd, &block.rgb, i);
        store_rgb::<S>(times(simd, rows, offset, colour), &mut block.rgb, i);
    }
}
