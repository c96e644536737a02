use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd};

use super::block::{Block, MOST_LANES, Plane, load, store, store_indices, vector_starts};
use super::dispatch::dispatch;
use crate::lut1d::Lut1d;

/// The curves of a [`Lut1d`] as the loops read them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Curves([ChannelCurve; 3]);

/// A channel's curve: its pieces, and where they lie. Clones share the pieces.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ChannelCurve {
    /// As many as one of [`LENGTHS`]: an index modulo that length needs no check.
    pieces: Arc<Vec<f64>>,
    axis: CurveAxis,
}

/// The lengths that the pieces of a curve are padded to with zeros. Each is compiled for itself. Taking a number modulo the first two
/// costs nothing: a processor loads the lower 8 or 16 bits alone.
const LENGTHS: [usize; 3] = [1 << 8, 1 << 16, 1 << 20];

/// Where the pieces of a channel's curve lie.
#[derive(Clone, Copy, Debug, PartialEq)]
struct CurveAxis {
    /// The number of pieces, which is where the last ends.
    end: f32,
    /// Where the first begins.
    start: f32,
    /// Pieces for each unit of input.
    scale: f32,
}

/// A piece of a curve as one number of eight bytes, which a vector takes by one load: its value at the start in the lower half, its
/// rise in the upper.
fn piece(value: f32, rise: f32) -> f64 {
    f64::from_bits(u64::from(rise.to_bits()) << 32 | u64::from(value.to_bits()))
}

impl Curves {
    pub(crate) fn new(table: &Lut1d) -> Self {
        Self(std::array::from_fn(|channel| ChannelCurve::new(table, channel)))
    }

    /// Reads each channel's curve at that channel's plane, which holds no NaN; values take the place of what they are read at.
    pub(crate) fn apply(&self, level: Level, Block { rgb, scratch, .. }: &mut Block, count: usize) {
        for (curve, plane) in self.0.iter().zip(rgb) {
            curve.apply(level, plane, &mut scratch.index[0], count);
        }
    }
}

impl ChannelCurve {
    pub(super) fn new(table: &Lut1d, channel: usize) -> Self {
        let [min, max] = [table.domain().min()[channel], table.domain().max()[channel]];
        let count = table.size() - 1;
        let length = LENGTHS.into_iter().find(|length| count <= *length).unwrap_or(LENGTHS[2]);
        let mut pieces = vec![0.0; length];
        for (to, ends) in pieces.iter_mut().zip(table.entries().windows(2)) {
            *to = piece(ends[0][channel], ends[1][channel] - ends[0][channel]);
        }
        let end = count as f32;
        Self { pieces: Arc::new(pieces), axis: CurveAxis { end, start: min, scale: end / (max - min) } }
    }

    /// The curve's values at the numbers of a plane, which are not NaN, in place of them.
    pub(super) fn apply(&self, level: Level, plane: &mut Plane, index: &mut Plane<u32>, count: usize) {
        dispatch!(level, simd => find(simd, self.axis, plane, index, count));
        if let Some(pieces) = self.pieces.first_chunk::<{ LENGTHS[2] }>() {
            dispatch!(level, simd => read(simd, pieces, index, plane, count));
        } else if let Some(pieces) = self.pieces.first_chunk::<{ LENGTHS[1] }>() {
            dispatch!(level, simd => read(simd, pieces, index, plane, count));
        } else if let Some(pieces) = self.pieces.first_chunk::<{ LENGTHS[0] }>() {
            dispatch!(level, simd => read(simd, pieces, index, plane, count));
        }
    }
}

/// The piece that each number lies in; the number becomes how far in it.
#[inline(always)]
fn find<S: Simd>(simd: S, axis: CurveAxis, plane: &mut Plane, index: &mut Plane<u32>, count: usize) {
    let last = S::f32s::splat(simd, axis.end - 1.0).to_int::<S::i32s>();
    for i in vector_starts::<S>(count) {
        let position = ((load(simd, plane, i) - axis.start) * axis.scale).max(0.0).min(axis.end);
        let start = position.to_int::<S::i32s>().min(last);
        store_indices(simd, start, index, i);
        store::<S>(position - start.to_float::<S::f32s>(), plane, i);
    }
}

/// The value in each piece, in place of how far in it.
#[inline(always)]
fn read<S: Simd, const N: usize>(simd: S, pieces: &[f64; N], index: &Plane<u32>, plane: &mut Plane, count: usize) {
    for i in vector_starts::<S>(count) {
        // In each block of four lanes the pieces of the first two pixels are in one vector, those of the others in the second.
        let at = &index[i..i + S::f32s::LEN];
        let first = S::f64s::from_fn(
            simd,
            #[inline(always)]
            |k| pieces[at[k / 2 * 4 + k % 2] as usize % N],
        );
        let second = S::f64s::from_fn(
            simd,
            #[inline(always)]
            |k| pieces[at[k / 2 * 4 + k % 2 + 2] as usize % N],
        );
        let [value, rise] = unzip_blocks(simd, first.bitcast(), second.bitcast());
        store::<S>(rise.mul_add(load(simd, plane, i), value), plane, i);
    }
}

/// The numbers at even places of two vectors, and those at odd ones, block by block of four lanes: one instruction each on most
/// processors, once the compiler has seen what these selections come to.
#[inline(always)]
fn unzip_blocks<S: Simd>(simd: S, a: S::f32s, b: S::f32s) -> [S::f32s; 2] {
    let mask = |lanes: [i32; 4]| lane_mask(simd, lanes);
    let [of_a, first, last] = [mask([-1, -1, 0, 0]), mask([-1, 0, 0, 0]), mask([0, 0, 0, -1])];
    let [a_1, a_2] = [a.slide_within_blocks::<1>(a), a.slide_within_blocks::<2>(a)];
    let [b_2, b_3] = [b.slide_within_blocks::<2>(b), b.slide_within_blocks::<3>(b)];
    let even = of_a.select(first.select(a, a_1), last.select(b_3, b_2));
    let odd = of_a.select(first.select(a_1, a_2), last.select(b, b_3));
    [even, odd]
}

/// The same mask for each block of four lanes.
#[inline(always)]
fn lane_mask<S: Simd>(simd: S, lanes: [i32; 4]) -> S::mask32s {
    let all: [i32; MOST_LANES] = std::array::from_fn(|lane| lanes[lane % 4]);
    S::mask32s::from_slice(simd, &all[..S::f32s::LEN])
}
