//! Reading TIFF: grey and RGB, with and without alpha, of 8, 16 or 32 bits or floating point.

use std::io::{ErrorKind, Read, Seek};

use anyhow::{Result, anyhow, bail};
use tiff::{
    ColorType, TiffError,
    decoder::{ChunkType, Decoder, DecodingResult},
    tags::Tag,
};

use super::{
    Limits, Picture, Pixels, Samples, Source, alpha,
    guard::guarded,
    limits::{allocate, check_claim},
};

/// More than Deflate, LZW or PackBits can give for one byte.
const EXPANSION: u64 = 2048;

/// Reads a picture from a TIFF file of `length` bytes: the first one in it.
pub(super) fn read<R: Read + Seek>(reader: R, length: u64, limits: &Limits) -> Result<Picture> {
    guarded(|| decode(reader, length, limits))?
}

fn decode<R: Read + Seek>(reader: R, length: u64, limits: &Limits) -> Result<Picture> {
    let mut decoder = Decoder::new(reader).map_err(sentence)?;
    let (width, height) = decoder.dimensions().map_err(sentence)?;
    let (width, height) = (u64::from(width), u64::from(height));
    limits.check_size("the picture", width, height)?;

    let colour = decoder.colortype().map_err(sentence)?;
    let channels = match colour {
        ColorType::Gray(_) => 1,
        ColorType::GrayA(_) | ColorType::Multiband { num_samples: 2, .. } => 2,
        ColorType::RGB(_) => 3,
        ColorType::RGBA(_) => 4,
        other => bail!("the TIFF's pixels are {other:?}, expected grey or RGB, with or without alpha"),
    };
    let bits = colour.bit_depth();
    if !matches!(bits, 8 | 16 | 32 | 64) {
        bail!("the TIFF has {bits} bits a sample, expected 8, 16 or 32, or floating point");
    }
    let planes = decoder.image_buffer_layout().map_err(sentence)?.planes;
    if planes > 1 && decoder.get_chunk_type() == ChunkType::Tile {
        bail!("the TIFF keeps its channels apart and in tiles, expected tiles of whole pixels, or strips");
    }
    let claimed = width * height * channels as u64 * u64::from(bits / 8);
    let expansion = match decoder.find_tag_unsigned::<u16>(Tag::Compression).map_err(sentence)? {
        None | Some(1) => 1, // uncompressed
        Some(_) => EXPANSION,
    };
    check_claim(width, height, claimed, length, expansion)?;

    // Tiles and strips may reach over the border.
    let most = usize::try_from(claimed)?.saturating_mul(2).saturating_add(1 << 24);
    let mut allowed = tiff::decoder::Limits::default();
    allowed.decoding_buffer_size = most;
    allowed.intermediate_buffer_size = most;
    let mut decoder = decoder.with_limits(allowed);
    let mut samples = DecodingResult::U8(Vec::new());
    decoder.read_image_to_buffer(&mut samples).map_err(sentence)?;

    let (width, height) = (width as usize, height as usize);
    let shape = Shape { count: width * height, channels, planes };
    let (kind, (mut rgb, alpha)) = shape.pixels(&samples)?;
    drop(samples);

    let mut notes = Vec::new();
    if let Some(alpha) = &alpha {
        let extra = decoder.find_tag_unsigned_vec::<u16>(Tag::ExtraSamples).map_err(sentence)?;
        // 1: associated (premultiplied), 2: unassociated, 0: not said.
        match extra.as_deref().and_then(<[u16]>::first) {
            Some(1) => alpha::straighten(&mut rgb, alpha),
            Some(2) => {}
            _ => notes.push("took the TIFF's extra channel, of which it says nothing, for straight alpha".to_owned()),
        }
    }
    if decoder.find_tag_unsigned::<u16>(Tag::Orientation).map_err(sentence)?.is_some_and(|way| way > 1) {
        notes.push("left the TIFF's orientation as stored".to_owned());
    }
    let source = Source::Tiff { bits, samples: kind };
    Ok(Picture { alpha, notes, ..Picture::opaque(width, height, rgb, source) })
}

/// How the samples lie: `planes` is 1 where a pixel's samples are side by side, else one plane a channel.
struct Shape {
    count: usize,
    channels: usize,
    planes: usize,
}

impl Shape {
    fn pixels(&self, samples: &DecodingResult) -> Result<(Samples, Pixels)> {
        use DecodingResult::{F16, F32, F64, U8, U16, U32};
        use Samples::{Float, Integer};
        Ok(match samples {
            U8(values) => (Integer, self.converted(values, |v| f32::from(v) / 255.0)?),
            U16(values) => (Integer, self.converted(values, |v| f32::from(v) / 65_535.0)?),
            U32(values) => (Integer, self.converted(values, |v| (f64::from(v) / f64::from(u32::MAX)) as f32)?),
            F16(values) => (Float, self.converted(values, half::f16::to_f32)?),
            F32(values) => (Float, self.converted(values, |v| v)?),
            F64(values) => (Float, self.converted(values, |v| v as f32)?),
            _ => bail!("the TIFF's samples are signed or 64-bit integers, expected unsigned or floating point"),
        })
    }

    fn converted<T: Copy>(&self, samples: &[T], value: impl Fn(T) -> f32) -> Result<Pixels> {
        let &Self { count, channels, planes } = self;
        if samples.len() != count * channels || (planes != 1 && planes != channels) {
            bail!(
                "the TIFF gives {} samples in {planes} planes, expected {} of {channels} channels",
                samples.len(),
                count * channels
            );
        }
        let (pixel_step, channel_step) = if planes == 1 { (channels, 1) } else { (1, count) };
        let at = |pixel: usize, channel: usize| value(samples[pixel * pixel_step + channel * channel_step]);
        let [green, blue] = if channels < 3 { [0, 0] } else { [1, 2] };
        let mut rgb = allocate(count, [0.0; 3])?;
        for (pixel, colour) in rgb.iter_mut().enumerate() {
            *colour = [at(pixel, 0), at(pixel, green), at(pixel, blue)];
        }
        let alpha = channels % 2 == 0;
        let alpha = alpha.then(|| (0..count).map(|pixel| at(pixel, channels - 1)).collect());
        Ok((rgb, alpha))
    }
}

fn sentence(error: TiffError) -> anyhow::Error {
    match error {
        // The unpackers, too, speak through this error.
        TiffError::IoError(error)
            if error.kind() == ErrorKind::InvalidData || error.kind() == ErrorKind::InvalidInput =>
        {
            anyhow!("the TIFF is damaged: {error}")
        }
        TiffError::IoError(error) => super::cannot_read(&error),
        TiffError::LimitsExceeded => anyhow!("the TIFF asks for more memory than its size explains"),
        other => anyhow!("the TIFF cannot be read: {other}"),
    }
}
