//! Strips: a table as a row of square tiles in a PNG, for game engines.

use std::io::{Read, Write};

use onelight_lut::Lut3d;

use crate::error::Error;
use crate::node_order::node_at;
use crate::picture::{self, Picture, PngDepth, refuse};

/// Which way green runs in each tile of a strip: engines disagree on where a texture begins.
///
/// ```
/// use onelight_formats::{PngDepth, StripGreen, strip};
///
/// let table = onelight_lut::Lut3d::identity(2)?;
/// let mut file = Vec::new();
/// strip::write(&mut file, &table, PngDepth::Eight, StripGreen::Down, [""; 0])?;
/// // Read the other way, black and green change places.
/// assert_eq!(strip::read(file.as_slice(), StripGreen::Up)?.entry([0; 3]), Some([0.0, 1.0, 0.0]));
/// # Ok::<(), onelight_formats::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum StripGreen {
    /// From the top row down: black is at the top left. Unreal's `RGBTable16x1`.
    Down,
    /// From the bottom row up: black is at the bottom left, the origin of Unity's textures. Unity's neutral LUTs.
    Up,
}

/// Writes a table as a strip of tiles, one for each node of blue from left to right, with red along a tile's rows.
///
/// A table of 16 becomes 256 x 16 pixels (Unreal, and Unity in low quality), one of 32 becomes 1024 x 32 (Unity). Its
/// coordinates are codes from 0 to 1, and so are its entries: they are clamped to 0 to 1 and rounded to the depth. The
/// comments go into a text chunk.
///
/// # Errors
///
/// If the writer fails; what it took until then is an incomplete file.
///
/// ```
/// use onelight_formats::{PngDepth, StripGreen, strip};
/// use onelight_lut::Lut3d;
///
/// let table = Lut3d::identity(16)?;
/// let mut file = Vec::new();
/// strip::write(&mut file, &table, PngDepth::Eight, StripGreen::Down, ["for Unreal"])?;
/// assert_eq!(strip::read(file.as_slice(), StripGreen::Down)?.entry([1, 0, 0]), Some([17.0 / 255.0, 0.0, 0.0]));
/// # Ok::<(), onelight_formats::Error>(())
/// ```
pub fn write<S: AsRef<str>>(
    writer: impl Write,
    table: &Lut3d,
    depth: PngDepth,
    green: StripGreen,
    comments: impl IntoIterator<Item = S>,
) -> Result<(), Error> {
    let size = table.size();
    let pixels = (0..size).flat_map(|row| (0..size * size).map(move |column| (row, column)));
    // Every pixel is a node of the table, so none is left out.
    let pixels =
        pixels.filter_map(|(row, column)| table.entry([column % size, green_node(row, size, green), column / size]));
    picture::write(writer, [size * size, size], depth, pixels, comments)
}

/// Reads a strip from a PNG of 8 or 16 bits, of at most 256 MiB.
///
/// # Errors
///
/// If the input fails, is no PNG in colour, is damaged, or is not as wide as the square of its height, from 2 to 256. The
/// size is checked before memory for pixels is taken: 128 MiB for the largest, and twice 192 MiB for its entries.
pub fn read(input: impl Read, green: StripGreen) -> Result<Lut3d, Error> {
    let (size, Picture { width, pixels }) = picture::read(input, |width, height| {
        if (Lut3d::MIN_SIZE..=Lut3d::MAX_SIZE).contains(&height) && width == height * height {
            return Ok(height);
        }
        let expected = "a width that is the square of the height, and a height from 2 to 256";
        Err(refuse("size of a LUT strip", format!("{width} x {height} pixels"), expected))
    })?;
    let entries = (0..pixels.len()).map(|index| {
        let [red, node, blue] = node_at(index, size);
        pixels[red + size * blue + width * green_node(node, size, green)]
    });
    Ok(Lut3d::new(size, entries.collect())?)
}

/// The node of green in a row, and the row of a node.
fn green_node(row: usize, size: usize, green: StripGreen) -> usize {
    match green {
        StripGreen::Down => row,
        StripGreen::Up => size - 1 - row,
    }
}
