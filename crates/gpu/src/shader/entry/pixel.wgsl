@group(1) @binding(0) var onelight_source: texture_2d<f32>;

// One pixel of the source as it goes to the target. Alpha goes through; NaN becomes 0 there too.
fn onelight_pixel(at: vec2u) -> vec4f {
    let pixel = textureLoad(onelight_source, vec2i(at), 0);
    return onelight_stored(vec4f(onelight_develop(pixel.rgb), onelight_finite(pixel.aaa).x));
}
