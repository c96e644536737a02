//! Writing PNG of 8 or 16 bits.

use std::{
    borrow::Cow,
    io::{self, Write},
};

use png::{BitDepth, ColorType, Compression, Encoder, Info, ScaledFloat, SourceChromaticities};

use crate::{
    band_sink::{BandSink, Fill, filled_by},
    colour_tag::{ColourTag, OutputTransfer},
    description::{Channels, Chromaticities, Description},
    display_rows::{DisplayRows, Samples},
    dither::Dither,
    error::{Error, WriteProblem},
    icc_write,
};

/// How a PNG is written.
///
/// ```
/// use onelight_picture::{Chromaticities, ColourTag, PngBits, PngSettings, OutputTransfer};
///
/// let srgb = Chromaticities { red: [0.64, 0.33], green: [0.3, 0.6], blue: [0.15, 0.06], white: [0.3127, 0.329] };
/// let tag = ColourTag { transfer: OutputTransfer::Srgb, primaries: srgb };
/// let settings = PngSettings { bits: PngBits::Sixteen, tag: Some(tag), ..PngSettings::default() };
/// # assert_ne!(settings, PngSettings::default());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PngSettings {
    /// Bits of a sample: 8 or 16.
    pub bits: PngBits,
    /// What the file says of its values; by default it says nothing, which viewers take for sRGB.
    pub tag: Option<ColourTag>,
    /// How values are rounded to 8 bits.
    pub dither: Dither,
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

/// Bytes of a chunk of pixels in the file.
const CHUNK_BYTES: usize = 1 << 16;

/// Writes the display window of a picture as PNG, from the bands that `fill` hands over: values are clamped to 0 to 1 (NaN
/// to 0) and rounded; what the data window does not have is black, transparent where there is alpha. Returns what `fill` returns. Memory is that of a band.
///
/// The tag becomes the chunks `sRGB`, `gAMA`, `cHRM` and `cICP` as far as they can say it, and an ICC profile where primaries have
/// negative coordinates; `texts`, a key and a value each,
/// become `tEXt`, or `iTXt` beyond Latin-1, with keys as PNG has them (`Software`, `Title`, ...);
/// EXIF becomes `eXIf`. The writer is best
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
    let PngSettings { bits, tag, dither } = settings;
    let [width, height] = picture.windows.display_size;
    let (Ok(columns), Ok(rows)) = (i32::try_from(width), i32::try_from(height)) else {
        return Err(WriteProblem::TooLarge { size: [width, height], format: "PNG" }.into());
    };
    if width == 0 || height == 0 {
        return Err(WriteProblem::NoPixels { size: [width, height] }.into());
    }
    let mut info = Info::with_size(columns.unsigned_abs(), rows.unsigned_abs());
    // The chunk of primaries has no sign: those such as ACES2065-1's blue take a profile.
    info.icc_profile =
        tag.filter(|tag| has_negative(&tag.primaries)).and_then(|tag| icc_write::profile(&tag)).map(Cow::Owned);
    let mut encoder = Encoder::with_info(Steadfast { writer, failed: false }, info).map_err(problem)?;
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
        set_chunks(tag, &mut encoder);
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
    if let Some(points) = tag.as_ref().and_then(code_points) {
        // The crate reads this chunk but does not write it. It comes before the pixels, as it must.
        writer.write_chunk(png::chunk::ChunkType(*b"cICP"), &points).map_err(problem)?;
    }
    if let Some(block) = picture.metadata.exif.block() {
        writer.write_chunk(png::chunk::ChunkType(*b"eXIf"), &block).map_err(problem)?;
    }
    let samples = match bits {
        PngBits::Eight => Samples::Eight(dither),
        PngBits::Sixteen => Samples::Sixteen,
    };
    let mut stream = writer.stream_writer_with_size(CHUNK_BYTES).map_err(problem)?;
    let mut rows = DisplayRows::new(picture, samples, |bytes: &[u8]| {
        stream.write_all(bytes).map_err(|error| WriteProblem::Io(error).into())
    });
    if !fill(&mut rows) {
        return Ok(()); // the caller knows why
    }
    rows.finish()?;
    stream.finish().map_err(problem)?;
    writer.finish().map_err(problem)
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

/// `sRGB` where it is that space, else `gAMA` (the nearest power) and `cHRM`.
fn set_chunks<W: Write>(tag: &ColourTag, encoder: &mut Encoder<'_, W>) {
    if tag.transfer == OutputTransfer::Srgb && code_point(&tag.primaries) == Some(BT709) {
        return encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
    }
    encoder.set_source_gamma(ScaledFloat::new(match tag.transfer {
        OutputTransfer::Srgb => 1.0 / 2.2,
        OutputTransfer::Gamma24 => 1.0 / 2.4,
        OutputTransfer::Gamma26 => 1.0 / 2.6,
        OutputTransfer::Linear => 1.0,
        // No power is near: only cICP says what they are.
        OutputTransfer::Pq | OutputTransfer::Hlg => return,
    }));
    if has_negative(&tag.primaries) {
        return;
    }
    let Chromaticities { red, green, blue, white } = tag.primaries;
    let pair = |[x, y]: [f32; 2]| (x, y);
    encoder.set_source_chromaticities(SourceChromaticities::new(pair(white), pair(red), pair(green), pair(blue)));
}

fn has_negative(Chromaticities { red, green, blue, white }: &Chromaticities) -> bool {
    [red, green, blue, white].into_iter().flatten().any(|v| *v < 0.0)
}

/// The bytes of `cICP`: primaries, transfer, RGB, full range; where H.273 has both code points.
fn code_points(tag: &ColourTag) -> Option<[u8; 4]> {
    let transfer = match tag.transfer {
        OutputTransfer::Srgb => 13,
        OutputTransfer::Linear => 8,
        OutputTransfer::Pq => 16,
        OutputTransfer::Hlg => 18,
        // H.273 has no pure power of 2.4 (its BT.709 point is the camera's curve), and its 2.6 has white at 48/52.37.
        OutputTransfer::Gamma24 | OutputTransfer::Gamma26 => return None,
    };
    Some([code_point(&tag.primaries)?, transfer, 0, 1])
}

/// The code point of the primaries of BT.709 and sRGB.
const BT709: u8 = 1;

/// The code point of H.273 for primaries.
fn code_point(primaries: &Chromaticities) -> Option<u8> {
    let known = [(BT709, Chromaticities::BT709), (9, Chromaticities::BT2020), (12, Chromaticities::P3_D65)];
    known.iter().find(|(_, known)| known.is_near(primaries)).map(|(code, _)| *code)
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
