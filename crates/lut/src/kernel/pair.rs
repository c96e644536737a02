use fearless_simd::prelude::*;
use fearless_simd::{f32x4, f32x8, f64x2, mask32x8, u8x32};

/// Pixels that four pairs hold.
pub(super) const GROUP: usize = 8;

/// Two pixels of four numbers each, side by side: on every level, since wider vectors take longer to fill from a table than they save.
///
/// Four pairs hold the pixels of a group: `near` ones follow each other in the order of the pixels, `far` ones are four pixels apart,
/// which makes planes of them with least work.
pub(super) type Pair<S> = f32x8<S>;

/// The group's pixels that near pair `k` holds.
#[inline(always)]
pub(super) fn near_pixels(start: usize, k: usize) -> [usize; 2] {
    let first = start + 2 * k;
    [first, first + 1]
}

/// The group's pixels that far pair `k` holds.
#[inline(always)]
pub(super) fn far_pixels(start: usize, k: usize) -> [usize; 2] {
    [start + k, start + k + 4]
}

/// A number for each pixel of a group: those of near pair `K`, four times each.
#[inline(always)]
pub(super) fn near<S: Simd, const K: usize>(numbers: Pair<S>) -> Pair<S> {
    let (low, high) = numbers.interleave(numbers);
    let half = if K < 2 { low } else { high };
    let (low, high) = half.interleave(half);
    if K.is_multiple_of(2) { low } else { high }
}

/// Those of far pair `K`, four times each.
#[inline(always)]
pub(super) fn far<S: Simd, const K: usize>(simd: S, numbers: Pair<S>) -> Pair<S> {
    let bytes = const {
        let mut bytes = [0; 32];
        let mut at = 0;
        while at < bytes.len() {
            bytes[at] = (4 * K + at % 4) as u8;
            at += 1;
        }
        bytes
    };
    numbers.swizzle_dyn_within_blocks(u8x32::simd_from(simd, bytes))
}

/// [`near`] of each weight.
#[inline(always)]
pub(super) fn each_of_near<S: Simd, const K: usize>([a, b, c, d]: [Pair<S>; 4]) -> [Pair<S>; 4] {
    [near::<S, K>(a), near::<S, K>(b), near::<S, K>(c), near::<S, K>(d)]
}

/// [`far`] of each weight.
#[inline(always)]
pub(super) fn each_of_far<S: Simd, const K: usize>(simd: S, [a, b, c, d]: [Pair<S>; 4]) -> [Pair<S>; 4] {
    [far::<S, K>(simd, a), far::<S, K>(simd, b), far::<S, K>(simd, c), far::<S, K>(simd, d)]
}

/// True for the fourth number of each pixel.
#[inline(always)]
pub(super) fn is_fourth<S: Simd>(simd: S) -> mask32x8<S> {
    mask32x8::from_slice(simd, &[0, 0, 0, -1, 0, 0, 0, -1])
}

/// Planes of the first three numbers of a group's far pairs.
#[inline(always)]
pub(super) fn transpose<S: Simd>([a, b, c, d]: [Pair<S>; 4]) -> [Pair<S>; 3] {
    let [(a, a_far), (b, b_far), (c, c_far), (d, d_far)] = [a.split(), b.split(), c.split(), d.split()];
    let [red, green, blue] = transposed(a, b, c, d);
    let [red_far, green_far, blue_far] = transposed(a_far, b_far, c_far, d_far);
    [red.combine(red_far), green.combine(green_far), blue.combine(blue_far)]
}

/// Red, green and blue of four pixels.
#[inline(always)]
fn transposed<S: Simd>(a: f32x4<S>, b: f32x4<S>, c: f32x4<S>, d: f32x4<S>) -> [f32x4<S>; 3] {
    let (low, high): (f64x2<S>, f64x2<S>) = (a.zip_low(b).bitcast(), c.zip_low(d).bitcast());
    let (low_far, high_far): (f64x2<S>, f64x2<S>) = (a.zip_high(b).bitcast(), c.zip_high(d).bitcast());
    [low.zip_low(high).bitcast(), low.zip_high(high).bitcast(), low_far.zip_low(high_far).bitcast()]
}
