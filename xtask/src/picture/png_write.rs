//! Writing PNG of 8 or 16 bits.

use std::{
    io::{self, Write},
    ops::Range,
    path::Path,
};

use anyhow::{Result, anyhow, bail};
use png::{BitDepth, ColorType, Compression, Encoder, ScaledFloat, SourceChromaticities, StreamWriter};
use rayon::prelude::*;

use super::{BandSink, BandView, Channels, Chromaticities, Description, display::Shown, limits::grow};
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

/// Bytes of a chunk of pixels in the file.
const CHUNK_BYTES: usize = 1 << 16;

/// Writes the display window of a picture as PNG, from the bands that `fill` hands over: values are clamped to 0..1 (NaN to 0)
/// and rounded to the nearest code, without dither; what the data window does not have is black, transparent where
/// there is alpha. Returns what `fill` returns.
///
/// `tag` becomes the chunks `sRGB`, `gAMA`, `cHRM` and `cICP` as far as they can say it; `texts` become `tEXt`, or
/// `iTXt` beyond Latin-1, with keys as PNG has them (`Software`, `Title`, ...).
///
/// # Errors
/// One sentence that starts with `path`: see [`write_whole`]; or a picture whose sizes do not fit each other or the
/// format, or a key that is not 1 to 79 Latin-1 characters; and what `fill` says.
pub(crate) fn write_png_bands<T>(
    path: &Path,
    picture: &Description,
    bits: Bits,
    tag: Option<&ColourTag>,
    texts: &[(&str, &str)],
    fill: impl FnOnce(&mut dyn BandSink) -> Result<T>,
) -> Result<T> {
    write_whole(path, |file| write_bands_to(file, picture, bits, tag, texts, fill))
}

/// The same to any writer.
pub(super) fn write_bands_to<T>(
    writer: impl Write + Send,
    picture: &Description,
    bits: Bits,
    tag: Option<&ColourTag>,
    texts: &[(&str, &str)],
    fill: impl FnOnce(&mut dyn BandSink) -> Result<T>,
) -> Result<T> {
    let [width, height] = picture.windows.display_size;
    let (Ok(columns), Ok(rows)) = (i32::try_from(width), i32::try_from(height)) else {
        bail!("a picture of {width} x {height} pixels is too large for PNG");
    };
    if width == 0 || height == 0 {
        bail!("a picture of {width} x {height} pixels cannot be written");
    }
    let mut encoder = Encoder::new(Steadfast { writer, failed: false }, columns.unsigned_abs(), rows.unsigned_abs());
    encoder.set_color(match picture.channels {
        Channels::Rgb => ColorType::Rgb,
        Channels::Rgba => ColorType::Rgba,
    });
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
    let stream = writer.stream_writer_with_size(CHUNK_BYTES).map_err(|error| sentence(&error))?;
    let mut rows = PngRows {
        stream,
        shown: Shown::new(picture),
        size: [picture.width, picture.height],
        channels: picture.channels,
        bits,
        row_bytes: width * bits.bytes() * picture.channels.count(),
        height,
        next: 0,
        row: 0,
        bytes: Vec::new(),
    };
    let value = fill(&mut rows)?;
    rows.finish()?;
    writer.finish().map_err(|error| sentence(&error))?;
    Ok(value)
}

/// The rows of a PNG as they come.
struct PngRows<'a, W: Write> {
    stream: StreamWriter<'a, W>,
    shown: Shown,
    /// Width and height of the data window.
    size: [usize; 2],
    channels: Channels,
    bits: Bits,
    row_bytes: usize,
    /// Rows of the display window.
    height: usize,
    /// The next row of the display window.
    next: usize,
    /// The next row of the data window.
    row: usize,
    bytes: Vec<u8>,
}

impl<W: Write + Send> BandSink for PngRows<'_, W> {
    fn write(&mut self, band: BandView<'_>) -> Result<()> {
        self.row += band.checked_rows(self.row, self.size, self.channels)?;
        let rows = self.shown.rows_of(band);
        if rows.is_empty() {
            return Ok(());
        }
        self.blank_to(rows.start)?;
        grow(&mut self.bytes, rows.len() * self.row_bytes, 0)?;
        let (shown, bits, channels) = (&self.shown, self.bits, self.channels);
        self.bytes.par_chunks_exact_mut(self.row_bytes).zip(rows.clone()).for_each(|(bytes, row)| {
            let (columns, rgb, alpha) = shown.row(row, band);
            match bits {
                Bits::Eight => pack(bytes, channels, columns, rgb, alpha, |value| [nearest(value * 255.0) as u8]),
                Bits::Sixteen => {
                    pack(bytes, channels, columns, rgb, alpha, |value| {
                        (nearest(value * 65_535.0) as u16).to_be_bytes()
                    });
                }
            }
        });
        self.stream.write_all(&self.bytes).map_err(|error| cannot_write(&error))?;
        self.next = rows.end;
        Ok(())
    }
}

impl<W: Write> PngRows<'_, W> {
    /// Writes empty rows up to `row` of the display window.
    fn blank_to(&mut self, row: usize) -> Result<()> {
        if self.next < row {
            let blank = vec![0; self.row_bytes];
            for _ in self.next..row {
                self.stream.write_all(&blank).map_err(|error| cannot_write(&error))?;
            }
            self.next = row;
        }
        Ok(())
    }

    fn finish(mut self) -> Result<()> {
        let [width, height] = self.size;
        if self.row != height {
            bail!("a picture of {width} x {height} pixels with {} rows cannot be written", self.row);
        }
        self.blank_to(self.height)?;
        self.stream.finish().map_err(|error| sentence(&error))
    }
}

/// A writer that goes on failing once it has failed: the crate forgets an error of the last pixels.
struct Steadfast<W> {
    writer: W,
    failed: bool,
}

impl<W: Write> Steadfast<W> {
    fn attempt<T>(&mut self, write: impl FnOnce(&mut W) -> io::Result<T>) -> io::Result<T> {
        if self.failed {
            return Err(io::Error::other("an earlier part could not be written"));
        }
        let outcome = write(&mut self.writer);
        self.failed = outcome.as_ref().is_err_and(|error| error.kind() != io::ErrorKind::Interrupted);
        outcome
    }
}

impl<W: Write> Write for Steadfast<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.attempt(|writer| writer.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.attempt(Write::flush)
    }
}

impl Bits {
    fn bytes(self) -> usize {
        match self {
            Self::Eight => 1,
            Self::Sixteen => 2,
        }
    }
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

/// Fills in a row of the display window; what lies outside of `columns` is empty.
fn pack<const N: usize>(
    bytes: &mut [u8],
    channels: Channels,
    columns: Range<usize>,
    rgb: &[[f32; 3]],
    alpha: Option<&[f32]>,
    code: impl Fn(f32) -> [u8; N],
) {
    // A cast of NaN gives 0, so clamping need not ask.
    let code = |value: f32| code(value.clamp(0.0, 1.0));
    let step = channels.count();
    let (samples, _) = bytes.as_chunks_mut::<N>();
    samples[..columns.start * step].fill([0; N]);
    samples[columns.end * step..].fill([0; N]);
    let pixels = samples[columns.start * step..columns.end * step].chunks_exact_mut(step);
    match alpha {
        Some(alpha) => pixels.zip(rgb.iter().zip(alpha)).for_each(|(pixel, ([r, g, b], a))| {
            pixel.copy_from_slice(&[code(*r), code(*g), code(*b), code(*a)]);
        }),
        None => pixels.zip(rgb).for_each(|(pixel, rgb)| pixel.copy_from_slice(&rgb.map(&code))),
    }
}

/// The nearest whole number, halves up, of what lies in 0..65535: as `round`, without the call that it is on most
/// processors.
fn nearest(value: f32) -> u32 {
    let whole = value as u32;
    // Exact, as both are of one size.
    whole + u32::from(value - whole as f32 >= 0.5)
}

fn is_latin1(character: char) -> bool {
    u32::from(character) < 256
}

fn sentence(error: &png::EncodingError) -> anyhow::Error {
    anyhow!("cannot be written: {error}")
}

fn cannot_write(error: &io::Error) -> anyhow::Error {
    anyhow!("cannot be written: {error}")
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn the_nearest_code_is_what_rounding_gives() {
        // Each code, half way to the next, and the values beside that.
        let halves = (0..65_535).map(|code| code as f32 + 0.5);
        let beside = halves.flat_map(|half| [half.next_down(), half, half.next_up(), half - 0.5]);
        for value in beside.chain([65_535.0, 0.5_f32.next_down(), f32::MIN_POSITIVE]) {
            assert_eq!(nearest(value), value.round() as u32, "{value}");
        }
        assert_eq!(nearest(f32::NAN), 0);
    }
}
