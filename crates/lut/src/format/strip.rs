use std::io::{Read, Write};

use super::picture::{self, Picture, PngDepth, refuse};
use crate::error::Error;
use crate::lut3d::Lut3d;

/// Which way green runs in each tile of a strip.
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
/// If the writer fails.
///
/// ```
/// # use onelight_lut::{Lut3d, PngDepth, StripGreen, read_strip, write_strip};
/// let table = Lut3d::identity(16)?;
/// let mut file = Vec::new();
/// write_strip(&mut file, &table, PngDepth::Eight, StripGreen::Down, ["for Unreal"])?;
/// assert_eq!(read_strip(file.as_slice(), StripGreen::Down)?.entry([1, 0, 0]).unwrap(), [17.0 / 255.0, 0.0, 0.0]);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
pub fn write_strip<S: AsRef<str>>(
    writer: impl Write,
    table: &Lut3d,
    depth: PngDepth,
    green: StripGreen,
    comments: impl IntoIterator<Item = S>,
) -> Result<(), Error> {
    let size = table.size();
    let pixels = (0..size).flat_map(|row| (0..size * size).map(move |column| (row, column)));
    let pixels = pixels.filter_map(|(row, column)| {
        let [red, blue] = [column % size, column / size];
        table.entry([red, green_node(row, size, green), blue])
    });
    picture::write(writer, [size * size, size], depth, pixels, comments)
}

/// Reads a strip from a PNG of 8 or 16 bits, of at most 256 MiB.
///
/// # Errors
///
/// If the input fails, is no PNG in colour, is damaged, or is not as wide as the square of its height, from 2 to 256. The
/// size is checked before memory for pixels is taken: 128 MiB for the largest, and twice 192 MiB for its entries.
pub fn read_strip(input: impl Read, green: StripGreen) -> Result<Lut3d, Error> {
    let (size, Picture { width, pixels }) = picture::read(input, |width, height| {
        if (Lut3d::MIN_SIZE..=Lut3d::MAX_SIZE).contains(&height) && width == height * height {
            return Ok(height);
        }
        let expected = "a width that is the square of the height, and a height from 2 to 256";
        Err(refuse("size of a LUT strip", format!("{width} x {height} pixels"), expected))
    })?;
    let entries = (0..pixels.len()).filter_map(|index| {
        let [red, node, blue] = [index % size, index / size % size, index / (size * size)];
        pixels.get(red + size * blue + width * green_node(node, size, green)).copied()
    });
    Lut3d::new(size, entries.collect())
}

/// The node of green in a row, and the row of a node.
fn green_node(row: usize, size: usize, green: StripGreen) -> usize {
    match green {
        StripGreen::Down => row,
        StripGreen::Up => size - 1 - row,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::picture::tests::{bent, damage, nearest_code};

    const BOTH: [StripGreen; 2] = [StripGreen::Down, StripGreen::Up];

    #[test]
    fn tables_come_back_to_half_a_code() {
        for depth in [PngDepth::Eight, PngDepth::Sixteen] {
            for (size, green) in [2, 16, 32].into_iter().flat_map(|size| BOTH.map(|green| (size, green))) {
                let table = bent(size);
                let mut file = Vec::new();
                write_strip(&mut file, &table, depth, green, ["a comment"]).unwrap();
                let back = read_strip(file.as_slice(), green).unwrap();
                assert_eq!(back.entries().collect::<Vec<_>>(), nearest_code(&table, depth));
            }
        }
    }

    #[test]
    fn tiles_lie_as_the_engines_want_them() {
        for (green, black, lime) in [(StripGreen::Down, 0, 15), (StripGreen::Up, 15, 0)] {
            let mut file = Vec::new();
            write_strip(&mut file, &Lut3d::identity(16).unwrap(), PngDepth::Eight, green, [""; 0]).unwrap();
            let (_, picture) = picture::read(file.as_slice(), |width, height| {
                assert_eq!([width, height], [256, 16]);
                Ok(())
            })
            .unwrap();
            let at = |x: usize, y: usize| picture.pixels[x + 256 * y];
            assert_eq!(at(0, black), [0.0; 3]);
            assert_eq!(at(15, black), [1.0, 0.0, 0.0]);
            assert_eq!(at(0, lime), [0.0, 1.0, 0.0]);
            assert_eq!(at(240, black), [0.0, 0.0, 1.0]);
        }
    }

    #[test]
    fn other_sizes_and_damage_are_refused() {
        let mut file = Vec::new();
        write_strip(&mut file, &bent(4), PngDepth::Sixteen, StripGreen::Down, [""; 0]).unwrap();
        damage(&file, |bytes| read_strip(bytes, StripGreen::Down));
        let mut hald = Vec::new();
        crate::write_hald(&mut hald, &bent(4), PngDepth::Eight, [""; 0]).unwrap();
        let error = read_strip(hald.as_slice(), StripGreen::Up).unwrap_err();
        assert!(error.to_string().starts_with("size of a LUT strip: found 8 x 8 pixels"), "{error}");
    }
}
