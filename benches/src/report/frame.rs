//! The picture that all forms are timed on.

use onelight::lut::{Channels, Pixels, SplitMix64};
use rayon::prelude::*;

use crate::error::{Error, Result};

/// Side by side and on top of each other, each pixel of the rendered scene becomes so many.
const ENLARGED: usize = 4;
/// Largest relative change of a channel by grain: as in a camera's picture, neighbours are never quite alike.
const GRAIN: f32 = 0.04;

/// The fixture scene, enlarged bilinearly, with grain; scene-linear RGB in `f32`.
pub(super) struct Frame {
    size: [usize; 2],
    samples: Vec<f32>,
}

impl Frame {
    /// A frame of four times `rendered` pixels along each side.
    pub(super) fn new(rendered: (usize, usize)) -> Result<Self> {
        if rendered.0 == 0 || rendered.1 == 0 {
            return Err(Error::new("the frame to time on has no pixels, expected at least one"));
        }
        let scene = onelight_fixtures::scene_rgb(rendered)?;
        let size = [rendered.0 * ENLARGED, rendered.1 * ENLARGED];
        let mut samples = vec![0.0; size[0] * size[1] * 3];
        samples.par_chunks_mut(size[0] * 3).enumerate().for_each(|(y, row)| {
            for (x, pixel) in row.chunks_exact_mut(3).enumerate() {
                let colour = between(&scene, rendered, x, y);
                for (c, to) in pixel.iter_mut().enumerate() {
                    *to = colour[c] * (1.0 + GRAIN * noise(3 * (x + y * size[0]) + c));
                }
            }
        });
        Ok(Self { size, samples })
    }

    /// Width and height in pixels.
    pub(super) fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Rows spread evenly over the frame, every `every`-th from row `first` on.
    pub(super) fn rows(&self, first: usize, every: usize) -> Result<Pixels<'_, f32>> {
        let [width, height] = self.size;
        let first = first % every;
        let rows = (height - first).div_ceil(every);
        let row = width * 3;
        Ok(Pixels::with_stride(&self.samples[first * row..], Channels::Rgb, [width, rows], every * row)?)
    }

    /// The samples of one row.
    pub(super) fn row(&self, y: usize) -> &[f32] {
        let row = self.size[0] * 3;
        let y = y % self.size[1];
        &self.samples[y * row..(y + 1) * row]
    }

    /// Rows that follow each other, `count` of them at most, from a row that leaves room for them.
    pub(super) fn strip(&self, first: usize, count: usize) -> Result<Pixels<'_, f32>> {
        let [width, height] = self.size;
        let count = count.min(height);
        let first = first % (height - count + 1);
        Ok(Pixels::new(&self.samples[first * width * 3..], Channels::Rgb, [width, count])?)
    }
}

/// A pixel of the enlarged scene.
fn between(scene: &[[f32; 3]], (width, height): (usize, usize), x: usize, y: usize) -> [f32; 3] {
    let place = |i: usize, size: usize| {
        let at = (i as f32 / ENLARGED as f32).min((size - 1) as f32);
        (at as usize, (at as usize + 1).min(size - 1), at.fract())
    };
    let ((x0, x1, s), (y0, y1, t)) = (place(x, width), place(y, height));
    let pixel = |x: usize, y: usize| scene[x + y * width];
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    std::array::from_fn(|c| {
        let [above, below] = [y0, y1].map(|y| mix(pixel(x0, y)[c], pixel(x1, y)[c], s));
        mix(above, below, t)
    })
}

/// -1 to 1, the same on every machine: the finaliser of SplitMix64 \[Steele2014\].
fn noise(index: usize) -> f32 {
    let mixed = SplitMix64::mix((index as u64).wrapping_mul(SplitMix64::STEP));
    (mixed >> 40) as f32 / (1 << 23) as f32 - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_those_of_the_frame() {
        let frame = Frame::new((8, 5)).unwrap();
        assert_eq!(frame.size(), [32, 20]);
        let all: usize = (0..7).map(|first| frame.rows(first, 7).unwrap().size()[1]).sum();
        assert_eq!(all, 20, "seven sets of rows are the frame");
        assert_eq!(frame.rows(9, 7).unwrap().size(), [32, 3]);
        assert_eq!(frame.strip(18, 4).unwrap().size(), [32, 4]);
        assert_eq!(frame.strip(0, 99).unwrap().size(), [32, 20]);
        assert!((0..20).all(|y| frame.row(y).iter().all(|v| *v >= 0.0 && v.is_finite())));
        assert!(frame.row(3) != frame.row(4));
    }
}
