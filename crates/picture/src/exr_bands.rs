//! The pixels of an OpenEXR part, one or more rows of blocks at a time.

use std::ops::Range;

use exr::{
    block::{UncompressedBlock, chunk::Chunk},
    compression::Compression,
    math::Vec2,
    meta::{MetaData, attribute::SampleType, header::Header},
};
use half::{f16, slice::HalfFloatSliceExt};
use rayon::prelude::*;

use crate::{
    alpha,
    band::{Band, Bands, ReadingMemory, RowMut, blocks_in_band},
    description::Channels,
    dwa,
    error::{Error, ExrProblem, PixelProblem, exr_message},
    exr_blocks::{Blocks, Grid},
    exr_layout::{Layout, Plane},
    limits::Limits,
    panic_to_error::panic_to_error,
};

/// Bytes of unpacked blocks held at once, beside the band: a file may have many channels that are not read.
pub(crate) const BATCH_BYTES: usize = 1 << 26;

/// How many times the samples of a block are held while it is unpacked: packed, between steps, and as they come out.
const UNPACKING: u64 = 3;
/// The same of DWA, which unpacks its sections one by one.
const UNPACKING_DWA: u64 = 5;

/// Refuses blocks that take more memory than [`Limits`] has.
pub(crate) fn check_memory(header: &Header, limits: &Limits) -> Result<(), Error> {
    let Vec2(width, height) = Grid::new(header).block;
    limits.check_bytes("a block", [width as u64, height as u64], held(header))
}

/// Bytes of blocks held at once, at most: those on their way, and those that wait in a row that is more than a band.
fn held(header: &Header) -> u64 {
    let grid = Grid::new(header);
    let (block, row) = (grid.bytes(header) as u64, grid.row_bytes(header) as u64);
    let times = match header.compression {
        Compression::Uncompressed => 2,
        Compression::DWAA(_) | Compression::DWAB(_) => UNPACKING_DWA,
        _ => UNPACKING,
    };
    let (width, down) = (header.layer_size.0, grid.count.1 as u64);
    let tall = grid.is_tall(width);
    let rows = if tall { row } else { row.saturating_mul((blocks_in_band(width, grid.block.1) as u64).min(down)) };
    let batch = rows.min((BATCH_BYTES as u64).max(block));
    batch.saturating_mul(times).saturating_add(if tall { row } else { 0 })
}

/// The pixels of the part that a [`Layout`] names.
pub(crate) struct ExrBands<'a> {
    blocks: Blocks<'a>,
    meta: MetaData,
    layout: Layout,
    /// The next row of pixels.
    next: usize,
    /// The row of blocks that was begun, where it is more than a band.
    begun: Vec<UncompressedBlock>,
}

impl<'a> ExrBands<'a> {
    /// From the first row on.
    pub(crate) fn new(blocks: Blocks<'a>, meta: MetaData, layout: Layout) -> Self {
        Self { blocks, meta, layout, next: 0, begun: Vec::new() }
    }

    fn header(&self) -> &Header {
        &self.meta.headers[self.layout.part]
    }

    /// The rows of the next band: whole rows of blocks, or a part of one.
    fn next_rows(&self) -> Range<usize> {
        let Vec2(width, height) = self.header().layer_size;
        let grid = self.blocks.grid();
        let end = if grid.is_tall(width) {
            let own = (self.next / grid.block.1 + 1) * grid.block.1;
            own.min(self.next + blocks_in_band(width, 1))
        } else {
            self.next + blocks_in_band(width, grid.block.1) * grid.block.1
        };
        self.next..end.min(height)
    }

    /// Unpacks blocks on all threads.
    fn unpack(&mut self, blocks: &[usize]) -> Result<Vec<UncompressedBlock>, Error> {
        let packed: Vec<Chunk> =
            blocks.iter().map(|&index| self.blocks.packed(index, &self.meta)).collect::<Result<_, Error>>()?;
        packed.into_par_iter().map(|chunk| unpack(chunk, &self.meta)).collect()
    }
}

impl Bands for ExrBands<'_> {
    fn next_into(&mut self, band: &mut Band) -> Result<(), Error> {
        let grid = self.blocks.grid();
        let width = self.header().layer_size.0;
        let rows = self.next_rows();
        let channels = if self.layout.alpha.is_some() { Channels::Rgba } else { Channels::Rgb };
        band.become_rows(rows.start, rows.len(), width, channels)?;

        let block_rows = rows.start / grid.block.1..rows.end.div_ceil(grid.block.1);
        let batch = (BATCH_BYTES / grid.bytes(self.header()).max(1)).max(1);
        if grid.is_tall(width) {
            if rows.start.is_multiple_of(grid.block.1) {
                self.begun.clear();
                for batch in self.blocks.of_rows(block_rows).chunks(batch) {
                    let unpacked = self.unpack(batch)?;
                    self.begun.extend(unpacked);
                }
            }
            fill(&self.layout, self.header(), band, &self.begun);
        } else {
            for batch in self.blocks.of_rows(block_rows).chunks(batch) {
                let unpacked = self.unpack(batch)?;
                fill(&self.layout, self.header(), band, &unpacked);
            }
        }
        self.next = rows.end;
        Ok(())
    }

    fn memory(&self) -> ReadingMemory {
        let grid = self.blocks.grid();
        let Vec2(width, height) = self.header().layer_size;
        let down = if grid.is_tall(width) { 1 } else { grid.block.1 };
        let rows = blocks_in_band(width, down).saturating_mul(down).min(height);
        ReadingMemory { band_pixels: width as u64 * rows as u64, bytes_beside: held(self.header()) }
    }
}

/// Fills in what blocks have of a band.
fn fill(layout: &Layout, header: &Header, band: &mut Band, blocks: &[UncompressedBlock]) {
    let side = header.max_block_pixel_size().1;
    let (top, first) = (band.top(), band.top() / side);
    let mut by_row = vec![Vec::new(); (top + band.rows()).div_ceil(side) - first];
    for block in blocks {
        by_row[block.index.pixel_position.1 / side - first].push(block);
    }
    let bytes_per_pixel = header.channels.bytes_per_pixel;
    band.rows_mut().enumerate().with_min_len(side.min(8)).for_each(|(row, mut to)| {
        for block in &by_row[(top + row) / side - first] {
            layout.fill(&mut to, &Row { block, row: (top + row) % side, bytes_per_pixel });
        }
    });
}

/// Unpacks a block.
pub(crate) fn unpack(chunk: Chunk, meta: &MetaData) -> Result<UncompressedBlock, Error> {
    dwa::check(&chunk, meta)?;
    panic_to_error(|| UncompressedBlock::decompress_chunk(chunk, meta, false))?
        .map_err(|error| ExrProblem::Pixels(PixelProblem::Decoder(exr_message(&error))).into())
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

/// Half floats that are widened at once; two buffers of this length are on the stack.
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
