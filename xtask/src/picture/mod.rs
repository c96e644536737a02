//! Pictures in and out of the runner: OpenEXR, PNG and TIFF to straight `f32` RGB, and back to PNG and OpenEXR.
//!
//! Pictures go through in bands of rows: `open` gives a `PictureReader`, `write_png_bands` and `write_exr_bands` take what was
//! made of its bands. What a file keeps in one piece (a strip of TIFF, a row of tiles, an interlaced PNG) is held in
//! one piece.
//!
//! `open` tells the format by the file's first bytes. Values are those of the file: linear for OpenEXR and float
//! TIFF, coded 0..1 for integers, whose transfer curve the caller undoes. Premultiplied colour is divided by alpha on
//! the way in and multiplied on the way out, so that a look sees the colour of things and not of their coverage.
//!
//! Damaged and lying files give one sentence: sizes are checked against [`Limits`] and the file's length before memory
//! is taken, and a decoder's panic is caught.
//!
//! Out of scope: deep data, subsampled channels, palette, CMYK and JPEG-compressed TIFF, ICC profiles, animation.

mod alpha;
mod band;
mod display;
mod dwa;
mod exr_bands;
mod exr_blocks;
mod exr_boxes;
mod exr_layout;
mod exr_read;
mod exr_write;
mod finished;
mod guard;
mod in_memory;
mod limits;
mod png_read;
mod png_write;
#[cfg(test)]
mod tests;
mod tiff_read;
mod tiff_tags;

use std::{
    fs::{self, File},
    io::{BufRead, BufReader, ErrorKind, Read, Seek, SeekFrom},
    path::{Path, PathBuf},
};

use anyhow::{Result, anyhow, bail};

use self::band::Bands;
pub(crate) use self::{
    band::{Band, BandSink, BandView, Channels, Holds, RowMut},
    exr_write::{write_exr, write_exr_bands},
    finished::text_of_finished,
    png_write::{Bits, Coding, ColourTag, write_png_bands},
};
pub use self::{
    in_memory::{read_picture, write_picture},
    limits::Limits,
};

/// What the formats are called in messages.
const READABLE: &str = "an OpenEXR, PNG or TIFF picture";

/// What a file says of its picture before the pixels.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Description {
    /// Width of the data window, in pixels.
    pub(crate) width: usize,
    /// Height of the data window, in pixels.
    pub(crate) height: usize,
    /// What a pixel holds.
    pub(crate) channels: Channels,
    /// Where the pixels lie and what part of the plane is shown.
    pub(crate) windows: Windows,
    /// The colour space where the file names it.
    pub(crate) primaries: Option<Chromaticities>,
    /// What kind of file it is.
    pub(crate) source: Source,
    /// What the reader chose among several layers or leaves out, a sentence each, for the user.
    pub(crate) notes: Vec<String>,
}

impl Description {
    /// A picture of one window at the origin, of no named primaries.
    fn plain(width: usize, height: usize, channels: Channels, source: Source) -> Self {
        let windows = Windows::of_size(width, height);
        Self { width, height, channels, windows, primaries: None, source, notes: Vec::new() }
    }
}

/// A picture as a file holds it, in memory.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Width of the data window, in pixels.
    pub width: usize,
    /// Height of the data window, in pixels.
    pub height: usize,
    /// `width * height` straight (not premultiplied) colours, top row first; NaN, infinities and negatives are kept.
    pub rgb: Vec<[f32; 3]>,
    /// Coverage, as many as there are colours.
    pub alpha: Option<Vec<f32>>,
    /// Where the pixels lie and what part of the plane is shown.
    pub(crate) windows: Windows,
    /// The colour space of `rgb` where the file names it.
    pub(crate) primaries: Option<Chromaticities>,
    /// What kind of file it was.
    pub(crate) source: Source,
    /// What the reader chose among several layers or left out, a sentence each, for the user.
    pub(crate) notes: Vec<String>,
}

impl Picture {
    /// All but the pixels.
    fn description(&self) -> Description {
        let channels = if self.alpha.is_some() { Channels::Rgba } else { Channels::Rgb };
        Description {
            windows: self.windows,
            primaries: self.primaries,
            ..Description::plain(self.width, self.height, channels, self.source)
        }
    }

    /// All of it as one band.
    fn view(&self) -> BandView<'_> {
        BandView { top: 0, width: self.width, rgb: &self.rgb, alpha: self.alpha.as_deref() }
    }

    /// Opaque colours of one window at the origin, of no named primaries.
    pub(crate) fn opaque(width: usize, height: usize, rgb: Vec<[f32; 3]>, source: Source) -> Self {
        let windows = Windows::of_size(width, height);
        Self { width, height, rgb, alpha: None, windows, primaries: None, source, notes: Vec::new() }
    }
}

/// The windows of OpenEXR: pixels are given in the data window, the display window is what a viewer shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Windows {
    /// Column and row of the first pixel.
    pub(crate) data_origin: [i32; 2],
    /// Column and row of the first pixel shown.
    pub(crate) display_origin: [i32; 2],
    /// Width and height of what is shown, in pixels.
    pub(crate) display_size: [usize; 2],
    /// Width of a pixel divided by its height.
    pub(crate) pixel_aspect: f32,
}

impl Windows {
    /// Both windows the same, at the origin.
    pub(crate) fn of_size(width: usize, height: usize) -> Self {
        Self { data_origin: [0; 2], display_origin: [0; 2], display_size: [width, height], pixel_aspect: 1.0 }
    }
}

/// CIE 1931 xy of an RGB space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Chromaticities {
    /// The red primary.
    pub(crate) red: [f32; 2],
    /// The green primary.
    pub(crate) green: [f32; 2],
    /// The blue primary.
    pub(crate) blue: [f32; 2],
    /// The white point.
    pub(crate) white: [f32; 2],
}

/// The kind of file a picture came from, which hints at its transfer curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Source {
    /// OpenEXR: linear by convention.
    Exr,
    /// PNG of 8 or 16 bits a sample (fewer are widened to 8): display-coded unless it says otherwise.
    Png {
        /// Bits a sample.
        bits: u8,
    },
    /// TIFF.
    Tiff {
        /// Bits a sample.
        bits: u8,
        /// How the samples are stored.
        samples: Samples,
    },
}

/// How a TIFF stores its samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Samples {
    /// Unsigned integers, given as 0..1.
    Integer,
    /// Floating point, given as they are.
    Float,
}

/// An open picture: what it is, and its rows from top to bottom.
pub(crate) struct PictureReader<'a> {
    description: Description,
    bands: Box<dyn Bands + 'a>,
    path: PathBuf,
}

/// Opens the picture in the file `path`; its pixels are values of the file, colours straight (not premultiplied), NaN,
/// infinities and negatives kept.
///
/// # Errors
/// One sentence that starts with `path`: no such file, a folder, another format, a picture over `limits` or one that
/// the file is too short to hold, damaged or truncated data, or a feature that is not read.
pub(crate) fn open(path: &Path, limits: &Limits) -> Result<PictureReader<'static>> {
    let opened = open_file(path).and_then(|(file, length)| open_from(BufReader::new(file), length, limits));
    let (description, bands) = opened.map_err(|error| at(path, &error))?;
    Ok(PictureReader { description, bands, path: path.to_owned() })
}

impl PictureReader<'_> {
    /// What the file says of the picture.
    pub(crate) fn description(&self) -> &Description {
        &self.description
    }

    /// What [`next_into`](Self::next_into) takes.
    pub(crate) fn holds(&self) -> Holds {
        self.bands.holds()
    }

    /// Fills `band` with the next rows, top to bottom; without rows after the last.
    ///
    /// # Errors
    /// One sentence that starts with the path: damaged or truncated data, or no memory.
    pub(crate) fn next_into(&mut self, band: &mut Band) -> Result<()> {
        self.bands.next_into(band).map_err(|error| at(&self.path, &error))
    }
}

/// Reads the whole picture in the file `path`.
#[cfg(test)]
pub(crate) fn read(path: &Path, limits: &Limits) -> Result<Picture> {
    let (file, length) = open_file(path).map_err(|error| at(path, &error))?;
    in_memory::read_from(BufReader::new(file), length, limits).map_err(|error| at(path, &error))
}

/// Opens a picture of `length` bytes from `reader`, which is at its start.
fn open_from<'a, R: BufRead + Seek + Send + 'a>(
    mut reader: R,
    length: u64,
    limits: &Limits,
) -> Result<(Description, Box<dyn Bands + 'a>)> {
    let mut start = Vec::new();
    reader.by_ref().take(16).read_to_end(&mut start).map_err(|error| cannot_read(&error))?;
    reader.seek(SeekFrom::Start(0)).map_err(|error| cannot_read(&error))?;
    match &start[..] {
        [] => bail!("the file is empty, expected {READABLE}"),
        [0x76, 0x2f, 0x31, 0x01, ..] => exr_read::open(reader, length, limits),
        [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n', ..] => png_read::open(reader, length, limits),
        [b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..] => tiff_read::open(reader, length, limits),
        other => {
            bail!("found {} by its first bytes, expected {READABLE}", kind_of_file(other))
        }
    }
}

fn at(path: &Path, error: &anyhow::Error) -> anyhow::Error {
    anyhow!("{}: {error:#}", path.display())
}

fn open_file(path: &Path) -> Result<(File, u64)> {
    let found = fs::metadata(path).map_err(|error| cannot_read(&error))?;
    if found.is_dir() {
        bail!("is a folder, expected {READABLE}");
    }
    // A pipe has no length to check claims against, and cannot seek.
    if !found.is_file() {
        bail!("is not a regular file, expected {READABLE}");
    }
    let file = File::open(path).map_err(|error| cannot_read(&error))?;
    Ok((file, found.len()))
}

/// A name for the formats a user may well try.
fn kind_of_file(start: &[u8]) -> &'static str {
    match start {
        [0xff, 0xd8, 0xff, ..] => "a JPEG picture",
        [b'#', b'?', ..] => "a Radiance HDR picture",
        [b'S', b'D', b'P', b'X', ..] | [b'X', b'P', b'D', b'S', ..] => "a DPX picture",
        [b'G', b'I', b'F', b'8', ..] => "a GIF picture",
        [b'B', b'M', ..] => "a BMP picture",
        [b'R', b'I', b'F', b'F', ..] => "a WebP or other RIFF file",
        [b'8', b'B', b'P', b'S', ..] => "a Photoshop file",
        [b'P', b'1'..=b'7' | b'F' | b'f', ..] => "a PNM or PFM picture",
        [_, _, _, _, b'f', b't', b'y', b'p', ..] => "an HEIF, AVIF or video file",
        _ => "an unknown format",
    }
}

/// The sentence for an input or output error while reading.
fn cannot_read(error: &std::io::Error) -> anyhow::Error {
    match error.kind() {
        ErrorKind::NotFound => anyhow!("there is no such file, expected {READABLE}"),
        ErrorKind::UnexpectedEof => anyhow!("the file ends too early (is it truncated?)"),
        _ => anyhow!("cannot be read: {error}"),
    }
}
