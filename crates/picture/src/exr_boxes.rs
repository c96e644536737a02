//! The header of an OpenEXR file as it is written: its windows, and what is kept of it.
//!
//! The `exr` crate swaps corners that are the wrong way round, which makes an empty window one of 2 x 2 pixels.

use std::io::{BufRead, Read, Seek, SeekFrom};

use crate::{
    error::{Error, ExrProblem},
    metadata::ExrAttribute,
};

/// Longest name of an attribute or type, with the zero at its end.
const NAME_BYTES: u64 = 257;

/// Most bytes of a value that is looked at.
const VALUE_BYTES: u32 = 1 << 14;
/// Most bytes of what is kept.
const METADATA_BYTES: usize = 1 << 18;

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
        if let (b"compression\0", [number]) = (&attribute.name[..], &attribute.value[..])
            && *number > LAST_COMPRESSION
        {
            // OpenEXR 3.5 added Zstandard.
            let found = match number {
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
        let corners: Vec<i32> = attribute.value.as_chunks().0.iter().map(|word| i32::from_le_bytes(*word)).collect();
        let [left, top, right, bottom] = corners[..] else { continue };
        if right < left || bottom < top {
            return Err(ExrProblem::EmptyWindow { what, columns: [left, right], rows: [top, bottom] }.into());
        }
    }
    Ok(())
}

/// One attribute of a header, or the nameless end of one.
struct Attribute {
    name: Vec<u8>,
    kind: Vec<u8>,
    /// Empty where it is longer than [`VALUE_BYTES`].
    value: Vec<u8>,
}

fn next<R: BufRead + Seek>(reader: &mut R) -> Option<Attribute> {
    let name = word(reader)?;
    let (mut kind, mut value) = (Vec::new(), Vec::new());
    if name != b"\0" {
        kind = word(reader)?;
        let mut size = [0; 4];
        reader.read_exact(&mut size).ok()?;
        let size = u32::try_from(i32::from_le_bytes(size)).ok()?;
        if size <= VALUE_BYTES {
            value.resize(size as usize, 0);
            reader.read_exact(&mut value).ok()?;
        } else {
            reader.seek(SeekFrom::Current(i64::from(size))).ok()?;
        }
    }
    Some(Attribute { name, kind, value })
}

/// What the header of a part says of how its picture was taken, by name: see [`Metadata`](crate::Metadata). `reader` is left
/// anywhere; what cannot be followed is left out.
pub(crate) fn metadata<R: BufRead + Seek>(mut reader: R, part: usize) -> Vec<ExrAttribute> {
    let (mut start, mut kept, mut room, mut at) = ([0; 8], Vec::new(), METADATA_BYTES, 0);
    if reader.read_exact(&mut start).is_err() {
        return kept;
    }
    while let Some(attribute) = next(&mut reader) {
        if attribute.name == b"\0" {
            if at == part {
                break;
            }
            at += 1;
            continue;
        }
        let text = |bytes: &[u8]| {
            let text = bytes.strip_suffix(b"\0").and_then(|bytes| std::str::from_utf8(bytes).ok());
            // What is written is Latin-1, as which these are read.
            text.filter(|text| text.is_ascii() && !text.is_empty()).map(str::to_owned)
        };
        let (Some(name), Some(kind)) = (text(&attribute.name), text(&attribute.kind)) else { continue };
        let bytes = name.len() + kind.len() + attribute.value.len();
        if at == part && bytes <= room && is_whole(&kind, attribute.value.len()) && stays_true(&name) {
            room -= bytes;
            kept.push(ExrAttribute { name, kind, bytes: attribute.value });
        }
    }
    kept.sort_by(|a, b| a.name.cmp(&b.name));
    kept.dedup_by(|a, b| a.name == b.name);
    kept
}

/// Whether a value has the bytes that its type has, which other programs rely on; types that are not known have none.
fn is_whole(kind: &str, bytes: usize) -> bool {
    match kind {
        "string" => true,
        "envmap" => bytes == 1,
        "int" | "float" => bytes == 4,
        "double" | "rational" | "v2i" | "v2f" | "timecode" => bytes == 8,
        "v3i" | "v3f" => bytes == 12,
        "box2i" | "box2f" | "v2d" => bytes == 16,
        "v3d" => bytes == 24,
        "keycode" => bytes == 28,
        "m33f" => bytes == 36,
        "m44f" => bytes == 64,
        "m33d" => bytes == 72,
        "m44d" => bytes == 128,
        "floatvector" => bytes.is_multiple_of(4),
        _ => false,
    }
}

/// Whether an attribute says the same of the picture that is written as of the one that was read.
fn stays_true(name: &str) -> bool {
    /// What the writer writes itself, what is of the file and not of the picture, and what is said of its colours.
    const OF_THE_FILE: [&str; 30] = [
        "acesImageContainerFlag",
        "adoptedNeutral",
        "channels",
        "chromaticities",
        "chunkCount",
        "colorInteropID",
        "compression",
        "dataWindow",
        "deepImageState",
        "displayWindow",
        "dwaCompressionLevel",
        "gamma",
        "idManifest",
        "lineOrder",
        "lookModTransform",
        "maxSamplesPerPixel",
        "multiView",
        "name",
        "originalDataWindow",
        "pixelAspectRatio",
        "preview",
        "renderingTransform",
        "screenWindowCenter",
        "screenWindowWidth",
        "software",
        "Software",
        "tiles",
        "type",
        "version",
        "whiteLuminance",
    ];
    // The masks' manifests are of channels that are not written; the last are our own.
    const BEGINNINGS: [&str; 3] = ["cryptomatte/", "oiio:", "onelight "];
    !OF_THE_FILE.contains(&name) && !BEGINNINGS.iter().any(|beginning| name.starts_with(beginning))
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
