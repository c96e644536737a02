//! Reading PNG of 1 to 16 bits: grey, palette and RGB, with and without alpha.

use std::io::{BufRead, Seek};

use anyhow::{Result, anyhow, bail};
use png::{BitDepth, ColorType, Decoder, DecodingError, Reader, Transformations};
use rayon::prelude::*;

use super::{
    Band, Bands, Channels, Description, Limits, RowMut, Source,
    band::{Holds, blocks_in_band},
    guard::{guarded, told},
    limits::{allocate, check_claim},
};

/// Most bytes the decoder may take beside the picture itself, for rows and ancillary chunks.
const WORKING_BYTES: usize = 1 << 26;

/// More than Deflate can give for one byte.
const EXPANSION: u64 = 1100;

/// Opens a picture in a PNG file of `length` bytes.
pub(super) fn open<'a, R: BufRead + Seek + Send + 'a>(
    reader: R,
    length: u64,
    limits: &Limits,
) -> Result<(Description, Box<dyn Bands + 'a>)> {
    guarded(|| start(reader, length, limits))?
}

fn start<'a, R: BufRead + Seek + Send + 'a>(
    reader: R,
    length: u64,
    limits: &Limits,
) -> Result<(Description, Box<dyn Bands + 'a>)> {
    let mut decoder = Decoder::new_with_limits(reader, png::Limits { bytes: WORKING_BYTES });
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let info = decoder.read_header_info().map_err(|error| sentence(&error))?;
    let (width, height) = (u64::from(info.width), u64::from(info.height));
    limits.check_size("the picture", width, height)?;
    let bits = info.bits_per_pixel() as u64;
    check_claim(width, height, (width * bits).div_ceil(8) * height, length, EXPANSION)?;

    let reader = decoder.read_info().map_err(|error| sentence(&error))?;
    let (colour, depth) = reader.output_color_type();
    let (samples, channels) = match colour {
        ColorType::Grayscale => (1, Channels::Rgb),
        ColorType::GrayscaleAlpha => (2, Channels::Rgba),
        ColorType::Rgb => (3, Channels::Rgb),
        ColorType::Rgba => (4, Channels::Rgba),
        ColorType::Indexed => bail!("the PNG's palette is missing"),
    };
    let bits = if depth == BitDepth::Sixteen { 16 } else { 8 };
    let row_bytes = reader.output_line_size(reader.info().width).ok_or_else(|| anyhow!("the PNG is too large"))?;
    let interlaced = reader.info().interlaced;
    if interlaced {
        limits.check_bytes("an interlaced PNG", [width, height], (row_bytes as u64).saturating_mul(height))?;
    }
    let description = Description::plain(width as usize, height as usize, channels, Source::Png { bits });
    let (width, height) = (width as usize, height as usize);
    let rows =
        PngBands { reader, width, height, channels, samples, bits, row_bytes, interlaced, bytes: Vec::new(), next: 0 };
    Ok((description, Box::new(rows)))
}

/// The rows of a PNG. An interlaced one has no row before it has them all, so its samples are held whole.
struct PngBands<R: BufRead + Seek> {
    reader: Reader<R>,
    width: usize,
    height: usize,
    channels: Channels,
    /// Samples of a pixel.
    samples: usize,
    bits: u8,
    row_bytes: usize,
    interlaced: bool,
    /// Samples of the band, or of the picture where it is interlaced.
    bytes: Vec<u8>,
    next: usize,
}

impl<R: BufRead + Seek + Send> Bands for PngBands<R> {
    fn next_into(&mut self, band: &mut Band) -> Result<()> {
        let rows = blocks_in_band(self.width, 1).min(self.height - self.next);
        band.become_rows(self.next, rows, self.width, self.channels)?;
        if rows > 0 {
            guarded(|| self.read(rows))??;
            let first = if self.interlaced { self.next * self.row_bytes } else { 0 };
            let bytes = &self.bytes[first..first + rows * self.row_bytes];
            let (samples, bits) = (self.samples, self.bits);
            band.rows_mut().zip(bytes.par_chunks_exact(self.row_bytes)).for_each(|(mut row, bytes)| match bits {
                8 => fill(&mut row, bytes, samples, |[byte]: [u8; 1]| f32::from(byte) / 255.0),
                _ => fill(&mut row, bytes, samples, |word| f32::from(u16::from_be_bytes(word)) / 65_535.0),
            });
        }
        self.next += rows;
        Ok(())
    }

    fn holds(&self) -> Holds {
        let rows = blocks_in_band(self.width, 1).min(self.height);
        let held = if self.interlaced { self.height } else { rows };
        Holds { band_pixels: self.width as u64 * rows as u64, bytes_beside: self.row_bytes as u64 * held as u64 }
    }
}

impl<R: BufRead + Seek> PngBands<R> {
    /// Makes the samples of the next rows lie in `bytes`.
    fn read(&mut self, rows: usize) -> Result<()> {
        if self.interlaced {
            if self.next == 0 {
                let size = self.reader.output_buffer_size().ok_or_else(|| anyhow!("the PNG is too large"))?;
                self.bytes = allocate(size, 0)?;
                self.reader.next_frame(&mut self.bytes).map_err(|error| sentence(&error))?;
            }
            return Ok(());
        }
        if self.bytes.is_empty() {
            self.bytes = allocate(rows * self.row_bytes, 0)?;
        }
        for row in self.bytes.chunks_exact_mut(self.row_bytes).take(rows) {
            if self.reader.read_row(row).map_err(|error| sentence(&error))?.is_none() {
                bail!("the PNG has fewer rows than its header says");
            }
        }
        if self.next + rows == self.height {
            // Goes past the last row, where damage may still show.
            self.reader.read_row(&mut []).map_err(|error| sentence(&error))?;
        }
        Ok(())
    }
}

/// Colours and coverage of a row from samples of `N` bytes.
fn fill<const N: usize>(row: &mut RowMut<'_>, bytes: &[u8], step: usize, value: impl Fn([u8; N]) -> f32) {
    let (samples, _) = bytes.as_chunks::<N>();
    let [green, blue] = if step < 3 { [0, 0] } else { [1, 2] };
    let pixels = || samples.chunks_exact(step);
    for (colour, pixel) in row.rgb.iter_mut().zip(pixels()) {
        *colour = [value(pixel[0]), value(pixel[green]), value(pixel[blue])];
    }
    if let Some(alpha) = &mut row.alpha {
        alpha.iter_mut().zip(pixels()).for_each(|(alpha, pixel)| *alpha = value(pixel[step - 1]));
    }
}

fn sentence(error: &DecodingError) -> anyhow::Error {
    match error {
        DecodingError::IoError(error) => super::cannot_read(error),
        DecodingError::LimitsExceeded => {
            anyhow!("the PNG's chunks need more than {} MiB", WORKING_BYTES >> 20)
        }
        other => {
            // The crate prints the innards of its chunk type.
            let text = other.to_string();
            let detail = text.split("ChunkType").next().unwrap_or_default().trim_end_matches([':', ' ', '.']);
            let detail = detail.trim_end_matches(" while decoding");
            if detail.is_empty() {
                anyhow!("the PNG is damaged")
            } else {
                anyhow!("the PNG is damaged: {}", told(detail))
            }
        }
    }
}
