use std::io::{Read, Write};

use super::picture::{self, PngDepth, refuse};
use crate::error::{Error, Kind};
use crate::lut3d::Lut3d;

/// The lowest and highest level: tables of 4 and of 256 nodes a side.
const LEVELS: std::ops::RangeInclusive<usize> = 2..=16;

/// Writes a table as a Hald CLUT: a square PNG that darktable, `RawTherapee`, GIMP (G'MIC) and `ImageMagick` read.
///
/// A Hald of level `L` has `L^2` nodes a side and `L^3` pixels a side; red runs fastest, then green, then blue, row by row
/// from the top. Its coordinates are the picture's codes from 0 to 1, whatever coding those have, and so are its entries:
/// they are clamped to 0 to 1 and rounded to the depth. The comments go into a text chunk.
///
/// # Errors
///
/// If the table's size is not a square from 4 to 256, or the writer fails.
///
/// ```
/// # use onelight_lut::{Lut3d, PngDepth, read_hald, write_hald};
/// let table = Lut3d::identity(16)?;
/// let mut file = Vec::new();
/// write_hald(&mut file, &table, PngDepth::Sixteen, ["level 4"])?;
/// assert_eq!(read_hald(file.as_slice())?.size(), 16);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
pub fn write_hald<S: AsRef<str>>(
    writer: impl Write,
    table: &Lut3d,
    depth: PngDepth,
    comments: impl IntoIterator<Item = S>,
) -> Result<(), Error> {
    let size = table.size();
    let level = LEVELS.into_iter().find(|level| level * level == size).ok_or(Kind::Parameter {
        what: "size of a table for a Hald CLUT",
        found: size as f64,
        expected: "the square of a level from 2 to 16, such as 25, 36, 49 or 64",
    })?;
    picture::write(writer, [level * size; 2], depth, table.entries(), comments)
}

/// Reads a Hald CLUT from a PNG of 8 or 16 bits, of at most 256 MiB.
///
/// # Errors
///
/// If the input fails, is no PNG in colour, is damaged, or its sides are not `L^3` with a level `L` from 2 to 16. The side is
/// checked before memory for pixels is taken: 128 MiB for the largest, and 192 MiB for its entries.
pub fn read_hald(input: impl Read) -> Result<Lut3d, Error> {
    let (size, picture) = picture::read(input, |width, height| {
        let level = LEVELS.into_iter().find(|level| level.pow(3) == width && width == height);
        level.map(|level| level * level).ok_or_else(|| {
            let expected = "a square whose side is the cube of a level from 2 to 16";
            refuse("size of a Hald CLUT", format!("{width} x {height} pixels"), expected)
        })
    })?;
    Lut3d::new(size, picture.pixels)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::picture::tests::{bent, damage, nearest_code};

    #[test]
    fn tables_come_back_to_half_a_code() {
        for depth in [PngDepth::Eight, PngDepth::Sixteen] {
            for size in [4, 9, 25] {
                let table = bent(size);
                let mut file = Vec::new();
                write_hald(&mut file, &table, depth, ["max dE 0.3", "\u{3b4}"]).unwrap();
                let back = read_hald(file.as_slice()).unwrap();
                assert_eq!(back.entries().collect::<Vec<_>>(), nearest_code(&table, depth));
                // Codes are fixed points.
                let mut again = Vec::new();
                write_hald(&mut again, &back, depth, ["max dE 0.3", "\u{3b4}"]).unwrap();
                assert_eq!(again, file);
            }
        }
    }

    #[test]
    fn red_runs_along_the_first_row() {
        let mut file = Vec::new();
        write_hald(&mut file, &Lut3d::identity(4).unwrap(), PngDepth::Eight, [""; 0]).unwrap();
        let (_, picture) = picture::read(file.as_slice(), |width, height| {
            assert_eq!([width, height], [8, 8]);
            Ok(())
        })
        .unwrap();
        let third = 85.0 / 255.0;
        assert_eq!(picture.pixels[1], [third, 0.0, 0.0]);
        assert_eq!(picture.pixels[4], [0.0, third, 0.0]);
        assert_eq!(picture.pixels[2 * 8], [0.0, 0.0, third]);
    }

    #[test]
    fn other_sizes_and_damage_are_refused() {
        let found = write_hald(Vec::new(), &Lut3d::identity(33).unwrap(), PngDepth::Eight, [""; 0]).unwrap_err();
        assert!(found.to_string().contains("found 33, expected the square of a level"), "{found}");
        let mut file = Vec::new();
        write_hald(&mut file, &bent(4), PngDepth::Sixteen, [""; 0]).unwrap();
        damage(&file, |bytes| read_hald(bytes));
    }
}
