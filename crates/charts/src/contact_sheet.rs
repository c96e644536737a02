use std::io::Cursor;

use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{Rgb, RgbImage};

use crate::error::Error;
use crate::sheet::{BACKGROUND, caption, paste};

/// Space around the tiles, the height of a line of captions, and the dots of its letters, in pixels.
const GAP: u32 = 10;
const LINE: u32 = 20;
const DOT: (u32, u32) = (1, 2);
const TITLE_DOT: (u32, u32) = (2, 2);
/// The largest sheet: 768 MiB in memory.
const MAX_PIXELS: u64 = 1 << 28;
/// Width of the widest picture of a contact sheet, in pixels: wider ones run into their neighbours.
pub const TILE_WIDTH: usize = 288;
/// How many letters go on a tile.
const LETTERS: usize = TILE_WIDTH / 8;

/// A picture on a contact sheet, or the sentence that says why there is none; [`contact_sheet`] has an example.
#[derive(Debug, Clone, PartialEq)]
pub struct Tile {
    /// Two lines above it.
    pub captions: [String; 2],
    /// Width in pixels, at most [`TILE_WIDTH`].
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Display-coded sRGB row by row, or the sentence that stands in the picture's place.
    pub picture: Result<Vec<[f32; 3]>, String>,
}

/// Tiles row by row under a title, `columns` of them in a row, as PNG.
///
/// ```
/// use onelight_charts::{Tile, contact_sheet};
/// let tile = |picture| Tile { captions: ["grey".into(), String::new()], width: 2, height: 1, picture };
/// let png = contact_sheet("two greys", 2, &[tile(Ok(vec![[0.5; 3]; 2])), tile(Err("no light".into()))])?;
/// assert_eq!(&png[1..4], b"PNG");
/// # Ok::<(), onelight_charts::Error>(())
/// ```
///
/// # Errors
/// If the sheet would have more than 2^28 pixels.
pub fn contact_sheet(title: &str, columns: usize, tiles: &[Tile]) -> Result<Vec<u8>, Error> {
    let columns = columns.clamp(1, tiles.len().max(1)) as u32;
    let tall = tiles.iter().map(|tile| tile.height).max().unwrap_or_default();
    let rows = (tiles.len() as u32).div_ceil(columns);
    let (width, height) = (
        u64::from(columns) * (TILE_WIDTH as u64 + u64::from(GAP)) + u64::from(GAP),
        u64::from(2 * LINE) + u64::from(rows) * (u64::from(tall) + u64::from(2 * LINE + GAP)),
    );
    if width.saturating_mul(height) > MAX_PIXELS {
        return Err(Error(format!("a sheet of {width} x {height} pixels, expected at most 2^28")));
    }
    let (pitch, top) = ((TILE_WIDTH as u32 + GAP, tall + 2 * LINE + GAP), 2 * LINE);
    let mut sheet = RgbImage::from_pixel(width as u32, height as u32, BACKGROUND);
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

/// Differences row by row as colours, as PNG: 0 black, 5 red, 10 yellow, 20 and more white.
///
/// ```
/// let png = onelight_charts::difference_map(2, &[0.0, 5.0, 10.0, 99.0])?;
/// assert_eq!(&png[1..4], b"PNG");
/// # Ok::<(), onelight_charts::Error>(())
/// ```
///
/// # Errors
/// If PNG cannot hold the picture: one of no pixels.
pub fn difference_map(width: u32, differences: &[f32]) -> Result<Vec<u8>, Error> {
    let level = |d: f32, from: f32, to: f32| (255.0 * ((d - from) / (to - from)).clamp(0.0, 1.0)) as u8;
    let colour = |d: f32| Rgb([level(d, 0.0, 5.0), level(d, 5.0, 10.0), level(d, 10.0, 20.0)]);
    let height = (differences.len() as u32).checked_div(width).unwrap_or_default();
    let at = |x: u32, y: u32| differences.get((y * width + x) as usize).copied().unwrap_or_default();
    png(&RgbImage::from_fn(width, height, |x, y| colour(at(x, y))))
}

/// Mean, 95 % and largest of differences: what a caption says of two pictures; zeros for none.
///
/// ```
/// assert_eq!(onelight_charts::mean_p95_max(&[0.0, 1.0, 2.0]), [1.0, 1.0, 2.0]);
/// ```
#[must_use]
pub fn mean_p95_max(differences: &[f32]) -> [f64; 3] {
    let mut sorted = differences.to_vec();
    sorted.sort_by(f32::total_cmp);
    let at = |part: f64| sorted.get((part * (sorted.len() as f64 - 1.0)) as usize).copied().map_or(0.0, f64::from);
    let mean = differences.iter().copied().map(f64::from).sum::<f64>() / differences.len().max(1) as f64;
    [mean, at(0.95), at(1.0)]
}

fn png(picture: &RgbImage) -> Result<Vec<u8>, Error> {
    let mut bytes = Cursor::new(Vec::new());
    let encoder = PngEncoder::new_with_quality(&mut bytes, CompressionType::Default, FilterType::Adaptive);
    picture.write_with_encoder(encoder).map_err(|error| Error(format!("a sheet as PNG: {error}")))?;
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
        let bytes = contact_sheet("title", 2, &tiles).unwrap();
        let sheet = image::load_from_memory(&bytes).unwrap().to_rgb8();
        assert_eq!(sheet.dimensions(), (2 * 298 + 10, 40 + 2 * 52));
        assert_eq!(sheet.get_pixel(10, 80).0, [255; 3]);
        assert_eq!(sheet.get_pixel(10, 80 + 52).0, [128; 3]);
        let map = image::load_from_memory(&difference_map(2, &[0.0, 5.0, 10.0, 99.0]).unwrap()).unwrap().to_rgb8();
        let expected = [[0, 0, 0], [255, 0, 0], [255, 255, 0], [255, 255, 255]];
        assert!(map.pixels().zip(expected).all(|(pixel, rgb)| pixel.0 == rgb));
    }
}
