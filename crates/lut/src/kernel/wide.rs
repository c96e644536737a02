use fearless_simd::prelude::*;
use fearless_simd::{f32x4, f32x8, f32x16, f64x2, mask32x8, mask32x16, u8x32};

/// A vector that holds several pixels of four numbers each, side by side.
///
/// A group is as many pixels as a vector has numbers, which four such vectors hold: `near` ones follow each other in the
/// order of the pixels, `far` ones in the order that makes planes of them with least work.
pub(super) trait Wide<S: Simd>: SimdFloat<S, Element = f32> {
    /// Those pixels side by side; of a vector of eight numbers, the first two.
    fn combine_pixels(pixels: [f32x4<S>; 4]) -> Self;

    /// The group's pixels that near vector `k` holds.
    fn near_pixels(start: usize, k: usize) -> [usize; 4];

    /// The group's pixels that far vector `k` holds.
    fn far_pixels(start: usize, k: usize) -> [usize; 4];

    /// A number for each pixel of a group: those of near vector `K`, four times each.
    #[inline(always)]
    fn near<const K: usize>(self) -> Self {
        let (low, high) = self.interleave(self);
        let half = if K < 2 { low } else { high };
        let (low, high) = half.interleave(half);
        if K.is_multiple_of(2) { low } else { high }
    }

    /// Those of far vector `K`, four times each.
    fn far<const K: usize>(simd: S, numbers: Self) -> Self;

    #[inline(always)]
    fn each_of_near<const K: usize>([a, b, c, d]: [Self; 4]) -> [Self; 4] {
        [a.near::<K>(), b.near::<K>(), c.near::<K>(), d.near::<K>()]
    }

    #[inline(always)]
    fn each_of_far<const K: usize>(simd: S, [a, b, c, d]: [Self; 4]) -> [Self; 4] {
        [Self::far::<K>(simd, a), Self::far::<K>(simd, b), Self::far::<K>(simd, c), Self::far::<K>(simd, d)]
    }

    /// Planes of the first three numbers of a group's far vectors.
    fn transpose(vectors: [Self; 4]) -> [Self; 3];

    /// True for the fourth number of each pixel.
    fn is_fourth(simd: S) -> Self::Mask;
}

impl<S: Simd> Wide<S> for f32x8<S> {
    #[inline(always)]
    fn combine_pixels([a, b, ..]: [f32x4<S>; 4]) -> Self {
        a.combine(b)
    }

    #[inline(always)]
    fn near_pixels(start: usize, k: usize) -> [usize; 4] {
        let first = start + 2 * k;
        [first, first + 1, first, first + 1]
    }

    #[inline(always)]
    fn far_pixels(start: usize, k: usize) -> [usize; 4] {
        let first = start + k;
        [first, first + 4, first, first + 4]
    }

    #[inline(always)]
    fn far<const K: usize>(simd: S, numbers: Self) -> Self {
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

    #[inline(always)]
    fn transpose([a, b, c, d]: [Self; 4]) -> [Self; 3] {
        let [(a, a_far), (b, b_far), (c, c_far), (d, d_far)] = [a.split(), b.split(), c.split(), d.split()];
        let [red, green, blue] = transposed(a, b, c, d);
        let [red_far, green_far, blue_far] = transposed(a_far, b_far, c_far, d_far);
        [red.combine(red_far), green.combine(green_far), blue.combine(blue_far)]
    }

    #[inline(always)]
    fn is_fourth(simd: S) -> Self::Mask {
        mask32x8::from_slice(simd, &[0, 0, 0, -1, 0, 0, 0, -1])
    }
}

/// Red, green and blue of four pixels.
#[inline(always)]
fn transposed<S: Simd>(a: f32x4<S>, b: f32x4<S>, c: f32x4<S>, d: f32x4<S>) -> [f32x4<S>; 3] {
    let (low, high): (f64x2<S>, f64x2<S>) = (a.zip_low(b).bitcast(), c.zip_low(d).bitcast());
    let (low_far, high_far): (f64x2<S>, f64x2<S>) = (a.zip_high(b).bitcast(), c.zip_high(d).bitcast());
    [low.zip_low(high).bitcast(), low.zip_high(high).bitcast(), low_far.zip_low(high_far).bitcast()]
}

impl<S: Simd> Wide<S> for f32x16<S> {
    #[inline(always)]
    fn combine_pixels([a, b, c, d]: [f32x4<S>; 4]) -> Self {
        a.combine(b).combine(c.combine(d))
    }

    #[inline(always)]
    fn near_pixels(start: usize, k: usize) -> [usize; 4] {
        let first = start + 4 * k;
        [first, first + 1, first + 2, first + 3]
    }

    #[inline(always)]
    fn far_pixels(start: usize, k: usize) -> [usize; 4] {
        Self::near_pixels(start, k)
    }

    #[inline(always)]
    fn far<const K: usize>(_: S, numbers: Self) -> Self {
        numbers.near::<K>()
    }

    #[inline(always)]
    fn transpose([a, b, c, d]: [Self; 4]) -> [Self; 3] {
        let ((rb, g), (rb_far, g_far)) = (a.deinterleave(b), c.deinterleave(d));
        let (red, blue) = rb.deinterleave(rb_far);
        [red, g.deinterleave(g_far).0, blue]
    }

    #[inline(always)]
    fn is_fourth(simd: S) -> Self::Mask {
        mask32x16::from_slice(simd, &[0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 0, -1])
    }
}
