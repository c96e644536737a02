//! A form cut where the first film is exposed and where it is developed.

use fearless_simd::Level;
use fearless_simd::prelude::*;

use super::block::{Block, Plane, load, store, vector_starts};
use super::dispatch::dispatch;
use super::log2_exp2::{exp2s, log2s};
use super::matrix::above_zero;
use crate::scene_light::LOG_FLOOR;

/// The three steps of a form, for a block at once; one after the other they are the form's
/// [`BlockMap`](super::block::BlockMap).
pub(crate) trait BlockSteps: Sync {
    /// Between what the values of the first film are held where they do not come from its curves.
    fn held(&self) -> [[f32; 2]; 3];

    /// Scene light to log2 exposure.
    fn expose_block(&self, level: Level, block: &mut Block, count: usize);

    /// Log2 exposure to what the first film holds.
    fn develop_block(&self, level: Level, block: &mut Block, count: usize);

    /// What the first film holds to the form's output.
    fn finish_block(&self, level: Level, block: &mut Block, count: usize);
}

/// As far beyond the ends of each channel as they are apart.
pub(crate) fn widened(ends: [[f32; 2]; 3]) -> [[f32; 2]; 3] {
    ends.map(|[low, high]| [low - (high - low), high + (high - low)])
}

/// Exposures of the block's log2 exposures.
pub(crate) fn exp2_of_block(level: Level, block: &mut Block, count: usize) {
    dispatch!(level, simd => block.rgb.iter_mut().for_each(#[inline(always)] |plane| exp2_with(simd, plane, count)));
}

#[inline(always)]
fn exp2_with<S: Simd>(simd: S, plane: &mut Plane, count: usize) {
    for i in vector_starts::<S>(count) {
        store::<S>(exp2s(simd, load(simd, plane, i)), plane, i);
    }
}

/// Log2 exposures of the block's exposures, which are at least [`LOG_FLOOR`]; NaN counts as 0.
pub(crate) fn log2_of_block(level: Level, block: &mut Block, count: usize) {
    dispatch!(level, simd => block.rgb.iter_mut().for_each(#[inline(always)] |plane| log2_with(simd, plane, count)));
}

#[inline(always)]
fn log2_with<S: Simd>(simd: S, plane: &mut Plane, count: usize) {
    for i in vector_starts::<S>(count) {
        let exposure = above_zero(simd, load(simd, plane, i)).max(LOG_FLOOR);
        store::<S>(log2s(simd, exposure), plane, i);
    }
}
