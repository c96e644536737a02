use fearless_simd::Level;
use fearless_simd::prelude::*;

use super::block::{Block, load_rgb, map_channels, map_plane, store, store_indices, vector_starts};
use super::dispatch::dispatch;
use super::log2_exp2::log2s;
use super::matrix::above_zero;
use crate::interpolate::Interpolation;
use crate::shaper::LogNumbers;

/// What the block's colours are to a table.
#[derive(Clone, Copy)]
pub(crate) enum Axes<'a> {
    /// Its coordinates, clamped to [0, 1]; not NaN.
    Coordinates,
    /// Light that a shaper makes coordinates of, as [`LogNumbers::encode`] does.
    Light(&'a LogNumbers),
}

/// Finds the cells of the block's colours in a table of `size` nodes a side, and what [`super::lookup`] needs to read them.
pub(super) fn find_cells(
    level: Level,
    axes: Axes<'_>,
    block: &mut Block,
    count: usize,
    size: usize,
    how: Interpolation,
) {
    let cells = (size - 1) as f32;
    match axes {
        Axes::Coordinates => dispatch!(level, simd => cells_with(simd, block, count, size, how, Scaled { cells })),
        Axes::Light(&LogNumbers { per_offset, per_stop, .. }) => {
            let shaper = Shaped { per_offset, per_stop: per_stop * cells, cells };
            dispatch!(level, simd => for plane in &mut block.rgb {
                map_plane(simd, plane, count,
                    #[inline(always)]
                    |value: _| shaper.position(simd, value));
            });
            dispatch!(level, simd => cells_with(simd, block, count, size, how, InCells));
        }
    }
}

/// From a colour's channel to a position along an axis of the table, in cells.
trait Position: Copy {
    fn position<S: Simd>(self, simd: S, value: S::f32s) -> S::f32s;
}

/// Coordinates.
#[derive(Clone, Copy)]
struct Scaled {
    cells: f32,
}

impl Position for Scaled {
    #[inline(always)]
    fn position<S: Simd>(self, _: S, value: S::f32s) -> S::f32s {
        value.max(0.0).min(1.0) * self.cells
    }
}

/// Positions already.
#[derive(Clone, Copy)]
struct InCells;

impl Position for InCells {
    #[inline(always)]
    fn position<S: Simd>(self, _: S, value: S::f32s) -> S::f32s {
        value
    }
}

/// Light.
#[derive(Clone, Copy)]
struct Shaped {
    per_offset: f32,
    /// Cells of the table for each stop.
    per_stop: f32,
    cells: f32,
}

impl Position for Shaped {
    #[inline(always)]
    fn position<S: Simd>(self, simd: S, value: S::f32s) -> S::f32s {
        let ratio = above_zero(simd, value).mul_add(self.per_offset, S::f32s::splat(simd, 1.0));
        (log2s(simd, ratio) * self.per_stop).min(self.cells)
    }
}

#[inline(always)]
fn cells_with<S: Simd>(simd: S, block: &mut Block, count: usize, size: usize, how: Interpolation, axis: impl Position) {
    match how {
        Interpolation::Tetrahedral => tetrahedra(simd, block, count, size, axis),
        Interpolation::Trilinear => cubes(simd, block, count, size, axis),
    }
}

/// The number of the entry where each lane's cell starts, and how far into the cell the lane lies.
#[inline(always)]
fn corner<S: Simd>(simd: S, colour: [S::f32s; 3], size: usize, axis: impl Position) -> (S::i32s, [S::f32s; 3]) {
    let position = map_channels(
        colour,
        #[inline(always)]
        |value| axis.position(simd, value),
    );
    // The last node has a cell of its own here, from which only that node is taken.
    let node = map_channels(
        position,
        #[inline(always)]
        |p: S::f32s| p.trunc(),
    );
    // Whole numbers below 2^24 (256^3 at most): exact.
    let size = S::f32s::splat(simd, size as f32);
    let entry = node[2].mul_add(size, node[1]).mul_add(size, node[0]);
    (entry.to_int(), [position[0] - node[0], position[1] - node[1], position[2] - node[2]])
}

/// The four vertices of the tetrahedron that a colour lies in, and their weights.
#[inline(always)]
fn tetrahedra<S: Simd>(simd: S, block: &mut Block, count: usize, size: usize, axis: impl Position) {
    let steps = map_channels(
        [1, size, size * size],
        #[inline(always)]
        |step| S::i32s::splat(simd, step as i32),
    );
    let across = steps[0] + steps[1] + steps[2];
    let scratch = &mut block.scratch;
    for i in vector_starts::<S>(count) {
        let (start, [x, y, z]) = corner(simd, load_rgb(simd, &block.rgb, i), size, axis);
        let end = start + across;
        let (low, high) = (x.min(y), x.max(y));
        let (least, most) = (low.min(z), high.max(z));
        let middle = low.max(high.min(z));
        // Where fractions are equal the vertex between them has weight 0, so that any order of them does.
        let first = x.simd_eq(most).select(steps[0], y.simd_eq(most).select(steps[1], steps[2]));
        let last = z.simd_eq(least).select(steps[2], y.simd_eq(least).select(steps[1], steps[0]));
        store_indices(simd, start, &mut scratch.index[0], i);
        store_indices(simd, start + first, &mut scratch.index[1], i);
        store_indices(simd, end - last, &mut scratch.index[2], i);
        store_indices(simd, end, &mut scratch.index[3], i);
        store::<S>(S::f32s::splat(simd, 1.0) - most, &mut scratch.weight[0], i);
        store::<S>(most - middle, &mut scratch.weight[1], i);
        store::<S>(middle - least, &mut scratch.weight[2], i);
        store::<S>(least, &mut scratch.weight[3], i);
    }
}

/// The first corner of a cell, and how far into it along each axis.
#[inline(always)]
fn cubes<S: Simd>(simd: S, block: &mut Block, count: usize, size: usize, axis: impl Position) {
    let scratch = &mut block.scratch;
    for i in vector_starts::<S>(count) {
        let (start, [x, y, z]) = corner(simd, load_rgb(simd, &block.rgb, i), size, axis);
        store_indices(simd, start, &mut scratch.index[0], i);
        store::<S>(x, &mut scratch.weight[0], i);
        store::<S>(y, &mut scratch.weight[1], i);
        store::<S>(z, &mut scratch.weight[2], i);
    }
}
