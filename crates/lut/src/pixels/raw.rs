use fearless_simd::prelude::*;

/// A number as it lies in a picture, and how pixels of four of them become vectors.
pub(super) trait Raw: Copy + Default {
    /// The bits of as many pixels as a vector has lanes, channel by channel.
    fn deinterleave<L: Simd>(simd: L, pixels: &[[Self; 4]]) -> [L::u32s; 4];

    /// Those pixels from their bits.
    fn interleave<L: Simd>(channels: [L::u32s; 4], pixels: &mut [[Self; 4]]);

    fn to_bits(self) -> u32;

    /// From the lower bits of a word; the others are dropped.
    fn from_bits(bits: u32) -> Self;
}

impl Raw for f32 {
    #[inline(always)]
    fn deinterleave<L: Simd>(simd: L, pixels: &[[Self; 4]]) -> [L::u32s; 4] {
        let (samples, len) = (pixels.as_flattened(), L::f32s::LEN);
        let [a, b] = [&samples[..len], &samples[len..2 * len]];
        let [c, d] = [&samples[2 * len..3 * len], &samples[3 * len..4 * len]];
        // Red and blue, green and alpha, of each half.
        let (rb, ga) = L::f32s::from_slice(simd, a).deinterleave(L::f32s::from_slice(simd, b));
        let (rb_far, ga_far) = L::f32s::from_slice(simd, c).deinterleave(L::f32s::from_slice(simd, d));
        let (red, blue) = rb.deinterleave(rb_far);
        let (green, alpha) = ga.deinterleave(ga_far);
        [red.bitcast(), green.bitcast(), blue.bitcast(), alpha.bitcast()]
    }

    #[inline(always)]
    fn interleave<L: Simd>([red, green, blue, alpha]: [L::u32s; 4], pixels: &mut [[Self; 4]]) {
        let (samples, len) = (pixels.as_flattened_mut(), L::f32s::LEN);
        let (rb, rb_far) = red.interleave(blue);
        let (ga, ga_far) = green.interleave(alpha);
        let (a, b) = rb.interleave(ga);
        let (c, d) = rb_far.interleave(ga_far);
        a.bitcast::<L::f32s>().store_slice(&mut samples[..len]);
        b.bitcast::<L::f32s>().store_slice(&mut samples[len..2 * len]);
        c.bitcast::<L::f32s>().store_slice(&mut samples[2 * len..3 * len]);
        d.bitcast::<L::f32s>().store_slice(&mut samples[3 * len..4 * len]);
    }

    #[inline(always)]
    fn to_bits(self) -> u32 {
        self.to_bits()
    }

    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        Self::from_bits(bits)
    }
}

impl Raw for u16 {
    #[inline(always)]
    fn deinterleave<L: Simd>(simd: L, pixels: &[[Self; 4]]) -> [L::u32s; 4] {
        let (samples, len) = (pixels.as_flattened(), L::u16s::LEN);
        let near: L::u32s = L::u16s::from_slice(simd, &samples[..len]).bitcast();
        let far: L::u32s = L::u16s::from_slice(simd, &samples[len..2 * len]).bitcast();
        let (rg, ba) = near.deinterleave(far);
        [rg & 0xffff, rg >> 16, ba & 0xffff, ba >> 16]
    }

    #[inline(always)]
    fn interleave<L: Simd>([red, green, blue, alpha]: [L::u32s; 4], pixels: &mut [[Self; 4]]) {
        let (samples, len) = (pixels.as_flattened_mut(), L::u16s::LEN);
        let (near, far) = (red | (green << 16)).interleave(blue | (alpha << 16));
        near.bitcast::<L::u16s>().store_slice(&mut samples[..len]);
        far.bitcast::<L::u16s>().store_slice(&mut samples[len..2 * len]);
    }

    #[inline(always)]
    fn to_bits(self) -> u32 {
        u32::from(self)
    }

    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        bits as Self
    }
}

impl Raw for u8 {
    #[inline(always)]
    fn deinterleave<L: Simd>(simd: L, pixels: &[[Self; 4]]) -> [L::u32s; 4] {
        let pixels: L::u32s = L::u8s::from_slice(simd, pixels.as_flattened()).bitcast();
        [pixels & 0xff, (pixels >> 8) & 0xff, (pixels >> 16) & 0xff, pixels >> 24]
    }

    #[inline(always)]
    fn interleave<L: Simd>([red, green, blue, alpha]: [L::u32s; 4], pixels: &mut [[Self; 4]]) {
        let joined = (red | (green << 8)) | ((blue << 16) | (alpha << 24));
        joined.bitcast::<L::u8s>().store_slice(pixels.as_flattened_mut());
    }

    #[inline(always)]
    fn to_bits(self) -> u32 {
        u32::from(self)
    }

    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        bits as Self
    }
}
