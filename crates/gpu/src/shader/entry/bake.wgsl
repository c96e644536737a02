// A plain look's table filled from a direct look. Twin: `bake` of onelight-lut.

@group(1) @binding(0) var<uniform> onelight_plain: OnelightPlain;

@compute @workgroup_size(4, 4, 4)
fn onelight_bake_table(@builtin(global_invocation_id) node: vec3u) {
    if all(node < textureDimensions(onelight_baked)) {
        // Twin: `Shaper::decode`.
        let stops = vec3f(node) / (onelight_plain.last * onelight_plain.per_stop);
        let linear = (exp2(stops) - 1.0) / onelight_plain.per_offset;
        textureStore(onelight_baked, node, onelight_stored(vec4f(onelight_develop(linear), 1.0)));
    }
}
