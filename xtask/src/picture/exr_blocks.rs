//! The blocks of an OpenEXR part: the table of offsets, and the packed blocks where it points.

use std::io::{Read, Seek, SeekFrom};

use anyhow::{Result, bail};
use exr::{
    block::chunk::{Chunk, CompressedBlock, CompressedScanLineBlock, CompressedTileBlock, TileCoordinates},
    math::Vec2,
    meta::{BlockDescription, MetaData, header::Header},
};

use super::{band::BAND_PIXELS, cannot_read, limits::allocate};

/// How the full-resolution picture is cut into blocks, in the order of the table.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grid {
    /// Width and height of a block that is not cut off by the border.
    pub(super) block: Vec2<usize>,
    /// Blocks across and down.
    pub(super) count: Vec2<usize>,
}

impl Grid {
    pub(super) fn new(header: &Header) -> Self {
        let block = header.max_block_pixel_size();
        let Vec2(width, height) = header.layer_size;
        Self { block, count: Vec2(width.div_ceil(block.0), height.div_ceil(block.1)) }
    }

    /// Bytes of an unpacked block.
    pub(super) fn bytes(&self, header: &Header) -> usize {
        self.block.0.saturating_mul(self.block.1).saturating_mul(header.channels.bytes_per_pixel)
    }

    /// Bytes of a row of unpacked blocks.
    pub(super) fn row_bytes(&self, header: &Header) -> usize {
        let rows = self.block.1.min(header.layer_size.1);
        header.layer_size.0.saturating_mul(rows).saturating_mul(header.channels.bytes_per_pixel)
    }

    /// Whether a row of blocks is more than a band, in a picture so wide.
    pub(super) fn is_tall(&self, width: usize) -> bool {
        width.saturating_mul(self.block.1) > BAND_PIXELS
    }
}

/// The blocks of one part in the file.
pub(super) struct Blocks<R> {
    reader: R,
    length: u64,
    position: u64,
    part: usize,
    grid: Grid,
    offsets: Vec<u64>,
}

impl<R: Read + Seek> Blocks<R> {
    /// The blocks of `part`, whose header has been checked; the tables of offsets begin at `tables_at`.
    pub(super) fn open(reader: R, length: u64, tables_at: u64, meta: &MetaData, part: usize) -> Result<Self> {
        let grid = Grid::new(&meta.headers[part]);
        let mut blocks = Self { reader, length, position: u64::MAX, part, grid, offsets: Vec::new() };
        // Tables follow each other; smaller resolutions come after the full one.
        let earlier: u64 = meta.headers[..part].iter().map(|part| part.chunk_count as u64 * 8).sum();
        blocks.offsets = blocks.table(tables_at.saturating_add(earlier))?;
        Ok(blocks)
    }

    /// Where each block of the full resolution lies, row by row.
    fn table(&mut self, table_at: u64) -> Result<Vec<u64>> {
        let count = self.grid.count.0 * self.grid.count.1;
        if table_at.saturating_add(count as u64 * 8) > self.length {
            bail!("the file ends within its table of {count} blocks (is it truncated?)");
        }
        let mut offsets = allocate(count, 0)?;
        let mut bytes = [0; 1 << 12];
        self.seek(table_at)?;
        for offsets in offsets.chunks_mut(bytes.len() / 8) {
            let bytes = &mut bytes[..offsets.len() * 8];
            self.read(bytes)?;
            let (entries, _) = bytes.as_chunks::<8>();
            offsets.iter_mut().zip(entries).for_each(|(offset, entry)| *offset = u64::from_le_bytes(*entry));
        }
        // What can be told now is not told after half of the picture.
        for (index, offset) in offsets.iter().enumerate() {
            if *offset == 0 {
                bail!("block {} of {count} is missing (the file was not finished)", index + 1);
            }
            if *offset >= self.length {
                bail!("block {} of {count} lies beyond the end of the file (is it truncated?)", index + 1);
            }
        }
        Ok(offsets)
    }

    /// How the picture is cut.
    pub(super) fn grid(&self) -> Grid {
        self.grid
    }

    /// The blocks of some rows of blocks, in the order of the file.
    pub(super) fn of_rows(&self, rows: std::ops::Range<usize>) -> Vec<usize> {
        let across = self.grid.count.0;
        let mut blocks: Vec<usize> = (rows.start * across..rows.end * across).collect();
        blocks.sort_unstable_by_key(|&index| self.offsets[index]);
        blocks
    }

    /// The packed block `index`.
    pub(super) fn packed(&mut self, index: usize, meta: &MetaData) -> Result<Chunk> {
        let header = &meta.headers[self.part];
        let offset = self.offsets[index];
        let Vec2(across, down) = self.grid.count;
        let which = format_args!("block {} of {}", index + 1, across * down).to_string();
        let (x, y) = (index % across, index / across);

        // What the block's own header must say, all but the size at its end.
        let mut expected = Vec::with_capacity(6);
        if meta.requirements.is_multilayer() {
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
        self.seek(offset)?;
        self.read(bytes)?;
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
        self.read(&mut compressed_pixels_le)?;

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

    /// Goes to `offset`; a reader that is there already keeps what it has buffered.
    fn seek(&mut self, offset: u64) -> Result<()> {
        if self.position != offset {
            self.position = self.reader.seek(SeekFrom::Start(offset)).map_err(|error| cannot_read(&error))?;
        }
        Ok(())
    }

    fn read(&mut self, bytes: &mut [u8]) -> Result<()> {
        self.reader.read_exact(bytes).map_err(|error| cannot_read(&error))?;
        self.position += bytes.len() as u64;
        Ok(())
    }
}
