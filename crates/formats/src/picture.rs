use std::io::{Cursor, Read, Write};

use png::{BitDepth, ColorType, Decoder, DecodingError, Encoder, EncodingError, Limits, Transformations};

use crate::error::{Error, ErrorKind};
use crate::text::{foreign_message, printable};

/// The most bytes of a PNG file that are read.
const MAX_BYTES: u64 = 1 << 28;

/// The most bytes that the decoder may take beside the picture itself.
const WORKING_BYTES: usize = 1 << 26;

/// More than Deflate can give for one byte.
const EXPANSION: usize = 1100;

/// Bits of each of the three numbers of a pixel: how finely a picture can hold a table's entries.
///
/// ```
/// use onelight_formats::{PngDepth, hald};
///
/// let table = onelight_lut::Lut3d::identity(9)?;
/// let [mut fine, mut coarse] = [Vec::new(), Vec::new()];
/// hald::write(&mut fine, &table, PngDepth::Sixteen, [""; 0])?;
/// hald::write(&mut coarse, &table, PngDepth::Eight, [""; 0])?;
/// let [fine, coarse] = [hald::read(fine.as_slice())?, hald::read(coarse.as_slice())?];
/// assert_eq!(fine.entry([1, 0, 0]).map(|rgb| rgb[0]), Some(8192.0 / 65_535.0));
/// assert_eq!(coarse.entry([1, 0, 0]).map(|rgb| rgb[0]), Some(32.0 / 255.0));
/// # Ok::<(), onelight_formats::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PngDepth {
    /// Codes from 0 to 255.
    Eight,
    /// Codes from 0 to 65535.
    #[default]
    Sixteen,
}

impl PngDepth {
    /// The code that stands for 1.
    fn max(self) -> f32 {
        match self {
            Self::Eight => 255.0,
            Self::Sixteen => 65_535.0,
        }
    }
}

/// Writes pixels, row by row from the top, clamped to 0 to 1 and rounded to the nearest code.
///
/// The comments go into one text of the keyword Comment.
pub(super) fn write<S: AsRef<str>>(
    writer: impl Write,
    [width, height]: [usize; 2],
    depth: PngDepth,
    pixels: impl Iterator<Item = [f32; 3]>,
    comments: impl IntoIterator<Item = S>,
) -> Result<(), Error> {
    // The largest table has 4096 pixels a side as a Hald, and 65536 in a row as a strip.
    let mut encoder = Encoder::new(writer, width as u32, height as u32);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(match depth {
        PngDepth::Eight => BitDepth::Eight,
        PngDepth::Sixteen => BitDepth::Sixteen,
    });
    let comments: Vec<String> = comments.into_iter().map(|text| printable(text.as_ref())).collect();
    if !comments.is_empty() {
        encoder.add_itxt_chunk("Comment".to_owned(), comments.join("\n")).map_err(encoding)?;
    }
    let mut bytes = Vec::with_capacity(6 * width * height);
    for value in pixels.flatten() {
        let code = (value.clamp(0.0, 1.0) * depth.max()).round();
        match depth {
            PngDepth::Eight => bytes.push(code as u8),
            PngDepth::Sixteen => bytes.extend((code as u16).to_be_bytes()),
        }
    }
    let mut out = encoder.write_header().map_err(encoding)?;
    out.write_image_data(&bytes).map_err(encoding)?;
    out.finish().map_err(encoding)
}

/// A picture's size and its pixels, row by row from the top, 0 to 1.
pub(super) struct Picture {
    pub(super) width: usize,
    pub(super) pixels: Vec<[f32; 3]>,
}

/// Reads a picture whose width and height `check` accepts, before anything of that size is allocated.
pub(super) fn read<T>(
    input: impl Read,
    check: impl FnOnce(usize, usize) -> Result<T, Error>,
) -> Result<(T, Picture), Error> {
    let mut file = Vec::new();
    input.take(MAX_BYTES + 1).read_to_end(&mut file)?;
    if file.len() as u64 > MAX_BYTES {
        return Err(refuse("length of a PNG file", format!("more than {MAX_BYTES} bytes"), "at most 256 MiB"));
    }
    let mut decoder = Decoder::new_with_limits(Cursor::new(&file), Limits { bytes: WORKING_BYTES });
    decoder.set_transformations(Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    decoder.set_ignore_iccp_chunk(true);
    let header = decoder.read_header_info().map_err(|error| decoding(&error))?;
    let (width, height) = (header.width as usize, header.height as usize);
    let checked = check(width, height)?;
    let mut reader = decoder.read_info().map_err(|error| decoding(&error))?;
    let (colour, depth) = reader.output_color_type();
    let channels = match colour {
        ColorType::Grayscale => 1,
        ColorType::GrayscaleAlpha => 2,
        ColorType::Rgb => 3,
        ColorType::Rgba => 4,
        ColorType::Indexed => return Err(refuse("colours of a PNG that holds a table", "a palette".to_owned(), "RGB")),
    };
    let size = reader.output_buffer_size().unwrap_or(usize::MAX);
    if size / EXPANSION > file.len() {
        return Err(refuse("PNG data", format!("{} bytes for {width} x {height} pixels", file.len()), "a whole file"));
    }
    let mut bytes = vec![0; size];
    reader.next_frame(&mut bytes).map_err(|error| decoding(&error))?;
    let pixels = if depth == BitDepth::Sixteen {
        colours(channels, &bytes, |word: [u8; 2]| f32::from(u16::from_be_bytes(word)) / PngDepth::Sixteen.max())
    } else {
        colours(channels, &bytes, |[byte]: [u8; 1]| f32::from(byte) / PngDepth::Eight.max())
    };
    Ok((checked, Picture { width, pixels }))
}

/// Colours from samples of `N` bytes, one or three a pixel; what coverage there is does not matter.
fn colours<const N: usize>(channels: usize, bytes: &[u8], value: impl Fn([u8; N]) -> f32) -> Vec<[f32; 3]> {
    let (samples, _) = bytes.as_chunks::<N>();
    let colour = |pixel: &[[u8; N]]| match pixel {
        [r, g, b, ..] => Some([*r, *g, *b].map(&value)),
        [grey, ..] => Some([value(*grey); 3]),
        [] => None,
    };
    samples.chunks_exact(channels).filter_map(colour).collect()
}

/// The error for a picture that is not a table.
pub(super) fn refuse(what: &'static str, found: String, expected: &'static str) -> Error {
    ErrorKind::Picture { what, found, expected }.into()
}

fn decoding(error: &DecodingError) -> Error {
    // The crate prints the innards of its chunk type.
    let text = foreign_message(&error.to_string());
    let detail = text.split("ChunkType").next().unwrap_or_default().trim_end_matches([':', ' ', '.']);
    let detail = detail.trim_end_matches(" while decoding");
    refuse("PNG data", if detail.is_empty() { "damage" } else { detail }.to_owned(), "a whole PNG file")
}

fn encoding(error: EncodingError) -> Error {
    match error {
        EncodingError::IoError(error) => error.into(),
        other => std::io::Error::other(other).into(),
    }
}
