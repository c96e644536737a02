//! Reading PNG of 1 to 16 bits: grey, palette and RGB, with and without alpha.

use std::io::{BufRead, Seek};

use anyhow::{Result, anyhow, bail};
use png::{BitDepth, ColorType, Decoder, DecodingError, Transformations};

use super::{
    Limits, Picture, Pixels, Source,
    guard::guarded,
    limits::{allocate, check_claim},
};

/// Most bytes the decoder may take beside the picture itself, for rows and ancillary chunks.
const WORKING_BYTES: usize = 1 << 26;

/// More than Deflate can give for one byte.
const EXPANSION: u64 = 1100;

/// Reads a picture from a PNG file of `length` bytes.
pub(super) fn read<R: BufRead + Seek>(reader: R, length: u64, limits: &Limits) -> Result<Picture> {
    guarded(|| decode(reader, length, limits))?
}

fn decode<R: BufRead + Seek>(reader: R, length: u64, limits: &Limits) -> Result<Picture> {
    let mut decoder = Decoder::new_with_limits(reader, png::Limits { bytes: WORKING_BYTES });
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let info = decoder.read_header_info().map_err(|error| sentence(&error))?;
    let (width, height) = (u64::from(info.width), u64::from(info.height));
    limits.check_size("the picture", width, height)?;
    let bits = info.bits_per_pixel() as u64;
    check_claim(width, height, (width * bits).div_ceil(8) * height, length, EXPANSION)?;

    let mut reader = decoder.read_info().map_err(|error| sentence(&error))?;
    let (colour, depth) = reader.output_color_type();
    let size = reader.output_buffer_size().ok_or_else(|| anyhow!("the PNG is too large"))?;
    let mut bytes = allocate(size, 0)?;
    reader.next_frame(&mut bytes).map_err(|error| sentence(&error))?;

    let (width, height) = (width as usize, height as usize);
    let bits = if depth == BitDepth::Sixteen { 16 } else { 8 };
    let (rgb, alpha) = match bits {
        8 => pixels(&bytes, colour, |[byte]: [u8; 1]| f32::from(byte) / 255.0)?,
        _ => pixels(&bytes, colour, |word| f32::from(u16::from_be_bytes(word)) / 65_535.0)?,
    };
    Ok(Picture { alpha, ..Picture::opaque(width, height, rgb, Source::Png { bits }) })
}

/// Colours and coverage from samples of `N` bytes.
fn pixels<const N: usize>(bytes: &[u8], colour: ColorType, value: impl Fn([u8; N]) -> f32) -> Result<Pixels> {
    let (samples, _) = bytes.as_chunks::<N>();
    let value = |sample: &[u8; N]| value(*sample);
    let (step, alpha_at) = match colour {
        ColorType::Grayscale => (1, None),
        ColorType::GrayscaleAlpha => (2, Some(1)),
        ColorType::Rgb => (3, None),
        ColorType::Rgba => (4, Some(3)),
        ColorType::Indexed => bail!("the PNG's palette is missing"),
    };
    let [green, blue] = if step < 3 { [0, 0] } else { [1, 2] };
    let rgb =
        samples.chunks_exact(step).map(|pixel| [value(&pixel[0]), value(&pixel[green]), value(&pixel[blue])]).collect();
    let alpha = alpha_at.map(|at| samples.chunks_exact(step).map(|pixel: &[[u8; N]]| value(&pixel[at])).collect());
    Ok((rgb, alpha))
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
            if detail.is_empty() { anyhow!("the PNG is damaged") } else { anyhow!("the PNG is damaged: {detail}") }
        }
    }
}
