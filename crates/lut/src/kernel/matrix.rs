use fearless_simd::prelude::*;

use crate::scene_light::Rows;

/// A matrix, each number in all lanes of a vector.
///
/// Made before a loop: what the loop stores to might be where the matrix lies for all the compiler knows, and then it loads the
/// numbers again for every vector.
#[derive(Clone, Copy)]
pub(super) struct Splat<S: Simd>([[S::f32s; 3]; 3]);

impl<S: Simd> Splat<S> {
    #[inline(always)]
    pub(super) fn new(simd: S, rows: &Rows) -> Self {
        let mut all = [[S::f32s::splat(simd, 0.0); 3]; 3];
        for (all, row) in all.iter_mut().zip(rows) {
            for (all, v) in all.iter_mut().zip(row) {
                *all = S::f32s::splat(simd, *v);
            }
        }
        Self(all)
    }

    /// The matrix times a colour of each lane.
    #[inline(always)]
    pub(super) fn times(self, [x, y, z]: [S::f32s; 3]) -> [S::f32s; 3] {
        let [red, green, blue] = self.0;
        [
            z.mul_add(red[2], y.mul_add(red[1], x * red[0])),
            z.mul_add(green[2], y.mul_add(green[1], x * green[0])),
            z.mul_add(blue[2], y.mul_add(blue[1], x * blue[0])),
        ]
    }

    /// The same, added to another colour.
    #[inline(always)]
    pub(super) fn times_plus(self, [x, y, z]: [S::f32s; 3], plus: [S::f32s; 3]) -> [S::f32s; 3] {
        let [red, green, blue] = self.0;
        [
            z.mul_add(red[2], y.mul_add(red[1], x.mul_add(red[0], plus[0]))),
            z.mul_add(green[2], y.mul_add(green[1], x.mul_add(green[0], plus[1]))),
            z.mul_add(blue[2], y.mul_add(blue[1], x.mul_add(blue[0], plus[2]))),
        ]
    }
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
