// A 3D table through the texture unit's filter, whose weights have 8 bits. Twin: `filtered` in the tests.

fn onelight_filtered(table: texture_3d<f32>, linear: sampler, coordinates: vec3f, last: f32) -> vec3f {
    // Texture coordinates run from edge to edge, nodes lie at the centres.
    let at = (clamp(coordinates, vec3f(0.0), vec3f(1.0)) * last + 0.5) / (last + 1.0);
    return textureSampleLevel(table, linear, at, 0.0).rgb;
}
