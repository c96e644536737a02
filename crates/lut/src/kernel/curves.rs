use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};

use super::block::{BLOCK, Block, Plane, Scratch, load, starts, store, store_place};
use crate::lut1d::Lut1d;

/// The curves of a [`Lut1d`], one after the other: as many bytes again as the table has.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Curves([Curve; 3]);

/// Entries of a channel, where the first of them lies, and entries for each unit of input.
#[derive(Clone, Debug, PartialEq)]
struct Curve {
    entries: Vec<f32>,
    start: f32,
    scale: f32,
}

impl Curves {
    pub(crate) fn new(table: &Lut1d) -> Self {
        let [min, max] = [table.domain().min(), table.domain().max()];
        Self(std::array::from_fn(|c| Curve {
            entries: table.entries().iter().map(|entry| entry[c]).collect(),
            start: min[c],
            scale: (table.size() - 1) as f32 / (max[c] - min[c]),
        }))
    }

    /// Reads each channel's curve at that channel's plane, which holds no NaN.
    pub(crate) fn apply(&self, level: Level, Block { rgb, scratch, .. }: &mut Block, count: usize) {
        for (curve, plane) in self.0.iter().zip(rgb) {
            dispatch!(level, simd => curve.apply(simd, plane, scratch, count));
        }
    }
}

impl Curve {
    #[inline(always)]
    fn apply<S: Simd>(&self, simd: S, plane: &mut Plane, scratch: &mut Scratch, count: usize) {
        let Scratch { place: [place, ..], weight: [fraction, ..], piece } = scratch;
        let end = (self.entries.len() - 1) as f32;
        let last = S::f32s::splat(simd, end - 1.0);
        for i in starts::<S>(count) {
            let position = ((load(simd, plane, i) - self.start) * self.scale).max(0.0).min(end);
            let index = position.trunc().min(last);
            store::<S>(position - index, fraction, i);
            store_place(simd, index.to_int(), place, i);
        }
        let covered = count.next_multiple_of(S::f32s::LEN).min(BLOCK);
        for (piece, place) in piece.iter_mut().zip(&place[..covered]) {
            let place = *place as usize;
            let ends = &self.entries[place..place + 2];
            *piece = [ends[0], ends[1]];
        }
        let ends = piece.as_flattened();
        for i in starts::<S>(count) {
            let (low, high) = (2 * i, 2 * i + S::f32s::LEN);
            let pairs = S::f32s::from_slice(simd, &ends[low..high]);
            let (near, far) = pairs.deinterleave(S::f32s::from_slice(simd, &ends[high..high + S::f32s::LEN]));
            let t = load(simd, fraction, i);
            store::<S>(far.mul_add(t, near * (S::f32s::splat(simd, 1.0) - t)), plane, i);
        }
    }
}
