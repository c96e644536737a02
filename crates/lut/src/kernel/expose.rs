use fearless_simd::Level;
use fearless_simd::prelude::*;

use super::block::{Block, load_rgb, map_channels, store_rgb, vector_starts};
use super::dispatch::dispatch;
use super::log2_exp2::log2s;
use super::matrix::{above_zero, times, zero_for_nan};
use crate::form::expose::{Expose, LOG2_E, MOST_NEGATIVE, NegativeLight};
use crate::scene_light::{IDENTITY, LOG_FLOOR, Rows, SCENE_MAX};

/// Scene light to the log2 exposure of each layer: the first step of the structured and the direct form.
pub(crate) fn expose(level: Level, expose: &Expose, block: &mut Block, count: usize) {
    dispatch!(level, simd => expose_with(simd, expose, block, count));
}

#[inline(always)]
fn expose_with<S: Simd>(simd: S, Expose { input, matrix, negative }: &Expose, block: &mut Block, count: usize) {
    let is_identity = *input == IDENTITY;
    let compresses = *negative == NegativeLight::Compress;
    let floor = S::f32s::splat(simd, LOG_FLOOR);
    for i in vector_starts::<S>(count) {
        let mut light = load_rgb(simd, &block.rgb, i);
        if !is_identity {
            light = map_channels(
                light,
                #[inline(always)]
                |v| zero_for_nan(simd, v).max(-SCENE_MAX).min(SCENE_MAX),
            );
            light = times(simd, input, [0.0; 3], light);
        }
        let positive = map_channels(
            light,
            #[inline(always)]
            |v| above_zero(simd, v).min(SCENE_MAX),
        );
        let exposure = map_channels(
            times(simd, matrix, [0.0; 3], positive),
            #[inline(always)]
            |e: S::f32s| e.max(floor),
        );
        let mut log2 = map_channels(
            exposure,
            #[inline(always)]
            |e: S::f32s| log2s(simd, e),
        );
        // Few pictures have such light, and those that do have it in few places.
        if compresses && any_below_zero(simd, light) {
            let negative = map_channels(
                light,
                #[inline(always)]
                |v| above_zero(simd, -v).min(SCENE_MAX),
            );
            let negative = times(simd, matrix, [0.0; 3], negative);
            for ((log2, exposure), negative) in log2.iter_mut().zip(exposure).zip(negative) {
                *log2 -= negative.max(0.0).min(exposure * MOST_NEGATIVE) / exposure * LOG2_E;
            }
        }
        store_rgb::<S>(log2, &mut block.rgb, i);
    }
}

#[inline(always)]
fn any_below_zero<S: Simd>(simd: S, light: [S::f32s; 3]) -> bool {
    let zero = S::f32s::splat(simd, 0.0);
    let [red, green, blue] = map_channels(
        light,
        #[inline(always)]
        |v: S::f32s| v.simd_lt(zero),
    );
    (red | green | blue).any_true()
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
