//! The sizes that a DWAA or DWAB block claims, checked before the decoder takes memory for them.
//!
//! The decoder of `exr` 1.74 believes the counters at the start of a block, and asks for up to 2^63 bytes.

use exr::{
    block::chunk::{Chunk, CompressedBlock},
    compression::Compression,
    math::Vec2,
    meta::MetaData,
};

use crate::error::{Error, ExrProblem, PixelProblem, exr_message};

/// Samples along one side of a DCT block.
const DCT_SIDE: usize = 8;

/// Refuses a DWA block that claims more than its pixels can need; other compressions pass.
pub(crate) fn check(chunk: &Chunk, meta: &MetaData) -> Result<(), Error> {
    let Some(header) = meta.headers.get(chunk.layer_index) else { return Ok(()) };
    if !matches!(header.compression, Compression::DWAA(_) | Compression::DWAB(_)) {
        return Ok(());
    }
    let data = match &chunk.compressed_block {
        CompressedBlock::ScanLine(block) => &block.compressed_pixels_le,
        CompressedBlock::Tile(block) => &block.compressed_pixels_le,
        CompressedBlock::DeepScanLine(_) | CompressedBlock::DeepTile(_) => return Ok(()),
    };
    let block = header.get_block_data_indices(&chunk.compressed_block);
    let block = block.and_then(|block| header.get_absolute_block_pixel_coordinates(block));
    let Vec2(width, height) = block.map_err(|error| pixels(PixelProblem::Decoder(exr_message(&error))))?.size;
    let raw = (width * height * header.channels.bytes_per_pixel) as u64;
    let dct_blocks = width.div_ceil(DCT_SIDE) * height.div_ceil(DCT_SIDE) * header.channels.list.len();
    if data.len() as u64 == raw {
        return Ok(()); // stored, not packed
    }
    let (words, _) = data.as_chunks::<8>();
    let Some(counters) = words.first_chunk::<11>() else {
        return Err(pixels(PixelProblem::DwaTooShort { bytes: data.len() }));
    };
    // Version, then sizes unpacked and packed, then counts; the packed ones are checked by the decoder against the
    // block.
    let [_, plain, _, _, _, _, run_tokens, run_bytes, ac, dc, _] = counters.map(u64::from_le_bytes);
    let dct_blocks = dct_blocks as u64;
    let most = [
        ("bytes", plain, raw),
        ("bytes of runs", run_bytes, raw),
        // A token is at most one byte longer than what it stands for.
        ("bytes of tokens", run_tokens, 2 * raw),
        ("AC coefficients", ac, dct_blocks * (DCT_SIDE * DCT_SIDE) as u64),
        ("DC coefficients", dc, dct_blocks),
    ];
    for (what, claimed, max) in most {
        if claimed > max {
            return Err(pixels(PixelProblem::DwaClaim { what, claimed, max }));
        }
    }
    Ok(())
}

fn pixels(problem: PixelProblem) -> Error {
    ExrProblem::Pixels(problem).into()
}
