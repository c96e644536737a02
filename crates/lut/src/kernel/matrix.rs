use fearless_simd::prelude::*;

use crate::form::structured::Rows;

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
