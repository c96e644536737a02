use nalgebra::{Matrix3, Vector3};
use onelight_film::PerLayer;
use rayon::prelude::*;

use super::quadrature::normal_nodes;
use crate::chain::Finish;

/// Newton's steps: the last changes nothing that can be seen.
const STEPS: usize = 4;
/// Of the largest slope, squared: directions in which the picture hardly moves get no shift.
const FLAT: f64 = 1e-6;

/// For each layer, amounts in increasing order and the shift that keeps the mean of the display-linear picture there.
pub(super) fn mean_shifts(
    greys: &[[f64; 3]],
    sigma: impl Fn(PerLayer<f64>) -> PerLayer<f64> + Sync,
    finish: &impl Finish,
) -> PerLayer<Vec<(f64, f64)>> {
    let shifts: Vec<[f64; 3]> =
        greys.par_iter().map(|grey| mean_shift(*grey, sigma(PerLayer::from(*grey)).to_array(), finish)).collect();
    let layer = |k: usize| {
        let mut points: Vec<(f64, f64)> = greys.iter().zip(&shifts).map(|(grey, shift)| (grey[k], shift[k])).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points.dedup_by(|a, b| a.0 == b.0);
        if points.is_empty() { vec![(0.0, 0.0)] } else { points }
    };
    PerLayer { red: layer(0), green: layer(1), blue: layer(2) }
}

/// The shift at one grey. The derivative of a mean by the shift is the mean of the picture times the noise, over sigma.
fn mean_shift(grey: [f64; 3], sigma: [f64; 3], finish: &impl Finish) -> [f64; 3] {
    let target = Vector3::from(finish.display_linear(grey));
    let mut shift = Vector3::<f64>::zeros();
    for _ in 0..STEPS {
        let (mut mean, mut slope) = (Vector3::zeros(), Matrix3::zeros());
        let amounts = |z: [f64; 3]| std::array::from_fn(|k| grey[k] + sigma[k] * z[k] + shift[k]);
        let amounts: Vec<[f64; 3]> = normal_nodes().map(|(z, _)| amounts(z)).collect();
        for ((z, weight), light) in normal_nodes().zip(finish.display_linear_of(&amounts)) {
            let light = weight * Vector3::from(light);
            mean += light;
            slope += light * Vector3::from(z).transpose();
        }
        let slope = slope * Matrix3::from_diagonal(&Vector3::from(sigma.map(|s| 1.0 / s.max(f64::MIN_POSITIVE))));
        let square = slope.transpose() * slope;
        let damped = square + Matrix3::identity() * (FLAT * square.trace());
        let Some(step) = damped.lu().solve(&(slope.transpose() * (mean - target))) else { break };
        if !step.iter().all(|s| s.is_finite()) {
            break;
        }
        for k in 0..3 {
            shift[k] = (shift[k] - step[k].clamp(-sigma[k], sigma[k])).clamp(-2.0 * sigma[k], 2.0 * sigma[k]);
        }
    }
    shift.into()
}
