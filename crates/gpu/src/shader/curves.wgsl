// Three curves, read linearly between points at equal steps; outside them the ends hold.

struct OnelightCurves {
    // From the first point to the last, 0 to 1: input * scale + offset.
    scale: vec3f,
    // Number of the last point.
    last: f32,
    offset: vec3f,
    // Row of the first channel in the texture of points; the others follow.
    row: i32,
}

// A point holds its value and the rise to the next; the last rises by 0.
fn onelight_curve(points: texture_2d<f32>, row: i32, position: f32) -> f32 {
    let point = textureLoad(points, vec2i(i32(position), row), 0);
    return point.x + point.y * fract(position);
}

fn onelight_curves(points: texture_2d<f32>, curves: OnelightCurves, input: vec3f) -> vec3f {
    let position = saturate(input * curves.scale + curves.offset) * curves.last;
    return vec3f(
        onelight_curve(points, curves.row, position.x),
        onelight_curve(points, curves.row + 1, position.y),
        onelight_curve(points, curves.row + 2, position.z),
    );
}

// What layers do to each other, then the curves. Twin: `Develop::apply`.
fn onelight_developed(
    points: texture_2d<f32>,
    curves: OnelightCurves,
    coupling: OnelightCurves,
    matrix: mat3x3f,
    couples: u32,
    log2_exposure: vec3f,
) -> vec3f {
    var h = log2_exposure;
    if couples != 0u {
        h += matrix * onelight_curves(points, coupling, h);
    }
    return onelight_curves(points, curves, h);
}
