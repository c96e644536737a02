//! Soft shadows without noise: how much of a round lamp a body's outline covers, in closed form.

use std::f32::consts::PI;

use glam::{Vec2, Vec3};

use super::shape::{Body, Outline};

/// A round lamp as a place sees it: direction of length 1, distance, radius.
#[derive(Clone, Copy)]
pub(super) struct Disc {
    pub(super) towards: Vec3,
    pub(super) distance: f32,
    pub(super) radius: f32,
}

impl Disc {
    /// Distance towards the lamp, and squared distance from the line to it, of a sphere that may shade a place.
    pub(super) fn behind(&self, centre: Vec3, radius: f32, place: Vec3) -> Option<(f32, f32)> {
        let offset = centre - place;
        let along = offset.dot(self.towards);
        let aside = offset.length_squared() - along * along;
        let reach = radius + self.radius * along.max(0.0) / self.distance;
        (along > -radius && along < self.distance + radius && aside < reach * reach).then_some((along, aside))
    }
}

/// A body as it stands before one lamp.
pub(super) struct Occluder {
    centre: Vec3,
    radius: f32,
    /// None for the sphere itself.
    polygon: Option<Vec<Vec3>>,
}

impl Occluder {
    pub(super) fn new(body: &Body, lamp: Vec3) -> Option<Self> {
        let (radius, polygon) = match body.outline((lamp - body.centre).normalize_or_zero()) {
            Outline::None => return None,
            Outline::Round(radius) => (radius, None),
            Outline::Polygon(corners) => (body.radius, Some(corners)),
        };
        Some(Self { centre: body.centre, radius, polygon })
    }

    /// The part of the lamp that the body hides from a place, 0 to 1.
    pub(super) fn coverage(&self, place: Vec3, disc: &Disc) -> f32 {
        match (disc.behind(self.centre, self.radius, place), &self.polygon) {
            (Some((along, _)), _) if along > disc.distance => 0.0,
            (Some(_), Some(corners)) => polygon(corners, place, disc),
            (Some((along, aside)), None) => {
                let scale = disc.distance / along.max(1e-3) / disc.radius;
                lens(aside.max(0.0).sqrt() * scale, self.radius * scale)
            }
            (None, _) => 0.0,
        }
    }
}

/// Part of the unit circle that a circle of a radius at a distance covers.
fn lens(distance: f32, radius: f32) -> f32 {
    if distance >= 1.0 + radius {
        return 0.0;
    }
    if distance <= (1.0 - radius).abs() {
        return radius.min(1.0).powi(2);
    }
    let part = |a: f32, b: f32| {
        let x = ((distance * distance + a * a - b * b) / (2.0 * distance * a)).clamp(-1.0, 1.0);
        a * a * (x.acos() - x * (1.0 - x * x).sqrt())
    };
    (part(1.0, radius) + part(radius, 1.0)) / PI
}

/// Part of the disc that a polygon covers, seen from a place.
fn polygon(outline: &[Vec3], place: Vec3, disc: &Disc) -> f32 {
    const NEAR: f32 = 1e-3;
    const MOST: usize = 24;
    let (u, v) = disc.towards.any_orthonormal_pair();
    let scale = disc.distance / disc.radius;
    let mut corners = [Vec2::ZERO; MOST];
    let mut count = 0;
    let mut corner = |p: Vec3| {
        if let Some(slot) = corners.get_mut(count) {
            *slot = Vec2::new(p.dot(u), p.dot(v)) * (scale / p.dot(disc.towards));
            count += 1;
        }
    };
    let Some(mut a) = outline.last().map(|&p| p - place) else { return 0.0 };
    for b in outline.iter().map(|&p| p - place) {
        let (da, db) = (a.dot(disc.towards) - NEAR, b.dot(disc.towards) - NEAR);
        if (da < 0.0) != (db < 0.0) {
            corner(a + (b - a) * (da / (da - db)));
        }
        if db >= 0.0 {
            corner(b);
        }
        a = b;
    }
    let corners = &corners[..count];
    let low = corners.iter().fold(Vec2::MAX, |m, &p| m.min(p));
    let high = corners.iter().fold(Vec2::MIN, |m, &p| m.max(p));
    if low.max_element() > 1.0 || high.min_element() < -1.0 {
        return 0.0;
    }
    let Some(mut a) = corners.last().copied() else { return 0.0 };
    let mut area = 0.0;
    for &b in corners {
        area += sector(a, b);
        a = b;
    }
    (area.abs() / PI).min(1.0)
}

/// Signed area that the unit circle and the triangle of its centre with an edge share.
fn sector(a: Vec2, b: Vec2) -> f32 {
    let d = b - a;
    let pie = |p: Vec2, q: Vec2| 0.5 * angle(p.perp_dot(q), p.dot(q));
    let (dd, ad) = (d.length_squared(), a.dot(d));
    let root = ad * ad - dd * (a.length_squared() - 1.0);
    if root <= 0.0 || dd < 1e-12 {
        return pie(a, b);
    }
    let (t0, t1) = ((-ad - root.sqrt()) / dd, (-ad + root.sqrt()) / dd);
    if t1 <= 0.0 || t0 >= 1.0 {
        return pie(a, b);
    }
    let (p, q) = (a + d * t0.max(0.0), a + d * t1.min(1.0));
    let outer = |outside: bool, x: Vec2, y: Vec2| if outside { pie(x, y) } else { 0.0 };
    outer(t0 > 0.0, a, p) + 0.5 * p.perp_dot(q) + outer(t1 < 1.0, q, b)
}

/// `y.atan2(x)`, in a sixth of its time (Abramowitz and Stegun 4.4.49, error 2e-8).
fn angle(y: f32, x: f32) -> f32 {
    const TERMS: [f32; 8] = [
        -0.333_331_45,
        0.199_935_51,
        -0.142_089,
        0.106_562_64,
        -0.075_289_64,
        0.042_909_614,
        -0.016_165_737,
        0.002_866_225_7,
    ];
    let (low, high) = (x.abs().min(y.abs()), x.abs().max(y.abs()));
    let t = low / high.max(f32::MIN_POSITIVE);
    let series = TERMS.iter().rev().fold(0.0, |sum, term| (sum + term) * t * t);
    let near = t + t * series;
    let quarter = if y.abs() > x.abs() { PI / 2.0 - near } else { near };
    let half = if x < 0.0 { PI - quarter } else { quarter };
    half.copysign(y)
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAMP: Disc = Disc { towards: Vec3::Z, distance: 10.0, radius: 1.0 };

    /// Regular polygon half way to the lamp.
    fn ring(corners: usize, radius: f32, aside: f32) -> Vec<Vec3> {
        let corner = |i: usize| {
            let angle = 2.0 * PI * i as f32 / corners as f32;
            Vec3::new(aside + radius * angle.cos(), radius * angle.sin(), 5.0)
        };
        (0..corners).map(corner).collect()
    }

    #[test]
    fn polygon_of_many_corners_shades_like_a_circle() {
        for (radius, aside) in [(0.5, 0.0), (0.2, 0.1), (0.3, 0.4), (0.7, 0.5), (1.0, 1.2), (0.1, 0.9)] {
            let found = polygon(&ring(20, radius, aside), Vec3::ZERO, &LAMP);
            let circle = lens(2.0 * aside, 2.0 * radius);
            // A polygon of 20 corners lacks 1.6 % of its circle.
            assert!((found - circle).abs() < 0.02, "{radius} {aside}: {found} {circle}");
        }
    }

    #[test]
    fn edge_through_the_lamps_centre_hides_half() {
        let half = [(-9.0, 0.0), (9.0, 0.0), (9.0, 9.0), (-9.0, 9.0)].map(|(x, y)| Vec3::new(x, y, 5.0));
        assert!((polygon(&half, Vec3::ZERO, &LAMP) - 0.5).abs() < 1e-5);
    }

    #[test]
    fn wall_past_the_place_is_cut_and_hides_its_quarter() {
        let wall = [(0.0, -5.0), (0.0, 5.0), (9.0, 5.0), (9.0, -5.0)].map(|(x, z)| Vec3::new(x, -0.001, z));
        let shade = polygon(&wall, Vec3::ZERO, &LAMP);
        assert!((shade - 0.25).abs() < 0.005, "{shade}");
    }

    #[test]
    fn angle_is_atan2() {
        for i in 0..64 {
            let (y, x) = (0.1 * i as f32).sin_cos();
            assert!((angle(y, x) - y.atan2(x)).abs() < 1e-6);
        }
    }
}
