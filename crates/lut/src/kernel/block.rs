use fearless_simd::prelude::*;
use fearless_simd::{Level, f32x4};

use super::dispatch::dispatch;

/// Pixels in a block: few enough for all scratch to stay in the first cache, many enough to hide what a block costs once.
pub(crate) const BLOCK: usize = 128;

/// One number for each pixel of a block.
pub(crate) type Plane<T = f32> = [T; BLOCK];

/// Colours on their way through a form, with the scratch of its steps. One lives as long as a task does.
///
/// Steps work on whole vectors: pixels beyond the last hold numbers of earlier blocks, which nobody stores.
#[repr(align(64))]
pub(crate) struct Block {
    pub(crate) rgb: [Plane; 3],
    pub(crate) alpha: Plane,
    pub(crate) scratch: Scratch,
}

/// What steps leave for their own second half.
#[repr(align(64))]
pub(crate) struct Scratch {
    /// Where entries lie: a vertex of a cell, or the start of a piece of a curve.
    pub(super) index: [Plane<u32>; 4],
    /// Weights of vertices, or fractions of pieces.
    pub(super) weight: [Plane; 4],
    /// Both numbers of a piece of a curve.
    pub(super) piece: [Plane<[f32; 2]>; 3],
}

impl Block {
    pub(crate) fn new() -> Self {
        let scratch = Scratch { index: [[0; BLOCK]; 4], weight: [[0.0; BLOCK]; 4], piece: [[[0.0; 2]; BLOCK]; 3] };
        Self { rgb: [[0.0; BLOCK]; 3], alpha: [1.0; BLOCK], scratch }
    }
}

/// The way from one colour to another, for a block at once.
pub(crate) trait BlockMap: Sync {
    /// Maps the first `count` pixels of the block.
    fn map_block(&self, level: Level, block: &mut Block, count: usize);

    /// As [`BlockMap::map_block`], with the result and the block's alpha written to `to`.
    fn map_block_to(&self, level: Level, block: &mut Block, to: &mut [[f32; 4]]) {
        self.map_block(level, block, to.len());
        interleave(level, block, to);
    }
}

/// Writes the block's colours and alpha.
pub(crate) fn interleave(level: Level, block: &Block, to: &mut [[f32; 4]]) {
    dispatch!(level, simd => interleave_with(simd, block, to));
}

#[inline(always)]
fn interleave_with<S: Simd>(simd: S, block: &Block, to: &mut [[f32; 4]]) {
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

/// The starts of the vectors that cover the first `count` pixels.
#[inline(always)]
pub(super) fn vector_starts<S: Simd>(count: usize) -> impl Iterator<Item = usize> {
    (0..count.min(BLOCK)).step_by(S::f32s::LEN)
}

/// The vector that starts at pixel `i`.
#[inline(always)]
pub(super) fn load<S: Simd>(simd: S, plane: &Plane, i: usize) -> S::f32s {
    S::f32s::from_slice(simd, &plane[i..i + S::f32s::LEN])
}

/// Writes the vector that starts at pixel `i`.
#[inline(always)]
pub(super) fn store<S: Simd>(vector: S::f32s, plane: &mut Plane, i: usize) {
    vector.store_slice(&mut plane[i..i + S::f32s::LEN]);
}

/// Writes the numbers of entries for the pixels from `i`.
#[inline(always)]
pub(super) fn store_indices<S: Simd>(_: S, indices: S::i32s, plane: &mut Plane<u32>, i: usize) {
    indices.bitcast::<S::u32s>().store_slice(&mut plane[i..i + S::f32s::LEN]);
}

/// All three channels from pixel `i`.
#[inline(always)]
pub(super) fn load_rgb<S: Simd>(simd: S, rgb: &[Plane; 3], i: usize) -> [S::f32s; 3] {
    [load(simd, &rgb[0], i), load(simd, &rgb[1], i), load(simd, &rgb[2], i)]
}

/// `f` of each channel. Written out, as the rest here is: a closure within the library's loops would not be compiled for the
/// level it is used in.
#[inline(always)]
pub(super) fn map_channels<T, U>([red, green, blue]: [T; 3], f: impl Fn(T) -> U) -> [U; 3] {
    [f(red), f(green), f(blue)]
}

/// Writes all three channels from pixel `i`.
#[inline(always)]
pub(super) fn store_rgb<S: Simd>([red, green, blue]: [S::f32s; 3], rgb: &mut [Plane; 3], i: usize) {
    store::<S>(red, &mut rgb[0], i);
    store::<S>(green, &mut rgb[1], i);
    store::<S>(blue, &mut rgb[2], i);
}
