use fearless_simd::Level;
use fearless_simd::prelude::*;

use super::block::{BLOCK, Block, Plane, Scratch, load, store, store_indices, vector_starts};
use super::dispatch::dispatch;
use crate::lut1d::Lut1d;

/// The curves of a [`Lut1d`], one after the other: twice as many bytes again as the table has.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Curves([ChannelCurve; 3]);

/// Both ends of each piece of a channel's curve.
#[derive(Clone, Debug, PartialEq)]
struct ChannelCurve {
    pieces: Vec<[f32; 2]>,
    axis: CurveAxis,
}

/// Where the pieces of a channel's curve lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct CurveAxis {
    /// The number of pieces, which is where the last ends.
    end: f32,
    /// Where the first begins.
    start: f32,
    /// Pieces for each unit of input.
    scale: f32,
}

impl CurveAxis {
    pub(super) fn new(table: &Lut1d, channel: usize) -> Self {
        let [min, max] = [table.domain().min()[channel], table.domain().max()[channel]];
        let end = (table.size() - 1) as f32;
        Self { end, start: min, scale: end / (max - min) }
    }

    /// The piece that each number of a plane, which holds no NaN, lies in, and where in it.
    #[inline(always)]
    pub(super) fn find<S: Simd>(
        &self,
        simd: S,
        plane: &Plane,
        index: &mut Plane<u32>,
        fraction: &mut Plane,
        count: usize,
    ) {
        let last = S::f32s::splat(simd, self.end - 1.0);
        for i in vector_starts::<S>(count) {
            let position = ((load(simd, plane, i) - self.start) * self.scale).max(0.0).min(self.end);
            let start = position.trunc().min(last);
            store::<S>(position - start, fraction, i);
            store_indices(simd, start.to_int(), index, i);
        }
    }
}

impl Curves {
    pub(crate) fn new(table: &Lut1d) -> Self {
        Self(std::array::from_fn(|c| ChannelCurve {
            pieces: table.entries().windows(2).map(|ends| [ends[0][c], ends[1][c]]).collect(),
            axis: CurveAxis::new(table, c),
        }))
    }

    /// Reads each channel's curve at that channel's plane, which holds no NaN; values take the place of what they are read at.
    pub(crate) fn apply(&self, level: Level, Block { rgb, scratch, .. }: &mut Block, count: usize) {
        for (curve, plane) in self.0.iter().zip(rgb) {
            dispatch!(level, simd => curve.apply(simd, plane, scratch, count));
        }
    }
}

impl ChannelCurve {
    #[inline(always)]
    fn apply<S: Simd>(&self, simd: S, plane: &mut Plane, scratch: &mut Scratch, count: usize) {
        let Scratch { index: [index, ..], weight: [fraction, ..], piece: [piece, ..] } = scratch;
        self.axis.find(simd, plane, index, fraction, count);
        let covered = count.next_multiple_of(S::f32s::LEN).min(BLOCK);
        for (piece, index) in piece.iter_mut().zip(&index[..covered]) {
            *piece = self.pieces.get(*index as usize).copied().unwrap_or_default();
        }
        let ends = piece.as_flattened();
        for i in vector_starts::<S>(count) {
            let (low, high) = (2 * i, 2 * i + S::f32s::LEN);
            let pairs = S::f32s::from_slice(simd, &ends[low..high]);
            let (near, far) = pairs.deinterleave(S::f32s::from_slice(simd, &ends[high..high + S::f32s::LEN]));
            let t = load(simd, fraction, i);
            store::<S>(far.mul_add(t, near * (S::f32s::splat(simd, 1.0) - t)), plane, i);
        }
    }
}
