//! The pixels of an OpenEXR part, one or more rows of blocks at a time.

use std::io::{Read, Seek};

use anyhow::{Result, anyhow};
use exr::{
    block::{UncompressedBlock, chunk::Chunk},
    math::Vec2,
    meta::{MetaData, attribute::SampleType, header::Header},
};
use half::{f16, slice::HalfFloatSliceExt};
use rayon::prelude::*;

use super::{
    Band, Bands, Channels, RowMut, alpha,
    band::{Holds, blocks_in_band},
    dwa,
    exr_blocks::Blocks,
    exr_layout::{Layout, Plane},
    exr_read::message,
    guard::guarded,
};

/// Bytes of unpacked blocks held at once, beside the band: a file may have many channels that are not read.
const BATCH_BYTES: usize = 1 << 26;

/// The pixels of the part that a [`Layout`] names.
pub(super) struct ExrBands<R> {
    blocks: Blocks<R>,
    meta: MetaData,
    layout: Layout,
    /// The next row of blocks.
    next: usize,
}

impl<R: Read + Seek> ExrBands<R> {
    /// From the first row on.
    pub(super) fn new(blocks: Blocks<R>, meta: MetaData, layout: Layout) -> Self {
        Self { blocks, meta, layout, next: 0 }
    }

    fn header(&self) -> &Header {
        &self.meta.headers[self.layout.part]
    }
}

impl<R: Read + Seek + Send> Bands for ExrBands<R> {
    fn next_into(&mut self, band: &mut Band) -> Result<()> {
        let grid = self.blocks.grid();
        let Vec2(width, height) = self.header().layer_size;
        let rows = self.next..(self.next + blocks_in_band(width, grid.block.1)).min(grid.count.1);
        let top = (rows.start * grid.block.1).min(height);
        let end = (rows.end * grid.block.1).min(height);
        let channels = if self.layout.alpha.is_some() { Channels::Rgba } else { Channels::Rgb };
        band.become_rows(top, end - top, width, channels)?;

        let batch = (BATCH_BYTES / grid.bytes(self.header()).max(1)).max(1);
        for batch in self.blocks.of_rows(rows.clone()).chunks(batch) {
            let packed: Vec<Chunk> =
                batch.iter().map(|&index| self.blocks.packed(index, &self.meta)).collect::<Result<_>>()?;
            let unpacked: Vec<UncompressedBlock> =
                packed.into_par_iter().map(|chunk| unpack(chunk, &self.meta)).collect::<Result<_>>()?;
            let mut by_row = vec![Vec::new(); rows.len()];
            for block in &unpacked {
                by_row[block.index.pixel_position.1 / grid.block.1 - rows.start].push(block);
            }
            let bytes_per_pixel = self.header().channels.bytes_per_pixel;
            band.rows_mut().enumerate().with_min_len(grid.block.1.min(8)).for_each(|(row, mut to)| {
                for block in &by_row[row / grid.block.1] {
                    self.layout.fill(&mut to, &Row { block, row: row % grid.block.1, bytes_per_pixel });
                }
            });
        }
        self.next = rows.end;
        Ok(())
    }

    fn holds(&self) -> Holds {
        let grid = self.blocks.grid();
        let Vec2(width, height) = self.header().layer_size;
        let down = blocks_in_band(width, grid.block.1).min(grid.count.1);
        let block = grid.bytes(self.header()).max(1);
        let batch = (BATCH_BYTES / block).clamp(1, down.saturating_mul(grid.count.0));
        Holds {
            band_pixels: width as u64 * (down * grid.block.1).min(height) as u64,
            // Packed, unpacked, and on the way.
            bytes_beside: 3 * (batch as u64).saturating_mul(block as u64),
        }
    }
}

fn unpack(chunk: Chunk, meta: &MetaData) -> Result<UncompressedBlock> {
    dwa::check(&chunk, meta)?;
    guarded(|| UncompressedBlock::decompress_chunk(chunk, meta, false))?
        .map_err(|error| anyhow!("the pixels are damaged: {}", message(&error)))
}

impl Layout {
    /// Fills the part of a row that a block has.
    fn fill(&self, to: &mut RowMut<'_>, from: &Row<'_>) {
        let (Vec2(x, _), Vec2(width, _)) = (from.block.index.pixel_position, from.block.index.pixel_size);
        let rgb = &mut to.rgb[x..x + width];
        for (channel, plane) in self.rgb.iter().enumerate() {
            from.of(*plane, |at, value| rgb[at][channel] = value);
        }
        if let (Some(alpha), Some(plane)) = (&mut to.alpha, self.alpha) {
            let alpha = &mut alpha[x..x + width];
            from.of(plane, |at, value| alpha[at] = value);
            alpha::straighten(rgb, alpha);
        }
    }
}

/// One row of a block: the samples of its channels one after the other.
struct Row<'a> {
    block: &'a UncompressedBlock,
    row: usize,
    bytes_per_pixel: usize,
}

/// Halves widened at once.
const HALVES: usize = 256;

impl Row<'_> {
    /// Gives column and value of the samples of one channel.
    fn of(&self, plane: Plane, mut each: impl FnMut(usize, f32)) {
        let width = self.block.index.pixel_size.0;
        let start = (self.row * self.bytes_per_pixel + plane.bytes_before) * width;
        let bytes = &self.block.data[start..];
        match plane.samples {
            SampleType::F16 => {
                let (mut halves, mut floats) = ([f16::ZERO; HALVES], [0.0; HALVES]);
                let (words, _) = bytes[..2 * width].as_chunks::<2>();
                for (run, words) in words.chunks(HALVES).enumerate() {
                    halves.iter_mut().zip(words).for_each(|(half, word)| *half = f16::from_ne_bytes(*word));
                    halves[..words.len()].convert_to_f32_slice(&mut floats[..words.len()]);
                    floats[..words.len()].iter().enumerate().for_each(|(i, value)| each(run * HALVES + i, *value));
                }
            }
            SampleType::F32 => samples(bytes, width, f32::from_ne_bytes).for_each(|(i, value)| each(i, value)),
            SampleType::U32 => {
                samples(bytes, width, |word| u32::from_ne_bytes(word) as f32).for_each(|(i, value)| each(i, value));
            }
        }
    }
}

fn samples<const N: usize>(
    bytes: &[u8],
    count: usize,
    value: impl Fn([u8; N]) -> f32,
) -> impl Iterator<Item = (usize, f32)> {
    bytes.as_chunks::<N>().0.iter().take(count).map(move |word| value(*word)).enumerate()
}
