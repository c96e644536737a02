@compute @workgroup_size(8, 8)
fn onelight_compute(@builtin(global_invocation_id) at: vec3u) {
    if all(at.xy < textureDimensions(onelight_target)) {
        textureStore(onelight_target, at.xy, onelight_pixel(at.xy));
    }
}
