//! Light outside the sRGB primaries: what compression keeps apart that clipping does not.

use onelight::film::{ExposureMatrix, PerLayer, WideGamut};
use onelight::spectra::nalgebra::Vector3;
use onelight::spectra::{Basis, Chromaticity, MID_GREY, RgbSpace};
use onelight::{Matching, Reconstruction, StockKind, stock, stock_ids};

/// Points of a ray from grey to a primary, and the longest part of it over which a layer may stay as it is.
const POINTS: usize = 200;
const LONGEST_STILL: f64 = 0.1;
/// Brightness of the primary at the end of the ray, in units of diffuse white.
const BRIGHTNESS: [f64; 4] = [0.18, 1.0, 4.0, 16.0];

/// The layers' exposures along a ray.
fn along(matrix: &ExposureMatrix, to_srgb: impl Fn([f64; 3]) -> [f64; 3], primary: usize, brightness: f64) -> [Vec<f64>; 3] {
    let mut layers = [Vec::new(), Vec::new(), Vec::new()];
    for i in 0..=POINTS {
        let t = i as f64 / POINTS as f64;
        let mut end = [0.0; 3];
        end[primary] = brightness;
        let rgb = end.map(|v| (1.0 - t) * MID_GREY + t * v);
        let exposure: PerLayer<f64> = matrix.expose(to_srgb(rgb));
        layers.iter_mut().zip(exposure.to_array()).for_each(|(layer, e)| layer.push(e));
    }
    layers
}

/// Whether a layer turns round where the matrix itself does not, and whether it stays still for too long.
fn faults(found: &[f64], uncut: &[f64]) -> [bool; 2] {
    let rising = uncut[POINTS] > uncut[0];
    let small = 1e-3 * found[0];
    let step = |pair: &[f64]| if rising { pair[1] - pair[0] } else { pair[0] - pair[1] };
    let turns = found.windows(2).any(|pair| step(pair) < -1e-9 * found[0]);
    let still = (0..=POINTS)
        .map(|i| found[i..].iter().take_while(|e| (*e - found[i]).abs() < small * 1e-3).count())
        .max()
        .unwrap_or(0);
    [turns, still as f64 > LONGEST_STILL * POINTS as f64]
}
