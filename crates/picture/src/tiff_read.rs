//! Reading TIFF: grey and RGB, with and without alpha, of 8, 16 or 32 bits or floating point.

use std::io::{ErrorKind, Seek, SeekFrom};

use rayon::prelude::*;
use tiff::{
    ColorType, TiffError,
    decoder::{ChunkType, Decoder, DecodingResult},
    tags::{SampleFormat, Tag},
};

use crate::{
    alpha,
    band::{BAND_PIXELS, Band, Bands, ReadingMemory, RowMut, blocks_in_band},
    decoder_message::one_line,
    description::{Channels, Description, Source, TiffSamples},
    error::{Error, TiffProblem},
    input::Input,
    limits::{Limits, check_claim},
    panic_to_error::panic_to_error,
    tiff_tags,
};

/// More than Deflate, LZW or PackBits can give for one byte.
const EXPANSION: u64 = 2048;

/// Samples that one task widens: for fewer, handing them to a thread takes longer than the work.
const SAMPLES_TOGETHER: usize = 1 << 14;

/// Opens the first picture in a TIFF file of `length` bytes.
pub(crate) fn open<'a>(
    reader: Input<'a>,
    length: u64,
    limits: &Limits,
) -> Result<(Description, Box<dyn Bands + 'a>), Error> {
    panic_to_error(|| start(reader, length, limits))?
}

fn start<'a>(mut reader: Input<'a>, length: u64, limits: &Limits) -> Result<(Description, Box<dyn Bands + 'a>), Error> {
    tiff_tags::check(&mut reader, length)?;
    reader.seek(SeekFrom::Start(0))?;
    let mut decoder = Decoder::new(reader).map_err(problem)?;
    let (width, height) = decoder.dimensions().map_err(problem)?;
    let (width, height) = (u64::from(width), u64::from(height));
    limits.check_size("the picture", width, height)?;

    let colour = decoder.colortype().map_err(problem)?;
    let samples = match colour {
        ColorType::Gray(_) => 1,
        ColorType::GrayA(_) | ColorType::Multiband { num_samples: 2, .. } => 2,
        ColorType::RGB(_) => 3,
        ColorType::RGBA(_) => 4,
        other => return Err(TiffProblem::Colours { found: one_line(&format!("{other:?}")) }.into()),
    };
    let bits = colour.bit_depth();
    if !matches!(bits, 8 | 16 | 32 | 64) {
        return Err(TiffProblem::Bits { found: bits }.into());
    }
    let layout = decoder.image_buffer_layout().map_err(problem)?;
    let kind = match (layout.sample_format, bits) {
        (SampleFormat::Uint, 8 | 16 | 32) => TiffSamples::Integer,
        (SampleFormat::IEEEFP, 16 | 32 | 64) => TiffSamples::Float,
        _ => return Err(TiffProblem::SampleFormat.into()),
    };
    if layout.planes > 1 && decoder.get_chunk_type() == ChunkType::Tile {
        return Err(TiffProblem::TiledPlanes.into());
    }
    if layout.planes != 1 && layout.planes != samples {
        return Err(TiffProblem::Planes { found: layout.planes, expected: samples }.into());
    }
    let claimed = width * height * samples as u64 * u64::from(bits / 8);
    let expansion = match decoder.find_tag_unsigned::<u16>(Tag::Compression).map_err(problem)? {
        None | Some(1) => 1, // uncompressed
        Some(_) => EXPANSION,
    };
    check_claim([width, height], claimed, length, expansion)?;

    let channels = if samples % 2 == 0 { Channels::Rgba } else { Channels::Rgb };
    let source = Source::Tiff { bits, samples: kind };
    let (width, height) = (width as usize, height as usize);
    let mut description = Description::new(width, height, channels, source);
    let mut coverage = Coverage::Straight;
    if channels == Channels::Rgba {
        let extra = decoder.find_tag_unsigned_vec::<u16>(Tag::ExtraSamples).map_err(problem)?;
        // 1: associated (premultiplied), 2: unassociated, 0: not said.
        match extra.as_deref().and_then(<[u16]>::first) {
            Some(1) => coverage = Coverage::Premultiplied,
            Some(2) => {}
            _ => description
                .notes
                .push("took the TIFF's extra channel, of which it says nothing, for straight alpha".to_owned()),
        }
    }
    if decoder.find_tag_unsigned::<u16>(Tag::Orientation).map_err(problem)?.is_some_and(|way| way > 1) {
        description.notes.push("left the TIFF's orientation as stored".to_owned());
    }

    let (chunk_width, chunk_height) = decoder.chunk_dimensions();
    let chunk = [chunk_width as usize, (chunk_height as usize).min(height)];
    if chunk.contains(&0) {
        return Err(TiffProblem::ChunkSize { found: [chunk_width, chunk_height] }.into());
    }
    let together = [width.next_multiple_of(chunk[0]) as u64, chunk[1] as u64];
    let bytes = (together[0].saturating_mul(together[1])).saturating_mul(samples as u64 * u64::from(bits / 8));
    limits.check_bytes("a strip or row of tiles", together, bytes)?;
    let most = usize::try_from(bytes).unwrap_or(usize::MAX).saturating_add(1 << 24);
    let mut allowed = tiff::decoder::Limits::default();
    allowed.decoding_buffer_size = most;
    allowed.intermediate_buffer_size = most;
    let decoder = decoder.with_limits(allowed);
    let bands = TiffBands {
        decoder,
        size: [width, height],
        chunk,
        samples,
        sample_bytes: u64::from(bits / 8),
        channels,
        planes: layout.planes,
        coverage,
        next: 0,
        begun: Vec::new(),
    };
    Ok((description, Box::new(bands)))
}

/// What an alpha channel has done to the colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Coverage {
    Straight,
    Premultiplied,
}

/// The strips of a TIFF, or its rows of tiles.
struct TiffBands<'a> {
    decoder: Decoder<Input<'a>>,
    size: [usize; 2],
    /// Width and height of a strip or tile.
    chunk: [usize; 2],
    /// Samples of a pixel in the file, 1 to 4.
    samples: usize,
    sample_bytes: u64,
    channels: Channels,
    /// 1 where a pixel's samples lie side by side, else one plane a sample.
    planes: usize,
    coverage: Coverage,
    /// The next row of pixels.
    next: usize,
    /// The row of strips or tiles that was begun.
    begun: Vec<(Part, DecodingResult)>,
}

impl Bands for TiffBands<'_> {
    fn next_into(&mut self, band: &mut Band) -> Result<(), Error> {
        let [width, height] = self.size;
        let together = self.chunk[1];
        // Whole rows of strips or tiles, or a part of one.
        let end = if self.is_tall() {
            (self.next + blocks_in_band(width, 1)).min((self.next / together + 1) * together)
        } else {
            self.next + blocks_in_band(width, together) * together
        };
        let rows = self.next..end.min(height);
        band.become_rows(rows.start, rows.len(), width, self.channels)?;
        for row in rows.start / together..rows.end.div_ceil(together) {
            if row * together >= rows.start {
                self.begin(row)?;
            }
            for (part, samples) in &self.begun {
                part.place(samples, band)?;
            }
        }
        if self.coverage == Coverage::Premultiplied {
            band.rows_mut().for_each(|row| {
                if let Some(alpha) = row.alpha {
                    alpha::straighten(row.rgb, alpha);
                }
            });
        }
        self.next = rows.end;
        Ok(())
    }

    fn memory(&self) -> ReadingMemory {
        let ([width, height], [across, down]) = (self.size, self.chunk);
        let rows = if self.is_tall() { blocks_in_band(width, 1) } else { blocks_in_band(width, down) * down };
        let pixels = |width: usize| (width as u64).saturating_mul(down as u64);
        // A row of strips or tiles unpacked, one of them packed.
        let bytes = pixels(width.next_multiple_of(across)).saturating_add(pixels(across));
        let bytes_beside = bytes.saturating_mul(self.samples as u64 * self.sample_bytes);
        ReadingMemory { band_pixels: width as u64 * rows.min(height) as u64, bytes_beside }
    }
}

impl TiffBands<'_> {
    /// Whether a row of strips or tiles is more than a band.
    fn is_tall(&self) -> bool {
        self.size[0].saturating_mul(self.chunk[1]) > BAND_PIXELS
    }

    /// Unpacks a row of strips or tiles.
    fn begin(&mut self, row: usize) -> Result<(), Error> {
        self.begun.clear();
        let across = self.size[0].div_ceil(self.chunk[0]);
        let down = self.size[1].div_ceil(self.chunk[1]);
        for plane in 0..self.planes {
            for column in 0..across {
                let index = u32::try_from(plane * across * down + row * across + column);
                let index = index.map_err(|_| TiffProblem::Chunks)?;
                let decoder = &mut self.decoder;
                let ((width, height), samples) =
                    panic_to_error(|| (decoder.chunk_data_dimensions(index), decoder.read_chunk(index)))?;
                let part = Part {
                    left: column * self.chunk[0],
                    top: row * self.chunk[1],
                    size: [width as usize, height as usize],
                    samples: self.samples,
                    plane: (self.planes > 1).then_some(plane),
                };
                self.begun.push((part, samples.map_err(problem)?));
            }
        }
        Ok(())
    }
}

/// Where the samples of a strip or tile go.
struct Part {
    left: usize,
    /// Its first row in the picture.
    top: usize,
    size: [usize; 2],
    /// Samples of a pixel, of all planes.
    samples: usize,
    /// The sample that the strip has where each has its own.
    plane: Option<usize>,
}

impl Part {
    fn place(&self, samples: &DecodingResult, band: &mut Band) -> Result<(), Error> {
        use DecodingResult::{F16, F32, F64, U8, U16, U32};
        match samples {
            U8(values) => self.put(values, band, |v| f32::from(v) / 255.0),
            U16(values) => self.put(values, band, |v| f32::from(v) / 65_535.0),
            U32(values) => self.put(values, band, |v| (f64::from(v) / f64::from(u32::MAX)) as f32),
            F16(values) => self.put(values, band, half::f16::to_f32),
            F32(values) => self.put(values, band, |v| v),
            F64(values) => self.put(values, band, |v| v as f32),
            _ => Err(TiffProblem::SampleFormat.into()),
        }
    }

    fn put<T: Copy + Sync>(
        &self,
        samples: &[T],
        band: &mut Band,
        value: impl Fn(T) -> f32 + Sync,
    ) -> Result<(), Error> {
        let [width, height] = self.size;
        let step = if self.plane.is_some() { 1 } else { self.samples };
        if samples.len() != width * height * step || self.left + width > band.width() {
            let (found, size) = (samples.len(), self.size);
            return Err(TiffProblem::SampleCount { found, size, channels: step }.into());
        }
        // The rows that both have.
        let rows = self.top.max(band.top())..(self.top + height).min(band.top() + band.rows());
        if samples.is_empty() || rows.is_empty() {
            return Ok(());
        }
        let samples = &samples[(rows.start - self.top) * width * step..(rows.end - self.top) * width * step];
        let rows = band.some_rows_mut(rows.start - band.top()..rows.end - band.top());
        let rows = rows.zip(samples.par_chunks_exact(width * step)).with_min_len(SAMPLES_TOGETHER / (width * step) + 1);
        rows.for_each(|(mut row, samples)| {
            for (channel, first) in (self.plane.unwrap_or(0)..self.samples).zip(0..step) {
                let values = samples[first..].iter().step_by(step).map(|sample| value(*sample));
                self.put_channel(&mut row, channel, values);
            }
        });
        Ok(())
    }

    /// Writes one channel of a row of the part.
    fn put_channel(&self, row: &mut RowMut<'_>, channel: usize, values: impl Iterator<Item = f32>) {
        let columns = self.left..self.left + self.size[0];
        let colours = &mut row.rgb[columns.clone()];
        match (&mut row.alpha, self.samples) {
            (Some(alpha), samples) if channel + 1 == samples => {
                alpha[columns].iter_mut().zip(values).for_each(|(alpha, value)| *alpha = value);
            }
            (_, 1 | 2) => colours.iter_mut().zip(values).for_each(|(colour, value)| *colour = [value; 3]),
            _ => colours.iter_mut().zip(values).for_each(|(colour, value)| colour[channel] = value),
        }
    }
}

fn problem(error: TiffError) -> Error {
    match error {
        // The unpackers, too, speak through this error.
        TiffError::IoError(error)
            if error.kind() == ErrorKind::InvalidData || error.kind() == ErrorKind::InvalidInput =>
        {
            TiffProblem::Damaged(one_line(&error.to_string())).into()
        }
        TiffError::IoError(error) => error.into(),
        TiffError::LimitsExceeded => TiffProblem::Memory.into(),
        other => TiffProblem::Unreadable(one_line(&other.to_string())).into(),
    }
}
