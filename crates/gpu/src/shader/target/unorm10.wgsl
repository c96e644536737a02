// Integers stand for 0 to 1: 10 bits of colour, 2 of alpha. Rounded here and moved a quarter of a code up, so that a card that
// cuts off what is left of a code stores the same as one that rounds.
fn onelight_stored(coded: vec4f) -> vec4f {
    let codes = vec4f(1023.0, 1023.0, 1023.0, 3.0);
    return (floor(clamp(coded, vec4f(0.0), vec4f(1.0)) * codes + 0.5) + 0.25) / codes;
}
