//! `.vlt`: the tables of Panasonic's cameras.

use std::io::{BufWriter, Write};

use onelight_lut::Lut3d;

use crate::error::{Error, ErrorKind};

/// Nodes along each side of every file.
pub const SIZE: usize = 17;

/// The largest code.
const MAX: f32 = 4095.0;

/// Writes a table as `.vlt` of version 1.0 \[PanasonicVlt2014\]: 17 nodes a side, codes of 12 bits, red fastest.
///
/// What goes in is coded, from 0 to 1 in 12 bits. Entries are clamped to 0 to 1 and rounded. The file holds no comment: cameras
/// want its four first lines as they are.
///
/// # Errors
///
/// If the table has another size, or the writer fails; what it took until then is an incomplete file.
///
/// ```
/// use onelight_formats::vlt;
///
/// let mut file = Vec::new();
/// vlt::write(&mut file, &onelight_lut::Lut3d::identity(vlt::SIZE)?)?;
/// assert!(file.starts_with(b"# panasonic vlt file version 1.0\n# source vlt file \"\"\nLUT_3D_SIZE 17\n\n0 0 0\n256 0 0\n"));
/// # Ok::<(), onelight_formats::Error>(())
/// ```
pub fn write(writer: impl Write, table: &Lut3d) -> Result<(), Error> {
    if table.size() != SIZE {
        return Err(ErrorKind::VltSize { found: table.size() }.into());
    }
    let mut out = BufWriter::with_capacity(1 << 16, writer);
    write!(out, "# panasonic vlt file version 1.0\n# source vlt file \"\"\nLUT_3D_SIZE {SIZE}\n\n")?;
    for entry in table.entries() {
        let [r, g, b] = entry.map(|v| (v.clamp(0.0, 1.0) * MAX).round());
        writeln!(out, "{r} {g} {b}")?;
    }
    out.flush()?;
    Ok(())
}
