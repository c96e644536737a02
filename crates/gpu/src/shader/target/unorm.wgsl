// Integers stand for 0 to 1.
fn onelight_stored(coded: vec4f) -> vec4f {
    return clamp(coded, vec4f(0.0), vec4f(1.0));
}
