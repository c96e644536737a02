// The direct form: the whole film for each pixel, no table. Twin: `DirectForm`.

// Four terms of a sum of exponentials; unused ones have weight 0.
struct OnelightTerms {
    rate_red: vec4f,
    rate_green: vec4f,
    rate_blue: vec4f,
    weight_red: vec4f,
    weight_green: vec4f,
    weight_blue: vec4f,
}

// 32 groups: 128 terms.
struct OnelightDirect {
    input: mat3x3f,
    exposure: mat3x3f,
    coupling_matrix: mat3x3f,
    coupling: OnelightCurves,
    curves: OnelightCurves,
    print_curves: OnelightCurves,
    coding: OnelightCoding,
    // Terms in use; a film without a print has none there.
    print_count: u32,
    projection_count: u32,
    // Whether what comes out is still to be decoded for an sRGB view.
    coded: u32,
    // Whether `input` is anything but the identity; whether light below 0 lowers the exposure; whether layers are coupled.
    converts: u32,
    compresses: u32,
    couples: u32,
    print: array<OnelightTerms, 32>,
    projection: array<OnelightTerms, 32>,
}

// What two terms add to the sums, each in one multiply-add.
fn onelight_two_terms(
    sum: vec3f,
    x: vec3f,
    rate_red: vec2f,
    rate_green: vec2f,
    rate_blue: vec2f,
    weight_red: vec2f,
    weight_green: vec2f,
    weight_blue: vec2f,
) -> vec3f {
    let light = exp2(-(rate_red * x.x + rate_green * x.y + rate_blue * x.z));
    return sum
        + vec3f(weight_red.x, weight_green.x, weight_blue.x) * light.x
        + vec3f(weight_red.y, weight_green.y, weight_blue.y) * light.y;
}

// What a group adds, of which so many terms are in use: the last two are left out where there are none.
fn onelight_group(before: vec3f, terms: OnelightTerms, x: vec3f, count: u32) -> vec3f {
    var sum = onelight_two_terms(
        before,
        x,
        terms.rate_red.xy,
        terms.rate_green.xy,
        terms.rate_blue.xy,
        terms.weight_red.xy,
        terms.weight_green.xy,
        terms.weight_blue.xy,
    );
    if count > 2u {
        sum = onelight_two_terms(
            sum,
            x,
            terms.rate_red.zw,
            terms.rate_green.zw,
            terms.rate_blue.zw,
            terms.weight_red.zw,
            terms.weight_green.zw,
            terms.weight_blue.zw,
        );
    }
    return sum;
}

// Twin: `ExponentialSum::apply`. The first groups, which are all that a fitted form has, stand at fixed positions: their numbers
// are then operands, not loads.
fn onelight_print(x: vec3f) -> vec3f {
    let count = onelight_look.print_count;
    var sum = onelight_group(vec3f(0.0), onelight_look.print[0], x, count);
    if count > 4u {
        sum = onelight_group(sum, onelight_look.print[1], x, count - 4u);
    }
    for (var first = 8u; first < count; first += 4u) {
        sum = onelight_group(sum, onelight_look.print[first / 4u], x, count - first);
    }
    return sum;
}

// As `onelight_print`.
fn onelight_projection(x: vec3f) -> vec3f {
    let count = onelight_look.projection_count;
    var sum = onelight_group(vec3f(0.0), onelight_look.projection[0], x, count);
    if count > 4u {
        sum = onelight_group(sum, onelight_look.projection[1], x, count - 4u);
    }
    if count > 8u {
        sum = onelight_group(sum, onelight_look.projection[2], x, count - 8u);
    }
    for (var first = 12u; first < count; first += 4u) {
        sum = onelight_group(sum, onelight_look.projection[first / 4u], x, count - first);
    }
    return sum;
}

// Scene light to log2 exposure. Twin: `Expose::log2`.
fn onelight_direct_exposed(linear: vec3f) -> vec3f {
    return onelight_expose(
        linear,
        onelight_look.input,
        onelight_look.exposure,
        onelight_look.converts,
        onelight_look.compresses,
    );
}

// Log2 exposure to dye in the camera film. Twin: `Develop::apply`.
fn onelight_direct_dye(log2_exposure: vec3f, points: texture_2d<f32>) -> vec3f {
    return onelight_developed(
        points,
        onelight_look.curves,
        onelight_look.coupling,
        onelight_look.coupling_matrix,
        onelight_look.couples,
        log2_exposure,
    );
}

// Dye in the camera film to what is seen. Twin: `StagedMap::finish`.
fn onelight_direct_shown(camera: vec3f, points: texture_2d<f32>) -> vec3f {
    var dye = camera;
    if onelight_look.print_count > 0u {
        dye = onelight_curves(points, onelight_look.print_curves, onelight_log2(onelight_print(dye)));
    }
    return onelight_encode(onelight_projection(dye), onelight_look.coding);
}

// Twin: `DirectForm::apply`.
fn onelight_direct(linear: vec3f, points: texture_2d<f32>) -> vec3f {
    return onelight_direct_shown(onelight_direct_dye(onelight_direct_exposed(linear), points), points);
}
