//! The spectra of the still life: its lights, and stuffs as smooth formulas that imitate real ones.

use super::spectrum::{Nodes, bell, black_body, line, mix, product, rise, sample, unit};

/// Rows of [`lights`].
pub(super) const KEY: usize = 0;
pub(super) const KEY_THROUGH_GLASS: usize = 1;
pub(super) const SKY: usize = 2;
pub(super) const BULB: usize = 3;
pub(super) const NEON: usize = 4;
pub(super) const BOUNCE: usize = 5;
pub(super) const DUSK: usize = 6;
pub(super) const ZENITH: usize = 7;
pub(super) const CITY: usize = 8;
pub(super) const LIGHTS: usize = CITY + 5;

/// Colours of light, all of luminance 1 but the one that passed the bottle.
pub(super) fn lights() -> [Nodes; LIGHTS] {
    // Tungsten at 3200 K through a half blue gel (-85 mired).
    let key = black_body(4400.0);
    // The sky after sunset: its red end eaten by ozone's Chappuis band.
    let sky = product(&black_body(9500.0), &sample(|nm| 1.0 - 0.18 * bell(nm, 600.0, 45.0)));
    let [heart, sap] = walnut();
    let afterglow = sample(|nm| 0.2 + 0.8 * rise(nm, 565.0, 25.0));
    [
        key,
        product(&key, &cobalt_glass()),
        unit(&sky),
        black_body(2750.0),
        line(636.0, 7.0),
        unit(&product(&mix(&heart, &sap, 0.5), &key)),
        unit(&product(&black_body(2500.0), &afterglow)),
        // Rayleigh scattering.
        unit(&sample(|nm| (550.0 / nm).powi(4))),
        // Sodium street lamp, windows, tail light, head light, green traffic light.
        line(589.0, 6.0),
        black_body(2900.0),
        line(628.0, 9.0),
        black_body(6000.0),
        line(505.0, 14.0),
    ]
}

/// Transmittance of a wall of cobalt glass: blue, and the far red that cobalt lets by.
pub(super) fn cobalt_glass() -> Nodes {
    sample(|nm| 0.10 + 0.84 * bell(nm, 458.0, 48.0) + 0.05 * rise(nm, 715.0, 9.0))
}

/// Heart and sap wood: climbs to the red without a step.
pub(super) fn walnut() -> [Nodes; 2] {
    [sample(|nm| 0.014 + 0.065 * rise(nm, 640.0, 60.0)), sample(|nm| 0.040 + 0.21 * rise(nm, 615.0, 60.0))]
}

/// Leaf seen, and the light through it: chlorophyll's green hump and red edge.
pub(super) fn leaf() -> [Nodes; 2] {
    [(0.10, 0.38), (0.21, 0.42)]
        .map(|(green, edge)| sample(|nm| 0.025 + green * bell(nm, 553.0, 27.0) + edge * rise(nm, 706.0, 8.0)))
}

/// Egg shell the colour of skin: melanin's slope and the bands of haemoglobin.
pub(super) fn skin(lightness: f32) -> Nodes {
    sample(|nm| {
        let blood = 0.055 * (bell(nm, 543.0, 13.0) + bell(nm, 577.0, 10.0)) + 0.05 * bell(nm, 418.0, 22.0);
        let slope = 0.18 * rise(nm, 480.0, 28.0) + 0.30 * rise(nm, 597.0, 14.0) + 0.06 * rise(nm, 680.0, 30.0);
        lightness * (0.26 + slope - blood)
    })
}

/// Peel with carotene, dark below its edge.
pub(super) fn orange() -> [Nodes; 2] {
    [577.0, 566.0].map(|edge| sample(|nm| 0.025 + 0.63 * rise(nm, edge, 11.0)))
}

/// Ripe pear, and its blush.
pub(super) fn pear() -> [Nodes; 2] {
    [
        sample(|nm| 0.04 + 0.36 * rise(nm, 517.0, 13.0) - 0.12 * bell(nm, 676.0, 15.0)),
        sample(|nm| 0.035 + 0.10 * rise(nm, 520.0, 16.0) + 0.30 * rise(nm, 600.0, 14.0)),
    ]
}

/// Plum: anthocyanin leaves a little blue and the far red.
pub(super) fn plum() -> [Nodes; 2] {
    [(660.0, 0.10), (630.0, 0.16)]
        .map(|(edge, red)| sample(|nm| 0.022 + 0.027 * bell(nm, 440.0, 40.0) + red * rise(nm, edge, 19.0)))
}

/// Brass: the interband edge near 500 nm.
pub(super) fn brass() -> Nodes {
    sample(|nm| 0.36 + 0.46 * rise(nm, 503.0, 16.0) + 0.06 * rise(nm, 600.0, 40.0))
}

pub(super) fn bark() -> Nodes {
    sample(|nm| 0.03 + 0.10 * rise(nm, 600.0, 60.0))
}
