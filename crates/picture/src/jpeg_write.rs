//! Writing JPEG.

use std::io::Write;

use jpeg_encoder::{ColorType, Encoder, EncodingError, SamplingFactor};

use crate::{
    band_sink::{BandSink, Fill, filled_by},
    colour_tag::ColourTag,
    description::{Channels, Description},
    display_rows::{DisplayRows, Samples},
    dither::Dither,
    error::{Error, WriteProblem},
    icc_write,
    metadata_text::{TEXT_MARK, TEXT_SEGMENT, text_line},
};

/// How a JPEG is written: baseline, colour of full resolution.
///
/// ```
/// use onelight_picture::JpegSettings;
///
/// assert_eq!(JpegSettings::default().quality, 95);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JpegSettings {
    /// 1 to 100, of the scale that libjpeg made usual; what lies outside is taken for the nearer end.
    pub quality: u8,
    /// What the file says of its values, in an ICC profile; by default it says nothing, which viewers take for sRGB.
    pub tag: Option<ColourTag>,
    /// How values are rounded to 8 bits before they are compressed.
    pub dither: Dither,
}

impl Default for JpegSettings {
    fn default() -> Self {
        Self { quality: 95, tag: None, dither: Dither::None }
    }
}

/// Writes the display window of a picture as JPEG, from the bands that `fill` hands over: values are clamped to 0 to 1 (NaN
/// to 0); what the data window does not have is black. Returns what `fill` returns. The picture is held whole, in 3 bytes a
/// pixel, until it is compressed.
///
/// The tag becomes an ICC profile of a matrix and a curve; `texts`, a key and a value each, become application segments
/// of up to 65 533 bytes, as does EXIF.
///
/// ```
/// use onelight_picture::{BandView, Channels, Description, Error, JpegSettings, Source, write_jpeg};
///
/// let picture = Description::new(2, 1, Channels::Rgb, Source::Exr);
/// let mut file = Vec::new();
/// write_jpeg(&mut file, &picture, JpegSettings::default(), &[], |sink| {
///     sink.write(BandView { top: 0, width: 2, rgb: &[[0.5; 3]; 2], alpha: None })
/// })?;
/// # assert!(file.starts_with(b"\xff\xd8\xff"));
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
/// What `fill` says; or bands or sizes that fit neither each other nor the format (sides up to 65535), a picture with alpha,
/// which JPEG has not, or a writer that fails. What was written by then is no picture.
pub fn write_jpeg<T, E: From<Error>>(
    mut writer: impl Write + Send,
    picture: &Description,
    settings: JpegSettings,
    texts: &[(&str, &str)],
    fill: impl FnOnce(&mut dyn BandSink) -> Result<T, E>,
) -> Result<T, E> {
    filled_by(fill, |fill| write_bands(&mut writer, picture, settings, texts, fill))
}

fn write_bands(
    writer: &mut (dyn Write + Send),
    picture: &Description,
    settings: JpegSettings,
    texts: &[(&str, &str)],
    fill: Fill<'_>,
) -> Result<(), Error> {
    let size = picture.windows.display_size;
    let (Ok(width), Ok(height)) = (u16::try_from(size[0]), u16::try_from(size[1])) else {
        return Err(WriteProblem::TooLarge { size, format: "JPEG" }.into());
    };
    if width == 0 || height == 0 {
        return Err(WriteProblem::NoPixels { size }.into());
    }
    if picture.channels == Channels::Rgba {
        return Err(WriteProblem::Alpha { format: "JPEG" }.into());
    }
    let mut pixels: Vec<u8> = Vec::new();
    let bytes = 3 * usize::from(width) * usize::from(height);
    pixels.try_reserve_exact(bytes).map_err(|_| crate::error::LimitProblem::Memory { bytes })?;
    let mut rows = DisplayRows::new(picture, Samples::Eight(settings.dither), |bytes: &[u8]| {
        pixels.extend_from_slice(bytes);
        Ok(())
    });
    if !fill(&mut rows) {
        return Ok(()); // the caller knows why
    }
    rows.finish()?;
    let mut encoder = Encoder::new(&mut *writer, settings.quality.clamp(1, 100));
    encoder.set_sampling_factor(SamplingFactor::F_1_1);
    encoder.set_optimized_huffman_tables(true);
    if let Some(block) = picture.metadata.exif.block() {
        encoder.add_app_segment(1, [&b"Exif\0\0"[..], &block].concat()).map_err(problem)?;
    }
    if let Some(profile) = settings.tag.as_ref().and_then(icc_write::profile) {
        encoder.add_icc_profile(&profile).map_err(problem)?;
    }
    for (key, value) in texts {
        let segment = [TEXT_MARK, text_line(key, value).as_bytes()].concat();
        encoder.add_app_segment(TEXT_SEGMENT, segment).map_err(problem)?;
    }
    encoder.encode(&pixels, width, height, ColorType::Rgb).map_err(problem)?;
    writer.flush().map_err(|error| WriteProblem::Io(error).into())
}

fn problem(error: EncodingError) -> Error {
    match error {
        EncodingError::IoError(error) => WriteProblem::Io(error),
        other => WriteProblem::Encoder(other.to_string()),
    }
    .into()
}
