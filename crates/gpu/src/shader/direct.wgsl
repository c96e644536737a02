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

// 64 groups: 256 terms.
const ONELIGHT_GROUPS: u32 = 64u;

struct OnelightDirect {
    input: mat3x3f,
    exposure: mat3x3f,
    curves: OnelightCurves,
    print_curves: OnelightCurves,
    coding: OnelightCoding,
    // Groups of the print's sum, which come first, and of both sums.
    print_end: u32,
    projection_end: u32,
    // Whether what comes out is still to be decoded for an sRGB view.
    coded: u32,
    // Whether `input` is anything but the identity.
    converts: u32,
    terms: array<OnelightTerms, 64>,
}

// Twin: `ExponentialSum::apply`, of the groups from `first` up to but not including `end` of `onelight_look.terms`.
fn onelight_exponential_sum(first: u32, end: u32, x: vec3f) -> vec3f {
    var sum = vec3f(0.0);
    for (var group = first; group < end; group++) {
        let terms = onelight_look.terms[group];
        let light = exp2(-(terms.rate_red * x.x + terms.rate_green * x.y + terms.rate_blue * x.z));
        // Term by term, so that each is one multiply-add.
        sum += vec3f(terms.weight_red.x, terms.weight_green.x, terms.weight_blue.x) * light.x;
        sum += vec3f(terms.weight_red.y, terms.weight_green.y, terms.weight_blue.y) * light.y;
        sum += vec3f(terms.weight_red.z, terms.weight_green.z, terms.weight_blue.z) * light.z;
        sum += vec3f(terms.weight_red.w, terms.weight_green.w, terms.weight_blue.w) * light.w;
    }
    return sum;
}

// Twin: `DirectForm::apply`.
fn onelight_direct(linear: vec3f, points: texture_2d<f32>) -> vec3f {
    let exposure = onelight_look.exposure * onelight_scene(linear, onelight_look.input, onelight_look.converts);
    var dye = onelight_curves(points, onelight_look.curves, onelight_log2(exposure));
    if onelight_look.print_end > 0u {
        let print = onelight_exponential_sum(0u, onelight_look.print_end, dye);
        dye = onelight_curves(points, onelight_look.print_curves, onelight_log2(print));
    }
    let light = onelight_exponential_sum(onelight_look.print_end, onelight_look.projection_end, dye);
    return onelight_encode(light, onelight_look.coding);
}
