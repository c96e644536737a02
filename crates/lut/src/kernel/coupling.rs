use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};

use super::block::{Block, Scratch, load_rgb, store_rgb, vector_starts};
use super::curves::Curves;
use crate::scene_light::Rows;

/// `h + matrix q` with the values `q` of the curves at the log2 exposures `h`.
pub(crate) fn couple(level: Level, curves: &Curves, matrix: &Rows, block: &mut Block, count: usize) {
    curves.read_beside(level, block, count);
    dispatch!(level, simd => couple_with(simd, matrix, block, count));
}

#[inline(always)]
fn couple_with<S: Simd>(simd: S, matrix: &Rows, block: &mut Block, count: usize) {
    let Block { rgb, scratch: Scratch { value, .. }, .. } = block;
    for i in vector_starts::<S>(count) {
        let q = load_rgb(simd, value, i);
        let mut h = load_rgb(simd, rgb, i);
        for (h, row) in h.iter_mut().zip(matrix) {
            *h = q[2].mul_add(row[2], q[1].mul_add(row[1], q[0].mul_add(row[0], *h)));
        }
        store_rgb::<S>(h, rgb, i);
    }
}
