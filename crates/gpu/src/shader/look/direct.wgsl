// What a direct look is bound to. `wgsl` writes the group and the numbers that it is asked for.
@group(0) @binding(0) var<uniform> onelight_look: OnelightDirect;
@group(0) @binding(2) var onelight_points: texture_2d<f32>;

fn onelight_develop(rgb: vec3f) -> vec3f {
    return onelight_direct(rgb, onelight_points);
}
