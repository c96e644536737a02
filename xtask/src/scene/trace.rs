//! Light along a ray: surfaces, mirrors and glass.

use glam::{Vec3, vec3};

use super::dusk::{add_haze, surroundings};
use super::light::{Cache, Path, Spot, irradiance};
use super::palette::{BULB, NEON};
use super::shape::{Body, Hit, Ray, Skin};
use super::spectrum::{NODES, Nodes, add, mix, product};
use super::still_life::{PATCH, STEP, Scene, TABLE, TABLE_BACK};

const GREY: f32 = 0.18;
/// Refractive index of coats and glass.
const INDEX: f32 = 1.5;

/// Radiance along a ray that leaves a body (or the eye, at [`TABLE`]), and which body it met.
pub(super) fn radiance(scene: &Scene, ray: Ray, from: usize, path: Path, cache: &mut Cache) -> (Nodes, usize) {
    const SURROUNDINGS: usize = TABLE - 1;
    let mut far = -ray.origin.y / ray.direction.y;
    let place = ray.origin + ray.direction * far;
    let on_table = far > 1e-4 && place.z > TABLE_BACK;
    if !on_table {
        far = f32::MAX;
    }
    let mut nearest = None;
    for cluster in scene.clusters.iter().filter(|c| ray.passes(c.centre, c.radius)) {
        for i in cluster.bodies.clone().filter(|&i| i != from) {
            let body = &scene.bodies[i];
            if path == Path::Curved && body.skin == Skin::Neon {
                continue;
            }
            if let Some(hit) = body.meet(&ray, far) {
                far = hit.distance;
                nearest = Some((hit, i));
            }
        }
    }
    let (mut light, met) = match nearest {
        Some((hit, i)) => (surface(scene, &ray, &hit, i, path, cache), i),
        None if on_table => (table(scene, &ray, place, path, cache), TABLE),
        None => (surroundings(scene, &ray), SURROUNDINGS),
    };
    add_haze(scene, &ray, far, path, &mut light);
    (light, met)
}

fn surface(scene: &Scene, ray: &Ray, hit: &Hit, index: usize, path: Path, cache: &mut Cache) -> Nodes {
    let body = &scene.bodies[index];
    let [colour, other] = &body.colours;
    let facing = hit.normal.dot(ray.direction).abs();
    let normal = hit.normal * -hit.normal.dot(ray.direction).signum();
    let place = ray.origin + ray.direction * hit.distance;
    let spot = Spot { path, ..Spot::new(place, normal, index) };
    let mut lit = |colour: &Nodes| product(&irradiance(scene, &spot, cache), colour);
    let ahead = |direction: Vec3| Ray { origin: place, direction };
    let mirror = ahead(ray.direction + 2.0 * facing * normal);
    let coat = if path == Path::Direct { fresnel(facing) } else { fresnel(1.0) };
    let mirrored = |cache: &mut Cache| match path {
        Path::Direct => radiance(scene, mirror, index, Path::Curved, cache).0,
        _ => surroundings(scene, &mirror),
    };
    match body.skin {
        Skin::Matte => lit(colour),
        Skin::ColorChecker => lit(patch(hit.local).map_or(colour, |p| &scene.chart[p])),
        Skin::Wedge => scene.wedge.map(|v| v * wedge(hit.local)),
        Skin::Globe => {
            // Opal glass: the filament glows through, the rim is light within the glass.
            let glow = 16.0 * facing.powi(10) + 2.6 * facing.powi(3) + 0.45;
            scene.lights[BULB].map(|v| v * glow)
        }
        Skin::Neon => scene.lights[NEON].map(|v| v * (0.2 + 1.1 * facing.powi(4))),
        Skin::Coat => {
            let blend = smooth(0.2, 0.8, blush(body, hit.local));
            let light = lit(&mix(colour, other, blend));
            mix(&light, &mirrored(cache), coat)
        }
        Skin::Metal => {
            let edge = (1.0 - facing).powi(5);
            product(&mirrored(cache), &mix(colour, &[1.0; NODES], edge))
        }
        Skin::ThinGlass => {
            let through = radiance(scene, ahead(ray.direction), index, path, cache).0;
            // Both walls, longer to cross where they slant.
            let walls = 0.9 / (1.0 - (1.0 - facing * facing) / (INDEX * INDEX)).sqrt() / (facing + 0.12).min(1.0);
            let stained = std::array::from_fn(|n| through[n] * colour[n].powf(walls) * (1.0 - coat));
            mix(&stained, &mirrored(cache), coat)
        }
        Skin::SolidGlass => {
            let inside = refract(ray.direction, normal, 1.0 / INDEX);
            let out = place - inside * (2.0 * inside.dot(normal) * body.radius);
            let direction = refract(inside, (body.centre - out) / body.radius, INDEX);
            let through = radiance(scene, Ray { origin: out, direction }, index, Path::Flat, cache).0;
            mix(&product(&through, colour), &mirrored(cache), coat)
        }
        Skin::Leaf => {
            let vein = smooth(0.016, 0.004, hit.local.y.abs());
            let mut light = lit(&mix(colour, other, 0.5 * vein));
            add(&mut light, &product(&irradiance(scene, &spot.far(), cache), other), 0.9);
            add(&mut light, &mirrored(cache), 0.6 * coat);
            light
        }
    }
}

/// Walnut planks along z, under a satin coat.
fn table(scene: &Scene, ray: &Ray, place: Vec3, path: Path, cache: &mut Cache) -> Nodes {
    const PLANK: f32 = 1.15;
    let x = place.x + 0.35;
    let plank = (x / PLANK).floor();
    let seed = vec3(plank * 7.3, 0.0, plank * 3.1);
    let warp = noise(vec3(x * 1.1, 0.0, place.z * 0.3) + seed);
    let rings = (0.5 + 0.5 * (3.0 * x + 16.0 * warp).sin()).powi(2);
    let streak = noise(vec3(x * 13.0, 0.0, place.z * 0.6) + seed);
    let sap = (0.05 + 0.4 * rings + 0.25 * streak + 0.3 * noise(seed + 0.5)).min(1.0);
    let joint = smooth(0.0, 0.016, PLANK * (0.5 - (x / PLANK - plank - 0.5).abs()));
    let wood = mix(&scene.wood[0], &scene.wood[1], sap).map(|v| v * (0.25 + 0.75 * joint));
    let spot = Spot { path, ..Spot::new(place, Vec3::Y, TABLE) };
    let mut light = product(&irradiance(scene, &spot, cache), &wood);
    if path == Path::Direct {
        let normal = vec3(0.024 * (warp - 0.5), 1.0, 0.0).normalize_or_zero();
        let facing = -normal.dot(ray.direction);
        let mirror = Ray { origin: place, direction: ray.direction + 2.0 * facing * normal };
        let mirrored = radiance(scene, mirror, TABLE, Path::Flat, cache).0;
        add(&mut light, &mirrored, 0.6 * fresnel(facing) * joint);
    }
    light
}

/// Patch of the ColorChecker at a place of its card.
fn patch(local: Vec3) -> Option<usize> {
    let (x, y) = (local.x / PATCH.1 + 3.0, 2.0 - local.y / PATCH.1);
    let inside = |v: f32| (v.fract() - 0.5).abs() < PATCH.0 / PATCH.1;
    let on_grid = x >= 0.0 && y >= 0.0 && x < 6.0 && y < 4.0;
    (on_grid && inside(x) && inside(y)).then_some(6 * y as usize + x as usize)
}

/// Luminance of the wedge at a place of its card: 15 steps, and light that leaks past its window.
fn wedge(local: Vec3) -> f32 {
    const LEAK: f32 = 0.006;
    let x = local.x / STEP.0;
    let step = (x + 7.5).floor().clamp(0.0, 14.0) - 7.0;
    let past = (local.y.abs() - STEP.1).max((x.abs() - 7.5) * STEP.0).max(0.0);
    GREY * step.exp2() * (-past / LEAK).exp()
}

/// Where a fruit shows its other colour.
fn blush(body: &Body, local: Vec3) -> f32 {
    0.1 + 0.4 * local.dot(vec3(1.2, 0.7, 0.3)) / body.radius + 0.5 * noise(local * 5.0)
}

fn refract(direction: Vec3, normal: Vec3, ratio: f32) -> Vec3 {
    let cosine = -direction.dot(normal);
    let within = (1.0 - ratio * ratio * (1.0 - cosine * cosine)).max(0.0).sqrt();
    (ratio * direction + (ratio * cosine - within) * normal).normalize_or_zero()
}

/// Reflectance of a surface of glass, after Schlick.
fn fresnel(facing: f32) -> f32 {
    let base = ((INDEX - 1.0) / (INDEX + 1.0)).powi(2);
    base + (1.0 - base) * (1.0 - facing.clamp(0.0, 1.0)).powi(5)
}

/// From 0 to 1 without a corner; `from` may be above `to`.
pub(super) fn smooth(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Value noise, 0 to 1.
fn noise(p: Vec3) -> f32 {
    let cell = p.floor();
    let t = p - cell;
    let t = t * t * (Vec3::splat(3.0) - 2.0 * t);
    let corner = |x: i32, y: i32, z: i32| {
        let mut h = (cell.x as i32 + x) as u32 ^ ((cell.y as i32 + y) as u32).wrapping_mul(0x9E37_79B1);
        h = (h.wrapping_mul(0x85EB_CA6B) ^ (cell.z as i32 + z) as u32).wrapping_mul(0xC2B2_AE35);
        h = (h ^ (h >> 15)).wrapping_mul(0x27D4_EB2F);
        ((h ^ (h >> 13)) & 0xFFFF) as f32 / 65535.0
    };
    let lerp = |a: f32, b: f32, t: f32| a + (b - a) * t;
    let row = |y, z| lerp(corner(0, y, z), corner(1, y, z), t.x);
    lerp(lerp(row(0, 0), row(1, 0), t.y), lerp(row(0, 1), row(1, 1), t.y), t.z)
}
