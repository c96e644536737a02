//! Halation in cells against the profile itself, summed point by point.

use super::{Antihalation, FilmBase, Halation, HalationCells, HalationSettings, PointSpread};
use crate::cells::ExpandedRows;
use crate::format::Pitch;
use crate::frame::Frame;
use crate::planes::Planes;

/// Grey, and a light on it: which pixels hold how many times grey.
type Light = fn(x_um: f64, y_um: f64) -> f64;

const DISC: Light = |x, y| if x.hypot(y) < 30.0 { 1024.0 } else { 0.0 };
const POINT: Light = |x, y| if x.abs() < 7.5 && y.abs() < 7.5 { 8192.0 } else { 0.0 };

/// Errors of the red layer's exposure in stops, in rising order.
fn errors(density: f64, pitch_um: f64, light: Light) -> Vec<f64> {
    let side = (2000.0 / pitch_um) as usize | 1;
    let place = |i: usize| (i as f64 - (side / 2) as f64) * pitch_um;
    let settings = HalationSettings { antihalation: Antihalation::Density(density), ..Default::default() };
    let halation = Halation::new(settings).unwrap();
    let frame = Frame::new([side, side], Pitch::new(pitch_um, pitch_um).unwrap()).unwrap();
    let mut exposures = Planes::new(side, 0..side).unwrap();
    let mut bright = Vec::new();
    for y in 0..side {
        for x in 0..side {
            let e = light(place(x), place(y));
            exposures.row_mut(y).into_iter().for_each(|row| row[x] = 1.0 + e as f32);
            if e > 0.0 {
                bright.push((x, y, e));
            }
        }
    }
    let mut cells = HalationCells::new(&halation, &frame).unwrap();
    cells.add(&exposures).unwrap();
    let field = cells.finish().unwrap();
    // The profile over a pixel, by the distance of two pixels.
    let spread = PointSpread::new(FilmBase::Triacetate, density);
    let over = |d: usize| [-0.375, -0.125, 0.125, 0.375].map(|i| (d as f64 + i) * pitch_um);
    let profile: Vec<f64> = (0..side * side)
        .map(|i| {
            let (dx, dy) = (over(i % side), over(i / side));
            dx.iter().flat_map(|x| dy.map(|y| spread.at(x.hypot(y)))).sum::<f64>() * pitch_um * pitch_um / 16.0
        })
        .collect();
    let (tau, returned) = (0.5, halation.returned_light());
    let mut rows = ExpandedRows::default();
    let mut errors = Vec::new();
    for y in 0..side {
        let (upper, lower, t) = field.rows(0, y, 0, side, &mut rows).unwrap();
        for x in 0..side {
            let e = f64::from(exposures.row(y)[0][x]);
            let halo: f64 = returned
                + bright.iter().map(|(bx, by, e)| e * profile[by.abs_diff(y) * side + bx.abs_diff(x)]).sum::<f64>();
            let exact = (e + tau * halo) / (1.0 + tau * returned);
            let pull = f64::from(field.pull(0).unwrap());
            let found = e + pull * (f64::from(upper[x] + t * (lower[x] - upper[x])) - e);
            errors.push((found / exact).log2().abs());
        }
    }
    errors.sort_by(f64::total_cmp);
    errors
}

#[test]
fn cells_are_as_exact_as_the_model_says() {
    // Largest and 99th percentile, in stops: what the model's own prototype came to.
    for (density, pitch, largest, p99) in [(0.6, 12.158, 0.114, 0.02), (0.0, 6.079, 0.454, 0.188)] {
        for light in [DISC, POINT] {
            let errors = errors(density, pitch, light);
            let found = [errors[errors.len() - 1], errors[errors.len() * 99 / 100]];
            assert!(found[0] < largest && found[1] < p99, "{density} {pitch}: {found:?}");
        }
    }
}
