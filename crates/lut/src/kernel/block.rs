use fearless_simd::Level;
use fearless_simd::prelude::*;

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
    pub(super) place: [Plane<u32>; 4],
    /// Weights of vertices, or fractions of pieces.
    pub(super) weight: [Plane; 4],
    /// Both ends of a piece of a curve.
    pub(super) piece: Plane<[f32; 2]>,
}

impl Block {
    pub(crate) fn new() -> Self {
        let scratch = Scratch { place: [[0; BLOCK]; 4], weight: [[0.0; BLOCK]; 4], piece: [[0.0; 2]; BLOCK] };
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
        super::lookup::interleave(level, block, to);
    }
}

/// The starts of the vectors that cover the first `count` pixels.
#[inline(always)]
pub(super) fn starts<S: Simd>(count: usize) -> impl Iterator<Item = usize> {
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

/// Writes the places that start at pixel `i`.
#[inline(always)]
pub(super) fn store_place<S: Simd>(_: S, places: S::i32s, plane: &mut Plane<u32>, i: usize) {
    places.bitcast::<S::u32s>().store_slice(&mut plane[i..i + S::f32s::LEN]);
}

/// All three channels from pixel `i`.
#[inline(always)]
pub(super) fn load_rgb<S: Simd>(simd: S, rgb: &[Plane; 3], i: usize) -> [S::f32s; 3] {
    [load(simd, &rgb[0], i), load(simd, &rgb[1], i), load(simd, &rgb[2], i)]
}

/// `f` of each channel. Written out, as the rest here is: a closure within the library's loops would not be compiled for the
/// level it is used in.
#[inline(always)]
pub(super) fn each<T, U>([red, green, blue]: [T; 3], f: impl Fn(T) -> U) -> [U; 3] {
    [f(red), f(green), f(blue)]
}

/// Writes all three channels from pixel `i`.
#[inline(always)]
pub(super) fn store_rgb<S: Simd>([red, green, blue]: [S::f32s; 3], rgb: &mut [Plane; 3], i: usize) {
    store::<S>(red, &mut rgb[0], i);
    store::<S>(green, &mut rgb[1], i);
    store::<S>(blue, &mut rgb[2], i);
}
