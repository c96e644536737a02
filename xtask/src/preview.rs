//! The fixture scene before and after a look, at several exposures, on one sheet.

use std::io::Cursor;

use anyhow::Result;
use font8x8::UnicodeFonts;
use image::{ImageFormat, Rgb, RgbImage};
use onelight::spectra::nalgebra::{Matrix3, Vector3};
use onelight::spectra::{Chromaticity, RgbSpace};
use onelight::{Process, TransferCurve};

use crate::compiled::Compiled;
use crate::truth;

/// Exposures shown, in stops.
const EXPOSURES: [f32; 3] = [-2.0, 0.0, 2.0];
const TILE: (u32, u32) = (640, 360);
/// Space around the tiles, and the height of a line of captions, in pixels.
const GAP: u32 = 12;
const CAPTION: u32 = 28;
const BACKGROUND: Rgb<u8> = Rgb([24, 24, 24]);
const INK: Rgb<u8> = Rgb([200, 200, 200]);

/// The sheet as PNG: the scene clipped to the display above, the look below.
pub(crate) fn sheet(process: &Process, look: &Compiled) -> Result<Vec<u8>> {
    let scene = truth::rgb((TILE.0 as usize, TILE.1 as usize))?;
    let to_input = RgbSpace::SRGB.to_about(&process.input_space.space(), Chromaticity::black_body_6500_k())?;
    // The sheet is sRGB, whatever display the look is made for.
    let to_srgb = process.output_space.space().to_about(&RgbSpace::SRGB, Chromaticity::D65)?;
    let columns = EXPOSURES.len() as u32;
    let (width, height) = (columns * (TILE.0 + GAP) + GAP, 2 * (TILE.1 + CAPTION) + GAP);
    let mut sheet = RgbImage::from_pixel(width, height, BACKGROUND);
    for (column, stops) in (0..columns).zip(EXPOSURES) {
        let left = GAP + column * (TILE.0 + GAP);
        let exposed: Vec<[f32; 3]> = scene.iter().map(|rgb| rgb.map(|v| v * stops.exp2())).collect();
        let clipped = exposed.iter().map(|rgb| rgb.map(srgb_coded)).collect();
        let mut developed: Vec<[f32; 3]> = exposed.iter().map(|rgb| multiply(&to_input, *rgb)).collect();
        look.apply_to_slice(&mut developed);
        for rgb in &mut developed {
            let linear = rgb.map(|v| process.output_coding.decode(f64::from(v)) as f32);
            *rgb = multiply(&to_srgb, linear).map(srgb_coded);
        }
        caption(&mut sheet, (left, 8), &format!("scene, clipped, {stops:+} EV"));
        paste(&mut sheet, (left, CAPTION), clipped);
        caption(&mut sheet, (left, CAPTION + TILE.1 + 8), &format!("{}, {stops:+} EV", process.name()));
        paste(&mut sheet, (left, 2 * CAPTION + TILE.1), developed);
    }
    let mut png = Vec::new();
    sheet.write_to(&mut Cursor::new(&mut png), ImageFormat::Png)?;
    Ok(png)
}

fn srgb_coded(linear: f32) -> f32 {
    TransferCurve::Srgb.encode(f64::from(linear)) as f32
}

fn multiply(matrix: &Matrix3<f64>, rgb: [f32; 3]) -> [f32; 3] {
    (matrix * Vector3::from(rgb.map(f64::from))).data.0[0].map(|v| v as f32)
}

fn paste(sheet: &mut RgbImage, (left, top): (u32, u32), pixels: Vec<[f32; 3]>) {
    for (i, rgb) in (0..).zip(pixels) {
        let code = rgb.map(|v| (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8);
        sheet.put_pixel(left + i % TILE.0, top + i / TILE.0, Rgb(code));
    }
}

fn caption(sheet: &mut RgbImage, (left, top): (u32, u32), text: &str) {
    /// Each dot of the 8x8 letters is this many pixels wide and high.
    const DOT: u32 = 2;
    for (column, letter) in (0u32..).zip(text.chars()) {
        let rows = font8x8::BASIC_FONTS.get(letter).unwrap_or_default();
        for (y, row) in (0u32..).zip(rows) {
            for x in (0..8u32).filter(|x| row >> x & 1 == 1) {
                for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                    let at = (left + (column * 8 + x) * DOT + dx, top + y * DOT + dy);
                    if at.0 < sheet.width() && at.1 < sheet.height() {
                        sheet.put_pixel(at.0, at.1, INK);
                    }
                }
            }
        }
    }
}
