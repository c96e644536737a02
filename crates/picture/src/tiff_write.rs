//! Writing TIFF of 8 or 16 bits or floating point.

use std::io::{Seek, SeekFrom, Write};

use crate::{
    band_sink::{BandSink, Fill, filled_by},
    colour_tag::ColourTag,
    description::{Channels, Description},
    display_rows::{DisplayRows, Samples},
    dither::Dither,
    error::{Error, WriteProblem},
    icc_write,
    metadata::{self, EXIF_DIRECTORY, GPS_DIRECTORY, IMAGE_DESCRIPTION, Metadata},
    metadata_text::text_line,
    tiff_directory::RawTag,
};

/// How a TIFF is written.
///
/// ```
/// use onelight_picture::{TiffBits, TiffSettings};
///
/// let settings = TiffSettings { bits: TiffBits::Float, ..TiffSettings::default() };
/// # assert_ne!(settings, TiffSettings::default());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TiffSettings {
    /// What a sample is.
    pub bits: TiffBits,
    /// What the file says of its values, in an ICC profile; by default it says nothing.
    pub tag: Option<ColourTag>,
    /// How values are rounded to 8 bits.
    pub dither: Dither,
}

/// Bits of a sample of a TIFF.
///
/// ```
/// # use onelight_picture::TiffBits;
/// assert_eq!(TiffBits::default(), TiffBits::Sixteen);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum TiffBits {
    /// Codes from 0 to 255.
    Eight,
    /// Codes from 0 to 65535.
    #[default]
    Sixteen,
    /// 32-bit floats, not clamped.
    Float,
}

/// Bytes of a strip, about.
const STRIP_BYTES: usize = 1 << 18;
/// What is kept free below 4 GiB for tags.
const ROOM_FOR_TAGS: u64 = 1 << 24;

/// Writes the display window of a picture as TIFF, uncompressed, with straight alpha, from the bands that `fill` hands over:
/// integers are clamped to 0 to 1 (NaN to 0), floats are written as they are; what the data window does not have is black,
/// transparent where there is alpha. Returns what `fill` returns. Memory is that of a band.
///
/// The tag becomes an ICC profile of a matrix and a curve; of the `texts`, a key and a value each, `Software` becomes the tag
/// of that name, and the others lines of the description, before those of the picture's own; EXIF is kept. The writer is best buffered; it is flushed, and left anywhere.
///
/// ```
/// use std::io::Cursor;
///
/// use onelight_picture::{BandView, Channels, Description, Error, Limits, Picture, Source, TiffSettings, write_tiff};
///
/// let picture = Description::new(2, 1, Channels::Rgb, Source::Exr);
/// let mut file = Cursor::new(Vec::new());
/// write_tiff(&mut file, &picture, TiffSettings::default(), &[("Software", "a test")], |sink| {
///     sink.write(BandView { top: 0, width: 2, rgb: &[[0.0; 3], [1.0, 0.5, 7.0]], alpha: None })
/// })?;
/// assert_eq!(Picture::read(file, "", Limits::default())?.rgb[1][2], 1.0);
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
/// What `fill` says; or bands or sizes that fit neither each other nor the format, which ends at 4 GiB, or a writer that
/// fails. What was written by then is no picture.
pub fn write_tiff<T, E: From<Error>>(
    mut writer: impl Write + Seek + Send,
    picture: &Description,
    settings: TiffSettings,
    texts: &[(&str, &str)],
    fill: impl FnOnce(&mut dyn BandSink) -> Result<T, E>,
) -> Result<T, E> {
    filled_by(fill, |fill| write_bands(&mut writer, picture, settings, texts, fill))
}

/// A writer of one type, so that all of this is compiled once, here.
trait WriteSeek: Write + Seek + Send {}

impl<W: Write + Seek + Send> WriteSeek for W {}

fn write_bands(
    writer: &mut dyn WriteSeek,
    picture: &Description,
    settings: TiffSettings,
    texts: &[(&str, &str)],
    fill: Fill<'_>,
) -> Result<(), Error> {
    let size @ [width, height] = picture.windows.display_size;
    if width == 0 || height == 0 {
        return Err(WriteProblem::NoPixels { size }.into());
    }
    let samples = match settings.bits {
        TiffBits::Eight => Samples::Eight(settings.dither),
        TiffBits::Sixteen => Samples::Sixteen,
        TiffBits::Float => Samples::Float,
    };
    let row_bytes = width.saturating_mul(samples.bytes() * picture.channels.count());
    let bytes = row_bytes as u64 * height as u64;
    if bytes > u64::from(u32::MAX) - ROOM_FOR_TAGS {
        return Err(WriteProblem::TooLarge { size, format: "TIFF, which ends at 4 GiB (OpenEXR does not)" }.into());
    }
    writer.seek(SeekFrom::Start(0)).map_err(WriteProblem::Io)?;
    // Big-endian. The directory is named when it is there, so that a file that was broken off is none.
    writer.write_all(b"MM\0\x2a\0\0\0\0").map_err(WriteProblem::Io)?;
    let mut rows = DisplayRows::new(picture, samples, |bytes: &[u8]| {
        writer.write_all(bytes).map_err(|error| WriteProblem::Io(error).into())
    });
    if !fill(&mut rows) {
        return Ok(()); // the caller knows why
    }
    rows.finish()?;
    let rows_per_strip = (STRIP_BYTES / row_bytes).max(1).min(height);
    let directory = directory(picture, settings, texts, samples, [row_bytes, rows_per_strip]);
    finish(writer, 8 + bytes, directory, &picture.metadata).map_err(|error| WriteProblem::Io(error).into())
}

/// The values of a tag.
enum Values {
    Raw(RawTag),
    Short(Vec<u16>),
    Long(Vec<u32>),
    Ascii(String),
    Undefined(Vec<u8>),
}

fn directory(
    picture: &Description,
    settings: TiffSettings,
    texts: &[(&str, &str)],
    samples: Samples,
    [row_bytes, rows_per_strip]: [usize; 2],
) -> Vec<(u16, Values)> {
    let [width, height] = picture.windows.display_size;
    let count = picture.channels.count();
    let bits = 8 * samples.bytes() as u16;
    let strips = (0..height).step_by(rows_per_strip);
    let format = if samples == Samples::Float { 3 } else { 1 };
    let software: Option<&str> = texts.iter().find(|(key, _)| *key == "Software").map(|(_, value)| *value);
    let others: Vec<String> =
        texts.iter().filter(|(key, _)| *key != "Software").map(|(k, v)| text_line(k, v)).collect();
    let mut tags = vec![
        (256, Values::Long(vec![width as u32])),
        (257, Values::Long(vec![height as u32])),
        (258, Values::Short(vec![bits; count])),
        (259, Values::Short(vec![1])),
        (262, Values::Short(vec![2])),
        (273, Values::Long(strips.clone().map(|row| (8 + row * row_bytes) as u32).collect())),
        (277, Values::Short(vec![count as u16])),
        (278, Values::Long(vec![rows_per_strip as u32])),
        (279, Values::Long(strips.map(|row| (rows_per_strip.min(height - row) * row_bytes) as u32).collect())),
        (284, Values::Short(vec![1])),
        (339, Values::Short(vec![format; count])),
    ];
    let mut description = others.join("\n");
    for tag in &picture.metadata.exif.first {
        if tag.tag == IMAGE_DESCRIPTION {
            let own = String::from_utf8_lossy(&tag.bytes);
            let between = if description.is_empty() { "" } else { "\n" };
            description = format!("{description}{between}{}", own.trim_end_matches('\0'));
        } else {
            tags.push((tag.tag, Values::Raw(tag.clone())));
        }
    }
    if !description.is_empty() {
        tags.push((IMAGE_DESCRIPTION, Values::Ascii(description)));
    }
    if let Some(software) = software {
        tags.push((305, Values::Ascii(software.to_owned())));
    }
    if picture.channels == Channels::Rgba {
        tags.push((338, Values::Short(vec![2])));
    }
    if let Some(profile) = settings.tag.as_ref().and_then(icc_write::profile) {
        tags.push((34_675, Values::Undefined(profile)));
    }
    tags
}

/// Writes the directories: those below the first lie before it.
fn finish(
    writer: &mut dyn WriteSeek,
    at: u64,
    mut tags: Vec<(u16, Values)>,
    metadata: &Metadata,
) -> std::io::Result<()> {
    let mut start = at.next_multiple_of(2);
    let mut file = vec![0; (start - at) as usize];
    for (pointer, own) in [(EXIF_DIRECTORY, &metadata.exif.exif), (GPS_DIRECTORY, &metadata.exif.gps)] {
        if !own.is_empty() {
            tags.push((pointer, Values::Long(vec![start as u32])));
            let bytes = metadata::directory(own, start as u32);
            start += bytes.len() as u64;
            file.extend(bytes);
        }
    }
    tags.sort_by_key(|(tag, _)| *tag);
    file.extend((tags.len() as u16).to_be_bytes());
    let mut beyond = start + 2 + 12 * tags.len() as u64 + 4;
    let mut values = Vec::new();
    for (tag, own) in tags {
        let (kind, count, mut bytes): (u16, usize, Vec<u8>) = match own {
            Values::Short(words) => (3, words.len(), words.iter().flat_map(|word| word.to_be_bytes()).collect()),
            Values::Long(words) => (4, words.len(), words.iter().flat_map(|word| word.to_be_bytes()).collect()),
            Values::Ascii(text) => (2, text.len() + 1, [text.as_bytes(), &[0]].concat()),
            Values::Undefined(bytes) => (7, bytes.len(), bytes),
            Values::Raw(RawTag { kind, count, bytes, .. }) => (kind, count as usize, bytes),
        };
        file.extend([tag.to_be_bytes(), kind.to_be_bytes()].concat());
        file.extend((count as u32).to_be_bytes());
        if bytes.len() > 4 {
            file.extend((beyond as u32).to_be_bytes());
            bytes.resize(bytes.len().next_multiple_of(2), 0);
            beyond += bytes.len() as u64;
            values.extend(bytes);
        } else {
            bytes.resize(4, 0);
            file.extend(bytes);
        }
    }
    file.extend([0; 4]);
    file.extend(values);
    writer.write_all(&file)?;
    writer.flush()?;
    writer.seek(SeekFrom::Start(4))?;
    writer.write_all(&(start as u32).to_be_bytes())?;
    writer.flush()
}
