//! Reading PNG of 1 to 16 bits: grey, palette and RGB, with and without alpha.

use png::{BitDepth, ColorType, Decoder, DecodingError, Info, Reader, ScaledFloat, Transformations};
use rayon::prelude::*;

use crate::{
    band::{Band, Bands, ReadingMemory, RowMut, blocks_in_band},
    decoder_message::one_line,
    description::{Channels, Chromaticities, Description, Source},
    error::{Error, PngProblem},
    exif,
    file_colours::{FileColours, of_code_points},
    input::Input,
    limits::{Limits, PNG_WORKING_BYTES, allocate, check_claim},
    orientation::upright,
    panic_to_error::panic_to_error,
    transfer::Transfer,
};

/// More than Deflate can give for one byte.
const EXPANSION: u64 = 1100;

/// Opens a picture in a PNG file of `length` bytes.
pub(crate) fn open<'a>(
    reader: Input<'a>,
    length: u64,
    limits: &Limits,
) -> Result<(Description, Box<dyn Bands + 'a>), Error> {
    panic_to_error(|| start(reader, length, limits))?
}

fn start<'a>(reader: Input<'a>, length: u64, limits: &Limits) -> Result<(Description, Box<dyn Bands + 'a>), Error> {
    let mut decoder = Decoder::new_with_limits(reader, png::Limits { bytes: PNG_WORKING_BYTES });
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(cfg!(not(feature = "icc")));
    let info = decoder.read_header_info().map_err(problem)?;
    let (width, height) = (u64::from(info.width), u64::from(info.height));
    limits.check_size("the picture", width, height)?;
    let bits = info.bits_per_pixel() as u64;
    check_claim([width, height], (width * bits).div_ceil(8) * height, length, EXPANSION)?;

    let reader = decoder.read_info().map_err(problem)?;
    let (colour, depth) = reader.output_color_type();
    let (samples, channels) = match colour {
        ColorType::Grayscale => (1, Channels::Rgb),
        ColorType::GrayscaleAlpha => (2, Channels::Rgba),
        ColorType::Rgb => (3, Channels::Rgb),
        ColorType::Rgba => (4, Channels::Rgba),
        ColorType::Indexed => return Err(PngProblem::PaletteMissing.into()),
    };
    let bits = if depth == BitDepth::Sixteen { 16 } else { 8 };
    let row_bytes = reader.output_line_size(reader.info().width).ok_or(PngProblem::TooLarge)?;
    let interlaced = reader.info().interlaced;
    if interlaced {
        limits.check_bytes("an interlaced PNG", [width, height], (row_bytes as u64).saturating_mul(height))?;
    }
    let mut description = Description::new(width as usize, height as usize, channels, Source::Png { bits });
    let exif = reader.info().exif_metadata.as_ref().map(|block| exif::read(block)).unwrap_or_default();
    description.metadata.exif = exif.tags;
    if let Some(colours) = colours(reader.info(), &mut description.notes).or(exif.colours) {
        colours.describe(&mut description);
    }
    let (width, height) = (width as usize, height as usize);
    let rows =
        PngBands { reader, width, height, channels, samples, bits, row_bytes, interlaced, bytes: Vec::new(), next: 0 };
    upright(exif.orientation, description, Box::new(rows), limits)
}

/// What the chunks of a PNG say of its colours, the most telling first, as the PNG specification orders them.
fn colours(info: &Info<'_>, notes: &mut Vec<String>) -> Option<FileColours> {
    let said = |primaries, transfer, what: &str| {
        Some(FileColours { primaries, transfer, said_by: format!("the PNG's {what}") })
    };
    if let Some(points) = &info.coding_independent_code_points {
        let (primaries, transfer) = of_code_points(points.color_primaries, points.transfer_function);
        if !points.is_video_full_range_image {
            notes.push("took the PNG's values for full range, although its cICP says video range".to_owned());
        }
        if primaries.is_some() || transfer.is_some() {
            return said(primaries, transfer, "cICP");
        }
        notes.push(format!(
            "left out the PNG's cICP, of which the code points {} and {} are not known",
            points.color_primaries, points.transfer_function
        ));
    }
    #[cfg(feature = "icc")]
    if let Some(profile) = &info.icc_profile {
        match crate::icc::colours(profile) {
            Ok(colours) => return Some(colours),
            Err(note) => notes.push(note),
        }
    }
    if info.srgb.is_some() {
        return said(Some(Chromaticities::BT709), Some(Transfer::Srgb), "sRGB");
    }
    let primaries = info.chrm_chunk.map(|points| {
        let xy = |(x, y): (ScaledFloat, ScaledFloat)| [x.into_value(), y.into_value()];
        let (red, green, blue, white) = (xy(points.red), xy(points.green), xy(points.blue), xy(points.white));
        let found = Chromaticities { red, green, blue, white };
        [Chromaticities::BT709, Chromaticities::P3_D65, Chromaticities::BT2020, Chromaticities::ADOBE_RGB]
            .into_iter()
            .find(|named| named.is_near(&found))
            .unwrap_or(found)
    });
    let transfer = info.gama_chunk.map(ScaledFloat::into_scaled).filter(|gamma| *gamma > 0).map(|gamma| match gamma {
        // What writers of sRGB give, as the chunk has no room for its curve.
        45_450..=45_460 => Transfer::Srgb,
        99_995..=100_005 => Transfer::Linear,
        gamma => Transfer::Power(power(100_000.0 / gamma as f32)),
    });
    match (primaries, transfer) {
        (None, None) => None,
        (primaries, None) => said(primaries, None, "cHRM"),
        (None, transfer) => said(None, transfer, "gAMA"),
        (primaries, transfer) => said(primaries, transfer, "gAMA and cHRM"),
    }
}

/// The power that a rounded inverse stands for: one decimal where that is meant.
fn power(power: f32) -> f32 {
    let round = (power * 10.0).round() / 10.0;
    if (power - round).abs() < 2e-4 { round } else { power }
}

/// The rows of a PNG. An interlaced one has no row before it has them all, so its samples are held whole.
struct PngBands<'a> {
    reader: Reader<Input<'a>>,
    width: usize,
    height: usize,
    channels: Channels,
    /// Samples of a pixel in the file, 1 to 4.
    samples: usize,
    bits: u8,
    row_bytes: usize,
    interlaced: bool,
    /// Samples of the band, or of the picture where it is interlaced.
    bytes: Vec<u8>,
    next: usize,
}

impl Bands for PngBands<'_> {
    fn next_into(&mut self, band: &mut Band) -> Result<(), Error> {
        let rows = blocks_in_band(self.width, 1).min(self.height - self.next);
        band.become_rows(self.next, rows, self.width, self.channels)?;
        if rows > 0 {
            panic_to_error(|| self.read(rows))??;
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

    fn memory(&self) -> ReadingMemory {
        let rows = blocks_in_band(self.width, 1).min(self.height);
        let held = if self.interlaced { self.height } else { rows };
        ReadingMemory {
            band_pixels: self.width as u64 * rows as u64,
            bytes_beside: self.row_bytes as u64 * held as u64,
        }
    }
}

impl PngBands<'_> {
    /// Makes the samples of the next rows lie in `bytes`.
    fn read(&mut self, rows: usize) -> Result<(), Error> {
        if self.interlaced {
            if self.next == 0 {
                let size = self.reader.output_buffer_size().ok_or(PngProblem::TooLarge)?;
                self.bytes = allocate(size, 0)?;
                self.reader.next_frame(&mut self.bytes).map_err(problem)?;
            }
            return Ok(());
        }
        if self.bytes.is_empty() {
            self.bytes = allocate(rows * self.row_bytes, 0)?;
        }
        for row in self.bytes.chunks_exact_mut(self.row_bytes).take(rows) {
            if self.reader.read_row(row).map_err(problem)?.is_none() {
                return Err(PngProblem::FewerRows.into());
            }
        }
        if self.next + rows == self.height {
            // Goes past the last row, where damage may still show.
            self.reader.read_row(&mut []).map_err(problem)?;
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

fn problem(error: DecodingError) -> Error {
    match error {
        DecodingError::IoError(error) => error.into(),
        DecodingError::LimitsExceeded => PngProblem::Chunks { max: PNG_WORKING_BYTES }.into(),
        other => {
            // The crate prints the innards of its chunk type.
            let text = other.to_string();
            let detail = text.split("ChunkType").next().unwrap_or_default().trim_end_matches([':', ' ', '.']);
            let detail = detail.trim_end_matches(" while decoding");
            PngProblem::Damaged((!detail.is_empty()).then(|| one_line(detail))).into()
        }
    }
}
