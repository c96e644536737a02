use fearless_simd::prelude::*;

use crate::scene_light::Rows;

/// `rows` times a colour of each lane, plus `offset`.
#[inline(always)]
pub(super) fn times<S: Simd>(simd: S, rows: &Rows, offset: [f32; 3], [x, y, z]: [S::f32s; 3]) -> [S::f32s; 3] {
    let mut out = [x, y, z];
    for ((out, row), offset) in out.iter_mut().zip(rows).zip(offset) {
        let sum = x.mul_add(row[0], S::f32s::splat(simd, offset));
        *out = z.mul_add(row[2], y.mul_add(row[1], sum));
    }
    out
}

/// The larger of the number and 0; 0 for NaN.
#[inline(always)]
pub(super) fn above_zero<S: Simd>(simd: S, v: S::f32s) -> S::f32s {
    let zero = S::f32s::splat(simd, 0.0);
    // x86 takes the second of two numbers if one is NaN; asking for that by name costs it two instructions more.
    if cfg!(any(target_arch = "x86", target_arch = "x86_64")) { v.max(zero) } else { v.max_precise(zero) }
}

/// [`finite`](crate::scene_light::finite) without the bounds: 0 for NaN, any other number as it is.
#[inline(always)]
pub(super) fn zero_for_nan<S: Simd>(simd: S, v: S::f32s) -> S::f32s {
    v.simd_eq(v).select(v, S::f32s::splat(simd, 0.0))
}
