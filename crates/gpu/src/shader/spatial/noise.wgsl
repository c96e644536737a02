// White noise that is a function of place, frame and seed, correlated along x: integers, to the bit those of the CPU. Twin:
// `GrainNumbers::field` of onelight-spatial, before it goes along y.

struct OnelightNoise {
    // The picture's first pixel, counted from the frame's origin.
    offset: vec2i,
    // Pixels that the taps reach on either side.
    radius: vec2i,
    frame: u32,
    seed: u32,
}

@group(0) @binding(0) var<uniform> onelight_noise: OnelightNoise;
// Taps along x, then along y: that of the pixel itself first.
@group(0) @binding(1) var<storage, read> onelight_taps: array<i32>;
@group(0) @binding(2) var onelight_rows: texture_storage_2d<rgba32sint, write>;

fn onelight_hash(place: vec4u) -> vec4u {
    var v = place * 1664525u + 1013904223u;
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    v ^= v >> vec4u(16u);
    v.x += v.y * v.w;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v.w += v.y * v.z;
    return v ^ (v >> vec4u(16u));
}

// A number for each layer: bits of one word counted, filled up by ten bits of another.
fn onelight_white(x: i32, y: i32) -> vec3i {
    let v = onelight_hash(vec4u(bitcast<u32>(x), bitcast<u32>(y), onelight_noise.frame, onelight_noise.seed));
    let fine = (vec3u(v.w) >> vec3u(0u, 10u, 20u)) & vec3u(1023u);
    return 2048 * (vec3i(countOneBits(v.xyz)) - 16) + 2 * vec3i(fine) - 1023;
}

@compute @workgroup_size(8, 8)
fn onelight_noise_rows(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= textureDimensions(onelight_rows)) {
        return;
    }
    let x = onelight_noise.offset.x + i32(id.x);
    let y = onelight_noise.offset.y + i32(id.y) - onelight_noise.radius.y;
    var sum = vec3i(32) + onelight_taps[0] * onelight_white(x, y);
    for (var d = 1; d <= onelight_noise.radius.x; d++) {
        sum += onelight_taps[d] * (onelight_white(x - d, y) + onelight_white(x + d, y));
    }
    textureStore(onelight_rows, id.xy, vec4i(sum >> vec3u(6u), 0));
}
