use std::f64::consts::PI;

use super::spread::PointSpread;
use crate::least_squares::minimise;

/// Radii at which the profile is met, and how far they reach, in paths through the base.
const RADII: usize = 300;
const REACH: f64 = 14.0;
/// Standard deviations from which the fit starts, and between which it stays, in paths.
const STARTS: [[f64; 4]; 2] = [[0.4, 0.7, 1.25, 2.7], [0.26, 0.36, 0.5, 0.7]];
const SIGMAS: [f64; 2] = [0.08, 6.0];

/// Shares and standard deviations (um) of four positive Gaussians that make the smooth part of a profile: their energy is exactly its
/// energy, and the light in each ring is met in least squares.
pub(super) fn smooth_gaussians(spread: &PointSpread) -> [(f64, f64); 4] {
    let path = spread.path_um();
    let energy = spread.smooth_returned();
    // More radii where the profile changes fast.
    let radius = |i: usize| REACH * (i as f64 / RADII as f64).powi(2);
    let ring = |i: usize| (radius(i + 1) - radius(i), 0.5 * (radius(i) + radius(i + 1)));
    let target: Vec<f64> = (0..RADII).map(|i| path * path * spread.smooth(path * ring(i).1) / energy).collect();
    let parts = |p: &[f64]| {
        let weights: [f64; 4] = std::array::from_fn(|i| p[4 + i].exp());
        let all: f64 = weights.iter().sum();
        std::array::from_fn::<_, 4, _>(|i| (weights[i] / all, p[i].exp()))
    };
    let residuals = |p: &[f64]| {
        let parts = parts(p);
        let at = |i: usize| {
            let (width, r) = ring(i);
            let sum: f64 = parts.iter().map(|(w, s)| w / (2.0 * PI * s * s) * (-0.5 * (r / s).powi(2)).exp()).sum();
            2.0 * PI * r * width.sqrt() * (sum - target[i])
        };
        (0..RADII).map(at).collect::<Vec<f64>>()
    };
    let log = SIGMAS.map(f64::ln);
    let bounds = [log, log, log, log, [-8.0, 8.0], [-8.0, 8.0], [-8.0, 8.0], [-8.0, 8.0]];
    let fits = STARTS.map(|sigmas| {
        let mut start = sigmas.map(f64::ln).to_vec();
        start.extend([-1.0, 0.0, 0.0, -1.0]);
        minimise(residuals, &start, &bounds)
    });
    let [a, b] = fits;
    let best = if a.1 <= b.1 { a.0 } else { b.0 };
    parts(&best).map(|(weight, sigma)| (weight * energy, sigma * path))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::halation::FilmBase;

    /// Misplaced light as a share of all: twice what one must move.
    fn misplaced(spread: &PointSpread, parts: &[(f64, f64)]) -> f64 {
        let at =
            |r: f64| parts.iter().map(|(w, s)| w / (2.0 * PI * s * s) * (-0.5 * (r / s).powi(2)).exp()).sum::<f64>();
        let rings = (0..20_000).map(|i| f64::from(i) + 0.5);
        rings.map(|r| 2.0 * PI * r * (at(r) - spread.smooth(r)).abs()).sum::<f64>() / spread.smooth_returned()
    }

    #[test]
    fn four_gaussians_misplace_as_little_light_as_an_independent_fit() {
        let reference: serde_json::Value = serde_json::from_str(include_str!("../../tests/reference.json")).unwrap();
        for (name, fit) in reference["halation_gaussians"].as_object().unwrap() {
            let density = name.strip_prefix("d=").unwrap().parse().unwrap();
            let spread = PointSpread::new(FilmBase::Triacetate, density);
            let numbers =
                |key: &str| fit[key].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect::<Vec<_>>();
            let theirs: Vec<(f64, f64)> = numbers("w").into_iter().zip(numbers("s")).collect();
            let ours = smooth_gaussians(&spread);
            let energy: f64 = ours.iter().map(|(w, _)| w).sum();
            assert!((energy / spread.smooth_returned() - 1.0).abs() < 1e-12);
            let (ours, theirs) = (misplaced(&spread, &ours), misplaced(&spread, &theirs));
            assert!(ours < 1.1 * theirs + 2e-4, "{name}: {ours} against {theirs}");
        }
    }
}
