//! From pixels to rays.

use glam::Vec3;

use super::shape::Ray;
use super::still_life::{AIM, EYE};

pub(super) struct Camera {
    forward: Vec3,
    right: Vec3,
    up: Vec3,
    middle: (f32, f32),
    /// Pixels per unit of tangent: the width always holds the same part of the scene.
    scale: f32,
}

impl Camera {
    pub(super) fn new((width, height): (usize, usize)) -> Self {
        const HALF_WIDTH: f32 = 0.394;
        let middle = (width as f32 / 2.0, height as f32 / 2.0);
        let forward = (AIM - EYE).normalize_or_zero();
        let right = forward.cross(Vec3::Y).normalize_or_zero();
        Self { forward, right, up: right.cross(forward), middle, scale: middle.0 / HALF_WIDTH }
    }

    pub(super) fn ray(&self, x: f32, y: f32) -> Ray {
        let (u, v) = ((x - self.middle.0) / self.scale, (self.middle.1 - y) / self.scale);
        let direction = (self.forward + self.right * u + self.up * v).normalize_or_zero();
        Ray { origin: EYE, direction }
    }

    /// Column and row that show a place.
    pub(super) fn pixel(&self, place: Vec3) -> (usize, usize) {
        let to = (place - EYE) * (self.scale / (place - EYE).dot(self.forward));
        ((self.middle.0 + to.dot(self.right)) as usize, (self.middle.1 - to.dot(self.up)) as usize)
    }
}

/// Offsets of samples from their pixel's centre: a lattice, shaped to a tent filter two pixels wide.
pub(super) fn offsets(count: usize, step: usize) -> Vec<(f32, f32)> {
    let tent = |k: usize| {
        let u = (k as f32 + 0.5) / count as f32 * 2.0;
        if u < 1.0 { u.sqrt() - 1.0 } else { 1.0 - (2.0 - u).sqrt() }
    };
    (0..count).map(|sample| (tent(sample), tent(sample * step % count))).collect()
}
