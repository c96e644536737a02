//! The fixture scene before and after a look, at several exposures, on one sheet.

use std::io::Cursor;

use anyhow::Result;
use image::{ImageFormat, Rgb, RgbImage};
use onelight::TransferCurve;
use onelight::baked::{Baked, Chart};
use onelight::spectra::nalgebra::{Matrix3, Vector3};
use onelight::spectra::{Chromaticity, RgbSpace};

use onelight_charts::{BACKGROUND, caption, paste};

/// Exposures shown, in stops.
const EXPOSURES: [f32; 3] = [-2.0, 0.0, 2.0];
const TILE: (u32, u32) = (640, 360);
/// Space around the tiles, and the height of a line of captions, in pixels.
const GAP: u32 = 12;
const CAPTION: u32 = 28;
/// Each dot of the 8x8 letters is this many pixels wide and high.
const DOT: (u32, u32) = (2, 2);

/// The sheet as PNG: the scene clipped to the display above, the look below.
pub(crate) fn sheet(look: &Baked) -> Result<Vec<u8>> {
    let scene = onelight_fixtures::scene_rgb((TILE.0 as usize, TILE.1 as usize))?;
    let to_input = RgbSpace::SRGB.to_about(&look.spaces().input_space.space(), Chromaticity::black_body_6500_k())?;
    // The sheet is sRGB, whatever display the look is made for.
    let to_srgb = look.spaces().output_space.space().to_about(&RgbSpace::SRGB, Chromaticity::D65)?;
    let columns = EXPOSURES.len() as u32;
    let (width, height) = (columns * (TILE.0 + GAP) + GAP, 2 * (TILE.1 + CAPTION) + GAP);
    let mut sheet = RgbImage::from_pixel(width, height, BACKGROUND);
    for (column, stops) in (0..columns).zip(EXPOSURES) {
        let left = GAP + column * (TILE.0 + GAP);
        let exposed: Vec<[f32; 3]> = scene.iter().map(|rgb| rgb.map(|v| v * stops.exp2())).collect();
        let clipped = exposed.iter().map(|rgb| rgb.map(srgb_coded));
        let mut developed: Vec<[f32; 3]> = exposed.iter().map(|rgb| multiply(&to_input, *rgb)).collect();
        look.map_in_place(&mut developed);
        for rgb in &mut developed {
            let linear = look.coding().decode_rgb(rgb.map(f64::from));
            *rgb = multiply(&to_srgb, linear.map(|v| v as f32)).map(srgb_coded);
        }
        caption(&mut sheet, (left, 8), DOT, &format!("scene, clipped, {stops:+} EV"));
        paste(&mut sheet, (left, CAPTION), TILE.0, clipped);
        caption(&mut sheet, (left, CAPTION + TILE.1 + 8), DOT, &format!("{}, {stops:+} EV", look.name()));
        paste(&mut sheet, (left, 2 * CAPTION + TILE.1), TILE.0, developed);
    }
    let mut png = Vec::new();
    sheet.write_to(&mut Cursor::new(&mut png), ImageFormat::Png)?;
    Ok(png)
}

/// What the look does to greys, hues and colours, as PNG.
pub(crate) fn chart(look: &Baked) -> Result<Vec<u8>> {
    let chart = Chart::of(look)?;
    let [width, height] = chart.size().map(|v| v as u32);
    let mut sheet = RgbImage::from_fn(width, height, |x, y| Rgb(chart.pixels()[(y * width + x) as usize]));
    for ([x, y], text) in chart.labels() {
        caption(&mut sheet, (*x as u32, *y as u32), (1, 2), text);
    }
    let mut png = Vec::new();
    sheet.write_to(&mut Cursor::new(&mut png), ImageFormat::Png)?;
    Ok(png)
}

fn srgb_coded(linear: f32) -> f32 {
    TransferCurve::Srgb.encode(f64::from(linear)) as f32
}

fn multiply(matrix: &Matrix3<f64>, rgb: [f32; 3]) -> [f32; 3] {
    <[f64; 3]>::from(matrix * Vector3::from(rgb.map(f64::from))).map(|v| v as f32)
}
