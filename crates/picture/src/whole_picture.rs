//! Pictures that are held whole, for small ones and for tests.

#[cfg(feature = "exr")]
use std::io::Write;
use std::io::{Read, Seek};

#[cfg(feature = "exr")]
use crate::exr_write::write_exr;
use crate::{
    band::BandView,
    description::{Channels, Chromaticities, Description, Source, Windows},
    error::Error,
    limits::Limits,
    reader::open,
    transfer::Transfer,
};

/// A picture in memory, as a file holds it: 12 bytes a pixel, 16 with coverage.
///
/// [`open`] needs memory for a band only.
///
/// ```
/// use std::io::Cursor;
///
/// use onelight_picture::{Limits, Picture, Source};
///
/// let ramp = Picture::opaque(3, 1, vec![[0.0; 3], [0.18; 3], [16.0, -0.5, f32::INFINITY]], Source::Exr);
/// let mut file = Cursor::new(Vec::new());
/// ramp.write_exr(&mut file, &[("Software", "a test")])?;
/// assert_eq!(Picture::read(file, "ramp.exr", Limits::default())?, ramp);
/// # Ok::<(), onelight_picture::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Width of the data window, in pixels.
    pub width: usize,
    /// Height of the data window, in pixels.
    pub height: usize,
    /// `width * height` straight (not premultiplied) colours, top row first; NaN, infinities and negatives are kept.
    pub rgb: Vec<[f32; 3]>,
    /// Coverage, as many values as there are colours.
    pub alpha: Option<Vec<f32>>,
    /// Where the pixels lie and what part of the plane is shown.
    pub windows: Windows,
    /// The colour space of `rgb` where the file names it.
    pub primaries: Option<Chromaticities>,
    /// How the values become light where the file says it.
    pub transfer: Option<Transfer>,
    /// What kind of file it was.
    pub source: Source,
    /// What the reader chose among several layers or left out, a sentence each, for the user.
    pub notes: Vec<String>,
}

impl Picture {
    /// Opaque colours of one window at the origin, of no named primaries.
    pub fn opaque(width: usize, height: usize, rgb: Vec<[f32; 3]>, source: Source) -> Self {
        let windows = Windows::of_size(width, height);
        Self { width, height, rgb, alpha: None, windows, primaries: None, transfer: None, source, notes: Vec::new() }
    }

    /// Reads all bands of a picture.
    ///
    /// # Errors
    /// Those of [`open`] and of [`PictureReader::next_band`](crate::PictureReader::next_band).
    pub fn read(reader: impl Read + Seek + Send, name: &str, limits: Limits) -> Result<Self, Error> {
        let mut reader = open(reader, name, limits)?;
        let Description { width, height, channels, windows, primaries, transfer, source, notes, .. } =
            reader.description().clone();
        let alpha = (channels == Channels::Rgba).then(Vec::new);
        let mut picture = Self { width, height, rgb: Vec::new(), alpha, windows, primaries, transfer, source, notes };
        while let Some(band) = reader.next_band()? {
            debug_assert_eq!((band.top() * width, band.width()), (picture.rgb.len(), width), "bands follow each other");
            picture.rgb.extend_from_slice(band.rgb());
            if let (Some(all), Some(some)) = (&mut picture.alpha, band.alpha()) {
                all.extend_from_slice(some);
            }
        }
        Ok(picture)
    }

    /// Writes it as [`write_exr`] does.
    ///
    /// # Errors
    /// Those of [`write_exr`]: among them, as many colours or values of coverage as its size does not have.
    #[cfg(feature = "exr")]
    pub fn write_exr(&self, writer: impl Write + Seek + Send, texts: &[(&str, &str)]) -> Result<(), Error> {
        write_exr(writer, &self.description(), texts, |sink| sink.write(self.view()))
    }

    /// All but the pixels, as a reader would describe it.
    pub fn description(&self) -> Description {
        let channels = if self.alpha.is_some() { Channels::Rgba } else { Channels::Rgb };
        Description {
            windows: self.windows,
            primaries: self.primaries,
            transfer: self.transfer.clone(),
            notes: self.notes.clone(),
            ..Description::new(self.width, self.height, channels, self.source)
        }
    }

    /// All of it as one band.
    pub fn view(&self) -> BandView<'_> {
        BandView { top: 0, width: self.width, rgb: &self.rgb, alpha: self.alpha.as_deref() }
    }
}
