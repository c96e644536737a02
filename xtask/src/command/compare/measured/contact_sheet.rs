//! Contact sheets as PNG: tiles with captions, and difference pictures.

use std::io::Cursor;

use anyhow::Result;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{Rgb, RgbImage};
use onelight::TransferCurve;

use super::frame::WIDTH;
use crate::sheet::{BACKGROUND, caption, paste};

/// Space around the tiles, the height of a line of captions, and the dots of its letters, in pixels.
const GAP: u32 = 10;
const LINE: u32 = 20;
const DOT: (u32, u32) = (1, 2);
const TITLE_DOT: (u32, u32) = (2, 2);
/// Width of a tile, and how many letters go on it.
const TILE: u32 = WIDTH as u32;
const LETTERS: usize = WIDTH / 8;

/// A picture on a sheet, or the sentence that says why there is none.
pub(super) struct Tile {
    pub(super) captions: [String; 2],
    pub(super) width: u32,
    pub(super) height: u32,
    /// Display-coded sRGB, or the sentence that stands in the picture's place.
    pub(super) picture: Result<Vec<[f32; 3]>, String>,
}

/// Display-linear sRGB to display-coded.
pub(super) fn coded(linear: &[[f32; 3]]) -> Vec<[f32; 3]> {
    linear.iter().map(|rgb| rgb.map(|v| TransferCurve::Srgb.encode(f64::from(v)) as f32)).collect()
}

/// Tiles row by row under a title.
pub(super) fn sheet(title: &str, columns: usize, tiles: &[Tile]) -> Result<Vec<u8>> {
    let columns = columns.clamp(1, tiles.len().max(1)) as u32;
    let tall = tiles.iter().map(|tile| tile.height).max().unwrap_or_default();
    let (pitch, top) = ((TILE + GAP, tall + 2 * LINE + GAP), 2 * LINE);
    let rows = (tiles.len() as u32).div_ceil(columns);
    let mut sheet = RgbImage::from_pixel(columns * pitch.0 + GAP, top + rows * pitch.1, BACKGROUND);
    let room = (sheet.width().saturating_sub(2 * GAP)) as usize;
    let dot = if 16 * title.len() <= room { TITLE_DOT } else { DOT };
    caption(&mut sheet, (GAP, GAP), dot, title);
    for (i, tile) in (0..).zip(tiles) {
        let (left, top) = (GAP + i % columns * pitch.0, top + i / columns * pitch.1);
        for (line, text) in (0..).zip(&tile.captions) {
            caption(&mut sheet, (left, top + line * LINE), DOT, text);
        }
        match &tile.picture {
            Ok(pixels) => paste(&mut sheet, (left, top + 2 * LINE), tile.width, pixels.iter().copied()),
            Err(sentence) => {
                for (line, text) in (2..).zip(wrapped(sentence)) {
                    caption(&mut sheet, (left, top + line * LINE), DOT, &text);
                }
            }
        }
    }
    png(&sheet)
}

/// Lines no longer than a tile is wide.
fn wrapped(sentence: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in sentence.split_whitespace() {
        let line = lines.last().map_or(0, String::len);
        if line > 0 && line + 1 + word.len() > LETTERS {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            let between = if line.is_empty() { "" } else { " " };
            *line = format!("{line}{between}{word}");
        }
    }
    lines
}

/// Differences as colours: 0 black, 5 red, 10 yellow, 20 and more white.
pub(super) fn differences(width: u32, differences: &[f32]) -> Result<Vec<u8>> {
    let level = |d: f32, from: f32, to: f32| (255.0 * ((d - from) / (to - from)).clamp(0.0, 1.0)) as u8;
    let colour = |d: f32| Rgb([level(d, 0.0, 5.0), level(d, 5.0, 10.0), level(d, 10.0, 20.0)]);
    let height = (differences.len() as u32).checked_div(width).unwrap_or_default();
    let at = |x: u32, y: u32| differences.get((y * width + x) as usize).copied().unwrap_or_default();
    png(&RgbImage::from_fn(width, height, |x, y| colour(at(x, y))))
}

fn png(picture: &RgbImage) -> Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_with_encoder(PngEncoder::new_with_quality(
        &mut bytes,
        CompressionType::Default,
        FilterType::Adaptive,
    ))?;
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sentences_are_broken_between_words() {
        let lines = wrapped("kodak-5207 on kodak-2383: the aim needs printer lights of -55.873, 163.586, 98.984");
        assert!(lines.len() == 3 && lines.iter().all(|line| line.len() <= LETTERS), "{lines:?}");
        assert_eq!(wrapped(""), [""]);
    }

    #[test]
    fn a_sheet_holds_its_tiles() {
        let tile = |picture| Tile { captions: ["a".into(), String::new()], width: 3, height: 2, picture };
        let tiles = [tile(Ok(vec![[1.0; 3]; 6])), tile(Err("no light".to_owned())), tile(Ok(vec![[0.5; 3]; 6]))];
        let bytes = sheet("title", 2, &tiles).unwrap();
        let sheet = image::load_from_memory(&bytes).unwrap().to_rgb8();
        assert_eq!(sheet.dimensions(), (2 * 298 + 10, 40 + 2 * 52));
        assert_eq!(sheet.get_pixel(10, 80).0, [255; 3]);
        assert_eq!(sheet.get_pixel(10, 80 + 52).0, [128; 3]);
        let map = image::load_from_memory(&differences(2, &[0.0, 5.0, 10.0, 99.0]).unwrap()).unwrap().to_rgb8();
        let expected = [[0, 0, 0], [255, 0, 0], [255, 255, 0], [255, 255, 255]];
        assert!(map.pixels().zip(expected).all(|(pixel, rgb)| pixel.0 == rgb));
    }
}
