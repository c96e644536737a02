//! The windows of an OpenEXR header as they are written.
//!
//! The `exr` crate swaps corners that are the wrong way round, which makes an empty window one of 2 x 2 pixels.

use std::io::{BufRead, Read, Seek, SeekFrom};

use crate::error::{Error, ExrProblem};

/// Longest name of an attribute or type, with the zero at its end.
const NAME_BYTES: u64 = 257;

/// The highest number of a compression that the decoder knows.
const LAST_COMPRESSION: u8 = 11;

/// Refuses a part whose data window or display window is empty, or that is packed in a way of later than the decoder. `reader` is left anywhere.
///
/// A header that cannot be followed passes: its own reader has the words for that.
pub(crate) fn check<R: BufRead + Seek>(mut reader: R) -> Result<(), Error> {
    let mut start = [0; 8];
    if reader.read_exact(&mut start).is_err() {
        return Ok(());
    }
    let several_parts = start[5] & 0x10 != 0;
    while let Some(attribute) = next(&mut reader) {
        if attribute.name == b"compression\0" && attribute.byte > LAST_COMPRESSION {
            // OpenEXR 3.5 added Zstandard.
            let found = match attribute.byte {
                12 | 13 => "Zstandard".to_owned(),
                number => format!("the unknown number {number} as"),
            };
            return Err(ExrProblem::Compression { found }.into());
        }
        // A nameless attribute ends a header; of several, the last is followed by one more.
        let what = match &attribute.name[..] {
            b"dataWindow\0" => "the data window",
            b"displayWindow\0" => "the display window",
            b"\0" if !several_parts || !has_more(&mut reader) => return Ok(()),
            _ => continue,
        };
        let [left, top, right, bottom] = attribute.corners;
        if right < left || bottom < top {
            return Err(ExrProblem::EmptyWindow { what, columns: [left, right], rows: [top, bottom] }.into());
        }
    }
    Ok(())
}

/// One attribute of a header; the corners are those of a box.
struct Attribute {
    name: Vec<u8>,
    corners: [i32; 4],
    /// The value of an attribute of one byte.
    byte: u8,
}

fn next<R: BufRead + Seek>(reader: &mut R) -> Option<Attribute> {
    let name = word(reader)?;
    let (mut corners, mut byte) = ([0; 4], 0);
    if name != b"\0" {
        let kind = word(reader)?;
        let mut size = [0; 4];
        reader.read_exact(&mut size).ok()?;
        let size = i32::from_le_bytes(size);
        if kind == b"box2i\0" && size == 16 {
            let mut bytes = [0; 16];
            reader.read_exact(&mut bytes).ok()?;
            let (words, _) = bytes.as_chunks::<4>();
            corners.iter_mut().zip(words).for_each(|(corner, word)| *corner = i32::from_le_bytes(*word));
        } else if size == 1 {
            let mut bytes = [0];
            reader.read_exact(&mut bytes).ok()?;
            [byte] = bytes;
        } else {
            reader.seek(SeekFrom::Current(i64::from(u32::try_from(size).ok()?))).ok()?;
        }
    }
    Some(Attribute { name, corners, byte })
}

/// Bytes up to a zero, with it.
fn word<R: BufRead>(reader: &mut R) -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    reader.take(NAME_BYTES).read_until(0, &mut bytes).ok()?;
    (bytes.last() == Some(&0)).then_some(bytes)
}

fn has_more<R: BufRead>(reader: &mut R) -> bool {
    reader.fill_buf().is_ok_and(|bytes| bytes.first().is_some_and(|byte| *byte != 0))
}
