//! Pictures as bytes, for tests and the fuzz targets.

use std::io::{BufRead, Cursor, Seek};

use anyhow::Result;

use super::{Band, Channels, Description, Limits, Picture, exr_write, open_from};

/// Reads all bands of the picture that `bytes` hold as a file.
///
/// # Errors
/// One sentence, as for a file, without a path.
pub fn read_picture(bytes: &[u8], limits: &Limits) -> Result<Picture> {
    read_from(Cursor::new(bytes), bytes.len() as u64, limits)
}

/// The picture as an OpenEXR file.
///
/// # Errors
/// One sentence, where the picture's sizes do not fit each other or the format.
pub fn write_picture(picture: &Picture) -> Result<Vec<u8>> {
    let mut bytes = Cursor::new(Vec::new());
    exr_write::write_to(&mut bytes, picture, &[])?;
    Ok(bytes.into_inner())
}

/// Reads all bands of a picture of `length` bytes.
pub(super) fn read_from<R: BufRead + Seek + Send>(reader: R, length: u64, limits: &Limits) -> Result<Picture> {
    let (description, mut bands) = open_from(reader, length, limits)?;
    let Description { width, height, channels, windows, primaries, source, notes } = description;
    let alpha = (channels == Channels::Rgba).then(Vec::new);
    let mut picture = Picture { width, height, rgb: Vec::new(), alpha, windows, primaries, source, notes };
    let mut band = Band::default();
    loop {
        bands.next_into(&mut band)?;
        if band.rows() == 0 {
            return Ok(picture);
        }
        debug_assert_eq!((band.top * width, band.width), (picture.rgb.len(), width), "bands follow each other");
        picture.rgb.extend_from_slice(&band.rgb);
        if let (Some(all), Some(some)) = (&mut picture.alpha, &band.alpha) {
            all.extend_from_slice(some);
        }
    }
}
