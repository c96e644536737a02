//! Tests of whole looks, in one program so that films are compiled once.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails loudly")]

mod approaches;
mod baked;
mod buffers;
mod derived;
mod direct;
mod effects;
mod films;
mod hdr;
mod laws;
mod oracle;
mod own_stock;
mod print_alone;
mod properties;
mod scan;
mod scene_light;
mod stages;
mod structured;
mod switches;
mod wide_gamut;

use std::ops::RangeInclusive;

use onelight::Reconstruction;
use onelight::spectra::{Basis, DisplayDifference, DisplayLinear, RgbSpace, color_checker};

pub(crate) use films::{compiled, film, films_once, process};

/// The films of the talk: K-negative, K-reversal (both), F-reversal, F-reversal 2.
pub(crate) const FILMS: [&str; 5] =
    ["kodak-5207", "kodak-ektachrome-100", "kodak-kodachrome-64", "fuji-velvia-50", "fuji-provia-100f"];

/// The ColorChecker over a range of exposures in stops, white being 1 at 0.
pub(crate) fn chart(stops: RangeInclusive<i32>) -> Vec<[f64; 3]> {
    let basis = Basis::new(Reconstruction::Smooth).unwrap();
    let patches: Vec<[f64; 3]> = color_checker()
        .iter()
        .map(|patch| basis.rgb_of(&basis.white().reflected_by(&patch.reflectance)).map(|v| v.max(0.0)))
        .collect();
    stops
        .flat_map(|s| patches.iter().map(move |rgb| rgb.map(|v| v * f64::from(s).exp2())).collect::<Vec<_>>())
        .collect()
}

/// Mean and largest difference of two maps on colours.
pub(crate) fn differ(
    colours: &[[f64; 3]],
    a: impl Fn([f64; 3]) -> DisplayLinear,
    b: impl Fn([f64; 3]) -> DisplayLinear,
) -> (f64, f64) {
    let difference = DisplayDifference::new(&RgbSpace::SRGB).unwrap();
    let all: Vec<f64> = colours.iter().map(|&rgb| difference.between(a(rgb), b(rgb))).collect();
    (all.iter().sum::<f64>() / all.len() as f64, all.iter().copied().fold(0.0, f64::max))
}

/// Whether a figure lies in a published range, a tenth beside it allowed: the range's own colours are not known exactly.
pub(crate) fn stated(what: &str, found: f64, published: RangeInclusive<f64>) {
    let (low, high) = (0.9 * published.start() - 5e-4, 1.1 * published.end() + 5e-4);
    assert!((low..=high).contains(&found), "{what}: {found:.4}, stated {published:?}");
}
