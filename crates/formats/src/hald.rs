//! Hald CLUTs: a table as a square PNG, for photo editors.

use std::io::{Read, Write};

use onelight_lut::Lut3d;

use crate::error::{Error, ErrorKind};
use crate::picture::{self, PngDepth, refuse};

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
/// use onelight_formats::{PngDepth, hald};
/// use onelight_lut::Lut3d;
///
/// let table = Lut3d::identity(16)?;
/// let mut file = Vec::new();
/// hald::write(&mut file, &table, PngDepth::Sixteen, ["level 4"])?;
/// assert_eq!(hald::read(file.as_slice())?.size(), 16);
/// # Ok::<(), onelight_formats::Error>(())
/// ```
pub fn write<S: AsRef<str>>(
    writer: impl Write,
    table: &Lut3d,
    depth: PngDepth,
    comments: impl IntoIterator<Item = S>,
) -> Result<(), Error> {
    let size = table.size();
    let level = LEVELS.into_iter().find(|level| level * level == size).ok_or(ErrorKind::HaldSize { found: size })?;
    picture::write(writer, [level * size; 2], depth, table.entries(), comments)
}

/// Reads a Hald CLUT from a PNG of 8 or 16 bits, of at most 256 MiB; one in grey, which programs write for looks in black and white,
/// gives equal entries.
///
/// # Errors
///
/// If the input fails, is no PNG, is damaged, or its sides are not `L^3` with a level `L` from 2 to 16. The side is
/// checked before memory for pixels is taken: 128 MiB for the largest, and 192 MiB for its entries.
pub fn read(input: impl Read) -> Result<Lut3d, Error> {
    let (size, picture) = picture::read(input, |width, height| {
        let level = LEVELS.into_iter().find(|level| level.pow(3) == width && width == height);
        level.map(|level| level * level).ok_or_else(|| {
            let expected = "a square whose side is the cube of a level from 2 to 16";
            refuse("size of a Hald CLUT", format!("{width} x {height} pixels"), expected)
        })
    })?;
    Ok(Lut3d::new(size, picture.pixels)?)
}
