// The target encodes what it is given by the sRGB curve, so that of coded values has to be undone.
fn onelight_stored(coded: vec4f) -> vec4f {
    let held = clamp(coded, vec4f(0.0), vec4f(1.0));
    if onelight_look.coded == 0u {
        return held;
    }
    let v = held.rgb;
    let power = exp2(2.4 * log2((v + 0.055) / 1.055));
    return vec4f(select(power, v / 12.92, v <= vec3f(0.04045)), held.a);
}
