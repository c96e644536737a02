//! The blocks of an OpenEXR part: the table of offsets, and the packed blocks where it points.

use std::io::{Read, Seek, SeekFrom};

use exr::{
    block::chunk::{Chunk, CompressedBlock, CompressedScanLineBlock, CompressedTileBlock, TileCoordinates},
    math::Vec2,
    meta::{BlockDescription, MetaData, header::Header},
};

use crate::{
    band::BAND_PIXELS,
    error::{BlockProblem, Error, ExrProblem},
    input::Input,
    limits::allocate,
};

/// How the full-resolution picture is cut into blocks, in the order of the table.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Grid {
    /// Width and height of a block that is not cut off by the border.
    pub(crate) block: Vec2<usize>,
    /// How many blocks the part has across and down.
    pub(crate) count: Vec2<usize>,
}

impl Grid {
    pub(crate) fn new(header: &Header) -> Self {
        let block = header.max_block_pixel_size();
        let Vec2(width, height) = header.layer_size;
        Self { block, count: Vec2(width.div_ceil(block.0), height.div_ceil(block.1)) }
    }

    /// Bytes of an unpacked block.
    pub(crate) fn bytes(&self, header: &Header) -> usize {
        self.block.0.saturating_mul(self.block.1).saturating_mul(header.channels.bytes_per_pixel)
    }

    /// Bytes of a row of unpacked blocks.
    pub(crate) fn row_bytes(&self, header: &Header) -> usize {
        let rows = self.block.1.min(header.layer_size.1);
        header.layer_size.0.saturating_mul(rows).saturating_mul(header.channels.bytes_per_pixel)
    }

    /// Whether a row of blocks is more than a band, in a picture so wide.
    pub(crate) fn is_tall(&self, width: usize) -> bool {
        width.saturating_mul(self.block.1) > BAND_PIXELS
    }
}

/// The blocks of one part in the file.
pub(crate) struct Blocks<'a> {
    reader: Input<'a>,
    length: u64,
    position: u64,
    part: usize,
    grid: Grid,
    offsets: Vec<u64>,
}

impl<'a> Blocks<'a> {
    /// The blocks of `part`, whose header has been checked; the tables of offsets begin at `tables_at`.
    pub(crate) fn open(
        reader: Input<'a>,
        length: u64,
        tables_at: u64,
        meta: &MetaData,
        part: usize,
    ) -> Result<Self, Error> {
        let grid = Grid::new(&meta.headers[part]);
        let mut blocks = Self { reader, length, position: u64::MAX, part, grid, offsets: Vec::new() };
        // Tables follow each other; smaller resolutions come after the full one.
        let earlier: u64 = meta.headers[..part].iter().map(|part| part.chunk_count as u64 * 8).sum();
        blocks.offsets = blocks.table(tables_at.saturating_add(earlier))?;
        Ok(blocks)
    }

    /// Where each block of the full resolution lies, row by row.
    fn table(&mut self, table_at: u64) -> Result<Vec<u64>, Error> {
        let count = self.grid.count.0 * self.grid.count.1;
        if table_at.saturating_add(count as u64 * 8) > self.length {
            return Err(ExrProblem::TableEndsEarly { count }.into());
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
        // A fault that the table shows is reported before any pixel is read, not after half of the picture.
        for (index, offset) in offsets.iter().enumerate() {
            if *offset == 0 {
                return Err(self.block(index, BlockProblem::Missing));
            }
            if *offset >= self.length {
                return Err(self.block(index, BlockProblem::BeyondEnd));
            }
        }
        Ok(offsets)
    }

    /// How the picture is cut.
    pub(crate) fn grid(&self) -> Grid {
        self.grid
    }

    /// The blocks of some rows of blocks, in the order of the file.
    pub(crate) fn of_rows(&self, rows: std::ops::Range<usize>) -> Vec<usize> {
        let across = self.grid.count.0;
        let mut blocks: Vec<usize> = (rows.start * across..rows.end * across).collect();
        blocks.sort_unstable_by_key(|&index| self.offsets[index]);
        blocks
    }

    /// Reads the block `index` as it is packed in the file.
    pub(crate) fn packed(&mut self, index: usize, meta: &MetaData) -> Result<Chunk, Error> {
        let header = &meta.headers[self.part];
        let offset = self.offsets[index];
        let across = self.grid.count.0;
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
            return Err(self.block(index, BlockProblem::BeyondEnd));
        }
        self.seek(offset)?;
        self.read(bytes)?;
        let mut found: Vec<i64> =
            bytes.as_chunks::<4>().0.iter().map(|word| i64::from(i32::from_le_bytes(*word))).collect();
        let size = found.pop().unwrap_or(0);
        if found != expected {
            return Err(self.block(index, BlockProblem::Misplaced));
        }
        let largest = self.grid.bytes(header) as i64;
        if size <= 0 || size > largest {
            return Err(self.block(index, BlockProblem::Size { found: size, max: largest }));
        }
        if data_at + size as u64 > self.length {
            return Err(self.block(index, BlockProblem::CutOff));
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

    /// What is wrong with the block `index`.
    fn block(&self, index: usize, problem: BlockProblem) -> Error {
        let Vec2(across, down) = self.grid.count;
        ExrProblem::Block { number: index + 1, count: across * down, problem }.into()
    }

    /// Goes to `offset`; a reader that is there already keeps what it has buffered.
    fn seek(&mut self, offset: u64) -> Result<(), Error> {
        if self.position != offset {
            self.position = self.reader.seek(SeekFrom::Start(offset))?;
        }
        Ok(())
    }

    fn read(&mut self, bytes: &mut [u8]) -> Result<(), Error> {
        self.reader.read_exact(bytes)?;
        self.position += bytes.len() as u64;
        Ok(())
    }
}
