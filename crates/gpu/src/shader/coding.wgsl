// From linear to coded RGB: a power with a straight foot, odd about 0.

struct OnelightCoding {
    // (1 + offset) v^inverse_exponent - offset above `end`, slope * v up to it.
    inverse_exponent: f32,
    offset: f32,
    slope: f32,
    end: f32,
}

fn onelight_encode(linear: vec3f, coding: OnelightCoding) -> vec3f {
    let v = abs(linear);
    let power = (1.0 + coding.offset) * exp2(coding.inverse_exponent * log2(v)) - coding.offset;
    let coded = select(power, coding.slope * v, v <= vec3f(coding.end));
    return bitcast<vec3f>(bitcast<vec3u>(coded) | (bitcast<vec3u>(linear) & vec3u(ONELIGHT_SIGN_BIT)));
}
