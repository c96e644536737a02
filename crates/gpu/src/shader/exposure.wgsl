// From scene-linear light to log2 exposure.

// Smallest value whose logarithm is taken.
const ONELIGHT_LOG_FLOOR: f32 = 1e-12;

fn onelight_log2(exposure: vec3f) -> vec3f {
    // The value first: where max() gives its second argument for NaN, that is the floor.
    return log2(max(exposure, vec3f(ONELIGHT_LOG_FLOOR)));
}

// The most that negative light counts for, in exposures of the positive: twin `Expose::log2`.
const ONELIGHT_MOST_NEGATIVE: f32 = 88.0;
const ONELIGHT_LOG2_E: f32 = 1.4426950408889634;

// Scene light to the log2 exposure of each layer: the picture's primaries become those of the matrix, unless they are the same
// (`converts` is 0); light below 0 there counts as 0, or lowers the exposure (`compresses` is not 0). Twin: `Expose::log2`.
fn onelight_expose(linear: vec3f, input: mat3x3f, matrix: mat3x3f, converts: u32, compresses: u32) -> vec3f {
    let most = vec3f(ONELIGHT_INPUT_MAX);
    var light = onelight_finite(linear);
    if converts != 0u {
        light = input * light;
    }
    let exposure = max(matrix * clamp(light, vec3f(0.0), most), vec3f(ONELIGHT_LOG_FLOOR));
    var log2_exposure = log2(exposure);
    if compresses != 0u && any(light < vec3f(0.0)) {
        let negative = matrix * clamp(-light, vec3f(0.0), most);
        log2_exposure -= ONELIGHT_LOG2_E * (clamp(negative, vec3f(0.0), ONELIGHT_MOST_NEGATIVE * exposure) / exposure);
    }
    return log2_exposure;
}
