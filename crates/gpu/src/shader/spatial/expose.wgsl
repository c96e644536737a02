// Scene light to the exposure of each layer. Twin: `StagedMap::expose`.

@group(1) @binding(0) var onelight_exposures: texture_storage_2d<rgba32float, write>;
@group(2) @binding(0) var onelight_source: texture_2d<f32>;

@compute @workgroup_size(8, 8)
fn onelight_expose_pixel(@builtin(global_invocation_id) id: vec3u) {
    if all(id.xy < textureDimensions(onelight_exposures)) {
        let rgb = textureLoad(onelight_source, vec2i(id.xy), 0).rgb;
        let exposure = min(exp2(onelight_direct_exposed(rgb)), vec3f(ONELIGHT_INPUT_MAX));
        textureStore(onelight_exposures, id.xy, vec4f(exposure, 1.0));
    }
}
