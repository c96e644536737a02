// One triangle that covers the target.
@vertex
fn onelight_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0;
    return vec4f(corner, 0.0, 1.0);
}

@fragment
fn onelight_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return onelight_pixel(min(vec2u(position.xy), textureDimensions(onelight_source) - 1u));
}
