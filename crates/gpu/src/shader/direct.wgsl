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
    // Groups in use; a film without a print has none there.
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

// What four terms add to the sums, each in one multiply-add.
fn onelight_four_terms(sum: vec3f, terms: OnelightTerms, x: vec3f) -> vec3f {
    let light = exp2(-(terms.rate_red * x.x + terms.rate_green * x.y + terms.rate_blue * x.z));
    return sum
        + vec3f(terms.weight_red.x, terms.weight_green.x, terms.weight_blue.x) * light.x
        + vec3f(terms.weight_red.y, terms.weight_green.y, terms.weight_blue.y) * light.y
        + vec3f(terms.weight_red.z, terms.weight_green.z, terms.weight_blue.z) * light.z
        + vec3f(terms.weight_red.w, terms.weight_green.w, terms.weight_blue.w) * light.w;
}

// Twin: `ExponentialSum::apply`. The first groups, which are all that a fitted form has, stand at fixed positions: their numbers
// are then operands, not loads.
fn onelight_print(x: vec3f) -> vec3f {
    let count = onelight_look.print_count;
    var sum = onelight_four_terms(vec3f(0.0), onelight_look.print[0], x);
    if count > 1u {
        sum = onelight_four_terms(sum, onelight_look.print[1], x);
    }
    for (var i = 2u; i < count; i++) {
        sum = onelight_four_terms(sum, onelight_look.print[i], x);
    }
    return sum;
}

// As `onelight_print`.
fn onelight_projection(x: vec3f) -> vec3f {
    let count = onelight_look.projection_count;
    var sum = onelight_four_terms(vec3f(0.0), onelight_look.projection[0], x);
    if count > 1u {
        sum = onelight_four_terms(sum, onelight_look.projection[1], x);
    }
    if count > 2u {
        sum = onelight_four_terms(sum, onelight_look.projection[2], x);
    }
    for (var i = 3u; i < count; i++) {
        sum = onelight_four_terms(sum, onelight_look.projection[i], x);
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
