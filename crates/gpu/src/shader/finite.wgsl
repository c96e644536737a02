// Numbers that every driver treats alike. By bits: a compiler may take it for granted that there is no NaN.

// 1e30, its bits, and those of infinity.
const ONELIGHT_INPUT_MAX: f32 = 1e30;
const ONELIGHT_INPUT_MAX_BITS: u32 = 0x7149f2cau;
const ONELIGHT_INFINITY_BITS: u32 = 0x7f800000u;
const ONELIGHT_SIGN_BIT: u32 = 0x80000000u;

// NaN becomes 0, infinities and what lies beyond ±1e30 become ±1e30. Subnormal numbers may count as 0: nothing that follows
// tells them apart.
fn onelight_finite(v: vec3f) -> vec3f {
    let bits = bitcast<vec3u>(v);
    let magnitude = bits & vec3u(~ONELIGHT_SIGN_BIT);
    let nan = magnitude > vec3u(ONELIGHT_INFINITY_BITS);
    let held = min(magnitude, vec3u(ONELIGHT_INPUT_MAX_BITS)) | (bits & vec3u(ONELIGHT_SIGN_BIT));
    // Among floats, which are numbers by now: GLSL ES 3.00 selects no integers.
    return select(bitcast<vec3f>(held), vec3f(0.0), nan);
}
