//! What falls on a place: lamps past their occluders, the sky, the light off the table.

use glam::Vec3;

use super::palette::{BOUNCE, KEY, KEY_THROUGH_GLASS, SKY};
use super::shadow::Disc;
use super::shape::{Shape, Skin};
use super::spectrum::{NODES, Nodes, add};
use super::still_life::{LAMPS, Scene};

/// How a place came to be seen.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Path {
    Direct,
    /// In the table, or through a glass ball.
    Flat,
    /// In a curved mirror, which shrinks what it shows.
    Curved,
}

/// A place on a body.
#[derive(Clone, Copy)]
pub(super) struct Spot {
    pub(super) place: Vec3,
    pub(super) normal: Vec3,
    pub(super) body: usize,
    pub(super) path: Path,
    /// Lit from behind: the far side of a leaf.
    pub(super) side: Side,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Side {
    Near,
    Far,
}

impl Spot {
    pub(super) fn new(place: Vec3, normal: Vec3, body: usize) -> Self {
        Self { place, normal, body, path: Path::Direct, side: Side::Near }
    }

    /// The same place from behind.
    pub(super) fn far(self) -> Self {
        Self { normal: -self.normal, side: Side::Far, ..self }
    }
}

/// What a place sees of each lamp (past opaque bodies, past the bottle) and of its surroundings.
#[derive(Clone, Copy)]
pub(super) struct Visibility {
    lamps: [(f32, f32); LAMPS],
    open: f32,
}

/// Visibilities for the samples of one pixel: shadows are soft, so one will do for each body.
pub(super) type Cache = Vec<((usize, Path, Side), Visibility)>;

/// What a white diffuser at a spot would send back.
pub(super) fn irradiance(scene: &Scene, spot: &Spot, cache: &mut Cache) -> Nodes {
    let key = (spot.body, spot.path, spot.side);
    let known = cache.iter().find(|(k, _)| *k == key).map(|(_, seen)| *seen);
    let seen = known.unwrap_or_else(|| {
        let seen = visibility(scene, spot);
        cache.push((key, seen));
        seen
    });
    let mut weights = [0.0; BOUNCE + 1];
    for (lamp, (clear, bottle)) in scene.lamps.iter().zip(seen.lamps) {
        let to = lamp.centre - spot.place;
        let distance = to.length();
        let cosine = wrapped(spot.normal.dot(to) / distance, (lamp.radius / distance).min(1.0));
        let weight = clear * lamp.power * cosine / (distance * distance + lamp.radius * lamp.radius);
        weights[lamp.light] += weight * bottle;
        if lamp.light == KEY {
            weights[KEY_THROUGH_GLASS] += weight * (1.0 - bottle);
        }
    }
    // The sky stands behind the table; the room before it is dim.
    weights[SKY] += seen.open * 0.06 * (1.0 + 0.5 * spot.normal.y - 0.35 * spot.normal.z);
    weights[BOUNCE] += seen.open * 0.035 * (1.0 - spot.normal.y);
    let mut sum = [0.0; NODES];
    for (weight, light) in weights.iter().zip(&scene.lights).filter(|(w, _)| **w > 0.0) {
        add(&mut sum, light, *weight);
    }
    sum
}

fn visibility(scene: &Scene, spot: &Spot) -> Visibility {
    let mut seen = Visibility { lamps: [(1.0, 1.0); LAMPS], open: 1.0 };
    for (i, body) in scene.bodies.iter().enumerate() {
        if i != spot.body && matches!(body.shape, Shape::Sphere(_) | Shape::Lathe(_)) {
            let to = body.centre - spot.place;
            let distance = to.length();
            let sine = (body.radius * 0.75 / distance).min(0.95);
            seen.open *= 1.0 - sine * sine * wrapped(spot.normal.dot(to) / distance, sine);
        }
    }
    for (lamp, (clear, bottle)) in scene.lamps.iter().zip(&mut seen.lamps) {
        let to = lamp.centre - spot.place;
        if spot.path != Path::Direct && lamp.light != KEY {
            // In a mirror the shadows of the weaker lamps are not missed.
            *clear = seen.open;
            continue;
        }
        if spot.normal.dot(to) < -lamp.radius {
            continue;
        }
        let distance = to.length();
        let disc = Disc { towards: to / distance, distance, radius: lamp.radius };
        let near = |c: &&super::still_life::Cluster| disc.behind(c.centre, c.radius, spot.place).is_some();
        for i in scene.clusters.iter().filter(near).flat_map(|c| c.bodies.clone()) {
            let Some(occluder) = lamp.occluders[i].as_ref().filter(|_| i != spot.body) else { continue };
            let shade = occluder.coverage(spot.place, &disc);
            match scene.bodies[i].skin {
                Skin::ThinGlass => *bottle *= 1.0 - shade,
                Skin::SolidGlass => *clear *= 1.0 - 0.6 * shade,
                _ => *clear *= 1.0 - shade,
            }
        }
    }
    seen
}

/// Cosine to a lamp that may stand half below the horizon, by the sine of its half angle.
fn wrapped(cosine: f32, sine: f32) -> f32 {
    if cosine > sine { cosine } else { (cosine + sine).max(0.0).powi(2) / (4.0 * sine) }
}
