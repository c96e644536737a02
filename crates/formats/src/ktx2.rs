//! KTX2: a table as a 3D texture for shaders.

use std::io::Write;

use half::f16;

use onelight_lut::Lut3d;

use crate::error::{Error, ErrorKind};
use crate::node_order::node_at;
use crate::text::printable;

/// The first bytes of every file.
const IDENTIFIER: [u8; 12] = *b"\xabKTX 20\xbb\r\n\x1a\n";

/// The number of Vulkan's `VK_FORMAT_R16G16B16A16_SFLOAT`: four half floats.
const FORMAT: u32 = 97;

/// The program that a file names as its writer: the name under which the first files were written.
const WRITER: &str = concat!("onelight-lut ", env!("CARGO_PKG_VERSION"));

/// Bytes of a channel, and of a texel.
const CHANNEL_BYTES: u32 = 2;
const TEXEL_BYTES: usize = 8;

/// Bytes of the header with its index, and of the index of one level.
const HEADER_BYTES: u32 = 80;
const LEVEL_INDEX_BYTES: u32 = 24;

/// Writes a table as a KTX2 3D texture of four halfs a texel (`rgba16float`), without mip levels or compression.
///
/// Red runs along x, green along y, blue along z; alpha is 1. Node 0 and the last lie at texel centres, so a shader reads the
/// texture at [`onelight_lut::texel_centre`]. What the numbers mean is the caller's affair; the file calls them linear, so that nothing
/// decodes them. The comments go into the file's metadata under the key `comment`.
///
/// # Errors
///
/// If an entry is not finite as a half (beyond ±65504), the comments have more than 16 MiB, or the writer fails.
///
/// ```
/// let table = onelight_lut::Lut3d::identity(32)?;
/// let mut file = Vec::new();
/// onelight_formats::ktx2::write(&mut file, &table, ["scene-linear in, sRGB out"])?;
/// assert!(file.starts_with(b"\xabKTX 20\xbb"));
/// # Ok::<(), onelight_formats::Error>(())
/// ```
pub fn write<S: AsRef<str>>(
    mut writer: impl Write,
    table: &Lut3d,
    comments: impl IntoIterator<Item = S>,
) -> Result<(), Error> {
    let size = table.size();
    let too_large = |entry: [f32; 3]| entry.iter().any(|&v| !f16::from_f32(v).is_finite());
    for (index, found) in table.entries().enumerate() {
        if too_large(found) {
            return Err(ErrorKind::Half { node: node_at(index, size), found }.into());
        }
    }
    let comments: Vec<String> = comments.into_iter().map(|text| printable(text.as_ref())).collect();
    let mut file = header(size as u32, table.entries().len(), &comments.join("\n"))?;
    let one = f16::ONE.to_le_bytes();
    for [r, g, b] in table.entries() {
        for value in [r, g, b] {
            file.extend(f16::from_f32(value).to_le_bytes());
        }
        file.extend(one);
        if file.len() >= 1 << 16 {
            writer.write_all(&file)?;
            file.clear();
        }
    }
    writer.write_all(&file)?;
    writer.flush()?;
    Ok(())
}

/// All before the texels, which start at a multiple of their size.
fn header(size: u32, texels: usize, comment: &str) -> Result<Vec<u8>, Error> {
    let descriptor = descriptor();
    let mut metadata = Vec::new();
    key_value(&mut metadata, "KTXwriter", WRITER)?;
    if !comment.is_empty() {
        key_value(&mut metadata, "comment", comment)?;
    }
    let descriptor_at = HEADER_BYTES + LEVEL_INDEX_BYTES;
    let metadata_at = descriptor_at + length(descriptor.len())?;
    let end = metadata_at + length(metadata.len())?;
    let texels_at = end.next_multiple_of(TEXEL_BYTES as u32);

    let mut file = IDENTIFIER.to_vec();
    let [layers, faces, levels, supercompression] = [0, 1, 1, 0];
    for word in [FORMAT, CHANNEL_BYTES, size, size, size, layers, faces, levels, supercompression] {
        file.extend(word.to_le_bytes());
    }
    for (at, bytes) in [(descriptor_at, descriptor.len()), (metadata_at, metadata.len())] {
        file.extend(at.to_le_bytes());
        file.extend(length(bytes)?.to_le_bytes());
    }
    let texel_bytes = (texels * TEXEL_BYTES) as u64;
    let [global_at, global_bytes] = [0, 0];
    for word in [global_at, global_bytes, u64::from(texels_at), texel_bytes, texel_bytes] {
        file.extend(word.to_le_bytes());
    }
    file.extend(descriptor);
    file.extend(metadata);
    file.resize(texels_at as usize, 0);
    Ok(file)
}

/// The data format descriptor: four signed floats of 16 bits, linear.
fn descriptor() -> Vec<u8> {
    const BLOCK_BYTES: u32 = 24 + 4 * 16;
    const VERSION: u32 = 2;
    const MODEL_RGBSDA: u8 = 1;
    const PRIMARIES_BT709: u8 = 1;
    const TRANSFER_LINEAR: u8 = 1;
    const ALPHA_STRAIGHT: u8 = 0;
    /// Channels of the RGBSDA model: red, green, blue, alpha.
    const CHANNELS: [u32; 4] = [0, 1, 2, 15];
    const SIGNED_FLOAT: u32 = 0xc0;

    let mut bytes = Vec::new();
    for word in [4 + BLOCK_BYTES, 0, VERSION | (BLOCK_BYTES << 16)] {
        bytes.extend(word.to_le_bytes());
    }
    bytes.extend([MODEL_RGBSDA, PRIMARIES_BT709, TRANSFER_LINEAR, ALPHA_STRAIGHT]);
    let block_of_one_texel = [0; 4];
    bytes.extend(block_of_one_texel);
    bytes.extend([TEXEL_BYTES as u8, 0, 0, 0, 0, 0, 0, 0]);
    for (i, channel) in (0..).zip(CHANNELS) {
        let [offset, bits_less_one] = [16 * i, 15];
        let place = offset | (bits_less_one << 16) | ((channel | SIGNED_FLOAT) << 24);
        let position = 0;
        let [lower, upper] = [-1.0_f32, 1.0].map(f32::to_bits);
        for word in [place, position, lower, upper] {
            bytes.extend(word.to_le_bytes());
        }
    }
    bytes
}

/// Appends a pair of metadata, padded to four bytes; keys have to come in the order of their bytes.
fn key_value(out: &mut Vec<u8>, key: &str, value: &str) -> Result<(), Error> {
    out.extend(length(key.len() + value.len() + 2)?.to_le_bytes());
    for text in [key, value] {
        out.extend(text.as_bytes());
        out.push(0);
    }
    out.resize(out.len().next_multiple_of(4), 0);
    Ok(())
}

/// A length as the format writes it; comments may be at most 16 MiB, so that sums stay lengths.
fn length(bytes: usize) -> Result<u32, Error> {
    const MAX: usize = 1 << 24;
    if bytes <= MAX {
        return Ok(bytes as u32);
    }
    Err(ErrorKind::CommentBytes { found: bytes, max: MAX }.into())
}
