// The page's own part of the shader: one pixel of light, exposed, on film, as the canvas takes it.

struct Frame {
    // What light is multiplied by: 2^stops.
    gain: f32,
    // Rows of the canvas where they are counted from below, or 0.
    rows_from_below: f32,
}

@group(1) @binding(0) var light: texture_2d<f32>;
@group(1) @binding(1) var<uniform> frame: Frame;

// One triangle that covers the canvas.
@vertex
fn draw_vertex(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(vec2f(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn draw_fragment(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let y = select(position.y, frame.rows_from_below - position.y, frame.rows_from_below > 0.0);
    let pixel = textureLoad(light, vec2i(i32(position.x), i32(y)), 0);
    let coded = onelight_develop(pixel.rgb * frame.gain);
    return vec4f(clamp(coded, vec3f(0.0), vec3f(1.0)), 1.0);
}
