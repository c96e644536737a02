//! The bodies of the still life and where a ray meets them.

use glam::{Mat3, Vec2, Vec3, vec2, vec3};

use super::spectrum::Nodes;

/// A ray, its direction of length 1.
#[derive(Clone, Copy)]
pub(super) struct Ray {
    pub(super) origin: Vec3,
    pub(super) direction: Vec3,
}

impl Ray {
    /// Whether the ray meets a sphere.
    pub(super) fn passes(&self, centre: Vec3, radius: f32) -> bool {
        let across = centre - self.origin;
        let along = across.dot(self.direction);
        along > -radius && across.length_squared() - along * along < radius * radius
    }
}

/// The form of a body in its own frame.
pub(super) enum Shape {
    Sphere(f32),
    Lathe(Profile),
    /// Rectangle in the plane z = 0, by its half size.
    Card(Vec2),
    /// Blade from the origin along x, bent towards -z: length, half width, bend.
    Leaf(Vec3),
    /// Torus round the z axis, by ring and tube radius.
    Ring(f32, f32),
}

/// Squared radius of a turned body against height: a table of values and slopes, cubic between.
pub(super) struct Profile {
    height: f32,
    widest: f32,
    table: Vec<(f32, f32)>,
}

/// How a body's surface answers light.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Skin {
    Matte,
    /// Colour under a clear coat.
    Coat,
    Metal,
    SolidGlass,
    /// An empty vessel of coloured glass.
    ThinGlass,
    Leaf,
    Globe,
    Neon,
    ColorChecker,
    Wedge,
}

/// A shape at a place.
pub(super) struct Body {
    pub(super) shape: Shape,
    pub(super) origin: Vec3,
    pub(super) axes: Mat3,
    /// Sphere that encloses it.
    pub(super) centre: Vec3,
    pub(super) radius: f32,
    pub(super) skin: Skin,
    pub(super) colours: [Nodes; 2],
}

/// What casts a shadow.
pub(super) enum Outline {
    None,
    /// A sphere about the body's centre.
    Round(f32),
    Polygon(Vec<Vec3>),
}

/// Where a ray meets a body: distance, normal, and the place in the body's frame.
pub(super) struct Hit {
    pub(super) distance: f32,
    pub(super) normal: Vec3,
    pub(super) local: Vec3,
}

impl Profile {
    /// From knots of height and radius, bottom to top; smooth between them.
    pub(super) fn new(knots: &[(f32, f32)]) -> Self {
        const STEPS: usize = 48;
        let (bottom, height) = (knots[0].0, knots[knots.len() - 1].0);
        let square = |i: usize| knots[i].1 * knots[i].1;
        let slope = |i: usize| {
            let (a, b) = (i.saturating_sub(1), (i + 1).min(knots.len() - 1));
            (square(b) - square(a)) / (knots[b].0 - knots[a].0)
        };
        let table = (0..=STEPS)
            .map(|step| {
                let y = bottom + (height - bottom) * step as f32 / STEPS as f32;
                let i = knots.iter().rposition(|k| k.0 <= y).unwrap_or(0).min(knots.len() - 2);
                let span = knots[i + 1].0 - knots[i].0;
                let t = (y - knots[i].0) / span;
                hermite(t, span, (square(i), slope(i)), (square(i + 1), slope(i + 1)))
            })
            .collect();
        let widest = knots.iter().fold(0.0, |w: f32, k| w.max(k.1)) * 1.1;
        Self { height: height - bottom, widest, table }
    }

    /// Squared radius and its slope at a height.
    fn at(&self, y: f32) -> (f32, f32) {
        let span = self.height / (self.table.len() - 1) as f32;
        let x = (y / span).clamp(0.0, (self.table.len() - 1) as f32);
        let i = (x as usize).min(self.table.len() - 2);
        hermite(x - i as f32, span, self.table[i], self.table[i + 1])
    }

    /// First crossing along a ray in the body's frame.
    fn meet(&self, o: Vec3, d: Vec3) -> Option<f32> {
        const STEPS: usize = 16;
        let (a, b) = (d.x * d.x + d.z * d.z, o.x * d.x + o.z * d.z);
        let root = (b * b - a * (o.x * o.x + o.z * o.z - self.widest * self.widest)).max(0.0).sqrt();
        let (y0, y1) = (-o.y / d.y, (self.height - o.y) / d.y);
        let mut near = ((-b - root) / a).max(y0.min(y1)).max(1e-4);
        let far = ((-b + root) / a).min(y0.max(y1));
        let outside = |t: f32| {
            let p = o + d * t;
            p.x * p.x + p.z * p.z - self.at(p.y).0
        };
        if root == 0.0 || near >= far {
            return None;
        }
        let mut before = outside(near);
        if before < 0.0 {
            return Some(near);
        }
        let step = (far - near) / STEPS as f32;
        for _ in 0..STEPS {
            let after = outside(near + step);
            if after < 0.0 {
                let (mut lo, mut hi, mut f_lo, mut f_hi) = (near, near + step, before, after);
                for _ in 0..6 {
                    let t = lo + (hi - lo) * (f_lo / (f_lo - f_hi)).clamp(0.05, 0.95);
                    let f = outside(t);
                    if f < 0.0 { (hi, f_hi) = (t, f) } else { (lo, f_lo) = (t, f) }
                }
                return Some(lo);
            }
            (near, before) = (near + step, after);
        }
        None
    }
}

impl Body {
    pub(super) fn new(shape: Shape, origin: Vec3, axes: Mat3, skin: Skin, colours: [Nodes; 2]) -> Self {
        let (middle, radius) = match &shape {
            Shape::Sphere(radius) => (Vec3::ZERO, *radius),
            Shape::Lathe(p) => (Vec3::Y * p.height / 2.0, vec2(p.height / 2.0, p.widest).length()),
            Shape::Card(half) => (Vec3::ZERO, half.length()),
            Shape::Leaf(size) => (vec3(size.x / 2.0, 0.0, -size.z * size.x * size.x / 2.0), size.x * 0.62),
            Shape::Ring(ring, tube) => (Vec3::ZERO, ring + tube),
        };
        Self { shape, origin, axes, centre: origin + axes * middle, radius, skin, colours }
    }

    /// Where a ray first meets the body, nearer than a limit.
    pub(super) fn meet(&self, ray: &Ray, limit: f32) -> Option<Hit> {
        let across = self.centre - ray.origin;
        let along = across.dot(ray.direction);
        let clear = self.radius * self.radius - (across.length_squared() - along * along);
        if clear < 0.0 || along < -self.radius || along - self.radius > limit {
            return None;
        }
        let inverse = self.axes.transpose();
        let (o, d) = (inverse * (ray.origin - self.origin), inverse * ray.direction);
        let distance = match &self.shape {
            Shape::Sphere(_) => along - clear.sqrt(),
            Shape::Lathe(profile) => profile.meet(o, d)?,
            Shape::Card(_) => -o.z / d.z,
            Shape::Leaf(size) => {
                let (a, b, c) = (size.z * d.x * d.x, d.z + 2.0 * size.z * o.x * d.x, o.z + size.z * o.x * o.x);
                let root = (b * b - 4.0 * a * c).max(0.0).sqrt();
                [root, -root]
                    .map(|r| -2.0 * c / (b + r))
                    .into_iter()
                    .filter(|&t| t > 1e-4 && inside_leaf(*size, o + d * t))
                    .reduce(f32::min)?
            }
            Shape::Ring(ring, tube) => meet_ring(*ring, *tube, o, d)?,
        };
        let local = o + d * distance;
        let normal = match &self.shape {
            Shape::Sphere(_) => local,
            Shape::Lathe(profile) => vec3(2.0 * local.x, -profile.at(local.y).1, 2.0 * local.z),
            Shape::Card(half) if local.truncate().abs().cmpgt(*half).any() => return None,
            Shape::Card(_) => Vec3::Z,
            Shape::Leaf(size) => vec3(2.0 * size.z * local.x, 0.22 * local.y.signum(), 1.0),
            Shape::Ring(ring, _) => local - local.truncate().normalize_or_zero().extend(0.0) * *ring,
        };
        let normal = self.axes * normal.normalize_or_zero();
        (distance > 1e-4 && distance < limit).then_some(Hit { distance, normal, local })
    }

    /// What a lamp in a direction finds in its way, for shadows.
    pub(super) fn outline(&self, towards: Vec3) -> Outline {
        match &self.shape {
            _ if matches!(self.skin, Skin::Globe | Skin::Neon | Skin::Wedge) => Outline::None,
            Shape::Lathe(profile) if profile.widest < 0.05 => Outline::None,
            Shape::Ring(..) => Outline::None,
            Shape::Sphere(radius) => Outline::Round(*radius),
            Shape::Leaf(size) => Outline::Round(0.3 * size.x),
            Shape::Lathe(profile) if profile.height < 2.5 * profile.widest => {
                Outline::Round(0.45 * profile.widest + 0.25 * profile.height)
            }
            Shape::Lathe(profile) => {
                const STEPS: usize = 6;
                let side = self.axes.y_axis.cross(towards).normalize_or_zero();
                let edge = |step: usize, sign: f32| {
                    let y = profile.height * step as f32 / STEPS as f32;
                    let width = profile.at(y).0.max(0.0).sqrt();
                    self.origin + self.axes.y_axis * y + side * sign * width
                };
                let (up, down) = ((0..=STEPS).map(|s| edge(s, 1.0)), (0..=STEPS).rev().map(|s| edge(s, -1.0)));
                Outline::Polygon(up.chain(down).collect())
            }
            Shape::Card(half) => {
                let corner = |(x, y)| self.origin + self.axes * (vec2(x, y) * *half).extend(0.0);
                Outline::Polygon([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(corner).to_vec())
            }
        }
    }
}

fn hermite(t: f32, span: f32, a: (f32, f32), b: (f32, f32)) -> (f32, f32) {
    let (d, e) = (b.0 - a.0, a.1 * span);
    let c2 = 3.0 * d - 2.0 * e - b.1 * span;
    let c3 = d - e - c2;
    (a.0 + t * (e + t * (c2 + t * c3)), (e + t * (2.0 * c2 + t * 3.0 * c3)) / span)
}

fn leaf_width(size: Vec3, s: f32) -> f32 {
    size.y * (s * (1.0 - s)).max(0.0).sqrt() * 2.4 * (1.0 - 0.45 * s) * (1.0 - s * s * s)
}

fn inside_leaf(size: Vec3, p: Vec3) -> bool {
    p.x > 0.0 && p.x < size.x && p.y.abs() < leaf_width(size, p.x / size.x)
}

fn meet_ring(ring: f32, tube: f32, o: Vec3, d: Vec3) -> Option<f32> {
    // Walk by the distance to the tube, from the slab that holds it.
    let (a, b) = ((-tube - o.z) / d.z, (tube - o.z) / d.z);
    let (mut t, far) = (a.min(b).max(0.0), a.max(b));
    for _ in 0..48 {
        let p = o + d * t;
        let gap = vec2(p.truncate().length() - ring, p.z).length() - tube;
        if gap < 1e-4 {
            return Some(t);
        }
        t += gap;
        if t > far + tube {
            break;
        }
    }
    None
}
