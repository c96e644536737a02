use fearless_simd::Level;
use fearless_simd::prelude::*;

use super::block::{Block, Plane, load, load_rgb, map_channels, store, store_rgb, vector_starts};
use super::dispatch::dispatch;
use super::log2_exp2::log2s;
use super::matrix::{Splat, above_zero, zero_for_nan};
use crate::form::expose::{Expose, LOG2_E, MOST_NEGATIVE, NegativeLight};
use crate::scene_light::{IDENTITY, LOG_FLOOR, Rows, SCENE_MAX};

/// Scene light to the log2 exposure of each layer: the first step of the structured and the direct form.
pub(crate) fn expose(level: Level, expose: &Expose, block: &mut Block, count: usize) {
    dispatch!(level, simd => expose_with(simd, expose, block, count));
}

#[inline(always)]
fn expose_with<S: Simd>(simd: S, Expose { input, matrix, negative }: &Expose, block: &mut Block, count: usize) {
    let Block { rgb, scratch, .. } = block;
    let [exposures @ .., _] = &mut scratch.weight;
    if *input != IDENTITY {
        convert(simd, input, rgb, count);
    }
    let some_are_negative = expose_positive(simd, matrix, rgb, exposures, count);
    // Few pictures have such light, and those that do have it in few places.
    let compresses = *negative == NegativeLight::Compress && some_are_negative;
    if compresses {
        lower_by_negative(simd, matrix, rgb, exposures, count);
    }
    for (plane, exposure) in rgb.iter_mut().zip(exposures.iter()) {
        for i in vector_starts::<S>(count) {
            let log2 = log2s(simd, load(simd, exposure, i));
            store::<S>(if compresses { log2 - load(simd, plane, i) } else { log2 }, plane, i);
        }
    }
}

/// The picture's primaries to those of the exposure matrix.
#[inline(always)]
fn convert<S: Simd>(simd: S, input: &Rows, rgb: &mut [Plane; 3], count: usize) {
    let input = Splat::new(simd, input);
    for i in vector_starts::<S>(count) {
        let light = map_channels(
            load_rgb(simd, rgb, i),
            #[inline(always)]
            |v| zero_for_nan(simd, v).max(-SCENE_MAX).min(SCENE_MAX),
        );
        store_rgb::<S>(input.times(light), rgb, i);
    }
}

/// What the positive part of the light exposes each layer to, at least [`LOG_FLOOR`]; whether any of the light may be negative.
#[inline(always)]
fn expose_positive<S: Simd>(
    simd: S,
    matrix: &Rows,
    light: &[Plane; 3],
    exposures: &mut [Plane; 3],
    count: usize,
) -> bool {
    let matrix = Splat::new(simd, matrix);
    let mut signs = S::u32s::splat(simd, 0);
    for i in vector_starts::<S>(count) {
        let light = load_rgb(simd, light, i);
        signs = signs | light[0].bitcast::<S::u32s>() | light[1].bitcast::<S::u32s>() | light[2].bitcast::<S::u32s>();
        let positive = map_channels(
            light,
            #[inline(always)]
            |v| above_zero(simd, v).min(SCENE_MAX),
        );
        let exposed = map_channels(
            matrix.times(positive),
            #[inline(always)]
            |e: S::f32s| e.max(LOG_FLOOR),
        );
        store_rgb::<S>(exposed, exposures, i);
    }
    signs.simd_ge(1 << 31).any_true()
}

/// Light becomes what its negative part lowers the log2 exposures by, 0 where there is none.
#[inline(always)]
fn lower_by_negative<S: Simd>(simd: S, matrix: &Rows, light: &mut [Plane; 3], exposures: &[Plane; 3], count: usize) {
    let matrix = Splat::new(simd, matrix);
    for i in vector_starts::<S>(count) {
        let negative = map_channels(
            load_rgb(simd, light, i),
            #[inline(always)]
            |v| above_zero(simd, -v).min(SCENE_MAX),
        );
        let mut lowered = matrix.times(negative);
        for (lowered, exposure) in lowered.iter_mut().zip(load_rgb(simd, exposures, i)) {
            *lowered = lowered.max(0.0).min(exposure * MOST_NEGATIVE) / exposure * LOG2_E;
        }
        store_rgb::<S>(lowered, light, i);
    }
}

/// A matrix and an offset.
pub(crate) fn affine(level: Level, rows: &Rows, offset: [f32; 3], block: &mut Block, count: usize) {
    dispatch!(level, simd => affine_with(simd, rows, offset, block, count));
}

#[inline(always)]
fn affine_with<S: Simd>(simd: S, rows: &Rows, offset: [f32; 3], block: &mut Block, count: usize) {
    let (matrix, offset) = (
        Splat::new(simd, rows),
        map_channels(
            offset,
            #[inline(always)]
            |v| S::f32s::splat(simd, v),
        ),
    );
    for i in vector_starts::<S>(count) {
        store_rgb::<S>(matrix.times_plus(load_rgb(simd, &block.rgb, i), offset), &mut block.rgb, i);
    }
}
