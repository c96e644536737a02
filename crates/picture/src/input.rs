//! What pictures are read from.

use std::io::{BufReader, Read, Seek, SeekFrom};

use crate::error::Error;

/// Bytes that can be read from any place, on any thread.
pub(crate) trait ReadSeek: Read + Seek + Send {}

impl<R: Read + Seek + Send> ReadSeek for R {}

/// The reader of a file, of one type for all formats: each format's code is compiled once, here.
pub(crate) type Input<'a> = BufReader<Box<dyn ReadSeek + 'a>>;

/// The input at its start, and its length in bytes.
pub(crate) fn input<'a>(mut reader: impl Read + Seek + Send + 'a) -> Result<(Input<'a>, u64), Error> {
    let length = reader.seek(SeekFrom::End(0))?;
    reader.seek(SeekFrom::Start(0))?;
    Ok((BufReader::new(Box::new(reader)), length))
}
