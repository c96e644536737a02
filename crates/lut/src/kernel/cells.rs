use fearless_simd::prelude::*;

use super::block::{Block, each, load_rgb, starts, store, store_place};
use crate::interpolate::Interpolation;

/// Numbers of an entry, as [`Lut3d::numbers`] has them.
///
/// [`Lut3d::numbers`]: crate::lut3d::Lut3d::numbers
pub(super) const NUMBERS: i32 = 3;

/// Finds the cells of coordinates (clamped to [0, 1], not NaN) in a table of `size` nodes a side, and what
/// [`super::lookup`] needs to read them.
#[inline(always)]
pub(super) fn find<S: Simd>(simd: S, block: &mut Block, count: usize, size: usize, how: Interpolation) {
    match how {
        Interpolation::Tetrahedral => tetrahedra(simd, block, count, size),
        Interpolation::Trilinear => cubes(simd, block, count, size),
    }
}

/// The corner of each lane's cell as a number of its entry, and how far into the cell it lies.
#[inline(always)]
fn corner<S: Simd>(simd: S, coordinates: [S::f32s; 3], size: usize) -> (S::i32s, [S::f32s; 3]) {
    let cells = S::f32s::splat(simd, (size - 1) as f32);
    let last = S::f32s::splat(simd, (size - 2) as f32);
    let position = each(
        coordinates,
        #[inline(always)]
        |c: S::f32s| c.max(0.0).min(1.0) * cells,
    );
    let node = each(
        position,
        #[inline(always)]
        |p: S::f32s| p.trunc().min(last),
    );
    // Whole numbers below 2^24 (256^3 at most): exact.
    let size = S::f32s::splat(simd, size as f32);
    let entry = node[2].mul_add(size, node[1]).mul_add(size, node[0]);
    (entry.to_int(), [position[0] - node[0], position[1] - node[1], position[2] - node[2]])
}

/// Three vertices (the fourth lies at a fixed distance from the first) and four weights.
#[inline(always)]
fn tetrahedra<S: Simd>(simd: S, block: &mut Block, count: usize, size: usize) {
    let steps = each(
        [1, size, size * size],
        #[inline(always)]
        |step| S::i32s::splat(simd, NUMBERS * step as i32),
    );
    let across = steps[0] + steps[1] + steps[2];
    let scratch = &mut block.scratch;
    for i in starts::<S>(count) {
        let (entry, [x, y, z]) = corner(simd, load_rgb(simd, &block.rgb, i), size);
        let (low, high) = (x.min(y), x.max(y));
        let (least, most) = (low.min(z), high.max(z));
        let middle = low.max(high.min(z));
        // Where fractions are equal the vertex between them has weight 0, so that any order of them does.
        let first = x.simd_eq(most).select(steps[0], y.simd_eq(most).select(steps[1], steps[2]));
        let last = z.simd_eq(least).select(steps[2], y.simd_eq(least).select(steps[1], steps[0]));
        let start = entry * NUMBERS;
        store_place(simd, start, &mut scratch.place[0], i);
        store_place(simd, first, &mut scratch.place[1], i);
        store_place(simd, across - last, &mut scratch.place[2], i);
        store::<S>(S::f32s::splat(simd, 1.0) - most, &mut scratch.weight[0], i);
        store::<S>(most - middle, &mut scratch.weight[1], i);
        store::<S>(middle - least, &mut scratch.weight[2], i);
        store::<S>(least, &mut scratch.weight[3], i);
    }
}

/// The corner and the three fractions.
#[inline(always)]
fn cubes<S: Simd>(simd: S, block: &mut Block, count: usize, size: usize) {
    let scratch = &mut block.scratch;
    for i in starts::<S>(count) {
        let (entry, [x, y, z]) = corner(simd, load_rgb(simd, &block.rgb, i), size);
        store_place(simd, entry * NUMBERS, &mut scratch.place[0], i);
        store::<S>(x, &mut scratch.weight[0], i);
        store::<S>(y, &mut scratch.weight[1], i);
        store::<S>(z, &mut scratch.weight[2], i);
    }
}
