use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};

use super::block::{Block, each, load_rgb, starts, store_rgb};
use super::log2_exp2::log2s;
use super::matrix::times;
use crate::form::structured::{INPUT_MAX, LOG_FLOOR, Rows};

const IDENTITY: Rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Scene light to the log2 exposure of each layer: the first steps of the structured and the direct form.
pub(crate) fn expose(level: Level, input: &Rows, exposure: &Rows, block: &mut Block, count: usize) {
    dispatch!(level, simd => exposed(simd, input, exposure, block, count));
}

#[inline(always)]
fn exposed<S: Simd>(simd: S, input: &Rows, exposure: &Rows, block: &mut Block, count: usize) {
    let is_identity = *input == IDENTITY;
    for i in starts::<S>(count) {
        let mut colour = load_rgb(simd, &block.rgb, i);
        if !is_identity {
            colour = each(
                colour,
                #[inline(always)]
                |v| number(simd, v).max(-INPUT_MAX).min(INPUT_MAX),
            );
            colour = times(simd, input, [0.0; 3], colour);
        }
        let scene = each(
            colour,
            #[inline(always)]
            |v| above_zero(simd, v).min(INPUT_MAX),
        );
        let log2 = each(
            times(simd, exposure, [0.0; 3], scene),
            #[inline(always)]
            |e: S::f32s| log2s(simd, e.max(LOG_FLOOR)),
        );
        store_rgb::<S>(log2, &mut block.rgb, i);
    }
}

/// The larger of the number and 0; 0 for NaN.
#[inline(always)]
pub(super) fn above_zero<S: Simd>(simd: S, v: S::f32s) -> S::f32s {
    let zero = S::f32s::splat(simd, 0.0);
    // x86 takes the second of two numbers if one is NaN; asking for that by name costs it two instructions more.
    if cfg!(any(target_arch = "x86", target_arch = "x86_64")) { v.max(zero) } else { v.max_precise(zero) }
}

/// 0 for NaN.
#[inline(always)]
pub(super) fn number<S: Simd>(simd: S, v: S::f32s) -> S::f32s {
    v.simd_eq(v).select(v, S::f32s::splat(simd, 0.0))
}

/// A matrix and an offset.
pub(crate) fn affine(level: Level, rows: &Rows, offset: [f32; 3], block: &mut Block, count: usize) {
    dispatch!(level, simd => mixed(simd, rows, offset, block, count));
}

#[inline(always)]
fn mixed<S: Simd>(simd: S, rows: &Rows, offset: [f32; 3], block: &mut Block, count: usize) {
    for i in starts::<S>(count) {
        let colour = load_rgb(simd, &block.rgb, i);
        store_rgb::<S>(times(simd, rows, offset, colour), &mut block.rgb, i);
    }
}
