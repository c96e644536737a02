//! A picture made smaller while its bands go by.

use half::f16;
use onelight_picture::Band;

use crate::film_look::SAMPLES;

/// The mean of light over squares of pixels.
#[derive(Debug, Clone)]
pub(crate) struct Shrink {
    /// Pixels of a side of a square.
    factor: usize,
    size: [usize; 2],
    /// Sums of red, green, blue and alpha, and how many pixels they are of.
    sums: Vec<[f32; SAMPLES]>,
    counts: Vec<u32>,
}

impl Shrink {
    /// By the least whole factor with which a picture has at most so many pixels.
    pub(crate) fn to([width, height]: [usize; 2], pixels: usize) -> Self {
        let mut factor = 1;
        while width.div_ceil(factor) * height.div_ceil(factor) > pixels.max(1) {
            factor += 1;
        }
        let size = [width.div_ceil(factor), height.div_ceil(factor)];
        let count = size[0] * size[1];
        Self { factor, size, sums: vec![[0.0; SAMPLES]; count], counts: vec![0; count] }
    }

    /// Pixels across and down.
    pub(crate) fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Adds the pixels of a band; what is not finite counts as the film counts it, so that one such pixel does not take others along.
    pub(crate) fn add(&mut self, band: &Band) {
        let [width, _] = self.size;
        let rows = band.rgb().chunks(band.width().max(1)).enumerate();
        for (y, row) in rows {
            let to = (band.top() + y) / self.factor * width;
            for (x, rgb) in row.iter().enumerate() {
                let alpha = band.alpha().map_or(1.0, |alpha| alpha[y * band.width() + x]);
                let (Some(sum), Some(count)) =
                    (self.sums.get_mut(to + x / self.factor), self.counts.get_mut(to + x / self.factor))
                else {
                    continue;
                };
                for (sum, value) in sum.iter_mut().zip(rgb.iter().chain([&alpha])) {
                    *sum += if value.is_nan() { 0.0 } else { value.clamp(-MOST, MOST) };
                }
                *count += 1;
            }
        }
    }

    /// The means as half floats.
    pub(crate) fn pixels(&self) -> Vec<u16> {
        let means = self.sums.iter().zip(&self.counts).flat_map(|(sum, count)| {
            let count = (*count).max(1) as f32;
            sum.map(|v| half(v / count))
        });
        means.collect()
    }
}

/// To half floats: what is beyond them is their end, and NaN 0, as films take them.
pub(crate) fn half(value: f32) -> u16 {
    let largest = f16::MAX.to_f32();
    f16::from_f32(if value.is_nan() { 0.0 } else { value.clamp(-largest, largest) }).to_bits()
}

/// The largest half float.
const MOST: f32 = 65504.0;

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use onelight_picture::{Limits, Picture, Source, open};

    use super::*;

    #[test]
    fn squares_are_their_means_also_at_the_edges() {
        let rgb = (0..15).map(|i| [i as f32, if i == 0 { f32::NAN } else { 1.0 }, -1.0]).collect();
        let mut file = Cursor::new(Vec::new());
        Picture::opaque(5, 3, rgb, Source::Exr).write_exr(&mut file, &[]).unwrap();
        let mut picture = open(file, "five.exr", Limits::default()).unwrap();
        let mut small = Shrink::to([5, 3], 6);
        assert_eq!(small.size(), [3, 2]);
        while let Some(band) = picture.next_band().unwrap() {
            small.add(band);
        }
        let red: Vec<f32> = small.pixels().chunks(4).map(|pixel| f16::from_bits(pixel[0]).to_f32()).collect();
        assert_eq!(red, [3.0, 5.0, 6.5, 10.5, 12.5, 14.0]);
        let first: Vec<f32> = small.pixels()[1..4].iter().map(|v| f16::from_bits(*v).to_f32()).collect();
        assert_eq!(first, [0.75, -1.0, 1.0]);
    }
}
