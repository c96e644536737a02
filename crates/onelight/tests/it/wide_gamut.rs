//! Light outside the sRGB primaries: what compression keeps apart that clipping does not.

use onelight::film::{ExposureMatrix, PerLayer, WideGamut};
use onelight::spectra::nalgebra::Vector3;
use onelight::spectra::{Basis, Chromaticity, MID_GREY, RgbSpace};
use onelight::{Image, Matching, Reconstruction, StockKind, stock, stock_ids};

/// Points of a ray from grey to a primary, and the longest part of it over which a layer may stay as it is.
const POINTS: usize = 200;
const LONGEST_STILL: f64 = 0.1;
/// Brightness of the primary at the end of the ray, in units of diffuse white.
const BRIGHTNESS: [f64; 4] = [0.18, 1.0, 4.0, 16.0];

/// The layers' exposures along a ray.
fn along(
    matrix: &ExposureMatrix,
    to_srgb: impl Fn([f64; 3]) -> [f64; 3],
    primary: usize,
    brightness: f64,
) -> [Vec<f64>; 3] {
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

/// How far a layer may go back, in exposures of grey: it cannot be seen.
const BACK: f64 = 0.01;

/// Whether a layer goes back where the matrix itself does not, and whether it stays still for too long.
fn faults(found: &[f64], rising: bool) -> [bool; 2] {
    let grey = found[0];
    let (mut furthest, mut back) = (grey, 0f64);
    for &e in found {
        furthest = if rising { e.max(furthest) } else { e.min(furthest) };
        back = back.max((e - furthest).abs());
    }
    let still = |i: usize| found[i..].iter().take_while(|e| (*e - found[i]).abs() < 1e-6 * grey).count();
    let longest = (0..=POINTS).map(still).max().unwrap_or(0);
    [back > BACK * grey, longest as f64 > LONGEST_STILL * POINTS as f64]
}

const SPACES: [(&str, RgbSpace); 6] = [
    ("P3", RgbSpace::DISPLAY_P3),
    ("Rec.2020", RgbSpace::REC2020),
    ("ACEScg", RgbSpace::ACESCG),
    ("ARRI Wide Gamut 4", RgbSpace::ARRI_WIDE_GAMUT_4),
    ("S-Gamut3", RgbSpace::S_GAMUT3),
    ("S-Gamut3.Cine", RgbSpace::S_GAMUT3_CINE),
];

#[test]
fn compression_keeps_colours_apart_that_clipping_does_not() {
    let basis = Basis::new(Reconstruction::Smooth).unwrap();
    let films = stock_ids().map(|id| stock(id).unwrap());
    let films = films
        .filter(|film| matches!(film.kind(), StockKind::Negative | StockKind::Reversal) && film.image() == Image::Dye);
    let (mut rays, mut clipped, mut compressed) = (0, [0, 0], [0, 0]);
    let mut of_space = [[0; 3]; SPACES.len()];
    for film in films {
        let grey = PerLayer::all(film.mid_grey().unwrap());
        let matrix = ExposureMatrix::new(&film, &basis, Matching::Grey, grey).unwrap();
        let clip = matrix.clone().with_gamut(WideGamut::Clip);
        for (s, (_, space)) in SPACES.iter().enumerate() {
            let convert = space.to_about(&RgbSpace::SRGB, Chromaticity::black_body_6500_k()).unwrap();
            let to_srgb = |rgb: [f64; 3]| <[f64; 3]>::from(convert * Vector3::from(rgb));
            for (primary, brightness) in (0..3).flat_map(|p| BRIGHTNESS.map(|b| (p, b))) {
                let [found, cut] = [&matrix, &clip].map(|matrix| along(matrix, to_srgb, primary, brightness));
                for layer in 0..3 {
                    let uncut: Vec<f64> = [0, POINTS]
                        .map(|i| {
                            let t = i as f64 / POINTS as f64;
                            let mut end = [0.0; 3];
                            end[primary] = brightness;
                            let light = to_srgb(end.map(|v| (1.0 - t) * MID_GREY + t * v));
                            matrix.matrix().row(layer).transpose().dot(&Vector3::from(light))
                        })
                        .to_vec();
                    let rising = uncut[1] > uncut[0];
                    assert!(found[layer].iter().all(|e| *e > 0.0 && e.is_finite()), "{}", film.id());
                    rays += 1;
                    let add = |faults: [bool; 2], to: &mut [i32; 2]| (0..2).for_each(|i| to[i] += i32::from(faults[i]));
                    add(faults(&cut[layer], rising), &mut clipped);
                    let mine = faults(&found[layer], rising);
                    add(mine, &mut compressed);
                    of_space[s][0] += 1;
                    (0..2).for_each(|i| of_space[s][1 + i] += i32::from(mine[i]));
                }
            }
        }
    }
    println!("{rays} rays and layers; turns and standstills: clipped {clipped:?}, compressed {compressed:?}");
    // No positive function of a layer's own light does without: ARCHITECTURE.md says why.
    assert!(3 * compressed[0] < clipped[0], "{compressed:?} of {clipped:?}");
    assert!(15 * compressed[1] < rays, "{compressed:?} of {rays}");
    SPACES.iter().zip(of_space).for_each(|((name, _), counts)| println!("  {name}: {counts:?}"));
}
