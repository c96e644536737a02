use fearless_simd::Level;
use fearless_simd::prelude::*;

use super::block::{Block, Plane, Scratch, load_rgb, store_rgb, vector_starts};
use super::curves::ChannelCurve;
use super::dispatch::dispatch;
use super::matrix::Splat;
use crate::lut1d::Lut1d;
use crate::scene_light::Rows;

/// The most pieces of a coupling's curves.
pub(crate) const MAX_PIECES: usize = 256;

/// The curves by which layers act on each other, and their matrix.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct CouplingCurves {
    channels: [ChannelCurve; 3],
    matrix: Rows,
}

impl CouplingCurves {
    pub(crate) fn new(table: &Lut1d, matrix: Rows) -> Self {
        Self { channels: std::array::from_fn(|channel| ChannelCurve::new(table, channel)), matrix }
    }

    /// `h + matrix q` with the values `q` of the curves at the log2 exposures `h`, which hold no NaN.
    pub(crate) fn apply(&self, level: Level, Block { rgb, scratch, .. }: &mut Block, count: usize) {
        let Scratch { index: [index, ..], weight: [_, acting @ ..], .. } = scratch;
        *acting = *rgb;
        for (curve, plane) in self.channels.iter().zip(acting.iter_mut()) {
            curve.apply(level, plane, index, count);
        }
        dispatch!(level, simd => shift(simd, &self.matrix, acting, rgb, count));
    }
}

/// Adds `matrix` times one colour to another.
#[inline(always)]
fn shift<S: Simd>(simd: S, matrix: &Rows, by: &[Plane; 3], rgb: &mut [Plane; 3], count: usize) {
    let matrix = Splat::new(simd, matrix);
    for i in vector_starts::<S>(count) {
        store_rgb::<S>(matrix.times_plus(load_rgb(simd, by, i), load_rgb(simd, rgb, i)), rgb, i);
    }
}
