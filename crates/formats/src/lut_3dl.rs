//! `.3dl`: the tables of Autodesk's Lustre and Flame, which many older programs read.

use std::io::{BufWriter, Write};

use onelight_lut::Lut3d;

use crate::error::Error;
use crate::node_order::blue_fastest;
use crate::text::one_line;

/// The largest code of the mesh, and of an entry.
const MESH_MAX: usize = 1023;
const MAX: f32 = 4095.0;

/// Writes a table as `.3dl`: a line with the mesh in codes of 10 bits, then entries in codes of 12 bits, blue fastest.
///
/// What goes in is coded, from 0 to 1. Entries are clamped to 0 to 1 and rounded. Programs that read the format expect 17 or 33
/// nodes a side; the comments go into lines with `#` before the mesh.
///
/// # Errors
///
/// If the writer fails; what it took until then is an incomplete file.
///
/// ```
/// use onelight_formats::lut_3dl;
///
/// let mut file = Vec::new();
/// lut_3dl::write(&mut file, &onelight_lut::Lut3d::identity(2)?, ["LogC4 in"])?;
/// assert!(file.starts_with(b"# LogC4 in\n0 1023\n0 0 0\n0 0 4095\n0 4095 0\n"));
/// # Ok::<(), onelight_formats::Error>(())
/// ```
pub fn write<S: AsRef<str>>(
    writer: impl Write,
    table: &Lut3d,
    comments: impl IntoIterator<Item = S>,
) -> Result<(), Error> {
    let mut out = BufWriter::with_capacity(1 << 16, writer);
    for comment in comments {
        for line in comment.as_ref().lines() {
            writeln!(out, "# {}", one_line(line))?;
        }
    }
    let last = table.size() - 1;
    let mesh: Vec<String> = (0..=last).map(|node| ((node * MESH_MAX + last / 2) / last).to_string()).collect();
    writeln!(out, "{}", mesh.join(" "))?;
    for (_, entry) in blue_fastest(table) {
        let [r, g, b] = entry.map(|v| (v.clamp(0.0, 1.0) * MAX).round());
        writeln!(out, "{r} {g} {b}")?;
    }
    out.flush()?;
    Ok(())
}
