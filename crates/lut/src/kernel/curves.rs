use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd};

use super::block::{Block, Plane, load, store, store_indices, vector_starts};
use super::dispatch::dispatch;
use crate::lut1d::Lut1d;

/// The curves of a [`Lut1d`] as the loops read them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Curves([ChannelCurve; 3]);

/// A channel's curve: its points, and where they lie. Clones share the points.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ChannelCurve {
    /// Bits of each point's value. As many as one of [`LENGTHS`] and one more: a number modulo that length is a point with a next one, and
    /// needs no check.
    points: Arc<Vec<u32>>,
    axis: CurveAxis,
}

/// The lengths that the points of a curve are padded to with zeros, but for the one behind them. Each is compiled for itself. Taking a
/// number modulo the first two costs nothing: a processor loads the lower 8 or 16 bits alone.
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
        let entries = table.entries();
        let length = LENGTHS.into_iter().find(|length| entries.len() <= *length).unwrap_or(LENGTHS[2]);
        let mut points = vec![0; length + 1];
        // The last stands twice: at the end, nothing is added to it.
        for (to, entry) in points.iter_mut().zip(entries.iter().chain(entries.last())) {
            *to = entry[channel].to_bits();
        }
        let end = (entries.len() - 1) as f32;
        Self { points: Arc::new(points), axis: CurveAxis { end, start: min, scale: end / (max - min) } }
    }

    /// The curve's values at the numbers of a plane, which are not NaN, in place of them.
    pub(super) fn apply(&self, level: Level, plane: &mut Plane, index: &mut Plane<u32>, count: usize) {
        dispatch!(level, simd => find(simd, self.axis, plane, index, count));
        if let Some(points) = self.points.first_chunk::<{ LENGTHS[2] + 1 }>() {
            dispatch!(level, simd => read::<_, { LENGTHS[2] }, _>(simd, points, index, plane, count));
        } else if let Some(points) = self.points.first_chunk::<{ LENGTHS[1] + 1 }>() {
            dispatch!(level, simd => read::<_, { LENGTHS[1] }, _>(simd, points, index, plane, count));
        } else if let Some(points) = self.points.first_chunk::<{ LENGTHS[0] + 1 }>() {
            dispatch!(level, simd => read::<_, { LENGTHS[0] }, _>(simd, points, index, plane, count));
        }
    }
}

/// The piece that each number lies in; the number becomes how far in it.
#[inline(always)]
fn find<S: Simd>(simd: S, axis: CurveAxis, plane: &mut Plane, index: &mut Plane<u32>, count: usize) {
    for i in vector_starts::<S>(count) {
        let position = ((load(simd, plane, i) - axis.start) * axis.scale).max(0.0).min(axis.end);
        let start = position.to_int::<S::i32s>();
        store_indices(simd, start, index, i);
        store::<S>(position - start.to_float::<S::f32s>(), plane, i);
    }
}

/// The value in each piece, in place of how far in it.
#[inline(always)]
fn read<S: Simd, const N: usize, const POINTS: usize>(
    simd: S,
    points: &[u32; POINTS],
    index: &Plane<u32>,
    plane: &mut Plane,
    count: usize,
) {
    for i in vector_starts::<S>(count) {
        let at = &index[i..i + S::f32s::LEN];
        let first = S::f64s::from_fn(
            simd,
            #[inline(always)]
            |k| piece::<N, POINTS>(points, at[k]),
        );
        let second = S::f64s::from_fn(
            simd,
            #[inline(always)]
            |k| piece::<N, POINTS>(points, at[k + S::f32s::LEN / 2]),
        );
        let (value, next) = first.bitcast::<S::f32s>().deinterleave(second.bitcast::<S::f32s>());
        store::<S>((next - value).mul_add(load(simd, plane, i), value), plane, i);
    }
}

/// A point and the next as one number of eight bytes, which a vector takes by one load.
#[inline(always)]
fn piece<const N: usize, const POINTS: usize>(points: &[u32; POINTS], at: u32) -> f64 {
    let at = at as usize % N;
    f64::from_bits(u64::from(points[at + 1]) << 32 | u64::from(points[at]))
}
