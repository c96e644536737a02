// The structured form: bent and mixed axes, one fetch from a table. Twin: `StructuredLut`.

struct OnelightStructured {
    input: mat3x3f,
    exposure: mat3x3f,
    coupling_matrix: mat3x3f,
    mix_matrix: mat3x3f,
    // From three transmittances to linear RGB.
    decode: mat3x3f,
    mix_offset: vec3f,
    // Number of the table's last node.
    last: f32,
    coupling: OnelightCurves,
    curves: OnelightCurves,
    mix_curves: OnelightCurves,
    coding: OnelightCoding,
    // Whether there is a mix; whether entries are densities; whether the form reads its table trilinearly;
    // whether what comes out is still to be decoded for an sRGB view.
    mixes: u32,
    densities: u32,
    trilinear: u32,
    coded: u32,
    // Whether `input` is anything but the identity; whether light below 0 lowers the exposure; whether layers are coupled.
    converts: u32,
    compresses: u32,
    couples: u32,
}

const ONELIGHT_LOG2_10: f32 = 3.321928094887362;

// Twin: `StructuredLut::coordinates`.
fn onelight_coordinates(linear: vec3f, look: OnelightStructured, points: texture_2d<f32>) -> vec3f {
    let h = onelight_expose(linear, look.input, look.exposure, look.converts, look.compresses);
    let first = onelight_developed(points, look.curves, look.coupling, look.coupling_matrix, look.couples, h);
    if look.mixes == 0u {
        return first;
    }
    return onelight_curves(points, look.mix_curves, look.mix_matrix * first + look.mix_offset);
}

// Twin: `StructuredLut::decode`.
fn onelight_decode(entry: vec3f, look: OnelightStructured) -> vec3f {
    if look.densities == 0u {
        return entry;
    }
    return onelight_encode(look.decode * exp2(-ONELIGHT_LOG2_10 * entry), look.coding);
}
