use fearless_simd::Level;
use fearless_simd::prelude::*;

use super::dispatch::dispatch;

/// Pixels in a block: few enough for all scratch to stay in the first cache, many enough to hide what a block costs once.
pub(crate) const BLOCK: usize = 128;

/// The most lanes that a vector of a level has.
pub(crate) const MOST_LANES: usize = 16;

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
    /// Where entries of a table lie: a vertex of a cell.
    pub(super) index: [Plane<u32>; 4],
    /// Weights of vertices, or numbers that a step works on beside the colours.
    pub(super) weight: [Plane; 4],
}

impl Block {
    pub(crate) fn new() -> Self {
        let scratch = Scratch { index: [[0; BLOCK]; 4], weight: [[0.0; BLOCK]; 4] };
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
    let mut groups = to.chunks_exact_mut(S::f32s::LEN);
    let mut i = 0;
    for group in &mut groups {
        interleave_group(simd, block, i, group);
        i += S::f32s::LEN;
    }
    let rest = groups.into_remainder();
    if !rest.is_empty() {
        let mut group = [[0.0; 4]; MOST_LANES];
        interleave_group(simd, block, i, &mut group[..S::f32s::LEN]);
        rest.copy_from_slice(&group[..rest.len()]);
    }
}

/// As many pixels as a vector has lanes, from pixel `i` on.
#[inline(always)]
fn interleave_group<S: Simd>(simd: S, block: &Block, i: usize, to: &mut [[f32; 4]]) {
    let [red, green, blue] = load_rgb(simd, &block.rgb, i);
    let alpha = load(simd, &block.alpha, i);
    let (samples, len) = (to.as_flattened_mut(), S::f32s::LEN);
    let (rb, rb_far) = red.interleave(blue);
    let (ga, ga_far) = green.interleave(alpha);
    let (a, b) = rb.interleave(ga);
    let (c, d) = rb_far.interleave(ga_far);
    a.store_slice(&mut samples[..len]);
    b.store_slice(&mut samples[len..2 * len]);
    c.store_slice(&mut samples[2 * len..3 * len]);
    d.store_slice(&mut samples[3 * len..4 * len]);
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

/// `f` of each number of the first `count` of a plane, in place of it.
///
/// A step that takes many constants goes through one plane after the other: together with one colour channel they stay in the
/// registers, of which most processors have sixteen. Three channels at once would have them loaded again and again.
#[inline(always)]
pub(super) fn map_plane<S: Simd>(simd: S, plane: &mut Plane, count: usize, f: impl Fn(S::f32s) -> S::f32s) {
    // Two vectors a turn: what the loop itself costs is a tenth of what it does.
    let len = S::f32s::LEN;
    for i in (0..count.min(BLOCK)).step_by(2 * len) {
        let (near, far) = (f(load(simd, plane, i)), f(load(simd, plane, i + len)));
        store::<S>(near, plane, i);
        store::<S>(far, plane, i + len);
    }
}
