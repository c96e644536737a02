//! OpenEXR pictures that keep luminance and two differences, these at a quarter of the pixels as a rule.
//!
//! R = (RY + 1) Y and B = (BY + 1) Y, and G is what luminance leaves: \[OpenEXR\], "Luminance/Chroma Images".

use exr::{
    block::{UncompressedBlock, chunk::Chunk},
    compression::Compression,
    math::Vec2,
    meta::{BlockDescription, MetaData, attribute::SampleType, header::Header},
};
use half::f16;
use rayon::prelude::*;

use crate::{
    alpha,
    band::{Band, Bands, ReadingMemory, RowMut, blocks_in_band},
    description::{Channels, Chromaticities},
    error::{Error, ExrProblem},
    exr_bands::{BATCH_BYTES, unpack},
    exr_blocks::Blocks,
    exr_layout::{Layout, Plane},
    limits::{Limits, grow},
};

/// The taps beside a pixel between two that have chroma, the nearest first: those of OpenEXR's own reader, which undo the filter
/// of its writer (`ImfRgbaYca`).
const TAPS: [f32; 7] = [0.627_123, -0.186_077, 0.087_929, -0.043_159, 0.019_597, -0.007_540, 0.002_128];

/// Refuses windows and samples that the differences do not fit, and pictures that are too large to be held.
pub(crate) fn check(header: &Header, layout: &Layout, step: usize, limits: &Limits) -> Result<(), Error> {
    let wrong = |what: &str| Err(ExrProblem::HeaderWrong(what.to_owned()).into());
    let (Vec2(width, height), Vec2(left, top)) = (header.layer_size, header.own_attributes.layer_position);
    let is_whole = |origin: i32, size: usize| i64::from(origin) % step as i64 == 0 && size.is_multiple_of(step);
    if !is_whole(left, width) || !is_whole(top, height) {
        return wrong("the data window does not begin and end where the chroma does");
    }
    if step > 1 && header.blocks != BlockDescription::ScanLines {
        return wrong("chroma is subsampled in tiles, expected rows");
    }
    // The decoder counts the samples of subsampled channels wrongly there.
    if step > 1 && matches!(header.compression, Compression::B44 | Compression::B44A) {
        let found = "B44 with subsampled chroma as".to_owned();
        return Err(ExrProblem::Compression { found }.into());
    }
    // Each difference has a quarter of the pixels, and the decoder wants a whole number of bytes for each pixel.
    if layout.rgb[0].samples != layout.rgb[2].samples {
        return wrong("RY and BY are of two kinds of numbers, expected one");
    }
    let bytes = held(header, layout, step);
    limits.check_bytes("a picture of luminance and chroma", [width as u64, height as u64], bytes)
}

/// Bytes of a picture that is held whole.
fn held(header: &Header, layout: &Layout, step: usize) -> u64 {
    let Vec2(width, height) = header.layer_size;
    let full = width as u64 * height as u64;
    let planes = if layout.alpha.is_some() { 2 } else { 1 };
    (full * planes).saturating_add(2 * full / (step * step) as u64).saturating_mul(4)
}

/// The pixels of a part of luminance and chroma.
pub(crate) struct LuminanceChromaBands<'a> {
    blocks: Blocks<'a>,
    meta: MetaData,
    layout: Layout,
    /// Pixels from one that has chroma to the next: 1 or 2.
    step: usize,
    /// What red, green and blue give to luminance.
    weights: [f32; 3],
    planes: Option<Planes>,
    next: usize,
}

/// All samples of a picture.
struct Planes {
    luminance: Vec<f32>,
    alpha: Vec<f32>,
    red: Vec<f32>,
    blue: Vec<f32>,
}

impl<'a> LuminanceChromaBands<'a> {
    /// From the first row on; a header that [`check`] let through.
    pub(crate) fn new(
        blocks: Blocks<'a>,
        meta: MetaData,
        layout: Layout,
        step: usize,
        primaries: Option<&Chromaticities>,
    ) -> Self {
        // Files that name no primaries are of these (\[OpenEXR\]).
        let weights = primaries.and_then(luminance).or_else(|| luminance(&Chromaticities::BT709));
        let weights = weights.unwrap_or([1.0 / 3.0; 3]).map(|v| v as f32);
        Self { blocks, meta, layout, step, weights, planes: None, next: 0 }
    }

    fn header(&self) -> &Header {
        &self.meta.headers[self.layout.part]
    }

    fn read(&mut self) -> Result<Planes, Error> {
        let Vec2(width, height) = self.header().layer_size;
        let step = self.step;
        let mut planes = Planes { luminance: Vec::new(), alpha: Vec::new(), red: Vec::new(), blue: Vec::new() };
        grow(&mut planes.luminance, width * height, 0.0)?;
        if self.layout.alpha.is_some() {
            grow(&mut planes.alpha, width * height, 0.0)?;
        }
        grow(&mut planes.red, (width / step) * (height / step), 0.0)?;
        grow(&mut planes.blue, (width / step) * (height / step), 0.0)?;

        let metas = [0, 1].map(|row| with_bytes_of_row(&self.meta, self.layout.part, row));
        let grid = self.blocks.grid();
        let batch = (BATCH_BYTES / grid.bytes(self.header()).max(1)).max(1);
        for blocks in self.blocks.of_rows(0..grid.count.1).chunks(batch) {
            let packed: Vec<(usize, Chunk)> = blocks
                .iter()
                .map(|&index| Ok((index / grid.count.0, self.blocks.packed(index, &self.meta)?)))
                .collect::<Result<_, Error>>()?;
            let unpacked: Vec<UncompressedBlock> = packed
                .into_par_iter()
                // Blocks of one row have chroma in every other one.
                .map(|(row, chunk)| unpack(chunk, &metas[row * grid.block.1 % 2]))
                .collect::<Result<_, Error>>()?;
            unpacked.iter().for_each(|block| self.place(block, &mut planes));
        }
        Ok(planes)
    }

    /// Puts the samples of a block where they belong.
    fn place(&self, block: &UncompressedBlock, planes: &mut Planes) {
        let (header, step) = (self.header(), self.step);
        let width = header.layer_size.0;
        let (Vec2(left, top), Vec2(across, down)) = (block.index.pixel_position, block.index.pixel_size);
        let [red, luminance, blue] = self.layout.rgb;
        let mut rest = &block.data[..];
        for y in top..top + down {
            for (index, channel) in header.channels.list.iter().enumerate() {
                let Vec2(x_step, y_step) = channel.sampling;
                if !y.is_multiple_of(y_step) {
                    continue;
                }
                let count = across / x_step;
                let (samples, after) = rest.split_at((count * channel.sample_type.bytes_per_sample()).min(rest.len()));
                rest = after;
                let is = |plane: Plane| plane.index == index;
                let full = y * width + left;
                let small = (y / step) * (width / step) + left / step;
                if is(luminance) {
                    widen(samples, channel.sample_type, &mut planes.luminance[full..full + count]);
                } else if is(red) {
                    widen(samples, channel.sample_type, &mut planes.red[small..small + count]);
                } else if is(blue) {
                    widen(samples, channel.sample_type, &mut planes.blue[small..small + count]);
                } else if self.layout.alpha.is_some_and(is) {
                    widen(samples, channel.sample_type, &mut planes.alpha[full..full + count]);
                }
            }
        }
    }
}

impl Bands for LuminanceChromaBands<'_> {
    fn next_into(&mut self, band: &mut Band) -> Result<(), Error> {
        let Vec2(width, height) = self.header().layer_size;
        let planes = match self.planes.take() {
            Some(planes) => planes,
            None => self.read()?,
        };
        let rows = blocks_in_band(width, 1).min(height - self.next);
        let channels = if self.layout.alpha.is_some() { Channels::Rgba } else { Channels::Rgb };
        band.become_rows(self.next, rows, width, channels)?;
        let (first, step, weights) = (self.next, self.step, self.weights);
        band.rows_mut().enumerate().for_each(|(row, to)| planes.row(first + row, [width, height], step, weights, to));
        self.planes = Some(planes);
        self.next += rows;
        Ok(())
    }

    fn memory(&self) -> ReadingMemory {
        let Vec2(width, height) = self.header().layer_size;
        let rows = blocks_in_band(width, 1).min(height);
        ReadingMemory {
            band_pixels: width as u64 * rows as u64,
            bytes_beside: held(self.header(), &self.layout, self.step) + 3 * BATCH_BYTES as u64,
        }
    }
}

impl Planes {
    /// One row of colours.
    fn row(&self, y: usize, [width, height]: [usize; 2], step: usize, weights: [f32; 3], mut to: RowMut<'_>) {
        let luminance = &self.luminance[y * width..(y + 1) * width];
        let (across, down) = (width / step, height / step);
        let of_row = |plane: &[f32]| -> Vec<f32> {
            (0..across).map(|x| between(y, step, down, |row| plane[row * across + x])).collect()
        };
        let (red, blue) = (of_row(&self.red), of_row(&self.blue));
        for (x, colour) in to.rgb.iter_mut().enumerate() {
            let [ry, by] = [&red, &blue].map(|row| between(x, step, across, |at| row[at]));
            *colour = rgb(luminance[x], ry, by, weights);
        }
        if let Some(alpha) = &mut to.alpha {
            alpha.copy_from_slice(&self.alpha[y * width..(y + 1) * width]);
            alpha::straighten(to.rgb, alpha);
        }
    }
}

/// A difference at a pixel, from those of `count` pixels that are `step` apart; beyond the ends the last counts.
fn between(pixel: usize, step: usize, count: usize, value: impl Fn(usize) -> f32) -> f32 {
    let before = pixel / step;
    if pixel.is_multiple_of(step) {
        return value(before);
    }
    let pairs = TAPS.iter().enumerate().map(|(away, tap)| {
        let (before, after) = (before.saturating_sub(away), (before + 1 + away).min(count - 1));
        tap * (value(before) + value(after))
    });
    pairs.sum()
}

/// A colour by its luminance and its differences; exactly grey where there are none.
fn rgb(luminance: f32, ry: f32, by: f32, [of_red, of_green, of_blue]: [f32; 3]) -> [f32; 3] {
    if ry == 0.0 && by == 0.0 {
        return [luminance; 3];
    }
    let (red, blue) = ((ry + 1.0) * luminance, (by + 1.0) * luminance);
    [red, (luminance - red * of_red - blue * of_blue) / of_green, blue]
}

/// What red, green and blue of a space give to the luminance of its white; `None` where there is no such space.
fn luminance(space: &Chromaticities) -> Option<[f64; 3]> {
    let point = |[x, y]: [f32; 2]| [f64::from(x), f64::from(y), 1.0 - f64::from(x) - f64::from(y)];
    let [red, green, blue, white] = [space.red, space.green, space.blue, space.white].map(point);
    let determinant = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    // Cramer's rule for the amounts of the primaries in white.
    let whole = determinant(red, green, blue) * white[1];
    let weights = [
        determinant(white, green, blue) * red[1] / whole,
        determinant(red, white, blue) * green[1] / whole,
        determinant(red, green, white) * blue[1] / whole,
    ];
    let makes_a_space = whole.abs() > 1e-9 && weights.iter().all(|v| v.is_finite()) && weights[1].abs() > 1e-6;
    makes_a_space.then_some(weights)
}

/// The headers with as many bytes a pixel as the blocks that begin in row `row` have: the decoder checks blocks by that number,
/// and counts channels as if all were of full size.
fn with_bytes_of_row(meta: &MetaData, part: usize, row: usize) -> MetaData {
    let mut meta = meta.clone();
    let header = &mut meta.headers[part];
    let single = header.max_block_pixel_size().1 == 1;
    let quarters = header.channels.list.iter().map(|channel| {
        let Vec2(x_step, y_step) = channel.sampling;
        let bytes = 4 * channel.sample_type.bytes_per_sample() / x_step;
        match single {
            true if row.is_multiple_of(y_step) => bytes,
            true => 0,
            false => bytes / y_step,
        }
    });
    header.channels.bytes_per_pixel = quarters.sum::<usize>() / 4;
    meta
}

/// Samples as floats, in the machine's order of bytes.
fn widen(samples: &[u8], kind: SampleType, to: &mut [f32]) {
    fn each<const N: usize>(samples: &[u8], to: &mut [f32], value: impl Fn([u8; N]) -> f32) {
        to.iter_mut().zip(samples.as_chunks::<N>().0).for_each(|(to, sample)| *to = value(*sample));
    }
    match kind {
        SampleType::F16 => each(samples, to, |word| f16::from_ne_bytes(word).to_f32()),
        SampleType::F32 => each(samples, to, f32::from_ne_bytes),
        SampleType::U32 => each(samples, to, |word| u32::from_ne_bytes(word) as f32),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The three decimals of BT.709, and of ACES2065-1 (its S-2008-001 has 0.343966, 0.728166, -0.072133).
    #[test]
    fn luminance_is_that_of_the_standards() {
        let near = |space: &Chromaticities, expected: [f64; 3]| {
            let found = luminance(space).unwrap();
            assert!((0..3).all(|i| (found[i] - expected[i]).abs() < 2e-4), "{found:?}");
        };
        near(&Chromaticities::BT709, [0.2126, 0.7152, 0.0722]);
        near(&Chromaticities::AP0, [0.343_966, 0.728_166, -0.072_133]);
        assert!(luminance(&Chromaticities { red: [0.3, 0.3], green: [0.3, 0.3], ..Chromaticities::BT709 }).is_none());
    }

    /// Between even samples the taps give a mean: what does not change stays, and a slope is followed.
    #[test]
    fn chroma_between_pixels_is_a_mean() {
        assert!((TAPS.iter().sum::<f32>() - 0.5).abs() < 2e-6);
        let ramp = |x: usize| between(x, 2, 40, |at| at as f32);
        assert!((20..60).all(|x| (ramp(x) - x as f32 / 2.0).abs() < 1e-4));
        assert!((0..80).all(|x| (between(x, 2, 40, |_| 0.3) - 0.3).abs() < 1e-6));
        assert_eq!(between(1, 2, 1, |_| 0.25), 0.25 * 2.0 * TAPS.iter().sum::<f32>());
    }

    #[test]
    fn no_difference_is_grey_and_luminance_is_kept() {
        let weights = luminance(&Chromaticities::BT709).unwrap().map(|v| v as f32);
        assert_eq!(rgb(0.37, 0.0, 0.0, weights), [0.37; 3]);
        let found = rgb(0.37, 0.4, -0.3, weights);
        let sum: f32 = (0..3).map(|i| found[i] * weights[i]).sum();
        assert!((sum - 0.37).abs() < 1e-6);
    }
}
