//! What EXIF says of a picture as it is stored: which way is up, and which space its values are in.

use std::io::{Cursor, Read, Seek};

use crate::{
    description::Chromaticities,
    file_colours::FileColours,
    metadata::{EXIF_DIRECTORY, ExifTags},
    orientation::Orientation,
    tiff_directory::{Directory, TiffFile},
    transfer::Transfer,
};

/// Most bytes of EXIF that are looked at: those of a JPEG have at most 64 KiB.
pub(crate) const MAX_BYTES: usize = 1 << 20;

const ORIENTATION: u16 = 274;
const INTEROPERABILITY_DIRECTORY: u16 = 40_965;
const INTEROPERABILITY_INDEX: u16 = 1;
const COLOUR_SPACE: u16 = 40_961;

/// What is of use in an EXIF block.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Exif {
    pub(crate) orientation: Orientation,
    pub(crate) colours: Option<FileColours>,
    pub(crate) tags: ExifTags,
}

/// Reads a block of EXIF, which is a TIFF without a picture; what is damaged in it is as if it were not there.
pub(crate) fn read(block: &[u8]) -> Exif {
    // JPEG's blocks begin with a name.
    let block = block.strip_prefix(b"Exif\0\0").unwrap_or(block);
    if block.len() > MAX_BYTES || !(block.starts_with(b"II") || block.starts_with(b"MM")) {
        return Exif::default();
    }
    let Ok((mut file, first)) = TiffFile::open(Cursor::new(block), block.len() as u64) else { return Exif::default() };
    let Ok(directory) = file.directory(first) else { return Exif::default() };
    let orientation = file.first(&directory, ORIENTATION).ok().flatten();
    let orientation = Orientation::from_exif(orientation);
    let tags = ExifTags::read(&mut file, &directory);
    Exif { orientation, colours: colours(&mut file, &directory), tags }
}

/// What the EXIF below a directory says of the colours: that of a JPEG's or PNG's block, or of a TIFF's page.
pub(crate) fn colours<R: Read + Seek>(file: &mut TiffFile<R>, directory: &Directory) -> Option<FileColours> {
    let mut under = |directory: &Directory, tag| {
        let at = file.first(directory, tag).ok().flatten()?;
        file.directory(at).ok()
    };
    let exif = under(directory, EXIF_DIRECTORY)?;
    let interoperability = under(&exif, INTEROPERABILITY_DIRECTORY);
    let index = interoperability.and_then(|own| file.bytes(&own, INTEROPERABILITY_INDEX, 16).ok().flatten());
    let said = |primaries, transfer| {
        Some(FileColours {
            primaries: Some(primaries),
            transfer: Some(transfer),
            said_by: "the EXIF colour space".to_owned(),
        })
    };
    // DCF gives Adobe RGB by an uncalibrated space and the index R03.
    match (file.first(&exif, COLOUR_SPACE).ok().flatten(), index) {
        (Some(1), _) => said(Chromaticities::BT709, Transfer::Srgb),
        (Some(2), _) => said(Chromaticities::ADOBE_RGB, Transfer::Power(563.0 / 256.0)),
        (_, Some(index)) if index.starts_with(b"R03") => {
            said(Chromaticities::ADOBE_RGB, Transfer::Power(563.0 / 256.0))
        }
        _ => None,
    }
}
