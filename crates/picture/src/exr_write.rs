//! Writing OpenEXR.

use std::io::{Seek, SeekFrom, Write};

use exr::{
    block::{BlockIndex, UncompressedBlock, chunk::Chunk, writer::ChunksWriter},
    compression::Compression,
    math::Vec2,
    meta::{
        BlockDescription, MetaData,
        attribute::{
            self, AttributeValue, ChannelDescription, Chromaticities as Primaries, IntegerBounds, LineOrder,
            SampleType, Text,
        },
        header::{Header, ImageAttributes, LayerAttributes},
    },
};
use rayon::prelude::*;

use crate::{
    alpha::premultiplied,
    band::BandView,
    band_sink::{BandSink, Fill, filled_by},
    description::{Channels, Description},
    error::{Error, WriteProblem},
    limits::grow,
    metadata::ExrAttribute,
};

/// Rows of a block of ZIP.
const BLOCK_ROWS: usize = 16;

/// Writes a picture as a linear OpenEXR file of `f32` RGB or premultiplied RGBA, ZIP-compressed, with its windows,
/// primaries and white luminance, from the bands that `fill` hands over; what `fill` returns. Memory is that of a band.
///
/// Nothing is clipped. `texts` become string attributes, of a key and a value each; `Software` is the standard one of that
/// name. The crate below keeps others in unordered maps, one of the part and one of the picture: two have a fixed order, so
/// that the same picture is always the same file, and a third is refused. Attributes that were read are kept. The writer is best
/// buffered; it is flushed, and left anywhere.
///
/// ```
/// use std::io::Cursor;
///
/// use onelight_picture::{BandView, Channels, Description, Error, Source, write_exr};
///
/// let picture = Description::new(64, 48, Channels::Rgb, Source::Exr);
/// let mut file = Cursor::new(Vec::new());
/// write_exr(&mut file, &picture, &[("Software", "a test")], |sink| {
///     for top in 0..48 {
///         let row = [[top as f32 / 48.0; 3]; 64];
///         sink.write(BandView { top, width: 64, rgb: &row, alpha: None })?;
///     }
///     Ok::<(), Error>(())
/// })?;
/// # assert!(file.into_inner().starts_with(b"\x76\x2f\x31\x01"));
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
/// What `fill` says; or bands, sizes, windows or texts that fit neither each other nor the format, or a writer that fails.
/// What was written by then is no picture.
pub fn write_exr<T, E: From<Error>>(
    mut writer: impl Write + Seek + Send,
    picture: &Description,
    texts: &[(&str, &str)],
    fill: impl FnOnce(&mut dyn BandSink) -> Result<T, E>,
) -> Result<T, E> {
    filled_by(fill, |fill| write_bands(&mut writer, picture, texts, fill))
}

/// A writer of one type, so that all of this is compiled once, here.
trait WriteSeek: Write + Seek + Send {}

impl<W: Write + Seek + Send> WriteSeek for W {}

fn write_bands(
    writer: &mut dyn WriteSeek,
    picture: &Description,
    texts: &[(&str, &str)],
    fill: Fill<'_>,
) -> Result<(), Error> {
    check_windows(picture)?;
    let header = header(picture, texts)?;
    let (kept, strict) = (kept_in_order(picture, &header)?, picture.metadata.exr.is_empty());
    let headers = std::iter::once(header).collect();
    let mut unfinished = None;
    // Its strict checks let nobody write the standard's attributes as they were read.
    let written = exr::block::write(&mut *writer, headers, strict, |meta, chunks| {
        let mut blocks = ExrBlocks { chunks, meta: &meta, channels: picture.channels, rows: Vec::new(), row: 0 };
        // The crate's own error has no room for ours.
        if !fill(&mut blocks) {
            return Err(exr::error::Error::Aborted);
        }
        blocks.finish().map_err(|error| {
            unfinished = Some(error);
            exr::error::Error::Aborted
        })
    });
    match unfinished {
        Some(error) => return Err(error),
        None => written.map_err(cannot_write)?,
    }
    if let Some(attributes) = kept {
        writer.seek(SeekFrom::Start(ATTRIBUTES_AT)).map_err(WriteProblem::Io)?;
        writer.write_all(&attributes).map_err(WriteProblem::Io)?;
        writer.flush().map_err(WriteProblem::Io)?;
    }
    Ok(())
}

/// Where the attributes begin: after the magic number and the version.
const ATTRIBUTES_AT: u64 = 8;

/// The attributes of a header by name, where there are more than have an order: the crate keeps them in a map of none, and the same
/// picture is to be the same file.
fn kept_in_order(picture: &Description, header: &Header) -> Result<Option<Vec<u8>>, Error> {
    if picture.metadata.exr.is_empty() {
        return Ok(None);
    }
    let mut attributes = Vec::new();
    for (name, value) in header.all_named_attributes() {
        let mut bytes = Vec::new();
        attribute::write(name, &value, &mut bytes).map_err(cannot_write)?;
        attributes.push(bytes);
    }
    // Each begins with its name and a zero.
    attributes.sort();
    Ok(Some(attributes.concat()))
}

/// Refuses windows without pixels, and those that 32 bits cannot say, on which the crate below panics.
fn check_windows(picture: &Description) -> Result<(), Error> {
    let Description { width, height, windows, .. } = picture;
    for (origin, size) in [(windows.data_origin, [*width, *height]), (windows.display_origin, windows.display_size)] {
        if size.contains(&0) {
            return Err(WriteProblem::NoPixels { size }.into());
        }
        let fits = |axis: usize| i32::try_from(size[axis]).ok().and_then(|size| origin[axis].checked_add(size));
        if fits(0).is_none() || fits(1).is_none() {
            return Err(WriteProblem::TooLarge { size, format: "OpenEXR" }.into());
        }
    }
    Ok(())
}

/// The blocks of a file as their rows come.
struct ExrBlocks<'a, W> {
    chunks: &'a mut W,
    meta: &'a MetaData,
    channels: Channels,
    /// Rows as the file has them, uncompressed, of blocks that are not whole yet.
    rows: Vec<u8>,
    /// The next row to come.
    row: usize,
}

impl<W: ChunksWriter + Send> BandSink for ExrBlocks<'_, W> {
    fn write(&mut self, band: BandView<'_>) -> Result<(), Error> {
        let Vec2(width, height) = self.header().layer_size;
        let rows = band.checked_rows(self.row, [width, height], self.channels)?;
        let row_bytes = self.row_bytes();
        let before = self.rows.len();
        grow(&mut self.rows, before + rows * row_bytes, 0)?;
        self.rows[before..]
            .par_chunks_exact_mut(row_bytes)
            .enumerate()
            .for_each(|(row, bytes)| fill_row(bytes, band.row(row)));
        self.row += rows;
        let whole = self.rows.len() / row_bytes / BLOCK_ROWS * BLOCK_ROWS;
        self.compress(if self.row == height { self.rows.len() / row_bytes } else { whole })
    }
}

impl<W: ChunksWriter> ExrBlocks<'_, W> {
    fn header(&self) -> &Header {
        &self.meta.headers[0]
    }

    fn row_bytes(&self) -> usize {
        self.header().layer_size.0 * self.header().channels.bytes_per_pixel
    }

    /// Compresses and writes the first `rows` of those that wait: whole blocks, or the picture's last.
    fn compress(&mut self, rows: usize) -> Result<(), Error> {
        let row_bytes = self.row_bytes();
        let width = self.header().layer_size.0;
        let first = self.row - self.rows.len() / row_bytes;
        let packed: Vec<Chunk> = self.rows[..rows * row_bytes]
            .par_chunks(BLOCK_ROWS * row_bytes)
            .enumerate()
            .map(|(block, data)| {
                let index = BlockIndex {
                    layer: 0,
                    pixel_position: Vec2(0, first + block * BLOCK_ROWS),
                    pixel_size: Vec2(width, data.len() / row_bytes),
                    level: Vec2(0, 0),
                };
                UncompressedBlock { index, data: data.to_vec() }.compress_to_chunk(&self.meta.headers)
            })
            .collect::<Result<_, _>>()
            .map_err(cannot_write)?;
        for (index, chunk) in (first / BLOCK_ROWS..).zip(packed) {
            self.chunks.write_chunk(index, chunk).map_err(cannot_write)?;
        }
        self.rows.drain(..rows * row_bytes);
        Ok(())
    }

    fn finish(&self) -> Result<(), Error> {
        let Vec2(width, height) = self.header().layer_size;
        if self.row != height {
            return Err(WriteProblem::RowsMissing { size: [width, height], rows: self.row }.into());
        }
        Ok(())
    }
}

/// Fills in a row: the channels one after the other, by their names.
fn fill_row(bytes: &mut [u8], (rgb, alpha): (&[[f32; 3]], Option<&[f32]>)) {
    let (words, _) = bytes.as_chunks_mut::<4>();
    let mut planes = words.chunks_exact_mut(rgb.len().max(1));
    let mut put = |values: &mut dyn Iterator<Item = f32>| {
        let words = planes.next().unwrap_or_default();
        words.iter_mut().zip(values).for_each(|(word, value)| *word = value.to_ne_bytes());
    };
    if let Some(alpha) = alpha {
        put(&mut alpha.iter().copied());
    }
    for channel in [2, 1, 0] {
        match alpha {
            Some(alpha) => put(&mut rgb.iter().zip(alpha).map(|(rgb, alpha)| premultiplied(*rgb, *alpha)[channel])),
            None => put(&mut rgb.iter().map(|rgb| rgb[channel])),
        }
    }
}

fn header(picture: &Description, texts: &[(&str, &str)]) -> Result<Header, Error> {
    let names: &[&str] = match picture.channels {
        Channels::Rgb => &["B", "G", "R"],
        Channels::Rgba => &["A", "B", "G", "R"],
    };
    let channels = names.iter().map(|name| ChannelDescription::named(*name, SampleType::F32)).collect();
    let [x, y] = picture.windows.data_origin;
    let mut own = LayerAttributes::default().with_position(Vec2(x, y));
    own.white_luminance = picture.white_luminance;
    let mut shared = shared_attributes(picture);
    add_texts(texts, &mut own, &mut shared)?;
    for ExrAttribute { name, kind, bytes } in &picture.metadata.exr {
        let (Some(name), Some(kind)) = (Text::new_or_none(name), Text::new_or_none(kind)) else { continue };
        let value = AttributeValue::Custom { kind, bytes: bytes.as_slice().into() };
        if !shared.other.contains_key(&name) {
            own.other.entry(name).or_insert(value);
        }
    }
    Ok(Header::new(Text::default(), (picture.width, picture.height), channels)
        .with_encoding(Compression::ZIP16, BlockDescription::ScanLines, LineOrder::Increasing)
        .with_attributes(own)
        .with_shared_attributes(shared))
}

fn cannot_write(error: exr::error::Error) -> Error {
    match error {
        exr::error::Error::Io(error) => WriteProblem::Io(error),
        other => WriteProblem::Encoder(other.to_string()),
    }
    .into()
}

fn add_texts(texts: &[(&str, &str)], own: &mut LayerAttributes, shared: &mut ImageAttributes) -> Result<(), Error> {
    for (key, value) in texts {
        let text =
            |string: &str| Text::new_or_none(string).ok_or_else(|| WriteProblem::NotLatin1 { key: (*key).to_owned() });
        if key.is_empty() || key.len() > 255 {
            return Err(WriteProblem::KeyLength { bytes: key.len() }.into());
        }
        let (name, value) = (text(key)?, text(value)?);
        if *key == "Software" {
            own.software_name = Some(value);
        } else if own.other.is_empty() {
            own.other.insert(name, AttributeValue::Text(value));
        } else if shared.other.is_empty() {
            shared.other.insert(name, AttributeValue::Text(value));
        } else {
            return Err(WriteProblem::ThirdText { key: (*key).to_owned() }.into());
        }
    }
    Ok(())
}

fn shared_attributes(picture: &Description) -> ImageAttributes {
    let windows = &picture.windows;
    let ([x, y], [width, height]) = (windows.display_origin, windows.display_size);
    let mut attributes = ImageAttributes::new(IntegerBounds::new((x, y), (width, height)));
    attributes.pixel_aspect = windows.pixel_aspect;
    let point = |[x, y]: [f32; 2]| Vec2(x, y);
    attributes.chromaticities = picture.primaries.map(|xy| Primaries {
        red: point(xy.red),
        green: point(xy.green),
        blue: point(xy.blue),
        white: point(xy.white),
    });
    attributes
}
