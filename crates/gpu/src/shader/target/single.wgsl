// A float takes what there is.
fn onelight_stored(coded: vec4f) -> vec4f {
    return coded;
}
