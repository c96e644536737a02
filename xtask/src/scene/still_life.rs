//! What stands on the table, and the lamps.

use std::ops::Range;

use glam::{Mat3, Vec2, Vec3, vec2, vec3};

use super::dusk::Dusk;
use super::light::{self, Spot};
use super::palette::{self, BULB, KEY, LIGHTS, NEON, SKY};
use super::shadow::Occluder;
use super::shape::{Body, Profile, Shape, Skin};
use super::spectrum::{Nodes, black_body, luminance};

pub(super) const EYE: Vec3 = vec3(0.0, 1.9, 9.2);
pub(super) const AIM: Vec3 = vec3(0.0, 1.17, 0.0);
pub(super) const GLOBE: Vec3 = vec3(2.3, 2.0, -0.9);
pub(super) const RING: Vec3 = vec3(0.62, 1.12, -1.5);
pub(super) const RING_RADIUS: f32 = 1.05;
pub(super) const TABLE_BACK: f32 = -3.4;
const BOTTLE: Vec3 = vec3(0.2, 0.0, -0.45);

/// Half size of a ColorChecker patch, and the distance between patches.
pub(super) const PATCH: (f32, f32) = (0.113, 0.26);
/// Length and half width of a step of the wedge.
pub(super) const STEP: (f32, f32) = (0.18, 0.095);

/// Indices of the cards in [`Scene::bodies`], and of the table, which is none of them.
pub(super) const COLOR_CHECKER: usize = 0;
pub(super) const GREY_CARD: usize = 1;
pub(super) const WEDGE: usize = 2;
pub(super) const TABLE: usize = usize::MAX;

/// Everything the picture shows.
pub(super) struct Scene {
    pub(super) bodies: Vec<Body>,
    pub(super) clusters: [Cluster; 5],
    pub(super) lamps: [Lamp; LAMPS],
    pub(super) lights: [Nodes; LIGHTS],
    /// White light of the step wedge, luminance 1.
    pub(super) wedge: Nodes,
    pub(super) wood: [Nodes; 2],
    pub(super) chart: [Nodes; 24],
    pub(super) dusk: Dusk,
}

/// Bodies near each other, and a sphere about them.
pub(super) struct Cluster {
    pub(super) centre: Vec3,
    pub(super) radius: f32,
    pub(super) bodies: Range<usize>,
}

/// A round lamp. `power` is the radiance of a white diffuser that faces it at distance 1.
pub(super) struct Lamp {
    pub(super) centre: Vec3,
    pub(super) radius: f32,
    pub(super) power: f32,
    /// Row of [`Scene::lights`].
    pub(super) light: usize,
    /// Body by body.
    pub(super) occluders: Vec<Option<Occluder>>,
}

pub(super) const LAMPS: usize = 4;

impl Scene {
    pub(super) fn new(color_checker: &[Nodes; 24]) -> Self {
        let bodies = bodies();
        let lamp = |centre: Vec3, radius, power, light| {
            let occluders = bodies.iter().map(|b| Occluder::new(b, centre)).collect();
            Lamp { centre, radius, power, light, occluders }
        };
        let lamps = [
            lamp(vec3(-4.9, 4.5, 4.2), 0.8, 66.0, KEY),
            lamp(vec3(4.5, 3.6, -6.5), 2.2, 26.0, SKY),
            lamp(GLOBE, 0.4, 1.7, BULB),
            lamp(RING, RING_RADIUS, 0.45, NEON),
        ];
        let groups = [0..3, 3..8, 8..14, 14..15, 15..bodies.len()];
        let clusters = groups.map(|range| Cluster::new(&bodies, range));
        let mut scene = Self {
            bodies,
            clusters,
            lamps,
            lights: palette::lights(),
            wedge: black_body(6500.0),
            wood: palette::walnut(),
            chart: *color_checker,
            dusk: Dusk::new(),
        };
        // Expose for the grey card.
        let card = &scene.bodies[GREY_CARD];
        let spot = Spot::new(card.origin, card.axes.z_axis, GREY_CARD);
        let gain = 1.0 / luminance(&light::irradiance(&scene, &spot, &mut Vec::new()));
        scene.lights = scene.lights.map(|light| light.map(|v| v * gain));
        scene
    }
}

impl Cluster {
    fn new(all: &[Body], range: Range<usize>) -> Self {
        let bodies = &all[range.clone()];
        let low = bodies.iter().fold(Vec3::MAX, |m, b| m.min(b.centre - b.radius));
        let high = bodies.iter().fold(Vec3::MIN, |m, b| m.max(b.centre + b.radius));
        let centre = 0.5 * (low + high);
        let reach = |b: &Body| b.centre.distance(centre) + b.radius;
        Self { centre, radius: bodies.iter().map(reach).fold(0.0, f32::max), bodies: range }
    }
}

fn bodies() -> Vec<Body> {
    let plain = |value: f32| [[value; 41]; 2];
    let turn = |yaw: f32, pitch: f32| Mat3::from_rotation_y(yaw) * Mat3::from_rotation_x(-pitch);
    let lean = |x: f32, z: f32| Mat3::from_rotation_z(x) * Mat3::from_rotation_x(z);
    let card = |skin, half: Vec2, foot: Vec3, axes: Mat3, grey| {
        Body::new(Shape::Card(half), foot + axes.y_axis * half.y, axes, skin, plain(grey))
    };
    let ball =
        |skin, centre: Vec3, radius, colours| Body::new(Shape::Sphere(radius), centre, Mat3::IDENTITY, skin, colours);
    let lathe = |skin, foot: Vec3, axes: Mat3, knots: &[(f32, f32)], colours| {
        Body::new(Shape::Lathe(Profile::new(knots)), foot, axes, skin, colours)
    };
    let egg = |x: f32, z: f32, axes: Mat3, lightness: f32| {
        // Rests on the table, its middle as high as it is thick.
        let middle = vec3(x, 0.315 + 0.085 * axes.y_axis.y.abs(), z);
        let colours = [palette::skin(lightness); 2];
        lathe(Skin::Coat, middle - axes.y_axis * 0.42, axes, &EGG, colours)
    };
    let bark = [palette::bark(); 2];
    let upright = Mat3::IDENTITY;
    let mut bodies = vec![
        card(Skin::ColorChecker, vec2(0.83, 0.57), vec3(-2.2, 0.01, -0.9), turn(0.3, 0.2), 0.025),
        card(Skin::Matte, vec2(0.27, 0.36), vec3(-0.98, 0.01, 0.15), turn(-0.1, 0.25), 0.18),
        card(Skin::Wedge, vec2(1.42, 0.15), vec3(-1.0, 0.03, 2.1), turn(0.08, 0.95), 0.0),
        lathe(Skin::ThinGlass, BOTTLE, upright, &BOTTLE_KNOTS, [palette::cobalt_glass(); 2]),
        lathe(Skin::Coat, vec3(0.86, 0.0, 0.1), lean(-0.08, 0.05), &PEAR, palette::pear()),
        lathe(Skin::Matte, vec3(0.935, 0.95, 0.14), lean(-0.3, 0.1), &PEAR_STEM, bark),
        ball(Skin::Coat, vec3(-0.2, 0.31, 0.62), 0.31, palette::orange()),
        ball(Skin::Coat, vec3(0.4, 0.24, 0.95), 0.24, palette::plum()),
        egg(1.6, 0.55, lean(1.35, 0.4), 1.0),
        egg(2.02, -0.08, lean(-0.18, -0.1), 0.62),
        egg(2.4, 0.75, lean(-1.45, -0.5), 0.3),
        ball(Skin::SolidGlass, vec3(0.98, 0.3, 1.75), 0.3, plain(0.98)),
        lathe(Skin::Metal, vec3(GLOBE.x, 0.0, GLOBE.z), upright, &LAMP, [palette::brass(); 2]),
        ball(Skin::Globe, GLOBE, 0.42, plain(0.0)),
        Body::new(Shape::Ring(RING_RADIUS, 0.032), RING, upright, Skin::Neon, plain(0.0)),
    ];
    let stem = lean(0.28, 0.0);
    let root = BOTTLE + Vec3::Y * 1.45;
    bodies.push(lathe(Skin::Matte, root, stem, &[(0.0, 0.02), (0.6, 0.017), (1.25, 0.008)], bark));
    for (up, angle, yaw, roll, length) in LEAVES {
        let axes = stem * Mat3::from_rotation_z(angle) * turn(yaw, -roll);
        let shape = Shape::Leaf(vec3(length, length * 0.2, 0.55));
        bodies.push(Body::new(shape, root + stem.y_axis * up, axes, Skin::Leaf, palette::leaf()));
    }
    bodies
}

/// Leaves of the sprig: height on the stem, angle to it, yaw, roll, length.
const LEAVES: [(f32, f32, f32, f32, f32); 7] = [
    (0.42, 0.35, 0.5, 0.5, 0.55),
    (0.5, 2.9, -0.4, -0.6, 0.6),
    (0.72, 0.75, -0.5, 0.7, 0.56),
    (0.8, 2.6, 0.5, -0.5, 0.55),
    (1.0, 1.0, 0.4, 0.4, 0.46),
    (1.05, 2.3, -0.4, -0.7, 0.44),
    (1.24, 1.75, 0.2, 0.3, 0.4),
];

// Turned bodies: height and radius.
#[rustfmt::skip]
const EGG: [(f32, f32); 7] = [
    (0.0, 0.0), (0.1, 0.2), (0.25, 0.29), (0.42, 0.315), (0.6, 0.265), (0.74, 0.16), (0.82, 0.0),
];
#[rustfmt::skip]
const PEAR: [(f32, f32); 10] = [
    (0.0, 0.0), (0.03, 0.16), (0.12, 0.28), (0.28, 0.345), (0.44, 0.315), (0.6, 0.215), (0.75, 0.155),
    (0.88, 0.125), (0.95, 0.07), (0.97, 0.0),
];
const PEAR_STEM: [(f32, f32); 3] = [(0.0, 0.022), (0.1, 0.018), (0.22, 0.026)];
#[rustfmt::skip]
const BOTTLE_KNOTS: [(f32, f32); 13] = [
    (0.0, 0.29), (0.04, 0.32), (0.15, 0.325), (0.5, 0.33), (0.95, 0.325), (1.12, 0.29), (1.26, 0.19),
    (1.38, 0.115), (1.5, 0.1), (1.75, 0.095), (1.8, 0.12), (1.86, 0.12), (1.88, 0.1),
];
#[rustfmt::skip]
const LAMP: [(f32, f32); 14] = [
    (0.0, 0.4), (0.05, 0.41), (0.1, 0.37), (0.15, 0.18), (0.25, 0.09), (0.5, 0.06), (0.62, 0.12),
    (0.7, 0.13), (0.78, 0.08), (1.1, 0.05), (1.4, 0.06), (1.5, 0.13), (1.6, 0.22), (1.64, 0.2),
];
