//! Writing PNG of 8 or 16 bits.

use std::{io::Write, path::Path};

use anyhow::{Result, anyhow, bail};
use png::{BitDepth, ColorType, Compression, Encoder, ScaledFloat, SourceChromaticities};
use rayon::prelude::*;

use super::{Chromaticities, DisplayPicture, limits::allocate};
use crate::whole::write_whole;

/// Bits a sample.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Bits {
    /// 0..255.
    Eight,
    /// 0..65535.
    Sixteen,
}

/// The transfer curve that the values went through.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Coding {
    /// The piecewise curve of IEC 61966-2-1.
    Srgb,
    /// A power of 1 / 2.4.
    Gamma24,
    /// None.
    Linear,
}

/// What the file says about its values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ColourTag {
    /// Their transfer curve.
    pub(crate) coding: Coding,
    /// Their primaries and white.
    pub(crate) primaries: Chromaticities,
}

/// Writes `picture` as PNG: values are clamped to 0..1 (NaN to 0) and rounded to the nearest code, without dither.
///
/// `tag` becomes the chunks `sRGB`, `gAMA`, `cHRM` and `cICP` as far as they can say it; `texts` become `tEXt`, or
/// `iTXt` beyond Latin-1, with keys as PNG has them (`Software`, `Title`, ...).
///
/// # Errors
/// One sentence that starts with `path`: see [`write_whole`]; or a picture whose sizes do not fit each other or the
/// format, or a key that is not 1 to 79 Latin-1 characters.
pub(crate) fn write_png(
    path: &Path,
    picture: &DisplayPicture,
    bits: Bits,
    tag: Option<&ColourTag>,
    texts: &[(&str, &str)],
) -> Result<()> {
    write_whole(path, |file| write_to(file, picture, bits, tag, texts))
}

/// The same to any writer.
pub(super) fn write_to(
    writer: impl Write,
    picture: &DisplayPicture,
    bits: Bits,
    tag: Option<&ColourTag>,
    texts: &[(&str, &str)],
) -> Result<()> {
    let DisplayPicture { width, height, rgb, alpha } = picture;
    let count = width * height;
    let (Ok(width), Ok(height)) = (i32::try_from(*width), i32::try_from(*height)) else {
        bail!("a picture of {width} x {height} pixels is too large for PNG");
    };
    if count == 0 || rgb.len() != count || alpha.as_ref().is_some_and(|alpha| alpha.len() != count) {
        bail!("a picture of {width} x {height} pixels with {} colours cannot be written", rgb.len());
    }
    let mut encoder = Encoder::new(writer, width.unsigned_abs(), height.unsigned_abs());
    encoder.set_color(if alpha.is_some() { ColorType::Rgba } else { ColorType::Rgb });
    encoder.set_depth(match bits {
        Bits::Eight => BitDepth::Eight,
        Bits::Sixteen => BitDepth::Sixteen,
    });
    encoder.set_compression(Compression::Fast);
    if let Some(tag) = tag {
        tag.set_chunks(&mut encoder);
    }
    for (key, value) in texts {
        let (key, value) = ((*key).to_owned(), (*value).to_owned());
        if key.chars().all(is_latin1) && value.chars().all(is_latin1) {
            encoder.add_text_chunk(key, value)?;
        } else {
            encoder.add_itxt_chunk(key, value)?;
        }
    }
    let mut writer = encoder.write_header().map_err(|error| sentence(&error))?;
    if let Some(points) = tag.and_then(ColourTag::code_points) {
        // The crate reads this chunk but does not write it. It comes before the pixels, as it must.
        writer.write_chunk(png::chunk::ChunkType(*b"cICP"), &points).map_err(|error| sentence(&error))?;
    }
    writer.write_image_data(&samples(picture, bits)?).map_err(|error| sentence(&error))?;
    writer.finish().map_err(|error| sentence(&error))
}

impl ColourTag {
    /// `sRGB` where it is that space, else `gAMA` (the nearest power) and `cHRM`.
    fn set_chunks<W: Write>(&self, encoder: &mut Encoder<'_, W>) {
        if self.coding == Coding::Srgb && self.primaries.code_point() == Some(BT709) {
            return encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
        }
        encoder.set_source_gamma(ScaledFloat::new(match self.coding {
            Coding::Srgb => 1.0 / 2.2,
            Coding::Gamma24 => 1.0 / 2.4,
            Coding::Linear => 1.0,
        }));
        let Chromaticities { red, green, blue, white } = self.primaries;
        let pair = |[x, y]: [f32; 2]| (x, y);
        encoder.set_source_chromaticities(SourceChromaticities::new(pair(white), pair(red), pair(green), pair(blue)));
    }

    /// The bytes of `cICP`: primaries, transfer, RGB, full range; where H.273 has both code points.
    fn code_points(&self) -> Option<[u8; 4]> {
        let transfer = match self.coding {
            Coding::Srgb => 13,
            Coding::Linear => 8,
            // H.273 has no pure power of 2.4: its BT.709 point is the camera's curve.
            Coding::Gamma24 => return None,
        };
        Some([self.primaries.code_point()?, transfer, 0, 1])
    }
}

/// The code point of the primaries of BT.709 and sRGB.
const BT709: u8 = 1;

impl Chromaticities {
    /// The code point of H.273 for these primaries.
    fn code_point(&self) -> Option<u8> {
        const D65: [f32; 2] = [0.3127, 0.3290];
        let known = [
            (BT709, [[0.640, 0.330], [0.300, 0.600], [0.150, 0.060], D65]),
            (9, [[0.708, 0.292], [0.170, 0.797], [0.131, 0.046], D65]), // BT.2020
            (12, [[0.680, 0.320], [0.265, 0.690], [0.150, 0.060], D65]), // Display P3
        ];
        let own = [self.red, self.green, self.blue, self.white];
        let near = |a: f32, b: f32| (a - b).abs() < 5e-4; // standards give three decimals
        let same =
            |points: &[[f32; 2]; 4]| points.as_flattened().iter().zip(own.as_flattened()).all(|(a, b)| near(*a, *b));
        known.iter().find(|(_, points)| same(points)).map(|(code, _)| *code)
    }
}

/// All samples as PNG stores them.
fn samples(picture: &DisplayPicture, bits: Bits) -> Result<Vec<u8>> {
    match bits {
        Bits::Eight => pack(picture, |value| [(value * 255.0).round() as u8]),
        Bits::Sixteen => pack(picture, |value| ((value * 65_535.0).round() as u16).to_be_bytes()),
    }
}

fn pack<const N: usize>(picture: &DisplayPicture, code: impl Fn(f32) -> [u8; N] + Sync) -> Result<Vec<u8>> {
    // A cast of NaN gives 0, so clamping need not ask.
    let code = |value: f32| code(value.clamp(0.0, 1.0));
    let channels = if picture.alpha.is_some() { 4 } else { 3 };
    let width = picture.width;
    let mut bytes = allocate(picture.rgb.len() * channels * N, 0)?;
    bytes.par_chunks_mut(width * channels * N).zip(picture.rgb.par_chunks(width)).enumerate().for_each(
        |(row, (bytes, colours))| {
            let alpha = picture.alpha.as_ref().map(|alpha| &alpha[row * width..]);
            let (samples, _) = bytes.as_chunks_mut::<N>();
            for (x, (pixel, colour)) in samples.chunks_exact_mut(channels).zip(colours).enumerate() {
                let values = colour.iter().chain(alpha.map(|alpha| &alpha[x]));
                pixel.iter_mut().zip(values).for_each(|(sample, value)| *sample = code(*value));
            }
        },
    );
    Ok(bytes)
}

fn is_latin1(character: char) -> bool {
    u32::from(character) < 256
}

fn sentence(error: &png::EncodingError) -> anyhow::Error {
    anyhow!("cannot be written: {error}")
}
