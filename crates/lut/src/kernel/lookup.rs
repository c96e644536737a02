use fearless_simd::prelude::*;
use fearless_simd::{Level, f32x4};

use super::block::{BLOCK, Block, Plane, Scratch};
use super::cells::{Axes, find_cells};
use super::dispatch::dispatch;
use super::pair::{GROUP, Pair, each_of_far, each_of_near, far_pixels, is_fourth, near, near_pixels, transpose};
use crate::interpolate::Interpolation;
use crate::lut3d::Lut3d;
use crate::padded::with_padded;

/// Reads the table at the block's colours, which become what was read.
pub(crate) fn lookup(level: Level, axes: Axes<'_>, table: &Lut3d, how: Interpolation, block: &mut Block, count: usize) {
    find_cells(level, axes, block, count, table.size(), how);
    let Block { rgb, scratch, .. } = block;
    with_padded!(table.padded(), entries => dispatch!(level, simd => match how {
        Interpolation::Tetrahedral => planes(simd, rgb, scratch, count, &Tetrahedra::new(entries, scratch)),
        Interpolation::Trilinear => planes(simd, rgb, scratch, count, &Cubes::new(entries, table, scratch)),
    }));
}

/// As [`lookup()`], with the result and the block's alpha written to `to`.
pub(crate) fn lookup_to(
    level: Level,
    axes: Axes<'_>,
    table: &Lut3d,
    how: Interpolation,
    block: &mut Block,
    to: &mut [[f32; 4]],
) {
    find_cells(level, axes, block, to.len(), table.size(), how);
    with_padded!(table.padded(), entries => dispatch!(level, simd => match how {
        Interpolation::Tetrahedral => pixels(simd, block, to, &Tetrahedra::new(entries, &block.scratch)),
        Interpolation::Trilinear => pixels(simd, block, to, &Cubes::new(entries, table, &block.scratch)),
    }));
}

/// The value between the entries of a table, from the cells found.
trait Read<S: Simd> {
    /// The three numbers of each of `pixels`, with a fourth without meaning, from their weights.
    fn read(&self, simd: S, weights: [Pair<S>; 4], pixels: [usize; 2]) -> Pair<S>;
}

/// Four vertices of a cell.
struct Tetrahedra<'a, const N: usize> {
    entries: &'a [[f32; 4]; N],
    vertices: &'a [Plane<u32>; 4],
}

impl<'a, const N: usize> Tetrahedra<'a, N> {
    #[inline(always)]
    fn new(entries: &'a [[f32; 4]; N], scratch: &'a Scratch) -> Self {
        Self { entries, vertices: &scratch.index }
    }
}

impl<S: Simd, const N: usize> Read<S> for Tetrahedra<'_, N> {
    #[inline(always)]
    fn read(&self, simd: S, weights: [Pair<S>; 4], pixels: [usize; 2]) -> Pair<S> {
        let Self { entries, vertices: [first, second, third, fourth] } = self;
        let sum = pair_of(simd, entries, first, pixels, 0) * weights[0];
        let sum = pair_of(simd, entries, second, pixels, 0).mul_add(weights[1], sum);
        let sum = pair_of(simd, entries, third, pixels, 0).mul_add(weights[2], sum);
        pair_of(simd, entries, fourth, pixels, 0).mul_add(weights[3], sum)
    }
}

/// Eight corners of a cell.
struct Cubes<'a, const N: usize> {
    entries: &'a [[f32; 4]; N],
    corners: &'a Plane<u32>,
    /// From a corner of a cell to its neighbours along red, green and blue.
    steps: [u32; 3],
}

impl<'a, const N: usize> Cubes<'a, N> {
    #[inline(always)]
    fn new(entries: &'a [[f32; 4]; N], table: &Lut3d, Scratch { index: [corners, ..], .. }: &'a Scratch) -> Self {
        let size = table.size() as u32;
        Self { entries, corners, steps: [1, size, size * size] }
    }
}

impl<S: Simd, const N: usize> Read<S> for Cubes<'_, N> {
    #[inline(always)]
    fn read(&self, simd: S, [x, y, z, _]: [Pair<S>; 4], pixels: [usize; 2]) -> Pair<S> {
        let Self { entries, corners, steps: [red, green, blue] } = *self;
        let mut sides = [x; 2];
        for (side, step) in sides.iter_mut().zip([0, blue]) {
            let mut edges = [x; 2];
            for (edge, step) in edges.iter_mut().zip([step, step + green]) {
                let near = pair_of(simd, entries, corners, pixels, step);
                *edge = mix(simd, near, pair_of(simd, entries, corners, pixels, step + red), x);
            }
            *side = mix(simd, edges[0], edges[1], y);
        }
        mix(simd, sides[0], sides[1], z)
    }
}

/// The entries of two pixels, `step` beyond their indices, side by side.
#[inline(always)]
fn pair_of<S: Simd, const N: usize>(
    simd: S,
    entries: &[[f32; 4]; N],
    indices: &Plane<u32>,
    [a, b]: [usize; 2],
    step: u32,
) -> Pair<S> {
    let entry = |i: usize| entries[indices[i].wrapping_add(step) as usize % N];
    f32x4::simd_from(simd, entry(a)).combine(f32x4::simd_from(simd, entry(b)))
}

/// A weighted mean rather than `a + (b - a) t`: finite for all finite ends.
#[inline(always)]
fn mix<S: Simd>(simd: S, a: Pair<S>, b: Pair<S>, t: Pair<S>) -> Pair<S> {
    b.mul_add(t, a * (Pair::splat(simd, 1.0) - t))
}

/// Reads groups of pixels and transposes them to planes.
#[inline(always)]
fn planes<S: Simd>(
    simd: S,
    [red, green, blue]: &mut [Plane; 3],
    scratch: &Scratch,
    count: usize,
    table: &impl Read<S>,
) {
    for i in (0..count.min(BLOCK)).step_by(GROUP) {
        let w = weights(simd, scratch, i);
        let a = table.read(simd, each_of_far::<_, 0>(simd, w), far_pixels(i, 0));
        let b = table.read(simd, each_of_far::<_, 1>(simd, w), far_pixels(i, 1));
        let c = table.read(simd, each_of_far::<_, 2>(simd, w), far_pixels(i, 2));
        let d = table.read(simd, each_of_far::<_, 3>(simd, w), far_pixels(i, 3));
        let [r, g, b] = transpose([a, b, c, d]);
        r.store_slice(&mut red[i..i + GROUP]);
        g.store_slice(&mut green[i..i + GROUP]);
        b.store_slice(&mut blue[i..i + GROUP]);
    }
}

/// Reads each pixel to its place, alpha beside it.
#[inline(always)]
fn pixels<S: Simd>(simd: S, block: &Block, to: &mut [[f32; 4]], table: &impl Read<S>) {
    let mut groups = to.chunks_exact_mut(GROUP);
    let mut i = 0;
    for group in &mut groups {
        pixel_group(simd, block, group, table, i);
        i += GROUP;
    }
    let rest = groups.into_remainder();
    if !rest.is_empty() {
        let mut group = [[0.0; 4]; GROUP];
        pixel_group(simd, block, &mut group, table, i);
        rest.copy_from_slice(&group[..rest.len()]);
    }
}

#[inline(always)]
fn pixel_group<S: Simd>(simd: S, block: &Block, to: &mut [[f32; 4]], table: &impl Read<S>, i: usize) {
    let Block { alpha, scratch, .. } = block;
    let w = weights(simd, scratch, i);
    let alpha = Pair::from_slice(simd, &alpha[i..i + GROUP]);
    let to = to.as_flattened_mut();
    let is_alpha = is_fourth(simd);
    let colours = table.read(simd, each_of_near::<_, 0>(w), near_pixels(i, 0));
    is_alpha.select(near::<_, 0>(alpha), colours).store_slice(&mut to[..GROUP]);
    let colours = table.read(simd, each_of_near::<_, 1>(w), near_pixels(i, 1));
    is_alpha.select(near::<_, 1>(alpha), colours).store_slice(&mut to[GROUP..2 * GROUP]);
    let colours = table.read(simd, each_of_near::<_, 2>(w), near_pixels(i, 2));
    is_alpha.select(near::<_, 2>(alpha), colours).store_slice(&mut to[2 * GROUP..3 * GROUP]);
    let colours = table.read(simd, each_of_near::<_, 3>(w), near_pixels(i, 3));
    is_alpha.select(near::<_, 3>(alpha), colours).store_slice(&mut to[3 * GROUP..4 * GROUP]);
}

#[inline(always)]
fn weights<S: Simd>(simd: S, Scratch { weight, .. }: &Scratch, i: usize) -> [Pair<S>; 4] {
    let end = i + GROUP;
    let (a, b) = (Pair::from_slice(simd, &weight[0][i..end]), Pair::from_slice(simd, &weight[1][i..end]));
    [a, b, Pair::from_slice(simd, &weight[2][i..end]), Pair::from_slice(simd, &weight[3][i..end])]
}
