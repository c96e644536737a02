// From scene-linear light to log2 exposure.

// Smallest value whose logarithm is taken.
const ONELIGHT_LOG_FLOOR: f32 = 1e-12;

fn onelight_log2(exposure: vec3f) -> vec3f {
    // The value first: where max() gives its second argument for NaN, that is the floor.
    return log2(max(exposure, vec3f(ONELIGHT_LOG_FLOOR)));
}

// The picture's primaries become those of the exposure matrix, unless they are the same (`converts` is 0); negative light
// counts as 0.
fn onelight_scene(linear: vec3f, input: mat3x3f, converts: u32) -> vec3f {
    var scene = onelight_finite(linear);
    if converts != 0u {
        scene = input * scene;
    }
    return clamp(scene, vec3f(0.0), vec3f(ONELIGHT_INPUT_MAX));
}
