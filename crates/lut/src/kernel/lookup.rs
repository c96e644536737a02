use fearless_simd::prelude::*;
use fearless_simd::{Level, f32x4, f32x8, f32x16};

use super::block::{BLOCK, Block, Plane, Scratch};
use super::cells::{Axes, find_cells};
use super::dispatch::dispatch;
use super::wide::Wide;
use crate::interpolate::Interpolation;
use crate::lut3d::Lut3d;
use crate::padded::with_padded;

/// Reads the table at the block's colours, which become what was read.
pub(crate) fn lookup(level: Level, axes: Axes<'_>, table: &Lut3d, how: Interpolation, block: &mut Block, count: usize) {
    find_cells(level, axes, block, count, table.size(), how);
    let Block { rgb, scratch, .. } = block;
    with_padded!(table.padded(), entries => dispatch!(level, simd => match how {
        Interpolation::Tetrahedral => to_planes(simd, rgb, scratch, count, &Tetrahedra::new(entries, scratch)),
        Interpolation::Trilinear => to_planes(simd, rgb, scratch, count, &Cubes::new(entries, table, scratch)),
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
        Interpolation::Tetrahedral => to_pixels(simd, block, to, &Tetrahedra::new(entries, &block.scratch)),
        Interpolation::Trilinear => to_pixels(simd, block, to, &Cubes::new(entries, table, &block.scratch)),
    }));
}

/// The value between the entries of a table, from the cells found.
trait Read<S: Simd> {
    /// The three numbers of each of `pixels`, with a fourth without meaning, from their weights.
    fn read<V: Wide<S>>(&self, simd: S, weights: [V; 4], pixels: [usize; 4]) -> V;
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
    fn read<V: Wide<S>>(&self, simd: S, weights: [V; 4], pixels: [usize; 4]) -> V {
        let Self { entries, vertices: [first, second, third, fourth] } = self;
        let sum = combine_pixels::<S, V, N>(simd, entries, first, pixels, 0) * weights[0];
        let sum = combine_pixels::<S, V, N>(simd, entries, second, pixels, 0).mul_add(weights[1], sum);
        let sum = combine_pixels::<S, V, N>(simd, entries, third, pixels, 0).mul_add(weights[2], sum);
        combine_pixels::<S, V, N>(simd, entries, fourth, pixels, 0).mul_add(weights[3], sum)
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
    fn read<V: Wide<S>>(&self, simd: S, [x, y, z, _]: [V; 4], pixels: [usize; 4]) -> V {
        let Self { entries, corners, steps: [red, green, blue] } = *self;
        let mut sides = [x; 2];
        for (side, step) in sides.iter_mut().zip([0, blue]) {
            let mut edges = [x; 2];
            for (edge, step) in edges.iter_mut().zip([step, step + green]) {
                let near = combine_pixels::<S, V, N>(simd, entries, corners, pixels, step);
                *edge = mix(simd, near, combine_pixels::<S, V, N>(simd, entries, corners, pixels, step + red), x);
            }
            *side = mix(simd, edges[0], edges[1], y);
        }
        mix(simd, sides[0], sides[1], z)
    }
}

/// The entries of several pixels, `step` beyond their indices, side by side.
#[inline(always)]
fn combine_pixels<S: Simd, V: Wide<S>, const N: usize>(
    simd: S,
    entries: &[[f32; 4]; N],
    indices: &Plane<u32>,
    [a, b, c, d]: [usize; 4],
    step: u32,
) -> V {
    let entry = |i: usize| entries[indices[i].wrapping_add(step) as usize % N];
    let (a, b) = (f32x4::simd_from(simd, entry(a)), f32x4::simd_from(simd, entry(b)));
    V::combine_pixels([a, b, f32x4::simd_from(simd, entry(c)), f32x4::simd_from(simd, entry(d))])
}

/// A weighted mean rather than `a + (b - a) t`: finite for all finite ends.
#[inline(always)]
fn mix<S: Simd, V: Wide<S>>(simd: S, a: V, b: V, t: V) -> V {
    b.mul_add(t, a * (V::splat(simd, 1.0) - t))
}

/// On the widest vectors that the level has; where it has but narrow ones, on two of them. The choice is a constant, so that only
/// one of the two is compiled for a level.
#[inline(always)]
fn to_planes<S: Simd>(simd: S, rgb: &mut [Plane; 3], scratch: &Scratch, count: usize, table: &impl Read<S>) {
    if const { S::f32s::LEN == 16 } {
        planes::<S, f32x16<S>>(simd, rgb, scratch, count, table);
    } else {
        planes::<S, f32x8<S>>(simd, rgb, scratch, count, table);
    }
}

#[inline(always)]
fn to_pixels<S: Simd>(simd: S, block: &Block, to: &mut [[f32; 4]], table: &impl Read<S>) {
    if const { S::f32s::LEN == 16 } {
        pixels::<S, f32x16<S>>(simd, block, to, table);
    } else {
        pixels::<S, f32x8<S>>(simd, block, to, table);
    }
}

/// Reads groups of pixels and transposes them to planes.
#[inline(always)]
fn planes<S: Simd, V: Wide<S>>(
    simd: S,
    [red, green, blue]: &mut [Plane; 3],
    scratch: &Scratch,
    count: usize,
    table: &impl Read<S>,
) {
    for i in (0..count.min(BLOCK)).step_by(V::LEN) {
        let w = weights::<S, V>(simd, scratch, i);
        let a = table.read(simd, V::each_of_far::<0>(simd, w), V::far_pixels(i, 0));
        let b = table.read(simd, V::each_of_far::<1>(simd, w), V::far_pixels(i, 1));
        let c = table.read(simd, V::each_of_far::<2>(simd, w), V::far_pixels(i, 2));
        let d = table.read(simd, V::each_of_far::<3>(simd, w), V::far_pixels(i, 3));
        let [r, g, b] = V::transpose([a, b, c, d]);
        r.store_slice(&mut red[i..i + V::LEN]);
        g.store_slice(&mut green[i..i + V::LEN]);
        b.store_slice(&mut blue[i..i + V::LEN]);
    }
}

/// Reads each pixel to its place, alpha beside it.
#[inline(always)]
fn pixels<S: Simd, V: Wide<S>>(simd: S, block: &Block, to: &mut [[f32; 4]], table: &impl Read<S>) {
    let mut groups = to.chunks_exact_mut(V::LEN);
    let mut i = 0;
    for group in &mut groups {
        pixel_group::<S, V>(simd, block, group, table, i);
        i += V::LEN;
    }
    let rest = groups.into_remainder();
    if !rest.is_empty() {
        let mut group = [[0.0; 4]; 16];
        pixel_group::<S, V>(simd, block, &mut group[..V::LEN], table, i);
        rest.copy_from_slice(&group[..rest.len()]);
    }
}

#[inline(always)]
fn pixel_group<S: Simd, V: Wide<S>>(simd: S, block: &Block, to: &mut [[f32; 4]], table: &impl Read<S>, i: usize) {
    let Block { alpha, scratch, .. } = block;
    let w = weights::<S, V>(simd, scratch, i);
    let alpha = V::from_slice(simd, &alpha[i..i + V::LEN]);
    let to = to.as_flattened_mut();
    let is_alpha = V::is_fourth(simd);
    let colours = table.read(simd, V::each_of_near::<0>(w), V::near_pixels(i, 0));
    is_alpha.select(V::near::<0>(alpha), colours).store_slice(&mut to[..V::LEN]);
    let colours = table.read(simd, V::each_of_near::<1>(w), V::near_pixels(i, 1));
    is_alpha.select(V::near::<1>(alpha), colours).store_slice(&mut to[V::LEN..2 * V::LEN]);
    let colours = table.read(simd, V::each_of_near::<2>(w), V::near_pixels(i, 2));
    is_alpha.select(V::near::<2>(alpha), colours).store_slice(&mut to[2 * V::LEN..3 * V::LEN]);
    let colours = table.read(simd, V::each_of_near::<3>(w), V::near_pixels(i, 3));
    is_alpha.select(V::near::<3>(alpha), colours).store_slice(&mut to[3 * V::LEN..4 * V::LEN]);
}

#[inline(always)]
fn weights<S: Simd, V: Wide<S>>(simd: S, Scratch { weight, .. }: &Scratch, i: usize) -> [V; 4] {
    let end = i + V::LEN;
    let (a, b) = (V::from_slice(simd, &weight[0][i..end]), V::from_slice(simd, &weight[1][i..end]));
    [a, b, V::from_slice(simd, &weight[2][i..end]), V::from_slice(simd, &weight[3][i..end])]
}
