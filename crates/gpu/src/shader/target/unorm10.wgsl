// Integers stand for 0 to 1: 10 bits of colour, 2 of alpha. Rounded here and moved up by a quarter of a code or less, so that
// the same is stored whether a driver rounds, cuts off what is left of a code, or takes the whole part of 1024 (4) times the
// value, as lavapipe 22 does.
fn onelight_stored(coded: vec4f) -> vec4f {
    let codes = vec4f(1023.0, 1023.0, 1023.0, 3.0);
    let value = floor(clamp(coded, vec4f(0.0), vec4f(1.0)) * codes + 0.5) / codes;
    return value + 0.25 * (1.0 - value) / codes;
}
