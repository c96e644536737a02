//! The directories of a TIFF, which EXIF is too: tags with numbers, read when they are asked for and within limits.

use std::io::{Read, Seek, SeekFrom};

use crate::{
    error::{Error, Kind, TiffProblem},
    limits::allocate,
};

/// Most numbers of a tag: the tiles of the largest picture, at the smallest tile there may be.
const MAX_NUMBERS: u64 = 1 << 20;
/// Most tags of a directory, which is what a classic TIFF can count.
const MAX_ENTRIES: u64 = 65_535;

/// A file of directories: its order of bytes, and whether it counts in 64 bits.
pub(crate) struct TiffFile<R> {
    pub(crate) reader: R,
    length: u64,
    order: Order,
    big: bool,
}

/// Which byte of a number comes first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Order {
    Little,
    Big,
}

/// The tags of one picture, and where the next directory lies: 0 after the last.
#[derive(Debug)]
pub(crate) struct Directory {
    entries: Vec<Entry>,
    pub(crate) next: u64,
}

/// A tag whose values have not been read.
#[derive(Debug, Clone, Copy)]
struct Entry {
    tag: u16,
    kind: u16,
    count: u64,
    /// Where the values lie in the file.
    at: u64,
}

/// A tag with its values, big-endian.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct RawTag {
    pub(crate) tag: u16,
    pub(crate) kind: u16,
    pub(crate) count: u32,
    pub(crate) bytes: Vec<u8>,
}

impl RawTag {
    /// A tag of one number of 32 bits.
    pub(crate) fn long(tag: u16, number: u32) -> Self {
        Self { tag, kind: 4, count: 1, bytes: number.to_be_bytes().to_vec() }
    }

    /// A tag of a text, which ends with a zero.
    pub(crate) fn ascii(tag: u16, text: &str) -> Self {
        Self { tag, kind: 2, count: text.len() as u32 + 1, bytes: [text.as_bytes(), &[0]].concat() }
    }
}

impl<R: Read + Seek> TiffFile<R> {
    /// A file of `length` bytes, and where its first directory lies.
    pub(crate) fn open(mut reader: R, length: u64) -> Result<(Self, u64), Error> {
        reader.seek(SeekFrom::Start(0))?;
        let mut start = [0; 2];
        reader.read_exact(&mut start)?;
        let order = if &start == b"MM" { Order::Big } else { Order::Little };
        let mut file = Self { reader, length, order, big: false };
        file.big = file.number(2)? == 43;
        if file.big {
            file.number(4)?; // the size of offsets, always 8
        }
        let first = file.offset()?;
        Ok((file, first))
    }

    /// The order of bytes of its numbers.
    pub(crate) fn order(&self) -> Order {
        self.order
    }

    /// The directory that lies at `at`.
    pub(crate) fn directory(&mut self, at: u64) -> Result<Directory, Error> {
        if at >= self.length {
            return Err(TiffProblem::DirectoryBeyondEnd { at, length: self.length }.into());
        }
        self.reader.seek(SeekFrom::Start(at))?;
        let (count_bytes, value_bytes) = if self.big { (8, 8) } else { (2, 4) };
        let count = self.number(count_bytes)?;
        let entry_bytes = 4 + 2 * value_bytes as u64;
        if count > MAX_ENTRIES || count * entry_bytes > self.length {
            return Err(TiffProblem::Entries { count }.into());
        }
        let mut entries = Vec::with_capacity(count as usize);
        for index in 0..count {
            let entry_at = at + count_bytes as u64 + index * entry_bytes;
            let (tag, kind) = (self.number(2)? as u16, self.number(2)? as u16);
            let (count, value) = (self.number(value_bytes)?, self.number(value_bytes)?);
            let inline = bytes_of(kind).is_some_and(|bytes| count.saturating_mul(bytes) <= value_bytes as u64);
            let at = if inline { entry_at + 4 + value_bytes as u64 } else { value };
            entries.push(Entry { tag, kind, count, at });
        }
        // A file that ends here has no further directory.
        let next = self.offset().unwrap_or(0);
        Ok(Directory { entries, next })
    }

    /// The whole numbers of a tag; `None` where it is not there.
    pub(crate) fn numbers(&mut self, directory: &Directory, tag: u16) -> Result<Option<Vec<u64>>, Error> {
        let Some(entry) = directory.entry(tag) else { return Ok(None) };
        let bytes = match entry.kind {
            1 | 6 | 7 => 1,
            3 => 2,
            4 | 13 => 4,
            16 | 18 => 8,
            kind => return Err(TiffProblem::TagKind { tag, kind }.into()),
        };
        let data = self.data(entry, bytes, MAX_NUMBERS)?;
        Ok(Some(data.chunks_exact(bytes as usize).map(|bytes| self.order.number(bytes)).collect()))
    }

    /// The first number of a tag.
    pub(crate) fn first(&mut self, directory: &Directory, tag: u16) -> Result<Option<u64>, Error> {
        Ok(self.numbers(directory, tag)?.and_then(|numbers| numbers.first().copied()))
    }

    /// The bytes of a tag, at most `max`; `None` where it is not there.
    pub(crate) fn bytes(&mut self, directory: &Directory, tag: u16, max: u64) -> Result<Option<Vec<u8>>, Error> {
        directory.entry(tag).map(|entry| self.data(entry, 1, max)).transpose()
    }

    /// The tags of up to `max` bytes each that are whole, of types that classic TIFF has.
    pub(crate) fn tags(&mut self, directory: &Directory, max: u64) -> Vec<RawTag> {
        let raw = |entry: &Entry| {
            let each = bytes_of(entry.kind).filter(|_| entry.kind <= 12)?;
            let total = entry.count.checked_mul(each).filter(|total| (1..=max).contains(total))?;
            if entry.at.checked_add(total).is_none_or(|end| end > self.length) {
                return None;
            }
            let mut bytes = self.read_at(entry.at, total).ok()?;
            // A rational is two numbers of 32 bits.
            let number = if matches!(entry.kind, 5 | 10) { 4 } else { each as usize };
            if self.order == Order::Little {
                bytes.chunks_exact_mut(number).for_each(<[u8]>::reverse);
            }
            Some(RawTag { tag: entry.tag, kind: entry.kind, count: entry.count as u32, bytes })
        };
        directory.entries.iter().filter_map(raw).collect()
    }

    /// Bytes of the picture, which lie at `at`.
    pub(crate) fn read_at(&mut self, at: u64, count: u64) -> Result<Vec<u8>, Error> {
        if at.checked_add(count).is_none_or(|end| end > self.length) {
            return Err(Kind::EndsEarly.into());
        }
        self.reader.seek(SeekFrom::Start(at))?;
        let mut bytes = allocate(usize::try_from(count).unwrap_or(usize::MAX), 0)?;
        self.reader.read_exact(&mut bytes)?;
        Ok(bytes)
    }

    fn data(&mut self, entry: Entry, bytes: u64, max: u64) -> Result<Vec<u8>, Error> {
        let Entry { tag, count, at, .. } = entry;
        if count > max {
            return Err(TiffProblem::Tag { tag, count, max }.into());
        }
        let total = count * bytes;
        if at.checked_add(total).is_none_or(|end| end > self.length) {
            return Err(TiffProblem::TagBeyondEnd { tag, count }.into());
        }
        self.read_at(at, total)
    }

    fn offset(&mut self) -> Result<u64, Error> {
        self.number(if self.big { 8 } else { 4 })
    }

    /// A number of up to eight bytes.
    fn number(&mut self, bytes: usize) -> Result<u64, Error> {
        let mut word = [0; 8];
        let word = &mut word[..bytes];
        self.reader.read_exact(word)?;
        Ok(self.order.number(word))
    }
}

impl Order {
    /// The number that up to eight bytes give.
    pub(crate) fn number(self, bytes: &[u8]) -> u64 {
        let append = |number: u64, byte: &u8| number << 8 | u64::from(*byte);
        match self {
            Self::Big => bytes.iter().fold(0, append),
            Self::Little => bytes.iter().rev().fold(0, append),
        }
    }
}

impl Directory {
    /// Whether it has a tag.
    pub(crate) fn has(&self, tag: u16) -> bool {
        self.entry(tag).is_some()
    }

    fn entry(&self, tag: u16) -> Option<Entry> {
        self.entries.iter().find(|entry| entry.tag == tag).copied()
    }
}

/// Bytes of a value of a type; none where the type is unknown.
fn bytes_of(kind: u16) -> Option<u64> {
    match kind {
        1 | 2 | 6 | 7 => Some(1),
        3 | 8 => Some(2),
        4 | 9 | 11 | 13 => Some(4),
        5 | 10 | 12 | 16 | 17 | 18 => Some(8),
        _ => None,
    }
}
