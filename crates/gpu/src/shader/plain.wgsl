// The plain form: a shaper on every channel, one fetch from a table. Twin: `PlainLut`.

struct OnelightPlain {
    // The shaper: log2(1 + u * per_offset) * per_stop up to `brightest`.
    brightest: f32,
    per_offset: f32,
    per_stop: f32,
    // Number of the table's last node.
    last: f32,
    // Whether the form reads its table trilinearly.
    trilinear: u32,
    // Whether what comes out is still to be decoded for an sRGB view.
    coded: u32,
}

// Twin: `Shaper::encode_f32`.
fn onelight_shaper(linear: vec3f, look: OnelightPlain) -> vec3f {
    let u = clamp(onelight_finite(linear), vec3f(0.0), vec3f(look.brightest));
    return log2(1.0 + u * look.per_offset) * look.per_stop;
}
