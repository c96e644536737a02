//! Pictures and captions on a sheet.

use font8x8::UnicodeFonts;
use image::{Rgb, RgbImage};

/// What lies around the pictures of a sheet.
pub const BACKGROUND: Rgb<u8> = Rgb([24, 24, 24]);
const INK: Rgb<u8> = Rgb([200, 200, 200]);

/// Puts display-coded pixels on a sheet, row by row, `width` of them in each; what lies outside the sheet is left out.
///
/// ```
/// use image::RgbImage;
/// use onelight_charts::{BACKGROUND, paste};
/// let mut sheet = RgbImage::from_pixel(4, 4, BACKGROUND);
/// paste(&mut sheet, (3, 0), 2, [[1.0; 3]; 4]);
/// assert_eq!((sheet.get_pixel(3, 1).0, sheet.get_pixel(2, 1)), ([255; 3], &BACKGROUND));
/// ```
pub fn paste(sheet: &mut RgbImage, (left, top): (u32, u32), width: u32, pixels: impl IntoIterator<Item = [f32; 3]>) {
    for (i, rgb) in (0..).zip(pixels) {
        let at = (left + i % width, top + i / width);
        if at.0 < sheet.width() && at.1 < sheet.height() {
            sheet.put_pixel(at.0, at.1, Rgb(rgb.map(|v| (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8)));
        }
    }
}

/// Writes a line of letters, each 8x8 dots of `dot` pixels; what lies outside the sheet is left out.
///
/// ```
/// use image::RgbImage;
/// use onelight_charts::{BACKGROUND, caption};
/// let mut sheet = RgbImage::from_pixel(16, 8, BACKGROUND);
/// caption(&mut sheet, (0, 0), (1, 1), "ok");
/// assert!(sheet.pixels().any(|pixel| *pixel != BACKGROUND));
/// ```
pub fn caption(sheet: &mut RgbImage, (left, top): (u32, u32), dot: (u32, u32), text: &str) {
    for (column, letter) in (0u32..).zip(text.chars()) {
        let rows = font8x8::BASIC_FONTS.get(letter).unwrap_or_default();
        for (y, row) in (0u32..).zip(rows) {
            for x in (0..8u32).filter(|x| row >> x & 1 == 1) {
                for (dx, dy) in (0..dot.1).flat_map(|dy| (0..dot.0).map(move |dx| (dx, dy))) {
                    let at = (left + (column * 8 + x) * dot.0 + dx, top + y * dot.1 + dy);
                    if at.0 < sheet.width() && at.1 < sheet.height() {
                        sheet.put_pixel(at.0, at.1, INK);
                    }
                }
            }
        }
    }
}
