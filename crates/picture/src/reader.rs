//! Opening a picture, whatever its format.

use std::io::{Read, Seek, SeekFrom};

#[cfg(feature = "exr")]
use crate::exr_read;
#[cfg(feature = "hdr")]
use crate::hdr_read;
#[cfg(feature = "jpeg")]
use crate::jpeg_read;
#[cfg(feature = "png")]
use crate::png_read;
#[cfg(feature = "tiff")]
use crate::tiff_read;
use crate::{
    band::{Band, Bands, ReadingMemory},
    description::Description,
    error::{Error, Kind},
    input::{Input, input},
    limits::Limits,
    selection::Selection,
};

/// An open picture: what it is, and its rows from top to bottom.
///
/// ```
/// # use std::io::Cursor;
/// use onelight_picture::{Limits, open};
/// # use onelight_picture::{Picture, Source};
/// # let mut file = Cursor::new(Vec::new());
/// # Picture::opaque(300, 200, vec![[0.5; 3]; 300 * 200], Source::Exr).write_exr(&mut file, &[])?;
///
/// let mut picture = open(file, "grey.exr", Limits::default())?;
/// let pixels = picture.description().pixels();
/// let mut sum = 0.0;
/// while let Some(band) = picture.next_band()? {
///     sum += band.rgb().iter().map(|rgb| f64::from(rgb[1])).sum::<f64>();
/// }
/// assert_eq!(sum / pixels as f64, 0.5);
/// # Ok::<(), onelight_picture::Error>(())
/// ```
pub struct PictureReader<'a> {
    description: Description,
    bands: Box<dyn Bands + 'a>,
    name: String,
    /// The pixels that [`PictureReader::next_band`] lends, kept so that each band uses the same memory.
    band: Band,
}

/// Opens the picture in a file; the format is recognised by the file's first bytes, and the picture begins where the reader does.
///
/// Pixels are values of the file: linear for OpenEXR and floating-point TIFF, 0 to 1 for integers, whose transfer curve the
/// caller undoes. Colours are straight (not premultiplied); NaN, infinities and negatives are kept. `name` is what the caller
/// calls the file, with which messages begin; without one they begin with the fault. The reader need not be buffered.
///
/// ```
/// use std::io::Cursor;
///
/// use onelight_picture::{Limits, open};
///
/// let error = open(Cursor::new(b""), "empty.exr", Limits::default()).unwrap_err();
/// assert_eq!(error.to_string(), "empty.exr: the file is empty, expected an OpenEXR, PNG, TIFF, JPEG or Radiance picture");
/// ```
///
/// # Errors
/// Another format, a picture over `limits` or one that the file is too short to hold, damaged or truncated data, a feature
/// that is not read, or a reader that fails. Memory for pixels is taken after all of that.
pub fn open<'a>(reader: impl Read + Seek + Send + 'a, name: &str, limits: Limits) -> Result<PictureReader<'a>, Error> {
    open_selected(reader, name, limits, &Selection::default())
}

/// Opens one picture of a file that holds several, as [`open`] does.
///
/// ```
/// use std::io::Cursor;
///
/// use onelight_picture::{Limits, Selection, open_selected};
/// # use onelight_picture::{Picture, Source};
/// # let mut file = Cursor::new(Vec::new());
/// # Picture::opaque(3, 2, vec![[0.5; 3]; 6], Source::Exr).write_exr(&mut file, &[])?;
///
/// let albedo = Selection { layer: Some("albedo".to_owned()), ..Selection::default() };
/// let error = open_selected(file, "render.exr", Limits::default(), &albedo).unwrap_err();
/// assert!(error.to_string().starts_with("render.exr: there is no layer `albedo`"));
/// # Ok::<(), onelight_picture::Error>(())
/// ```
///
/// # Errors
/// Those of [`open`], and a layer or part that the file does not have.
pub fn open_selected<'a>(
    reader: impl Read + Seek + Send + 'a,
    name: &str,
    limits: Limits,
    selection: &Selection,
) -> Result<PictureReader<'a>, Error> {
    let opened = input(reader).and_then(|(input, length)| open_input(input, length, &limits, selection));
    let (description, bands) = opened.map_err(|error| error.named(name))?;
    Ok(PictureReader { description, bands, name: name.to_owned(), band: Band::default() })
}

impl PictureReader<'_> {
    /// What the file says of the picture.
    pub fn description(&self) -> &Description {
        &self.description
    }

    /// The most memory that the next band takes, for a program that has to stay within bounds.
    pub fn memory(&self) -> ReadingMemory {
        self.bands.memory()
    }

    /// The next rows, from top to bottom; `None` after the last. The band is lent, and may be changed in place.
    ///
    /// # Errors
    /// Damaged or truncated data, or no memory. Rows after an error are not to be relied on.
    pub fn next_band(&mut self) -> Result<Option<&mut Band>, Error> {
        self.bands.next_into(&mut self.band).map_err(|error| error.named(&self.name))?;
        Ok((self.band.rows() > 0).then_some(&mut self.band))
    }

    /// Fills a band of the caller's with the next rows, from top to bottom; without rows after the last. For programs that
    /// hold several bands, as one is read while another is at work.
    ///
    /// # Errors
    /// The same as those of [`PictureReader::next_band`].
    pub fn next_into(&mut self, band: &mut Band) -> Result<(), Error> {
        self.bands.next_into(band).map_err(|error| error.named(&self.name))
    }
}

impl std::fmt::Debug for PictureReader<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { description, name, .. } = self;
        f.debug_struct("PictureReader").field("name", name).field("description", description).finish_non_exhaustive()
    }
}

/// The formats that this build reads, as messages name them: with all features "an OpenEXR, PNG, TIFF, JPEG or
/// Radiance picture".
pub fn readable_formats() -> String {
    let all = [
        (cfg!(feature = "exr"), "OpenEXR"),
        (cfg!(feature = "png"), "PNG"),
        (cfg!(feature = "tiff"), "TIFF"),
        (cfg!(feature = "jpeg"), "JPEG"),
        (cfg!(feature = "hdr"), "Radiance"),
    ];
    let formats: Vec<&str> = all.into_iter().filter(|(read, _)| *read).map(|(_, format)| format).collect();
    let article = if cfg!(feature = "exr") { "an" } else { "a" };
    match &formats[..] {
        [] => "a format that is among the features of this build, which has none".to_owned(),
        [one] => format!("{article} {one} picture"),
        [others @ .., last] => format!("{article} {} or {last} picture", others.join(", ")),
    }
}

fn open_input<'a>(
    mut reader: Input<'a>,
    length: u64,
    limits: &Limits,
    selection: &Selection,
) -> Result<(Description, Box<dyn Bands + 'a>), Error> {
    let mut start = Vec::new();
    reader.by_ref().take(16).read_to_end(&mut start)?;
    reader.seek(SeekFrom::Start(0))?;
    match &start[..] {
        [] => Err(Kind::Empty { expected: readable_formats() }.into()),
        #[cfg(feature = "exr")]
        [0x76, 0x2f, 0x31, 0x01, ..] => exr_read::open(reader, length, limits, selection),
        #[cfg(feature = "png")]
        [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n', ..] => png_read::open(reader, length, limits),
        #[cfg(feature = "tiff")]
        [b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..] => tiff_read::open(reader, length, limits),
        #[cfg(feature = "jpeg")]
        [0xff, 0xd8, 0xff, ..] => jpeg_read::open(reader, length, limits),
        #[cfg(feature = "hdr")]
        [b'#', b'?', b'R', b'A', b'D', b'I', b'A', b'N', b'C', b'E', ..] | [b'#', b'?', b'R', b'G', b'B', b'E', ..] => {
            hdr_read::open(reader, length, limits)
        }
        other => {
            let found = kind_of_file(other);
            let expected = match found {
                raw if raw.contains("camera raw") => {
                    "what a raw converter makes of it (darktable or RawTherapee, exported as linear Rec.2020 float TIFF or as OpenEXR)"
                        .to_owned()
                }
                "a DPX picture" => {
                    "its codes as a TIFF or PNG of 16 bits (`oiiotool scan.dpx -d uint16 -o scan.tif`)".to_owned()
                }
                _ => readable_formats(),
            };
            Err(Kind::Format { found, expected }.into())
        }
    }
}

/// A name for the formats a user may well try, and for those that this build was made without.
fn kind_of_file(start: &[u8]) -> &'static str {
    match start {
        [0x76, 0x2f, 0x31, 0x01, ..] => "an OpenEXR picture",
        [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n', ..] => "a PNG picture",
        [b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..] => "a TIFF picture",
        [0xff, 0xd8, 0xff, ..] => "a JPEG picture",
        [b'#', b'?', ..] => "a Radiance HDR picture",
        [b'S', b'D', b'P', b'X', ..] | [b'X', b'P', b'D', b'S', ..] => "a DPX picture",
        [b'G', b'I', b'F', b'8', ..] => "a GIF picture",
        [b'B', b'M', ..] => "a BMP picture",
        [0xff, 0x0a, ..] | [0, 0, 0, 12, b'J', b'X', b'L', b' ', ..] => "a JPEG XL picture",
        [0, 0, 0, 12, b'j', b'P', b' ', b' ', ..] => "a JPEG 2000 picture",
        [b'D', b'D', b'S', b' ', ..] => "a DDS texture",
        [b'F', b'U', b'J', b'I', b'F', b'I', b'L', b'M', ..] => "a Fujifilm camera raw file (RAF)",
        [b'I', b'I', b'R', b'O' | b'S', ..] | [b'M', b'M', b'O', b'R', ..] => "an Olympus camera raw file (ORF)",
        [b'I', b'I', b'U', 0, ..] => "a Panasonic camera raw file (RW2)",
        [_, _, _, _, b'f', b't', b'y', b'p', b'c', b'r', b'x', ..] => "a Canon camera raw file (CR3)",
        [b'R', b'I', b'F', b'F', ..] => "a WebP or other RIFF file",
        [b'8', b'B', b'P', b'S', ..] => "a Photoshop file",
        [b'P', b'1'..=b'7' | b'F' | b'f', ..] => "a PNM or PFM picture",
        [_, _, _, _, b'f', b't', b'y', b'p', ..] => "an HEIF, AVIF or video file",
        _ => "an unknown format",
    }
}
