use fearless_simd::Level;
use fearless_simd::prelude::*;

use super::block::{Block, Plane, load, load_rgb, map_plane, store, store_rgb, vector_starts};
use super::dispatch::dispatch;
use super::log2_exp2::{exp2s, exp2s_within, log2s};
use super::matrix::Splat;
use crate::coding::PowerNumbers;
use crate::scene_light::Rows;

/// Densities to coded light: 10^-density, a matrix, a coding.
pub(crate) fn decode_density(level: Level, rows: &Rows, coding: &PowerNumbers<f32>, block: &mut Block, count: usize) {
    dispatch!(level, simd => decode_with(simd, rows, &mut block.rgb, count));
    code(level, coding, block, count);
}

#[inline(always)]
fn decode_with<S: Simd>(simd: S, rows: &Rows, rgb: &mut [Plane; 3], count: usize) {
    for plane in rgb.iter_mut() {
        map_plane(
            simd,
            plane,
            count,
            #[inline(always)]
            |density| exp2s(simd, density * -std::f32::consts::LOG2_10),
        );
    }
    let matrix = Splat::new(simd, rows);
    for i in vector_starts::<S>(count) {
        store_rgb::<S>(matrix.times(load_rgb(simd, rgb, i)), rgb, i);
    }
}

/// [`PowerNumbers::encode`] of the block's colours, which are no NaN.
pub(crate) fn code(level: Level, coding: &PowerNumbers<f32>, Block { rgb, scratch, .. }: &mut Block, count: usize) {
    if coding.is_linear() {
        return;
    }
    let (coding, exponents) = (*coding, &mut scratch.weight[0]);
    dispatch!(level, simd => for plane in rgb.iter_mut() {
        find_exponents(simd, coding, plane, exponents, count);
        raise(simd, coding, exponents, plane, count);
    });
}

/// What 2 is raised to for the power of each number.
#[inline(always)]
fn find_exponents<S: Simd>(simd: S, coding: PowerNumbers<f32>, plane: &Plane, exponents: &mut Plane, count: usize) {
    for i in vector_starts::<S>(count) {
        store::<S>(log2s(simd, load(simd, plane, i).abs()) * coding.power, exponents, i);
    }
}

/// The coding of each number, from the exponents found.
#[inline(always)]
fn raise<S: Simd>(simd: S, coding: PowerNumbers<f32>, exponents: &Plane, plane: &mut Plane, count: usize) {
    let minus_offset = S::f32s::splat(simd, -coding.offset);
    for i in vector_starts::<S>(count) {
        let linear = load(simd, plane, i);
        let v = linear.abs();
        let power = exp2s_within(simd, load(simd, exponents, i)).mul_add(coding.scale, minus_offset);
        let coded = v.simd_le(coding.end).select(v * coding.slope, power);
        store::<S>(coded.copysign(linear), plane, i);
    }
}
