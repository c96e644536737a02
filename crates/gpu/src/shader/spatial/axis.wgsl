// A linear map along one axis, the same for every row or column. Twin: `AxisMap` of onelight-spatial.

struct OnelightAxis {
    // Neighbours in a sum.
    count: u32,
    // 0 along x, 1 along y.
    axis: u32,
    // What is done with the sum: 0, it is stored; 1, `share` of its distance from `own`; 2, that is added to `base`.
    adds: u32,
    share: f32,
}

@group(0) @binding(0) var<uniform> onelight_axis: OnelightAxis;
@group(0) @binding(1) var<storage, read> onelight_first: array<u32>;
@group(0) @binding(2) var<storage, read> onelight_weights: array<vec4f>;
@group(0) @binding(3) var onelight_from: texture_2d<f32>;
@group(0) @binding(4) var onelight_own: texture_2d<f32>;
@group(0) @binding(5) var onelight_base: texture_2d<f32>;
@group(0) @binding(6) var onelight_to: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn onelight_along_axis(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= textureDimensions(onelight_to)) {
        return;
    }
    let at = vec2i(id.xy);
    let along_x = onelight_axis.axis == 0u;
    let i = select(id.y, id.x, along_x);
    let first = onelight_first[i];
    var sum = vec3f(0.0);
    for (var k = 0u; k < onelight_axis.count; k++) {
        let j = i32(first + k);
        let place = select(vec2i(at.x, j), vec2i(j, at.y), along_x);
        sum += onelight_weights[i * onelight_axis.count + k].rgb * textureLoad(onelight_from, place, 0).rgb;
    }
    if onelight_axis.adds != 0u {
        sum = onelight_axis.share * (sum - textureLoad(onelight_own, at, 0).rgb);
    }
    if onelight_axis.adds == 2u {
        sum += textureLoad(onelight_base, at, 0).rgb;
    }
    textureStore(onelight_to, id.xy, vec4f(sum, 1.0));
}
