//! Writing PNG of 8 or 16 bits.

use std::{
    io::{self, Write},
    ops::Range,
};

use png::{BitDepth, ColorType, Compression, Encoder, ScaledFloat, SourceChromaticities, StreamWriter};
use rayon::prelude::*;

use crate::{
    band::BandView,
    band_sink::{BandSink, Fill, filled_by},
    description::{Channels, Chromaticities, Description},
    display::Shown,
    error::{Error, WriteProblem},
    limits::{allocate, grow},
};

/// How a PNG is written.
///
/// ```
/// use onelight_picture::{Chromaticities, ColourTag, PngBits, PngSettings, PngTransfer};
///
/// let srgb = Chromaticities { red: [0.64, 0.33], green: [0.3, 0.6], blue: [0.15, 0.06], white: [0.3127, 0.329] };
/// let tag = ColourTag { transfer: PngTransfer::Srgb, primaries: srgb };
/// let settings = PngSettings { bits: PngBits::Sixteen, tag: Some(tag) };
/// # assert_ne!(settings, PngSettings::default());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PngSettings {
    /// Bits of a sample: 8 or 16.
    pub bits: PngBits,
    /// What the file says of its values; by default it says nothing, which viewers take for sRGB.
    pub tag: Option<ColourTag>,
}

/// Bits of a sample of a PNG.
///
/// ```
/// # use onelight_picture::PngBits;
/// assert_eq!((PngBits::default(), PngBits::Sixteen.bytes()), (PngBits::Eight, 2));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum PngBits {
    /// Codes from 0 to 255.
    #[default]
    Eight,
    /// Codes from 0 to 65535.
    Sixteen,
}

/// The transfer curve that the values of a picture went through before they are written.
///
/// ```
/// # use onelight_picture::{Chromaticities, ColourTag, PngTransfer};
/// # let primaries = Chromaticities { red: [0.64, 0.33], green: [0.3, 0.6], blue: [0.15, 0.06], white: [0.3127, 0.329] };
/// let tag = ColourTag { transfer: PngTransfer::Gamma24, primaries };
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PngTransfer {
    /// The piecewise curve of IEC 61966-2-1.
    Srgb,
    /// A power of 1 / 2.4.
    Gamma24,
    /// No curve: the values are linear light.
    Linear,
}

/// What a PNG says about its values. Values are written as they are; this changes none.
///
/// ```
/// use onelight_picture::{Chromaticities, ColourTag, PngTransfer};
///
/// let display_p3 = ColourTag {
///     transfer: PngTransfer::Srgb,
///     primaries: Chromaticities { red: [0.68, 0.32], green: [0.265, 0.69], blue: [0.15, 0.06], white: [0.3127, 0.329] },
/// };
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColourTag {
    /// The transfer curve that the values went through.
    pub transfer: PngTransfer,
    /// The primaries and the white point of the values.
    pub primaries: Chromaticities,
}

/// Bytes of a chunk of pixels in the file.
const CHUNK_BYTES: usize = 1 << 16;

/// Writes the display window of a picture as PNG, from the bands that `fill` hands over: values are clamped to 0 to 1 (NaN
/// to 0) and rounded to the nearest code, without dither; what the data window does not have is black, transparent where
/// there is alpha. Returns what `fill` returns. Memory is that of a band.
///
/// The tag becomes the chunks `sRGB`, `gAMA`, `cHRM` and `cICP` as far as they can say it; `texts`, a key and a value each,
/// become `tEXt`, or `iTXt` beyond Latin-1, with keys as PNG has them (`Software`, `Title`, ...). The writer is best
/// buffered; it is flushed.
///
/// ```
/// use onelight_picture::{BandView, Channels, Description, Error, PngSettings, Source, write_png};
///
/// let picture = Description::new(3, 1, Channels::Rgb, Source::Exr);
/// let row = [[0.0; 3], [0.5; 3], [7.0, 1.0, -1.0]];
/// let mut file = Vec::new();
/// write_png(&mut file, &picture, PngSettings::default(), &[("Title", "Three pixels")], |sink| {
///     sink.write(BandView { top: 0, width: 3, rgb: &row, alpha: None })
/// })?;
/// # assert!(file.starts_with(b"\x89PNG"));
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
/// What `fill` says; or bands or sizes that fit neither each other nor the format, a key that is not 1 to 79 Latin-1
/// characters, or a writer that fails. What was written by then is no picture.
pub fn write_png<T, E: From<Error>>(
    mut writer: impl Write + Send,
    picture: &Description,
    settings: PngSettings,
    texts: &[(&str, &str)],
    fill: impl FnOnce(&mut dyn BandSink) -> Result<T, E>,
) -> Result<T, E> {
    filled_by(fill, |fill| write_bands(&mut writer, picture, settings, texts, fill))
}

fn write_bands(
    writer: &mut (dyn Write + Send),
    picture: &Description,
    settings: PngSettings,
    texts: &[(&str, &str)],
    fill: Fill<'_>,
) -> Result<(), Error> {
    let PngSettings { bits, tag } = settings;
    let [width, height] = picture.windows.display_size;
    let (Ok(columns), Ok(rows)) = (i32::try_from(width), i32::try_from(height)) else {
        return Err(WriteProblem::TooLarge { size: [width, height], format: "PNG" }.into());
    };
    if width == 0 || height == 0 {
        return Err(WriteProblem::NoPixels { size: [width, height] }.into());
    }
    let mut encoder = Encoder::new(Steadfast { writer, failed: false }, columns.unsigned_abs(), rows.unsigned_abs());
    encoder.set_color(match picture.channels {
        Channels::Rgb => ColorType::Rgb,
        Channels::Rgba => ColorType::Rgba,
    });
    encoder.set_depth(match bits {
        PngBits::Eight => BitDepth::Eight,
        PngBits::Sixteen => BitDepth::Sixteen,
    });
    encoder.set_compression(Compression::Fast);
    if let Some(tag) = &tag {
        tag.set_chunks(&mut encoder);
    }
    for (key, value) in texts {
        let (key, value) = ((*key).to_owned(), (*value).to_owned());
        if key.chars().all(is_latin1) && value.chars().all(is_latin1) {
            encoder.add_text_chunk(key, value).map_err(problem)?;
        } else {
            encoder.add_itxt_chunk(key, value).map_err(problem)?;
        }
    }
    let mut writer = encoder.write_header().map_err(problem)?;
    if let Some(points) = tag.as_ref().and_then(ColourTag::code_points) {
        // The crate reads this chunk but does not write it. It comes before the pixels, as it must.
        writer.write_chunk(png::chunk::ChunkType(*b"cICP"), &points).map_err(problem)?;
    }
    let stream = writer.stream_writer_with_size(CHUNK_BYTES).map_err(problem)?;
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
    if !fill(&mut rows) {
        return Ok(()); // the caller knows why
    }
    rows.finish()?;
    writer.finish().map_err(problem)
}

/// The rows of a PNG as they come.
struct PngRows<'a, W: Write> {
    stream: StreamWriter<'a, W>,
    shown: Shown,
    /// Width and height of the data window.
    size: [usize; 2],
    channels: Channels,
    bits: PngBits,
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
    fn write(&mut self, band: BandView<'_>) -> Result<(), Error> {
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
                PngBits::Eight => pack(bytes, channels, columns, rgb, alpha, |value| [nearest(value * 255.0) as u8]),
                PngBits::Sixteen => {
                    pack(bytes, channels, columns, rgb, alpha, |value| {
                        (nearest(value * 65_535.0) as u16).to_be_bytes()
                    });
                }
            }
        });
        self.stream.write_all(&self.bytes).map_err(WriteProblem::Io)?;
        self.next = rows.end;
        Ok(())
    }
}

impl<W: Write> PngRows<'_, W> {
    /// Writes empty rows up to `row` of the display window.
    fn blank_to(&mut self, row: usize) -> Result<(), Error> {
        if self.next < row {
            let blank = allocate(self.row_bytes, 0)?;
            for _ in self.next..row {
                self.stream.write_all(&blank).map_err(WriteProblem::Io)?;
            }
            self.next = row;
        }
        Ok(())
    }

    fn finish(mut self) -> Result<(), Error> {
        let [width, height] = self.size;
        if self.row != height {
            return Err(WriteProblem::RowsMissing { size: [width, height], rows: self.row }.into());
        }
        self.blank_to(self.height)?;
        self.stream.finish().map_err(problem)
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

impl PngBits {
    /// Bytes of a sample: 1 or 2.
    pub fn bytes(self) -> usize {
        match self {
            Self::Eight => 1,
            Self::Sixteen => 2,
        }
    }
}

impl ColourTag {
    /// `sRGB` where it is that space, else `gAMA` (the nearest power) and `cHRM`.
    fn set_chunks<W: Write>(&self, encoder: &mut Encoder<'_, W>) {
        if self.transfer == PngTransfer::Srgb && self.primaries.code_point() == Some(BT709) {
            return encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
        }
        encoder.set_source_gamma(ScaledFloat::new(match self.transfer {
            PngTransfer::Srgb => 1.0 / 2.2,
            PngTransfer::Gamma24 => 1.0 / 2.4,
            PngTransfer::Linear => 1.0,
        }));
        let Chromaticities { red, green, blue, white } = self.primaries;
        let pair = |[x, y]: [f32; 2]| (x, y);
        // The chunk has no sign: primaries such as ACES2065-1's blue cannot be said.
        if [red, green, blue, white].as_flattened().iter().any(|v| *v < 0.0) {
            return;
        }
        encoder.set_source_chromaticities(SourceChromaticities::new(pair(white), pair(red), pair(green), pair(blue)));
    }

    /// The bytes of `cICP`: primaries, transfer, RGB, full range; where H.273 has both code points.
    fn code_points(&self) -> Option<[u8; 4]> {
        let transfer = match self.transfer {
            PngTransfer::Srgb => 13,
            PngTransfer::Linear => 8,
            // H.273 has no pure power of 2.4: its BT.709 point is the camera's curve.
            PngTransfer::Gamma24 => return None,
        };
        Some([self.primaries.code_point()?, transfer, 0, 1])
    }
}

/// The code point of the primaries of BT.709 and sRGB.
const BT709: u8 = 1;

impl Chromaticities {
    /// The code point of H.273 for these primaries.
    fn code_point(&self) -> Option<u8> {
        let known = [(BT709, Self::BT709), (9, Self::BT2020), (12, Self::P3_D65)];
        known.iter().find(|(_, known)| known.is_near(self)).map(|(code, _)| *code)
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

fn problem(error: png::EncodingError) -> Error {
    match error {
        png::EncodingError::IoError(error) => WriteProblem::Io(error),
        other => WriteProblem::Encoder(other.to_string()),
    }
    .into()
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
