//! Whether a picture of ours is there, whole, and what it says of itself: by its header and its end, without its pixels.

use std::{
    fs::File,
    io::{BufRead, BufReader, Seek, SeekFrom},
    path::Path,
};

use exr::meta::{BlockDescription, MetaData, attribute::AttributeValue};

use super::guard::guarded;

/// The text `key` of the PNG or OpenEXR file `path`, as [`write_png_bands`](super::write_png_bands) and
/// [`write_exr_bands`](super::write_exr_bands) write it; `None` where it has none, or the file is damaged, cut short,
/// of another kind or not there.
///
/// Files are written whole or not at all, so that beginning and end tell enough: the pixels are not looked at.
pub(crate) fn text_of_finished(path: &Path, key: &str) -> Option<String> {
    let file = File::open(path).ok()?;
    let found = file.metadata().ok()?;
    let mut reader = BufReader::new(file);
    let png = found.is_file() && reader.fill_buf().ok()?.starts_with(b"\x89PNG");
    let text = if png { guarded(|| of_png(reader, key)) } else { guarded(|| of_exr(reader, found.len(), key)) };
    text.ok()?
}

/// Memory that the PNG decoder may take for a row and its texts.
const WORKING_BYTES: usize = 1 << 26;

/// The last chunk of a PNG.
const IEND: [u8; 12] = *b"\0\0\0\0IEND\xae\x42\x60\x82";

fn of_png(mut reader: impl BufRead + Seek, key: &str) -> Option<String> {
    let mut end = [0; IEND.len()];
    reader.seek(SeekFrom::End(-(IEND.len() as i64))).ok()?;
    reader.read_exact(&mut end).ok()?;
    reader.rewind().ok()?;
    let reader = png::Decoder::new_with_limits(reader, png::Limits { bytes: WORKING_BYTES }).read_info().ok()?;
    let text = reader.info().uncompressed_latin1_text.iter().find(|text| text.keyword == key)?;
    (end == IEND).then(|| text.text.clone())
}

fn of_exr(mut reader: impl BufRead + Seek, length: u64, key: &str) -> Option<String> {
    let meta = MetaData::read_from_buffered(&mut reader, false).ok()?;
    let [header] = &meta.headers[..] else { return None };
    let texts = || header.own_attributes.other.iter().chain(&header.shared_attributes.other);
    let text = texts().find_map(|(name, value)| match value {
        AttributeValue::Text(text) if name.eq(key) => Some(text.to_string()),
        _ => None,
    })?;
    if header.blocks != BlockDescription::ScanLines {
        return None;
    }
    // The last block ends where the file ends.
    let mut word = [0; 8];
    let last = u64::try_from(header.chunk_count).ok()?.checked_sub(1)?;
    reader.seek(SeekFrom::Current(i64::try_from(last).ok()?.checked_mul(8)?)).ok()?;
    reader.read_exact(&mut word).ok()?;
    let offset = u64::from_le_bytes(word);
    reader.seek(SeekFrom::Start(offset)).ok()?;
    // Its row, and its size.
    reader.read_exact(&mut word).ok()?;
    let [.., a, b, c, d] = word;
    let size = u64::from(u32::from_le_bytes([a, b, c, d]));
    (offset.checked_add(8)?.checked_add(size)? == length).then_some(text)
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;
    use crate::picture::{Bits, Channels, Description, Source, exr_write, png_write};

    const KEY: &str = "onelight job";

    /// A black picture as PNG and as EXR.
    fn files(width: usize) -> [Vec<u8>; 2] {
        let picture = Description::plain(width, 3, Channels::Rgb, Source::Exr);
        let rgb = vec![[0.25; 3]; width * 3];
        let texts = [("Software", "onelight"), ("onelight look", "day"), (KEY, "a1")];
        let band = || crate::picture::BandView { top: 0, width, rgb: &rgb, alpha: None };
        let (mut png, mut exr) = (Vec::new(), Cursor::new(Vec::new()));
        png_write::write_bands_to(&mut png, &picture, Bits::Sixteen, None, &texts, |sink| sink.write(band())).unwrap();
        exr_write::write_bands_to(&mut exr, &picture, &texts, |sink| sink.write(band())).unwrap();
        [png, exr.into_inner()]
    }

    fn found(png: &[u8], exr: &[u8]) -> [Option<String>; 2] {
        let length = exr.len() as u64;
        let found = [guarded(|| of_png(Cursor::new(png), KEY)), guarded(|| of_exr(Cursor::new(exr), length, KEY))];
        found.map(|found| found.ok().flatten())
    }

    #[test]
    fn whole_files_say_what_they_are() {
        for width in [1, 40, 65_535] {
            let [png, exr] = files(width);
            assert_eq!(found(&png, &exr), [Some("a1".to_owned()), Some("a1".to_owned())], "{width}");
            assert_eq!(of_png(Cursor::new(&png), "another"), None);
            assert_eq!(of_exr(Cursor::new(&exr), exr.len() as u64, "another"), None);
        }
    }

    #[test]
    fn files_cut_short_say_nothing() {
        let [png, exr] = files(40);
        for left in 0..png.len().max(exr.len()) {
            let expect = |whole: usize| (left >= whole).then(|| "a1".to_owned());
            let cut = |bytes: &[u8]| bytes[..left.min(bytes.len())].to_vec();
            assert_eq!(found(&cut(&png), &cut(&exr)), [expect(png.len()), expect(exr.len())], "{left}");
        }
    }

    /// Damage gives the text, another or none, and no panic.
    #[test]
    fn damaged_files_end() {
        let [png, exr] = files(40);
        for at in 0..png.len().max(exr.len()) {
            for byte in [0, 0x7f, 0xff] {
                let damaged = |bytes: &[u8]| {
                    let mut bytes = bytes.to_vec();
                    bytes.get_mut(at).into_iter().for_each(|old| *old = byte);
                    bytes
                };
                found(&damaged(&png), &damaged(&exr));
            }
        }
    }
}
