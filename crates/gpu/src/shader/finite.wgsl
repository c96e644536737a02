// Numbers that every driver treats alike. By bits: a compiler may take it for granted that there is no NaN.

// 1e30, infinity, and the smallest number with full precision, as bits.
const ONELIGHT_INPUT_MAX: f32 = 1e30;
const ONELIGHT_INPUT_MAX_BITS: u32 = 0x7149f2cau;
const ONELIGHT_NORMAL_MIN_BITS: u32 = 0x00800000u;
const ONELIGHT_NORMAL_SPAN_BITS: u32 = 0x7f000000u;

// NaN and subnormal numbers become 0, infinities and what lies beyond ±1e30 become ±1e30.
fn onelight_finite(v: vec3f) -> vec3f {
    let bits = bitcast<vec3u>(v);
    let magnitude = bits & vec3u(0x7fffffffu);
    // One comparison: 0 and subnormals wrap round to the top, where NaN is.
    let odd = magnitude - vec3u(ONELIGHT_NORMAL_MIN_BITS) > vec3u(ONELIGHT_NORMAL_SPAN_BITS);
    let held = select(min(magnitude, vec3u(ONELIGHT_INPUT_MAX_BITS)), vec3u(0u), odd);
    return bitcast<vec3f>(held | (bits & vec3u(0x80000000u)));
}
