//! Reading JPEG of 8 bits, baseline and progressive, grey and colour.

use std::io::Read;

use rayon::prelude::*;
use zune_core::{bytestream::ZCursor, colorspace::ColorSpace, options::DecoderOptions};
use zune_jpeg::{JpegDecoder, errors::DecodeErrors};

use crate::{
    band::{Band, Bands, ReadingMemory, blocks_in_band},
    decoder_message::one_line,
    description::{Channels, Description, Source},
    error::{Error, JpegProblem},
    exif,
    input::Input,
    limits::{Limits, allocate, check_claim},
    orientation::upright,
    panic_to_error::panic_to_error,
};

/// A block of 64 flat pixels takes a bit or two in each of its scans.
const EXPANSION: u64 = 1 << 10;

/// What phones write into a picture that has a second one of its brightest light.
const GAIN_MAP_MARKS: [&[u8]; 2] = [b"hdrgm:", b"urn:iso:std:iso:ts:21496"];

/// Opens a JPEG of `length` bytes.
pub(crate) fn open<'a>(
    mut reader: Input<'a>,
    length: u64,
    limits: &Limits,
) -> Result<(Description, Box<dyn Bands + 'a>), Error> {
    if length > limits.max_bytes {
        return Err(JpegProblem::Length { found: length, max: limits.max_bytes }.into());
    }
    let mut file = allocate(usize::try_from(length).unwrap_or(usize::MAX), 0)?;
    reader.read_exact(&mut file)?;
    refuse_process(&file)?;
    let side = usize::try_from(limits.max_side).unwrap_or(usize::MAX);
    let options = DecoderOptions::default().set_max_width(side).set_max_height(side).set_strict_mode(true);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(&file[..]), options);
    panic_to_error(|| decoder.decode_headers())?.map_err(problem)?;
    let info = decoder.info().ok_or(JpegProblem::NoFrame)?;
    let [width, height] = [info.width, info.height].map(usize::from);
    limits.check_size("the picture", width as u64, height as u64)?;
    let samples = match decoder.input_colorspace() {
        Some(ColorSpace::Luma) => 1,
        Some(ColorSpace::YCbCr | ColorSpace::RGB) => 3,
        Some(ColorSpace::CMYK | ColorSpace::YCCK) => return Err(JpegProblem::Cmyk.into()),
        _ => return Err(JpegProblem::Components.into()),
    };
    let bytes = (width * height * samples) as u64;
    limits.check_bytes("a JPEG", [width as u64, height as u64], bytes + length)?;
    check_claim([width as u64, height as u64], bytes, length, EXPANSION)?;

    let mut description = Description::new(width, height, Channels::Rgb, Source::Jpeg);
    let exif = decoder.exif().map(|block| exif::read(block)).unwrap_or_default();
    description.metadata.exif = exif.tags;
    #[cfg(feature = "icc")]
    if let Some(profile) = decoder.icc_profile() {
        match crate::icc::colours(&profile) {
            Ok(colours) => colours.describe(&mut description),
            Err(note) => description.notes.push(note),
        }
    }
    if description.transfer.is_none()
        && let Some(colours) = exif.colours
    {
        colours.describe(&mut description);
    }
    if GAIN_MAP_MARKS.iter().any(|mark| file.windows(mark.len()).any(|window| window == *mark)) {
        description
            .notes
            .push("left out the gain map, which makes the brightest light brighter on some displays".into());
    }
    drop(decoder);
    let bands = JpegBands { file, size: [width, height], samples, pixels: Vec::new(), next: 0 };
    upright(exif.orientation, description, Box::new(bands), limits)
}

/// Refuses what is no 8-bit Huffman-coded DCT, which the markers of frames and scans say.
fn refuse_process(file: &[u8]) -> Result<(), Error> {
    let mut at = 2;
    while let Some([0xff, marker, high, low]) = file.get(at..at + 4).and_then(|bytes| bytes.first_chunk::<4>()) {
        match marker {
            0xc0..=0xc2 => {
                return match file.get(at + 4) {
                    Some(8) | None => Ok(()),
                    Some(bits) => Err(JpegProblem::Bits { found: *bits }.into()),
                };
            }
            0xc3 | 0xc7 => return Err(JpegProblem::Process { found: "lossless" }.into()),
            0xc9..=0xcb | 0xcd..=0xcf => return Err(JpegProblem::Process { found: "arithmetic-coded" }.into()),
            0xc5 | 0xc6 => return Err(JpegProblem::Process { found: "hierarchical" }.into()),
            0xf7 => return Err(JpegProblem::Process { found: "JPEG-LS" }.into()),
            // Fill bytes before a marker.
            0xff => at += 1,
            0xda => return Ok(()),
            _ => at += 2 + usize::from(u16::from_be_bytes([*high, *low])),
        }
    }
    Ok(())
}

/// The rows of a JPEG, which has none before it has them all where it is progressive.
struct JpegBands {
    file: Vec<u8>,
    size: [usize; 2],
    /// Samples of a pixel: 1 or 3.
    samples: usize,
    pixels: Vec<u8>,
    next: usize,
}

impl Bands for JpegBands {
    fn next_into(&mut self, band: &mut Band) -> Result<(), Error> {
        let [width, height] = self.size;
        if self.pixels.is_empty() {
            self.decode()?;
        }
        let rows = blocks_in_band(width, 1).min(height - self.next);
        band.become_rows(self.next, rows, width, Channels::Rgb)?;
        let row_bytes = width * self.samples;
        let bytes = &self.pixels[self.next * row_bytes..(self.next + rows) * row_bytes];
        let samples = self.samples;
        band.rows_mut().zip(bytes.par_chunks_exact(row_bytes)).for_each(|(row, bytes)| {
            let value = |byte: u8| f32::from(byte) / 255.0;
            for (colour, pixel) in row.rgb.iter_mut().zip(bytes.chunks_exact(samples)) {
                *colour = match *pixel {
                    [red, green, blue] => [value(red), value(green), value(blue)],
                    _ => [value(pixel[0]); 3],
                };
            }
        });
        self.next += rows;
        Ok(())
    }

    fn memory(&self) -> ReadingMemory {
        let [width, height] = self.size;
        let rows = blocks_in_band(width, 1).min(height);
        // A progressive picture holds 16-bit coefficients of all its samples while it is unpacked.
        let bytes = (width * height * self.samples) as u64;
        ReadingMemory { band_pixels: width as u64 * rows as u64, bytes_beside: self.file.len() as u64 + 3 * bytes }
    }
}

impl JpegBands {
    fn decode(&mut self) -> Result<(), Error> {
        let [width, height] = self.size;
        let space = if self.samples == 1 { ColorSpace::Luma } else { ColorSpace::RGB };
        let options = DecoderOptions::default()
            .set_max_width(width)
            .set_max_height(height)
            .set_strict_mode(true)
            .jpeg_set_out_colorspace(space);
        let mut pixels = allocate(width * height * self.samples, 0)?;
        let mut decoder = JpegDecoder::new_with_options(ZCursor::new(&self.file[..]), options);
        panic_to_error(|| decoder.decode_into(&mut pixels))?.map_err(problem)?;
        self.pixels = pixels;
        Ok(())
    }
}

fn problem(error: DecodeErrors) -> Error {
    match error {
        DecodeErrors::ExhaustedData => crate::error::Kind::EndsEarly.into(),
        other => JpegProblem::Damaged(one_line(&format!("{other:?}"))).into(),
    }
}
