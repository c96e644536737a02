@group(0) @binding(0) var source: texture_2d<f32>;
@group(0) @binding(1) var target_: texture_storage_2d<rgba16float, write>;

@compute @workgroup_size(8, 8)
fn copy(@builtin(global_invocation_id) at: vec3u) {
    if all(at.xy < textureDimensions(target_)) {
        textureStore(target_, at.xy, textureLoad(source, vec2i(at.xy), 0));
    }
}
