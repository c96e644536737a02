//! Step 2: what low-precision frame buffers show on a smooth ramp.

use anyhow::Result;
use onelight::Look;
use onelight_benches::buffers::{CASES, Case, largest_step};
use onelight_charts::{Tile, mean_p95_max};

use super::develop::{coded, differences};
use super::frame::WIDTH;

/// Rows of a ramp, and its ends in stops about mid grey.
const HEIGHT: usize = 60;
const RAMP: (f64, f64) = (-7.0, 3.0);
/// The part that is shown again, stretched over the whole display.
const DARK: (f64, f64) = (-4.0, -2.0);

/// What a buffer does to the ramp.
pub(super) struct Band {
    pub(super) name: &'static str,
    /// Largest visible step on a grey ramp, CIEDE2000.
    pub(super) step: f64,
    /// Mean, 95 % and largest difference on the ramp, CIEDE2000.
    pub(super) distance: [f64; 3],
}

/// A pair of tiles for the ramp without a buffer and with each: as it is, and its dark part stretched.
pub(super) fn tiles(look: &Look) -> Result<(Vec<Tile>, Vec<Band>)> {
    let (exact, dark) = (developed(look, RAMP, None), developed(look, DARK, None));
    let mut tiles = Vec::new();
    let mut bands = Vec::new();
    pair(&mut tiles, "no buffer", String::new(), &exact, &dark, &dark);
    for case in &CASES {
        let shown = developed(look, RAMP, Some(case));
        let distance = mean_p95_max(&differences(&exact, &shown)?);
        let step = largest_step(case, look)?;
        let figures = format!("largest step dE {step:.2}");
        pair(&mut tiles, case.name, figures, &shown, &developed(look, DARK, Some(case)), &dark);
        bands.push(Band { name: case.name, step, distance });
    }
    Ok((tiles, bands))
}

fn pair(tiles: &mut Vec<Tile>, name: &str, figures: String, shown: &[[f32; 3]], dark: &[[f32; 3]], exact: &[[f32; 3]]) {
    let (width, height) = (WIDTH as u32, HEIGHT as u32);
    let captions = [name.to_owned(), figures];
    tiles.push(Tile { captions, width, height, picture: Ok(coded(shown)) });
    let captions = [format!("{:+} to {:+} stops, stretched", DARK.0, DARK.1), String::new()];
    tiles.push(Tile { captions, width, height, picture: Ok(stretched(dark, exact)) });
}

/// Grey above, a warm light below, over a range of stops.
fn developed(look: &Look, (from, to): (f64, f64), case: Option<&Case>) -> Vec<[f32; 3]> {
    let row = |tint: [f64; 3]| -> Vec<[f32; 3]> {
        let at = |x: usize| {
            let stops = from + (to - from) * x as f64 / (WIDTH - 1) as f64;
            let rgb = tint.map(|v| onelight::spectra::MID_GREY * v * stops.exp2());
            look.develop_linear(case.map_or(rgb, |case| case.stored(rgb))).map(|v| v as f32)
        };
        (0..WIDTH).map(at).collect()
    };
    let (grey, warm) = (row([1.0; 3]), row([1.0, 0.6, 0.25]));
    (0..HEIGHT).flat_map(|y| if y < HEIGHT / 2 { grey.clone() } else { warm.clone() }).collect()
}

/// Coded values such that those of `exact` fill the display.
fn stretched(linear: &[[f32; 3]], exact: &[[f32; 3]]) -> Vec<[f32; 3]> {
    let bounds = coded(exact).into_iter().flatten().fold((1.0f32, 0.0f32), |(low, high), v| (low.min(v), high.max(v)));
    let scale = 1.0 / (bounds.1 - bounds.0).max(1e-6);
    coded(linear).into_iter().map(|rgb| rgb.map(|v| (v - bounds.0) * scale)).collect()
}
