// Adjacency and grain, then dye to what is seen. Twins: `AdjacencyNumbers` and `GrainNumbers` of onelight-spatial,
// `StagedMap::finish`.

struct OnelightFinish {
    strength: vec4f,
    // Where the layers' tables of grain begin, and intervals in a unit of dye.
    low: vec4f,
    per_unit: vec4f,
    // What makes the standard deviation of the noise 1; 0 without grain.
    scale: f32,
    // Where the taps along y begin, and how far they reach.
    first_tap: i32,
    radius: i32,
    // Intervals of a table.
    intervals: i32,
}

@group(1) @binding(0) var<uniform> onelight_finish: OnelightFinish;
@group(1) @binding(1) var<storage, read> onelight_taps: array<i32>;
// Standard deviation and shift at the start of each interval, and what is added across it; a table for each layer.
@group(1) @binding(2) var<storage, read> onelight_grain: array<vec4f>;
@group(1) @binding(3) var onelight_amounts: texture_2d<f32>;
@group(1) @binding(4) var onelight_blurred: texture_2d<f32>;
@group(1) @binding(5) var onelight_rows: texture_2d<i32>;
@group(2) @binding(0) var onelight_source: texture_2d<f32>;

fn onelight_strength(layer: i32, amount: f32) -> vec2f {
    let end = f32(onelight_finish.intervals) - 0.0001;
    let place = clamp((amount - onelight_finish.low[layer]) * onelight_finish.per_unit[layer], 0.0, end);
    let interval = i32(place);
    let ends = onelight_grain[layer * onelight_finish.intervals + interval];
    return ends.xz + (place - f32(interval)) * ends.yw;
}

@compute @workgroup_size(8, 8)
fn onelight_finish_pixel(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= textureDimensions(onelight_target)) {
        return;
    }
    let at = vec2i(id.xy);
    var dye = textureLoad(onelight_amounts, at, 0).rgb;
    if any(onelight_finish.strength.rgb != vec3f(0.0)) {
        dye += onelight_finish.strength.rgb * (dye - textureLoad(onelight_blurred, at, 0).rgb);
        dye = max(dye, vec3f(0.0));
    }
    if onelight_finish.scale != 0.0 {
        let middle = at + vec2i(0, onelight_finish.radius);
        var sum = onelight_taps[onelight_finish.first_tap] * textureLoad(onelight_rows, middle, 0).rgb;
        for (var d = 1; d <= onelight_finish.radius; d++) {
            let both = textureLoad(onelight_rows, middle - vec2i(0, d), 0).rgb + textureLoad(onelight_rows, middle + vec2i(0, d), 0).rgb;
            sum += onelight_taps[onelight_finish.first_tap + d] * both;
        }
        let noise = onelight_finish.scale * vec3f(sum);
        let red = onelight_strength(0, dye.r);
        let green = onelight_strength(1, dye.g);
        let blue = onelight_strength(2, dye.b);
        dye += vec3f(red.x, green.x, blue.x) * noise + vec3f(red.y, green.y, blue.y);
    }
    let alpha = textureLoad(onelight_source, at, 0).aaa;
    let shown = onelight_direct_shown(dye, onelight_points);
    textureStore(onelight_target, id.xy, onelight_stored(vec4f(shown, onelight_finite(alpha).x)));
}
