//! Rounding to 8 bits so that a slow change of colour shows no bands.

/// How values are rounded to 8 bits.
///
/// ```
/// use onelight_picture::{Dither, PngSettings};
///
/// let smooth = PngSettings { dither: Dither::Pattern, ..PngSettings::default() };
/// # assert_ne!(smooth, PngSettings::default());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Dither {
    /// To the nearest code: a slow ramp has steps that an eye can see.
    #[default]
    None,
    /// Up or down by a fixed pattern of 16 x 16 pixels (\[Bayer1973\]), the same for red, green and blue: over any 16 x 16
    /// pixels the mean is kept to a 1/512 of a code, what is a code already stays as it is, and the result depends on the
    /// value and its place alone. Alpha is rounded to the nearest code.
    Pattern,
}

/// Side of the pattern, in pixels.
const SIDE: usize = 16;

impl Dither {
    /// What is added to a value in codes at a place before it is cut off: each of 256 steps in the middle of which it
    /// lies comes once in the pattern.
    pub(crate) fn threshold(x: usize, y: usize) -> f32 {
        const PATTERN: [[f32; SIDE]; SIDE] = pattern();
        PATTERN[y % SIDE][x % SIDE]
    }
}

/// The matrix of ordered dither: the bits of `x ^ y` and of `y`, interleaved, the lowest becoming the highest.
const fn pattern() -> [[f32; SIDE]; SIDE] {
    let mut pattern = [[0.0; SIDE]; SIDE];
    let mut place = 0;
    while place < SIDE * SIDE {
        let (x, y) = (place % SIDE, place / SIDE);
        let (mut rank, mut bit) = (0, 0);
        while bit < 4 {
            rank = rank << 2 | ((x ^ y) >> bit & 1) << 1 | (y >> bit & 1);
            bit += 1;
        }
        pattern[y][x] = (rank as f32 + 0.5) / (SIDE * SIDE) as f32;
        place += 1;
    }
    pattern
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_threshold_comes_once_in_any_16_by_16_pixels() {
        for (left, top) in [(0, 0), (3, 7), (1000, 16)] {
            let mut ranks: Vec<u32> =
                (0..256).map(|place| (Dither::threshold(left + place % 16, top + place / 16) * 256.0) as u32).collect();
            ranks.sort_unstable();
            assert!(ranks.into_iter().eq(0..256));
        }
    }
}
