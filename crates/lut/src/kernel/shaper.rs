use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};

use super::block::{Block, load, starts, store};
use super::log2_exp2::log2s;
use crate::shaper::LogNumbers;

/// Scene light to coordinates: [`LogNumbers::encode`] of every number.
pub(crate) fn shape(level: Level, shaper: &LogNumbers, block: &mut Block, count: usize) {
    dispatch!(level, simd => shaped(simd, shaper, block, count));
}

#[inline(always)]
fn shaped<S: Simd>(simd: S, shaper: &LogNumbers, block: &mut Block, count: usize) {
    let (zero, one) = (S::f32s::splat(simd, 0.0), S::f32s::splat(simd, 1.0));
    for plane in &mut block.rgb {
        for i in starts::<S>(count) {
            let light = load(simd, plane, i);
            // A comparison, so that NaN becomes 0 on every machine.
            let above = light.simd_gt(zero).select(light, zero);
            let coordinate = log2s(simd, above.mul_add(shaper.per_offset, one)) * shaper.per_stop;
            store::<S>(light.simd_ge(shaper.max).select(one, coordinate), plane, i);
        }
    }
}
