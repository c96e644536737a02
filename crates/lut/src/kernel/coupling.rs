use fearless_simd::Level;
use fearless_simd::prelude::*;

use super::block::{BLOCK, Block, Scratch, load, load_rgb, store_rgb, vector_starts};
use super::curves::CurveAxis;
use super::dispatch::dispatch;
use crate::lut1d::Lut1d;
use crate::scene_light::Rows;

/// The most pieces of a coupling's curves: an index of eight bits needs no check.
pub(crate) const MAX_PIECES: usize = 256;

/// The curves by which layers act on each other, and their matrix.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CouplingCurves {
    channels: [ChannelCurve; 3],
    matrix: Rows,
}

/// A channel's curve: value and rise of each piece.
#[derive(Clone, Debug, PartialEq)]
struct ChannelCurve {
    pieces: Box<[[f32; 2]; MAX_PIECES]>,
    axis: CurveAxis,
}

impl CouplingCurves {
    /// Of curves with at most [`MAX_PIECES`] pieces; what is beyond is left out.
    pub(crate) fn new(table: &Lut1d, matrix: Rows) -> Self {
        let channels = std::array::from_fn(|c| {
            let mut pieces = Box::new([[0.0; 2]; MAX_PIECES]);
            for (piece, ends) in pieces.iter_mut().zip(table.entries().windows(2)) {
                *piece = [ends[0][c], ends[1][c] - ends[0][c]];
            }
            ChannelCurve { pieces, axis: CurveAxis::new(table, c) }
        });
        Self { channels, matrix }
    }

    /// `h + matrix q` with the values `q` of the curves at the log2 exposures `h`, which hold no NaN.
    pub(crate) fn apply(&self, level: Level, block: &mut Block, count: usize) {
        dispatch!(level, simd => self.apply_with(simd, block, count));
    }

    #[inline(always)]
    fn apply_with<S: Simd>(&self, simd: S, Block { rgb, scratch, .. }: &mut Block, count: usize) {
        let Scratch { index, weight, piece } = scratch;
        for (c, curve) in self.channels.iter().enumerate() {
            curve.axis.find(simd, &rgb[c], &mut index[c], &mut weight[c], count);
        }
        let covered = count.next_multiple_of(S::f32s::LEN).min(BLOCK);
        for ((curve, piece), index) in self.channels.iter().zip(piece.iter_mut()).zip(index.iter()) {
            for (piece, index) in piece.iter_mut().zip(&index[..covered]) {
                *piece = curve.pieces[usize::from(*index as u8)];
            }
        }
        for i in vector_starts::<S>(count) {
            let mut h = load_rgb(simd, rgb, i);
            for (c, piece) in piece.iter().enumerate() {
                let (ends, at) = (piece.as_flattened(), 2 * i);
                let first = S::f32s::from_slice(simd, &ends[at..at + S::f32s::LEN]);
                let second = S::f32s::from_slice(simd, &ends[at + S::f32s::LEN..at + 2 * S::f32s::LEN]);
                let (value, rise) = first.deinterleave(second);
                let q = rise.mul_add(load(simd, &weight[c], i), value);
                for (h, row) in h.iter_mut().zip(&self.matrix) {
                    *h = q.mul_add(row[c], *h);
                }
            }
            store_rgb::<S>(h, rgb, i);
        }
    }
}
