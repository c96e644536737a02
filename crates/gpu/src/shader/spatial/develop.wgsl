// Scatter and halation, then exposures to dye in the camera film. Twins: `ScatterNumbers` and `HalationNumbers` of onelight-spatial,
// `StagedMap::develop`.

struct OnelightExposed {
    // Share of the narrow blur; by how much exposure goes towards the field.
    share: vec4f,
    pull: vec4f,
}

@group(1) @binding(0) var<uniform> onelight_exposed: OnelightExposed;
@group(1) @binding(1) var onelight_narrow: texture_2d<f32>;
@group(1) @binding(2) var onelight_wide: texture_2d<f32>;
@group(1) @binding(3) var onelight_halo: texture_2d<f32>;
@group(1) @binding(4) var onelight_amounts: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn onelight_develop_pixel(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= textureDimensions(onelight_amounts)) {
        return;
    }
    let at = vec2i(id.xy);
    let wide = textureLoad(onelight_wide, at, 0).rgb;
    var exposure = wide + onelight_exposed.share.rgb * (textureLoad(onelight_narrow, at, 0).rgb - wide);
    exposure += onelight_exposed.pull.rgb * (textureLoad(onelight_halo, at, 0).rgb - exposure);
    let dye = onelight_direct_dye(onelight_log2(exposure), onelight_points);
    textureStore(onelight_amounts, id.xy, vec4f(dye, 1.0));
}
