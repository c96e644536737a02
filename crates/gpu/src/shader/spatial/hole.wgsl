// What is lost through the back of the film inside the ring, and what the Gaussians add: the field of halation in cells. Twin:
// `HalationNumbers` of onelight-spatial.

struct OnelightHole {
    // Cells on either side.
    reach: vec2i,
}

@group(0) @binding(0) var<uniform> onelight_hole: OnelightHole;
@group(0) @binding(1) var<storage, read> onelight_weights: array<f32>;
@group(0) @binding(2) var onelight_cells: texture_2d<f32>;
@group(0) @binding(3) var onelight_gain: texture_2d<f32>;
@group(0) @binding(4) var onelight_field: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn onelight_halo(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(onelight_field);
    if any(id.xy >= size) {
        return;
    }
    let at = vec2i(id.xy);
    let last = vec2i(size) - 1;
    let reach = onelight_hole.reach;
    let own = textureLoad(onelight_cells, at, 0).rgb;
    var lost = vec3f(0.0);
    var k = 0;
    for (var y = -reach.y; y <= reach.y; y++) {
        for (var x = -reach.x; x <= reach.x; x++) {
            let cell = textureLoad(onelight_cells, clamp(at + vec2i(x, y), vec2i(0), last), 0).rgb;
            lost += onelight_weights[k] * (cell - own);
            k++;
        }
    }
    let gain = textureLoad(onelight_gain, at, 0).rgb;
    textureStore(onelight_field, id.xy, vec4f(max(own - lost + gain, vec3f(0.0)), 1.0));
}
