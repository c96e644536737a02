//! Writing OpenEXR.

use std::{
    io::{Seek, Write},
    path::Path,
};

use anyhow::{Result, anyhow, bail};
use exr::{
    block::{BlockIndex, UncompressedBlock, chunk::Chunk, writer::ChunksWriter},
    compression::Compression,
    math::Vec2,
    meta::{
        BlockDescription, MetaData,
        attribute::{
            AttributeValue, ChannelDescription, Chromaticities as Primaries, IntegerBounds, LineOrder, SampleType, Text,
        },
        header::{Header, ImageAttributes, LayerAttributes},
    },
};
use rayon::prelude::*;

use super::{BandSink, BandView, Channels, Description, Picture, alpha::premultiplied, limits::grow};
use crate::whole::write_whole;

/// Rows of a block of ZIP.
const BLOCK_ROWS: usize = 16;

/// Writes `picture` as a linear OpenEXR file of `f32` RGB or premultiplied RGBA, ZIP-compressed, with its windows and
/// primaries.
///
/// Nothing is clipped. `texts` become string attributes; `Software` is the standard one of that name. The crate keeps
/// others in unordered maps, one of the part and one of the picture: two have a fixed order, a third is refused.
///
/// # Errors
/// One sentence that starts with `path`: see [`write_whole`]; or a picture whose sizes do not fit each other or the
/// format, or texts as above.
pub(crate) fn write_exr(path: &Path, picture: &Picture, texts: &[(&str, &str)]) -> Result<()> {
    write_whole(path, |file| write_to(file, picture, texts))
}

/// Writes as [`write_exr`] what `fill` hands over, band by band; what `fill` returns.
///
/// # Errors
/// As [`write_exr`], and what `fill` says, which is not given a path: it has its own.
pub(crate) fn write_exr_bands<T>(
    path: &Path,
    picture: &Description,
    texts: &[(&str, &str)],
    fill: impl FnOnce(&mut dyn BandSink) -> Result<T>,
) -> Result<T> {
    write_whole(path, |file| write_bands_to(file, picture, texts, fill))
}

/// The same to any writer.
pub(super) fn write_to(writer: impl Write + Seek + Send, picture: &Picture, texts: &[(&str, &str)]) -> Result<()> {
    write_bands_to(writer, &picture.description(), texts, |sink| sink.write(picture.view()))
}

/// The same to any writer.
pub(super) fn write_bands_to<T>(
    writer: impl Write + Seek + Send,
    picture: &Description,
    texts: &[(&str, &str)],
    fill: impl FnOnce(&mut dyn BandSink) -> Result<T>,
) -> Result<T> {
    if picture.width == 0 || picture.height == 0 {
        bail!("a picture of {} x {} pixels cannot be written", picture.width, picture.height);
    }
    let headers = std::iter::once(header(picture, texts)?).collect();
    let mut filled = None;
    let written = exr::block::write(writer, headers, true, |meta, chunks| {
        let mut blocks = ExrBlocks { chunks, meta: &meta, channels: picture.channels, rows: Vec::new(), row: 0 };
        let outcome = fill(&mut blocks).and_then(|value| blocks.finish().map(|()| value));
        let done = outcome.is_ok();
        filled = Some(outcome);
        // The crate's own error has no room for ours.
        if done { Ok(()) } else { Err(exr::error::Error::Aborted) }
    });
    match (filled, written) {
        (Some(Err(error)), _) => Err(error),
        (Some(Ok(value)), Ok(())) => Ok(value),
        (_, Err(error)) => Err(cannot_write(&error)),
        (None, Ok(())) => bail!("the picture was not written"),
    }
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
    fn write(&mut self, band: BandView<'_>) -> Result<()> {
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
    fn compress(&mut self, rows: usize) -> Result<()> {
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
            .map_err(|error| cannot_write(&error))?;
        for (index, chunk) in (first / BLOCK_ROWS..).zip(packed) {
            self.chunks.write_chunk(index, chunk).map_err(|error| cannot_write(&error))?;
        }
        self.rows.drain(..rows * row_bytes);
        Ok(())
    }

    fn finish(&self) -> Result<()> {
        let Vec2(width, height) = self.header().layer_size;
        if self.row != height {
            bail!("a picture of {width} x {height} pixels with {} rows cannot be written", self.row);
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

fn header(picture: &Description, texts: &[(&str, &str)]) -> Result<Header> {
    let names: &[&str] = match picture.channels {
        Channels::Rgb => &["B", "G", "R"],
        Channels::Rgba => &["A", "B", "G", "R"],
    };
    let channels = names.iter().map(|name| ChannelDescription::named(*name, SampleType::F32)).collect();
    let [x, y] = picture.windows.data_origin;
    let mut own = LayerAttributes::default().with_position(Vec2(x, y));
    let mut shared = shared_attributes(picture);
    add_texts(texts, &mut own, &mut shared)?;
    Ok(Header::new(Text::default(), (picture.width, picture.height), channels)
        .with_encoding(Compression::ZIP16, BlockDescription::ScanLines, LineOrder::Increasing)
        .with_attributes(own)
        .with_shared_attributes(shared))
}

fn cannot_write(error: &exr::error::Error) -> anyhow::Error {
    anyhow!("cannot be written: {error}")
}

fn add_texts(texts: &[(&str, &str)], own: &mut LayerAttributes, shared: &mut ImageAttributes) -> Result<()> {
    for (key, value) in texts {
        let text = |string: &str| {
            Text::new_or_none(string)
                .ok_or_else(|| anyhow!("the text `{key}` cannot be written, as it has characters beyond Latin-1"))
        };
        if key.is_empty() || key.len() > 255 {
            bail!("a text's key has {} bytes, expected 1 to 255", key.len());
        }
        let (name, value) = (text(key)?, text(value)?);
        if *key == "Software" {
            own.software_name = Some(value);
        } else if own.other.is_empty() {
            own.other.insert(name, AttributeValue::Text(value));
        } else if shared.other.is_empty() {
            shared.other.insert(name, AttributeValue::Text(value));
        } else {
            bail!("the text `{key}` cannot be written, as it is the third beside `Software`, expected two at most");
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
