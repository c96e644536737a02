//! What a file says of how its picture was taken, from reading to writing.

use std::io::{Read, Seek};

use crate::tiff_directory::{Directory, RawTag, TiffFile};

/// What a file says of how its picture was taken and of whose it is: who, when, where, with which camera and lens.
///
/// A reader fills it in, and a writer of a format that has room for it writes it: EXIF in PNG, JPEG and TIFF, attributes in OpenEXR. It
/// has what stays true when the picture's values change: neither size, orientation, thumbnail nor a word on colours, nor notes
/// that only the camera's maker can read.
///
/// ```
/// use onelight_picture::{Channels, Description, Metadata, Source};
///
/// let mut picture = Description::new(6000, 4000, Channels::Rgb, Source::Jpeg);
/// // To be written without it, such as where the place is nobody's business:
/// picture.metadata = Metadata::default();
/// assert!(picture.metadata.is_empty());
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Metadata {
    pub(crate) exif: ExifTags,
    /// Attributes of OpenEXR, by name.
    pub(crate) exr: Vec<ExrAttribute>,
}

impl Metadata {
    /// Whether there is nothing.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// An attribute as it lies in a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct ExrAttribute {
    pub(crate) name: String,
    pub(crate) kind: String,
    pub(crate) bytes: Vec<u8>,
}

/// The tags of the three directories of EXIF.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct ExifTags {
    pub(crate) first: Vec<RawTag>,
    pub(crate) exif: Vec<RawTag>,
    pub(crate) gps: Vec<RawTag>,
}

pub(crate) const IMAGE_DESCRIPTION: u16 = 270;
pub(crate) const EXIF_DIRECTORY: u16 = 34_665;
pub(crate) const GPS_DIRECTORY: u16 = 34_853;

/// Of the first directory, which is of the stored picture: what was seen, maker, model, whose it is.
const KEPT: [u16; 6] = [IMAGE_DESCRIPTION, 271, 272, 315, 316, 33_432];
/// Of EXIF: components and packing, the maker's notes (whose offsets break), the subject's place in the picture, colour space and
/// size, a sound file, other directories, how it was rendered, gamma.
const LEFT_OUT: [u16; 13] =
    [37_121, 37_122, 37_396, 37_500, 40_961, 40_962, 40_963, 40_964, 40_965, 41_492, 41_730, 41_985, 42_240];

/// Most bytes of a tag, and of all, so that the block fits a segment of a JPEG.
const MAX_TAG_BYTES: u64 = 1 << 12;
const MAX_BYTES: usize = 48 << 10;
/// Bytes of a tag beside those of its value.
const TAG_BYTES: usize = 12;

/// What our own files have in their description, which is of the picture that they hold.
const OWN_TEXT: &str = "onelight ";

impl ExifTags {
    /// What is below the first directory of a block of EXIF, or of the page of a TIFF; what is damaged is left out.
    pub(crate) fn read<R: Read + Seek>(file: &mut TiffFile<R>, first: &Directory) -> Self {
        let mut room = MAX_BYTES;
        let mut keep = |tags: Vec<RawTag>, is_kept: &dyn Fn(u16) -> bool| -> Vec<RawTag> {
            let fits = |tag: &RawTag| match room.checked_sub(tag.bytes.len() + TAG_BYTES) {
                Some(left) if is_kept(tag.tag) => {
                    room = left;
                    true
                }
                _ => false,
            };
            tags.into_iter().filter(fits).collect()
        };
        let mut kept = keep(file.tags(first, MAX_TAG_BYTES), &|tag| KEPT.contains(&tag));
        kept.iter_mut().filter(|tag| tag.tag == IMAGE_DESCRIPTION).for_each(leave_out_own_lines);
        kept.retain(|tag| tag.count > 0);
        let mut under = |pointer, is_kept: &dyn Fn(u16) -> bool| {
            let at = file.first(first, pointer).ok().flatten();
            let directory = at.and_then(|at| file.directory(at).ok());
            directory.map_or(Vec::new(), |directory| keep(file.tags(&directory, MAX_TAG_BYTES), is_kept))
        };
        let exif = under(EXIF_DIRECTORY, &|tag| !LEFT_OUT.contains(&tag));
        let gps = under(GPS_DIRECTORY, &|_| true);
        Self { first: kept, exif, gps }
    }

    /// A block as JPEG and PNG have it, big-endian; `None` where there is nothing to say.
    pub(crate) fn block(&self) -> Option<Vec<u8>> {
        if *self == Self::default() {
            return None;
        }
        const START: usize = 8;
        let mut first = self.first.clone();
        let own = |tags: &[RawTag]| !tags.is_empty();
        let pointers = [(EXIF_DIRECTORY, &self.exif), (GPS_DIRECTORY, &self.gps)];
        // How long the first directory is does not depend on where the others lie.
        first.extend(pointers.iter().filter(|(_, tags)| own(tags)).map(|(tag, _)| RawTag::long(*tag, 0)));
        first.sort_by_key(|tag| tag.tag);
        let mut at = START + directory(&first, 0).len();
        let mut others = Vec::new();
        for (pointer, tags) in pointers.into_iter().filter(|(_, tags)| own(tags)) {
            first.iter_mut().filter(|tag| tag.tag == pointer).for_each(|tag| *tag = RawTag::long(pointer, at as u32));
            let bytes = directory(tags, at as u32);
            at += bytes.len();
            others.extend(bytes);
        }
        let head = [&b"MM\0\x2a"[..], &(START as u32).to_be_bytes()].concat();
        Some([head, directory(&first, START as u32), others].concat())
    }
}

/// A big-endian directory that lies at `at`, with its values behind it; none follows. Of even length.
pub(crate) fn directory(tags: &[RawTag], at: u32) -> Vec<u8> {
    let mut bytes = (tags.len() as u16).to_be_bytes().to_vec();
    let beyond = at as usize + 2 + TAG_BYTES * tags.len() + 4;
    let mut values: Vec<u8> = Vec::new();
    for RawTag { tag, kind, count, bytes: value } in tags {
        bytes.extend([tag.to_be_bytes(), kind.to_be_bytes()].concat());
        bytes.extend(count.to_be_bytes());
        if value.len() > 4 {
            bytes.extend(((beyond + values.len()) as u32).to_be_bytes());
            values.extend(value);
            values.resize(values.len().next_multiple_of(2), 0);
        } else {
            bytes.extend(value);
            bytes.resize(bytes.len() + 4 - value.len(), 0);
        }
    }
    bytes.extend([0; 4]);
    bytes.extend(values);
    bytes
}

/// Takes lines of our own out of a description.
fn leave_out_own_lines(tag: &mut RawTag) {
    let text = String::from_utf8_lossy(&tag.bytes);
    let lines: Vec<&str> = text.trim_end_matches('\0').lines().filter(|line| !line.starts_with(OWN_TEXT)).collect();
    let text = lines.join("\n");
    *tag = if text.trim().is_empty() {
        RawTag { count: 0, ..RawTag::ascii(tag.tag, "") }
    } else {
        RawTag::ascii(tag.tag, &text)
    };
}

#[cfg(test)]
mod tests {
    use std::io::Cursor;

    use super::*;

    fn read(block: &[u8]) -> ExifTags {
        let (mut file, first) = TiffFile::open(Cursor::new(block), block.len() as u64).unwrap();
        let directory = file.directory(first).unwrap();
        ExifTags::read(&mut file, &directory)
    }

    /// Camera and description, exposure time and a lens, a place; with what is not kept among them.
    fn sample() -> ExifTags {
        let rational = |tag| RawTag { tag, kind: 5, count: 1, bytes: [1_u32, 250].map(u32::to_be_bytes).concat() };
        ExifTags {
            first: vec![RawTag::ascii(IMAGE_DESCRIPTION, "a walk"), RawTag::ascii(271, "Maker")],
            exif: vec![rational(33_434), RawTag { tag: 36_864, kind: 7, count: 4, bytes: b"0232".to_vec() }],
            gps: vec![RawTag::ascii(1, "N"), rational(2)],
        }
    }

    #[test]
    fn what_is_written_is_read() {
        let block = sample().block().unwrap();
        assert_eq!(read(&block), sample());
        assert_eq!(read(&block).block().unwrap(), block);
        assert_eq!(ExifTags::default().block(), None);
        let alone = ExifTags { gps: sample().gps, ..ExifTags::default() };
        assert_eq!(read(&alone.block().unwrap()), alone);
    }

    #[test]
    fn what_is_no_longer_true_is_left_out() {
        let mut tags = sample();
        tags.first.extend([RawTag::long(274, 6), RawTag::ascii(305, "firmware 1.0")]);
        tags.exif.extend([RawTag::long(40_961, 1), RawTag { tag: 37_500, kind: 7, count: 9, bytes: vec![7; 9] }]);
        assert_eq!(read(&tags.block().unwrap()), sample());
        tags.first[0] = RawTag::ascii(IMAGE_DESCRIPTION, "onelight look: a\na walk\nonelight job: b");
        assert_eq!(read(&tags.block().unwrap()), sample());
        tags.first[0] = RawTag::ascii(IMAGE_DESCRIPTION, "onelight look: a");
        assert_eq!(read(&tags.block().unwrap()).first, [RawTag::ascii(271, "Maker")]);
    }

    /// Numbers of both orders of bytes come out the same.
    #[test]
    fn little_endian_numbers_are_turned() {
        let mut block = b"II\x2a\0\x08\0\0\0\x01\0".to_vec();
        block.extend([0x69, 0x87, 4, 0, 1, 0, 0, 0, 26, 0, 0, 0, 0, 0, 0, 0]);
        block.extend([1, 0, 0x9a, 0x82, 5, 0, 1, 0, 0, 0, 44, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 250, 0, 0, 0]);
        assert_eq!(read(&block).exif, sample().exif[..1]);
    }

    #[test]
    fn much_is_cut_to_what_a_segment_holds() {
        let long = |tag| RawTag { tag, kind: 7, count: 4000, bytes: vec![1; 4000] };
        let tags = ExifTags { exif: (1..40).map(long).collect(), ..ExifTags::default() };
        let kept = read(&tags.block().unwrap());
        assert!(kept.exif.len() == 12 && kept.block().unwrap().len() < 50_000);
    }
}
