//! The lengths that the tags of a TIFF claim, checked before the decoder takes memory for them.
//!
//! The decoder of `tiff` 0.11 takes 32 bytes for each number that a tag claims, up to 256 MiB, before it reads one.

use std::io::{Read, Seek, SeekFrom};

use crate::error::{Error, TiffProblem};

/// The tags that say how pixels are stored; others the decoder leaves alone.
const READ: std::ops::RangeInclusive<u64> = 254..=347;

/// Most numbers of a tag: the tiles of the largest picture, at the smallest tile there may be.
const MAX_NUMBERS: u64 = 1 << 20;

/// Refuses a file of `length` bytes whose first directory has a tag of more numbers than the file or anyone can have.
/// `reader` is left anywhere.
///
/// A directory that cannot be followed passes: its own reader has the words for that.
pub(crate) fn check<R: Read + Seek>(reader: R, length: u64) -> Result<(), Error> {
    let mut file = File { reader, order: Order::Little };
    let Some(directory) = file.directory() else { return Ok(()) };
    for _ in 0..directory.entries {
        let Some((tag, kind, count)) = file.entry(directory.number) else { return Ok(()) };
        let Some(bytes) = bytes_of(kind).filter(|_| READ.contains(&tag)) else { continue };
        if count > MAX_NUMBERS || count.saturating_mul(bytes) > length {
            return Err(TiffProblem::Tag { tag, count, max: MAX_NUMBERS }.into());
        }
    }
    Ok(())
}

/// Bytes of a number of a type; none where it is text or unknown.
fn bytes_of(kind: u64) -> Option<u64> {
    match kind {
        1 | 6 | 7 => Some(1),
        3 | 8 => Some(2),
        4 | 9 | 11 | 13 => Some(4),
        5 | 10 | 12 | 16 | 17 | 18 => Some(8),
        _ => None,
    }
}

#[derive(Clone, Copy)]
enum Order {
    Little,
    Big,
}

struct File<R> {
    reader: R,
    order: Order,
}

/// A list of tags whose first comes next.
struct Directory {
    entries: u64,
    /// Bytes of an offset or a count: 4, in a `BigTIFF` 8.
    number: usize,
}

impl<R: Read + Seek> File<R> {
    fn directory(&mut self) -> Option<Directory> {
        let mut start = [0; 2];
        self.reader.read_exact(&mut start).ok()?;
        self.order = if &start == b"MM" { Order::Big } else { Order::Little };
        let number = match self.number(2)? {
            43 => {
                self.number(4)?; // the size of offsets, always 8
                8
            }
            _ => 4,
        };
        let at = self.number(number)?;
        self.reader.seek(SeekFrom::Start(at)).ok()?;
        let entries = self.number(if number == 8 { 8 } else { 2 })?;
        Some(Directory { entries, number })
    }

    /// Tag, type and count of the next entry.
    fn entry(&mut self, number: usize) -> Option<(u64, u64, u64)> {
        let entry = (self.number(2)?, self.number(2)?, self.number(number)?);
        self.number(number)?;
        Some(entry)
    }

    /// A number of up to eight bytes.
    fn number(&mut self, bytes: usize) -> Option<u64> {
        let mut word = [0; 8];
        match self.order {
            Order::Little => {
                self.reader.read_exact(word.get_mut(..bytes)?).ok()?;
                Some(u64::from_le_bytes(word))
            }
            Order::Big => {
                self.reader.read_exact(word.get_mut(8 - bytes..)?).ok()?;
                Some(u64::from_be_bytes(word))
            }
        }
    }
}
