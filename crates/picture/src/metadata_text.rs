//! What a complete picture of ours says of itself: by its header and its end, without its pixels.

use std::io::{BufRead, Read, Seek, SeekFrom};

#[cfg(feature = "exr")]
use exr::meta::{
    BlockDescription, MetaData,
    attribute::{AttributeValue, Text},
};

#[cfg(feature = "png")]
use crate::limits::PNG_WORKING_BYTES;
#[cfg(feature = "tiff")]
use crate::tiff_directory::TiffFile;
use crate::{
    input::{Input, input},
    panic_to_error::panic_to_error,
};

/// The number of a JPEG's application segments that hold texts, and what those begin with.
#[cfg(feature = "jpeg")]
pub(crate) const TEXT_SEGMENT: u8 = 10;
#[cfg(feature = "jpeg")]
pub(crate) const TEXT_MARK: &[u8] = b"onelight\0";

/// The text `key` of a PNG, TIFF, JPEG or OpenEXR file, as [`write_png`](crate::write_png) and its like write it;
/// `None` where it has none, or the file is damaged, cut short or of another kind.
///
/// Beginning and end are read, not the pixels: a file that is written under another name, and renamed when it is complete, is
/// known to be complete by that. A program learns from it whether a file is what it would write again.
///
/// ```
/// use std::io::Cursor;
///
/// use onelight_picture::{Picture, Source, text_of_complete_picture};
///
/// let mut file = Cursor::new(Vec::new());
/// Picture::opaque(1, 1, vec![[0.18; 3]], Source::Exr).write_exr(&mut file, &[("job", "grey, take 2")])?;
/// assert_eq!(text_of_complete_picture(&mut file, "job").as_deref(), Some("grey, take 2"));
///
/// let cut_short = &file.get_ref()[..file.get_ref().len() - 1];
/// assert_eq!(text_of_complete_picture(Cursor::new(cut_short), "job"), None);
/// # Ok::<(), onelight_picture::Error>(())
/// ```
pub fn text_of_complete_picture(reader: impl Read + Seek + Send, key: &str) -> Option<String> {
    let (mut input, length) = input(reader).ok()?;
    match input.fill_buf().ok()? {
        #[cfg(feature = "png")]
        [0x89, b'P', b'N', b'G', ..] => panic_to_error(|| of_png(input, key)).ok()?,
        #[cfg(feature = "tiff")]
        [b'M', b'M', 0, 42, ..] => of_tiff(input, length, key),
        #[cfg(feature = "jpeg")]
        [0xff, 0xd8, 0xff, ..] => of_jpeg(input, key),
        #[cfg(feature = "exr")]
        _ => panic_to_error(|| of_exr(input, length, key)).ok()?,
        #[cfg(not(feature = "exr"))]
        _ => None,
    }
}

/// A text as a line of a description: the key, and the value with its line ends as two characters.
#[cfg(any(feature = "jpeg", feature = "tiff"))]
pub(crate) fn text_line(key: &str, value: &str) -> String {
    format!("{key}: {}", value.replace('\\', "\\\\").replace('\n', "\\n"))
}

/// What [`text_line`] made a line of.
#[cfg(any(feature = "jpeg", feature = "tiff"))]
fn text_of_line(line: &str, key: &str) -> Option<String> {
    let mut value = String::new();
    let mut letters = line.strip_prefix(key)?.strip_prefix(": ")?.chars();
    while let Some(letter) = letters.next() {
        match letter {
            '\\' => value.push(if letters.next()? == 'n' { '\n' } else { '\\' }),
            other => value.push(other),
        }
    }
    Some(value)
}

/// Of a TIFF that is complete, which it is when its head names the directory at its end.
#[cfg(feature = "tiff")]
fn of_tiff(reader: Input<'_>, length: u64, key: &str) -> Option<String> {
    const MAX_TEXT: u64 = 1 << 20;
    let (mut file, first) = TiffFile::open(reader, length).ok()?;
    let directory = file.directory(first).ok()?;
    let tag = if key == "Software" { 305 } else { 270 };
    let bytes = file.bytes(&directory, tag, MAX_TEXT).ok()??;
    let text = String::from_utf8(bytes).ok()?;
    let text = text.trim_end_matches('\0');
    if key == "Software" { Some(text.to_owned()) } else { text.lines().find_map(|line| text_of_line(line, key)) }
}

/// Of a JPEG that ends as one.
#[cfg(feature = "jpeg")]
fn of_jpeg(mut reader: Input<'_>, key: &str) -> Option<String> {
    let mut end = [0; 2];
    reader.seek(SeekFrom::End(-2)).ok()?;
    reader.read_exact(&mut end).ok()?;
    reader.seek(SeekFrom::Start(2)).ok()?;
    let mut found = None;
    while end == [0xff, 0xd9] && found.is_none() {
        let mut head = [0; 4];
        reader.read_exact(&mut head).ok()?;
        let [0xff, marker, high, low] = head else { return None };
        if marker == 0xda {
            break;
        }
        let mut segment = vec![0; usize::from(u16::from_be_bytes([high, low])).checked_sub(2)?];
        reader.read_exact(&mut segment).ok()?;
        if marker == 0xe0 | TEXT_SEGMENT {
            let line = segment.strip_prefix(TEXT_MARK).and_then(|line| std::str::from_utf8(line).ok());
            found = line.and_then(|line| text_of_line(line, key));
        }
    }
    found
}

/// The last chunk of a PNG.
#[cfg(feature = "png")]
const IEND: [u8; 12] = *b"\0\0\0\0IEND\xae\x42\x60\x82";

#[cfg(feature = "png")]
fn of_png(mut reader: Input<'_>, key: &str) -> Option<String> {
    let mut end = [0; IEND.len()];
    reader.seek(SeekFrom::End(-(IEND.len() as i64))).ok()?;
    reader.read_exact(&mut end).ok()?;
    reader.rewind().ok()?;
    let reader = png::Decoder::new_with_limits(reader, png::Limits { bytes: PNG_WORKING_BYTES }).read_info().ok()?;
    let info = reader.info();
    let latin1 = info.uncompressed_latin1_text.iter().find(|text| text.keyword == key).map(|text| text.text.clone());
    let beyond = || info.utf8_text.iter().find(|text| text.keyword == key)?.get_text().ok();
    latin1.or_else(beyond).filter(|_| end == IEND)
}

#[cfg(feature = "exr")]
fn of_exr(mut reader: Input<'_>, length: u64, key: &str) -> Option<String> {
    let meta = MetaData::read_from_buffered(&mut reader, false).ok()?;
    let [header] = &meta.headers[..] else { return None };
    let texts = || header.own_attributes.other.iter().chain(&header.shared_attributes.other);
    let software = || header.own_attributes.software_name.as_ref().filter(|_| key == "Software").map(Text::to_string);
    let text = texts().find_map(|(name, value)| match value {
        AttributeValue::Text(text) if name.eq(key) => Some(text.to_string()),
        _ => None,
    });
    let text = text.or_else(software)?;
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
#[cfg(all(feature = "exr", feature = "png"))]
mod tests {
    use std::io::Cursor;

    use super::*;
    use crate::{
        BandView, Channels, Description, PngBits, PngSettings, Source, exr_write::write_exr, png_write::write_png,
    };

    const KEY: &str = "onelight job";

    /// A black picture as PNG and as EXR.
    fn files(width: usize) -> [Vec<u8>; 2] {
        let picture = Description::new(width, 3, Channels::Rgb, Source::Exr);
        let rgb = vec![[0.25; 3]; width * 3];
        let texts = [("Software", "onelight"), ("onelight look", "day"), (KEY, "a1")];
        let band = || BandView { top: 0, width, rgb: &rgb, alpha: None };
        let (mut png, mut exr) = (Vec::new(), Cursor::new(Vec::new()));
        let sixteen = PngSettings { bits: PngBits::Sixteen, ..PngSettings::default() };
        write_png(&mut png, &picture, sixteen, &texts, |sink| sink.write(band())).unwrap();
        write_exr(&mut exr, &picture, &texts, |sink| sink.write(band())).unwrap();
        [png, exr.into_inner()]
    }

    fn text(bytes: &[u8], key: &str) -> Option<String> {
        text_of_complete_picture(Cursor::new(bytes), key)
    }

    fn found(png: &[u8], exr: &[u8]) -> [Option<String>; 2] {
        [text(png, KEY), text(exr, KEY)]
    }

    #[test]
    fn whole_files_say_what_they_are() {
        for width in [1, 40, 65_535] {
            let [png, exr] = files(width);
            assert_eq!(found(&png, &exr), [Some("a1".to_owned()), Some("a1".to_owned())], "{width}");
            assert_eq!(text(&png, "another"), None);
            assert_eq!(text(&exr, "another"), None);
            assert_eq!([text(&png, "Software"), text(&exr, "Software")], [(); 2].map(|()| Some("onelight".to_owned())));
        }
    }

    #[test]
    fn a_text_beyond_latin_1_is_found() {
        let picture = Description::new(1, 1, Channels::Rgb, Source::Exr);
        let mut png = Vec::new();
        let band = BandView { top: 0, width: 1, rgb: &[[0.5; 3]], alpha: None };
        write_png(&mut png, &picture, PngSettings::default(), &[("Title", "\u{4e00}")], |sink| sink.write(band))
            .unwrap();
        assert_eq!(text(&png, "Title").as_deref(), Some("\u{4e00}"));
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
