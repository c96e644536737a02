use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f32x4, f64x2};

use super::block::{BLOCK, Block, Scratch};
use super::cells::{self, NUMBERS};
use crate::interpolate::Interpolation;
use crate::lut3d::Lut3d;

/// Reads the table at the block's coordinates, which become what was read.
pub(crate) fn lookup(level: Level, table: &Lut3d, how: Interpolation, block: &mut Block, count: usize) {
    dispatch!(level, simd => {
        cells::find(simd, block, count, table.size(), how);
        match how {
            Interpolation::Tetrahedral => planes(block, count, &Tetrahedra::new(simd, table)),
            Interpolation::Trilinear => planes(block, count, &Cubes::new(simd, table)),
        }
    });
}

/// As [`lookup()`], with the result and the block's alpha written to `to`.
pub(crate) fn lookup_to(level: Level, table: &Lut3d, how: Interpolation, block: &mut Block, to: &mut [[f32; 4]]) {
    dispatch!(level, simd => {
        cells::find(simd, block, to.len(), table.size(), how);
        match how {
            Interpolation::Tetrahedral => pixels(block, to, &Tetrahedra::new(simd, table)),
            Interpolation::Trilinear => pixels(block, to, &Cubes::new(simd, table)),
        }
    });
}

/// Writes the block's colours and alpha.
pub(crate) fn interleave(level: Level, block: &Block, to: &mut [[f32; 4]]) {
    dispatch!(level, simd => interleaved(simd, block, to));
}

#[inline(always)]
fn interleaved<S: Simd>(simd: S, block: &Block, to: &mut [[f32; 4]]) {
    let planes = [&block.rgb[0], &block.rgb[1], &block.rgb[2], &block.alpha];
    let mut fours = to.chunks_exact_mut(4);
    let mut i = 0;
    for four in &mut fours {
        let mut vectors = [f32x4::splat(simd, 0.0); 4];
        for (vector, plane) in vectors.iter_mut().zip(planes) {
            *vector = f32x4::from_slice(simd, &plane[i..i + 4]);
        }
        f32x4::store_four_interleaved(vectors, four.as_flattened_mut());
        i += 4;
    }
    for (k, pixel) in fours.into_remainder().iter_mut().enumerate() {
        *pixel = planes.map(|plane| plane[i + k]);
    }
}

/// A value between the entries of a table, from the cells found.
trait Read<S: Simd> {
    /// The three numbers of a pixel of the block, and a fourth without meaning.
    fn read(&self, scratch: &Scratch, i: usize) -> f32x4<S>;
}

struct Tetrahedra<'a, S> {
    simd: S,
    numbers: &'a [f32],
    /// From the first corner of a cell to the last.
    across: usize,
}

impl<'a, S: Simd> Tetrahedra<'a, S> {
    #[inline(always)]
    fn new(simd: S, table: &'a Lut3d) -> Self {
        let size = table.size();
        Self { simd, numbers: table.numbers(), across: NUMBERS as usize * (1 + size + size * size) }
    }
}

impl<S: Simd> Read<S> for Tetrahedra<'_, S> {
    #[inline(always)]
    fn read(&self, Scratch { place, weight, .. }: &Scratch, i: usize) -> f32x4<S> {
        let start = place[0][i] as usize;
        let cell = &self.numbers[start..start + self.across + 4];
        // They are within the cell; said once more, so that the compiler checks the cell only.
        let first = (place[1][i] as usize).min(self.across);
        let second = (place[2][i] as usize).min(self.across);
        let sum = entry(self.simd, cell, 0) * weight[0][i];
        let sum = entry(self.simd, cell, first).mul_add(weight[1][i], sum);
        let sum = entry(self.simd, cell, second).mul_add(weight[2][i], sum);
        entry(self.simd, cell, self.across).mul_add(weight[3][i], sum)
    }
}

struct Cubes<'a, S> {
    simd: S,
    numbers: &'a [f32],
    steps: [usize; 3],
}

impl<'a, S: Simd> Cubes<'a, S> {
    #[inline(always)]
    fn new(simd: S, table: &'a Lut3d) -> Self {
        let size = table.size();
        let step = NUMBERS as usize;
        Self { simd, numbers: table.numbers(), steps: [step, step * size, step * size * size] }
    }
}

impl<S: Simd> Read<S> for Cubes<'_, S> {
    #[inline(always)]
    fn read(&self, Scratch { place, weight, .. }: &Scratch, i: usize) -> f32x4<S> {
        let [r, g, b] = self.steps;
        let [x, y, z] = [weight[0][i], weight[1][i], weight[2][i]];
        let start = place[0][i] as usize;
        let cell = &self.numbers[start..start + r + g + b + 4];
        let mut sides = [f32x4::splat(self.simd, 0.0); 2];
        for (side, step) in sides.iter_mut().zip([0, b]) {
            let near = mix(entry(self.simd, cell, step), entry(self.simd, cell, step + r), x);
            let far = mix(entry(self.simd, cell, step + g), entry(self.simd, cell, step + r + g), x);
            *side = mix(near, far, y);
        }
        mix(sides[0], sides[1], z)
    }
}

/// A weighted mean rather than `a + (b - a) t`: finite for all finite ends.
#[inline(always)]
fn mix<S: Simd>(a: f32x4<S>, b: f32x4<S>, t: f32) -> f32x4<S> {
    b.mul_add(t, a * (1.0 - t))
}

/// Four numbers at once: the entry, and the next one's first.
#[inline(always)]
fn entry<S: Simd>(simd: S, numbers: &[f32], start: usize) -> f32x4<S> {
    f32x4::from_slice(simd, &numbers[start..start + 4])
}

/// Reads four pixels at a time and turns them to planes.
#[inline(always)]
fn planes<S: Simd>(block: &mut Block, count: usize, table: &impl Read<S>) {
    let [red, green, blue] = &mut block.rgb;
    for i in (0..count.min(BLOCK)).step_by(4) {
        let [a, b] = [table.read(&block.scratch, i), table.read(&block.scratch, i + 1)];
        let [c, d] = [table.read(&block.scratch, i + 2), table.read(&block.scratch, i + 3)];
        let (low, high): (f64x2<S>, f64x2<S>) = (a.zip_low(b).bitcast(), c.zip_low(d).bitcast());
        low.zip_low(high).bitcast::<f32x4<S>>().store_slice(&mut red[i..i + 4]);
        low.zip_high(high).bitcast::<f32x4<S>>().store_slice(&mut green[i..i + 4]);
        let (low, high): (f64x2<S>, f64x2<S>) = (a.zip_high(b).bitcast(), c.zip_high(d).bitcast());
        low.zip_low(high).bitcast::<f32x4<S>>().store_slice(&mut blue[i..i + 4]);
    }
}

/// Reads each pixel to its place, alpha beside it.
#[inline(always)]
fn pixels<S: Simd>(block: &Block, to: &mut [[f32; 4]], table: &impl Read<S>) {
    for (i, (to, alpha)) in to.iter_mut().zip(&block.alpha).enumerate() {
        let mut pixel = table.read(&block.scratch, i);
        pixel[3] = *alpha;
        pixel.store_array(to);
    }
}
