//! The pixels of an OpenEXR part: table of offsets, blocks, and the samples in them.

use std::io::{Read, Seek, SeekFrom};

use anyhow::{Result, anyhow, bail};
use exr::{
    block::{
        UncompressedBlock,
        chunk::{Chunk, CompressedBlock, CompressedScanLineBlock, CompressedTileBlock, TileCoordinates},
    },
    math::Vec2,
    meta::{BlockDescription, MetaData, attribute::SampleType, header::Header},
};
use half::f16;
use rayon::prelude::*;

use super::{
    Pixels, cannot_read, dwa,
    exr_layout::{Layout, Plane},
    exr_read::message,
    guard::guarded,
    limits::allocate,
};

/// Bytes of unpacked blocks held at once, beside the picture.
const BATCH_BYTES: usize = 1 << 26;

/// Reads the pixels of the part that `layout` names, premultiplied as in the file. The header has been checked; the
/// tables of offsets begin at `tables_at`.
pub(super) fn read<R: Read + Seek>(
    reader: R,
    length: u64,
    tables_at: u64,
    meta: &MetaData,
    layout: &Layout,
) -> Result<Pixels> {
    let header = &meta.headers[layout.part];
    let grid = Grid::new(header);
    let mut blocks = Blocks { reader, length, meta, part: layout.part, grid };
    let offsets = blocks.offsets(tables_at)?;

    let Vec2(width, height) = header.layer_size;
    let mut rgb = allocate(width * height, [0.0; 3])?;
    let mut alpha = layout.alpha.map(|_| allocate(width * height, 0.0)).transpose()?;
    let mut line = vec![0.0; grid.block.0.min(width)];

    for batch in offsets.chunks(grid.blocks_in(BATCH_BYTES, header)) {
        let packed: Vec<Chunk> =
            batch.iter().map(|&(index, offset)| blocks.read(index, offset)).collect::<Result<_>>()?;
        let unpacked: Vec<UncompressedBlock> =
            packed.into_par_iter().map(|chunk| unpack(chunk, meta)).collect::<Result<_>>()?;
        for block in &unpacked {
            let Vec2(x, y) = block.index.pixel_position;
            let Vec2(block_width, block_height) = block.index.pixel_size;
            for row in 0..block_height {
                let samples = Row { block, row, bytes_per_pixel: header.channels.bytes_per_pixel };
                let at = (y + row) * width + x;
                let line = &mut line[..block_width];
                let row = &mut rgb[at..at + block_width];
                for (channel, plane) in layout.rgb.iter().enumerate() {
                    samples.of(*plane, line);
                    row.iter_mut().zip(&*line).for_each(|(colour, &value)| colour[channel] = value);
                }
                if let (Some(alpha), Some(plane)) = (&mut alpha, layout.alpha) {
                    samples.of(plane, &mut alpha[at..at + block_width]);
                }
            }
        }
    }
    Ok((rgb, alpha))
}

/// How the full-resolution picture is cut into blocks, in the order of the table.
#[derive(Debug, Clone, Copy)]
struct Grid {
    /// Width and height of a block that is not cut off by the border.
    block: Vec2<usize>,
    /// Blocks across and down.
    count: Vec2<usize>,
}

impl Grid {
    fn new(header: &Header) -> Self {
        let block = header.max_block_pixel_size();
        let Vec2(width, height) = header.layer_size;
        Self { block, count: Vec2(width.div_ceil(block.0), height.div_ceil(block.1)) }
    }

    fn bytes(&self, header: &Header) -> usize {
        self.block.0.saturating_mul(self.block.1).saturating_mul(header.channels.bytes_per_pixel)
    }

    /// How many blocks to unpack together: enough for all threads, within `bytes`.
    fn blocks_in(&self, bytes: usize, header: &Header) -> usize {
        (bytes / self.bytes(header).max(1)).clamp(1, 16 * rayon::current_num_threads())
    }
}

/// The blocks of one part in the file.
struct Blocks<'a, R> {
    reader: R,
    length: u64,
    meta: &'a MetaData,
    part: usize,
    grid: Grid,
}

impl<R: Read + Seek> Blocks<'_, R> {
    /// Index and offset of each block of the full resolution, in the order of the file.
    fn offsets(&mut self, tables_at: u64) -> Result<Vec<(usize, u64)>> {
        // Tables follow each other; smaller resolutions come after the full one.
        let earlier: u64 = self.meta.headers[..self.part].iter().map(|part| part.chunk_count as u64 * 8).sum();
        let count = self.grid.count.0 * self.grid.count.1;
        let table_at = tables_at.saturating_add(earlier);
        if table_at.saturating_add(count as u64 * 8) > self.length {
            bail!("the file ends within its table of {count} blocks (is it truncated?)");
        }
        let mut bytes = vec![0; count * 8];
        self.read_at(table_at, &mut bytes)?;
        let (entries, _) = bytes.as_chunks::<8>();
        let mut offsets: Vec<(usize, u64)> =
            entries.iter().map(|entry| u64::from_le_bytes(*entry)).enumerate().collect();
        if let Some((index, _)) = offsets.iter().find(|(_, offset)| *offset == 0) {
            bail!("block {} of {count} is missing (the file was not finished)", index + 1);
        }
        offsets.sort_unstable_by_key(|&(_, offset)| offset);
        Ok(offsets)
    }

    /// The packed block `index`, which is to lie at `offset`.
    fn read(&mut self, index: usize, offset: u64) -> Result<Chunk> {
        let header = &self.meta.headers[self.part];
        let Vec2(across, down) = self.grid.count;
        let which = format_args!("block {} of {}", index + 1, across * down).to_string();
        let (x, y) = (index % across, index / across);

        // What the block's own header must say, all but the size at its end.
        let mut expected = Vec::with_capacity(6);
        if self.meta.requirements.is_multilayer() {
            expected.push(self.part as i64);
        }
        match header.blocks {
            BlockDescription::Tiles(_) => expected.extend([x as i64, y as i64, 0, 0]),
            BlockDescription::ScanLines => {
                let top = i64::from(header.own_attributes.layer_position.1);
                expected.push(top + (y * self.grid.block.1) as i64);
            }
        }
        let mut bytes = [0; 24];
        let bytes = &mut bytes[..expected.len() * 4 + 4];
        let data_at = offset.saturating_add(bytes.len() as u64);
        if data_at > self.length {
            bail!("{which} lies beyond the end of the file (is it truncated?)");
        }
        self.read_at(offset, bytes)?;
        let mut found: Vec<i64> =
            bytes.as_chunks::<4>().0.iter().map(|word| i64::from(i32::from_le_bytes(*word))).collect();
        let size = found.pop().unwrap_or(0);
        if found != expected {
            bail!("{which} is not where the table of blocks puts it (the file is damaged)");
        }
        let largest = self.grid.bytes(header) as i64;
        if size <= 0 || size > largest {
            bail!("{which} has {size} bytes, expected 1 to {largest} (the file is damaged)");
        }
        if data_at + size as u64 > self.length {
            bail!("{which} is cut off by the end of the file (is it truncated?)");
        }
        let mut compressed_pixels_le = allocate(size as usize, 0)?;
        self.reader.read_exact(&mut compressed_pixels_le).map_err(|error| cannot_read(&error))?;

        let compressed_block = match header.blocks {
            BlockDescription::Tiles(_) => CompressedBlock::Tile(CompressedTileBlock {
                coordinates: TileCoordinates { tile_index: Vec2(x, y), level_index: Vec2(0, 0) },
                compressed_pixels_le,
            }),
            BlockDescription::ScanLines => CompressedBlock::ScanLine(CompressedScanLineBlock {
                y_coordinate: header.own_attributes.layer_position.1 + (y * self.grid.block.1) as i32,
                compressed_pixels_le,
            }),
        };
        Ok(Chunk { layer_index: self.part, compressed_block })
    }

    fn read_at(&mut self, offset: u64, bytes: &mut [u8]) -> Result<()> {
        self.reader.seek(SeekFrom::Start(offset)).map_err(|error| cannot_read(&error))?;
        self.reader.read_exact(bytes).map_err(|error| cannot_read(&error))
    }
}

fn unpack(chunk: Chunk, meta: &MetaData) -> Result<UncompressedBlock> {
    dwa::check(&chunk, meta)?;
    guarded(|| UncompressedBlock::decompress_chunk(chunk, meta, false))?
        .map_err(|error| anyhow!("the pixels are damaged: {}", message(&error)))
}

/// One row of a block: the samples of its channels one after the other.
struct Row<'a> {
    block: &'a UncompressedBlock,
    row: usize,
    bytes_per_pixel: usize,
}

impl Row<'_> {
    /// Writes the samples of one channel to `line`, which is as wide as the block.
    fn of(&self, plane: Plane, line: &mut [f32]) {
        let start = (self.row * self.bytes_per_pixel + plane.bytes_before) * line.len();
        let bytes = &self.block.data[start..];
        match plane.samples {
            SampleType::F16 => fill(line, bytes, |word| f16::from_ne_bytes(word).to_f32()),
            SampleType::F32 => fill(line, bytes, f32::from_ne_bytes),
            SampleType::U32 => fill(line, bytes, |word| u32::from_ne_bytes(word) as f32),
        }
    }
}

fn fill<const N: usize>(line: &mut [f32], bytes: &[u8], value: impl Fn([u8; N]) -> f32) {
    let (words, _) = bytes.as_chunks::<N>();
    line.iter_mut().zip(words).for_each(|(out, word)| *out = value(*word));
}
