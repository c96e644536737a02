//! What lies about the table: dusk over a city, out of focus; the room; thin smoke.

use glam::{Vec2, Vec3, vec2};

use super::light::Path;
use super::palette::{BOUNCE, BULB, CITY, DUSK, KEY, NEON, SKY, ZENITH};
use super::shape::Ray;
use super::spectrum::{NODES, Nodes, add};
use super::still_life::{GLOBE, RING, RING_RADIUS, Scene};
use super::trace::smooth;

/// City lights and buildings, placed by the tangents of their azimuth and height.
pub(super) struct Dusk {
    lamps: Vec<Bokeh>,
    skyline: Vec<Block>,
}

struct Bokeh {
    place: Vec2,
    radius: f32,
    luminance: f32,
    light: usize,
}

struct Block {
    middle: f32,
    half_width: f32,
    top: f32,
}

impl Dusk {
    /// Places of low-discrepancy sequences.
    pub(super) fn new() -> Self {
        let even = |i: usize, step: f32| (0.5 + step * i as f32).fract();
        let lamp = |i: usize| {
            let (across, down, size) = (even(i, 0.754_877_7), even(i, 0.569_840_3), even(i, 0.618_034));
            Bokeh {
                place: vec2(1.1 * (across - 0.5), 0.004 - 0.16 * down * down),
                radius: 0.0105 + 0.004 * size,
                luminance: 0.05 + 0.9 * size.powi(4),
                light: CITY + [0, 1, 0, 3, 1, 0, 2, 1, 0, 4][i % 10],
            }
        };
        let block = |i: usize| Block {
            middle: 1.1 * (even(i, 0.618_034) - 0.5),
            half_width: 0.012 + 0.022 * even(i, 0.754_877_7),
            top: -0.012 + 0.05 * even(i, 0.324_717_9).powi(2),
        };
        Self { lamps: (0..64).map(lamp).collect(), skyline: (0..16).map(block).collect() }
    }
}

/// Radiance of what a ray meets past the table.
pub(super) fn surroundings(scene: &Scene, ray: &Ray) -> Nodes {
    let mut sum = [0.0; NODES];
    if ray.direction.z > -0.02 {
        room(scene, ray, &mut sum);
    } else {
        window(scene, vec2(ray.direction.x, ray.direction.y) / -ray.direction.z, &mut sum);
    }
    sum
}

fn window(scene: &Scene, place: Vec2, sum: &mut Nodes) {
    const BLUR: f32 = 0.014;
    let (above, below) = (place.y.max(0.0), place.y.min(0.0));
    let mut air = (below / 0.045).exp();
    if place.y < 0.06 {
        for block in &scene.dusk.skyline {
            let beside = block.half_width - (place.x - block.middle).abs();
            let under = block.top - place.y;
            air *= 1.0 - 0.75 * smooth(-BLUR, BLUR, beside) * smooth(-BLUR, BLUR, under);
        }
    }
    let sun = 0.5 + 0.5 * (3.0 * (place.x + 0.2)).cos();
    let veiled = 1.0 - 0.65 * (-above / 0.03).exp();
    let blue = (0.02 + 0.085 * (-above / 0.075).exp()) * veiled * air + 0.014;
    add(sum, &scene.lights[ZENITH], blue);
    add(sum, &scene.lights[DUSK], 0.34 * sun * (-above / 0.034).exp() * air + 0.0025);
    // The brighter sky that lights the scene, out of the picture.
    let aside = (place - vec2(0.62, 0.64)).abs();
    add(sum, &scene.lights[SKY], 1.4 * smooth(0.3, 0.2, aside.x) * smooth(0.26, 0.16, aside.y));
    if (-0.18..0.03).contains(&place.y) {
        for lamp in &scene.dusk.lamps {
            let away = lamp.place.distance_squared(place) / (lamp.radius * lamp.radius);
            if away < 1.4 {
                // The disc of a lens: flat, a little brighter at its rim.
                let disc = smooth(1.15, 0.85, away.sqrt()) * (0.75 + 0.25 * away);
                add(sum, &scene.lights[lamp.light], lamp.luminance * disc);
            }
        }
    }
}

/// Dim; the key lamp's softbox, and a tall window for the sides of upright things.
fn room(scene: &Scene, ray: &Ray, sum: &mut Nodes) {
    let d = ray.direction;
    add(sum, &scene.lights[BOUNCE], 0.012);
    add(sum, &scene.lights[KEY], 0.16 * smooth(0.2, -1.0, d.x) * smooth(-0.1, 0.5, d.y));
    let strip = smooth(0.22, 0.17, (d.x / d.z.max(0.05) + 0.9).abs()) * smooth(0.62, 0.55, d.y.abs());
    add(sum, &scene.lights[SKY], 3.0 * strip + 0.05 * smooth(0.3, 1.0, d.x) + 0.012 * (1.0 + d.y));
    for key in scene.lamps.iter().filter(|lamp| lamp.light == KEY) {
        let to = key.centre - ray.origin;
        let aside = (d * to.dot(d) - to) / key.radius;
        let (x, y) = (aside.dot(Vec3::Y.cross(key.centre).normalize_or_zero()) / 0.65, aside.y);
        let face = 0.3 * key.power / (key.radius * key.radius);
        if to.dot(d) > 0.0 {
            add(sum, &scene.lights[KEY], face * smooth(1.05, 0.9, x.abs()) * smooth(1.05, 0.93, y.abs()));
        }
    }
}

/// Smoke that glows about the lamps behind the table, on the way to what is `far` away.
pub(super) fn add_haze(scene: &Scene, ray: &Ray, far: f32, path: Path, sum: &mut Nodes) {
    let to = GLOBE - ray.origin;
    let along = to.dot(ray.direction);
    let fade = (1.0 - (to.length_squared() - along * along) / 2.9).max(0.0).powi(4);
    if fade > 0.0 && along > 0.0 {
        add(sum, &scene.lights[BULB], 0.14 * fade * smooth(-0.3, 1.2, far - along));
    }
    let along = (RING.z - ray.origin.z) / ray.direction.z;
    let place = ray.origin + ray.direction * along - RING;
    let fade = (1.0 - (place.truncate().length() - RING_RADIUS).abs() / 0.7).max(0.0).powi(4);
    if fade > 0.0 && along > 0.0 {
        // A curved mirror shows the tube too thin to draw: there it is all glow.
        let glow = if path == Path::Curved { 0.35 } else { 0.035 };
        add(sum, &scene.lights[NEON], glow * fade * smooth(-0.4, 0.4, far - along));
    }
}
