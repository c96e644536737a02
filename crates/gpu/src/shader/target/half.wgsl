// Beyond the largest half float lies infinity, which no picture wants.
fn onelight_stored(coded: vec4f) -> vec4f {
    return clamp(coded, vec4f(-65504.0), vec4f(65504.0));
}
