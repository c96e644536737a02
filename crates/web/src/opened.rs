//! A picture file on its way to the page: light in half floats, a smaller copy, and what a meter says of it.

use std::io::Cursor;

use onelight::{Meter, WorkingSpace};
use onelight_picture::{Limits, PictureReader, open};
use serde::Serialize;

use crate::error::Error;
use crate::film_look::SAMPLES;
use crate::light::Light;
use crate::shrink::{Shrink, half};

/// Pixels of the copy that the page draws while the whole picture is on the screen.
const PREVIEW_PIXELS: usize = 1_500_000;
/// Pixels of the copy that the film strip is made of.
const THUMBNAIL_PIXELS: usize = 16_000;
/// Bins of the histogram in a stop, and the stops about mid grey that it shows.
const BINS: usize = 4;
const STOPS: [f64; 2] = [-12.0, 12.0];

/// A picture that is read band after band, as [`onelight_picture::open`] does.
///
/// ```
/// use std::io::Cursor;
/// use onelight_web::OpenedPicture;
/// # use onelight_picture::{Picture, Source};
/// # let mut file = Cursor::new(Vec::new());
/// # Picture::opaque(3, 2, vec![[0.09; 3]; 6], Source::Exr).write_exr(&mut file, &[])?;
/// let mut picture = OpenedPicture::new(file.into_inner(), "grey.exr", onelight::WorkingSpace::Srgb)?;
/// let mut samples = 0;
/// while let Some(rows) = picture.next_rows()? {
///     samples += rows.len();
/// }
/// assert_eq!(samples, 3 * 2 * 4);
/// // One stop under: what a meter would open by.
/// assert!((picture.seen().auto_ev - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct OpenedPicture {
    reader: PictureReader<'static>,
    light: Light,
    notes: Vec<String>,
    meter: Meter,
    preview: Shrink,
    thumbnail: Shrink,
}

/// What a picture is, before its pixels.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Described {
    /// Pixels.
    pub width: usize,
    /// Pixels.
    pub height: usize,
    /// Pixels across and down of the smaller copy.
    pub preview: [usize; 2],
    /// Pixels across and down of the smallest copy.
    pub thumbnail: [usize; 2],
    /// What the user should know, a sentence each.
    pub notes: Vec<String>,
}

/// What was seen of its light, once all rows were read.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Seen {
    /// The exposure in stops that brings what is metered to mid grey.
    pub auto_ev: f64,
    /// Pixels by luminance, in even parts of `stops`.
    pub histogram: Vec<u64>,
    /// The range of the histogram in stops about mid grey.
    pub stops: [f64; 2],
}

impl OpenedPicture {
    /// Opens the picture in a file.
    ///
    /// # Errors
    /// Those of [`onelight_picture::open`]; chromaticities that make no colour space.
    pub fn new(file: Vec<u8>, name: &str, input: WorkingSpace) -> Result<Self, Error> {
        let reader = open(Cursor::new(file), name, Limits::default())?;
        let description = reader.description();
        let mut notes = description.notes.clone();
        let light = Light::new(description, input, &mut notes)?;
        let size = [description.width, description.height];
        let [preview, thumbnail] = [PREVIEW_PIXELS, THUMBNAIL_PIXELS].map(|pixels| Shrink::to(size, pixels));
        Ok(Self { reader, light, notes, meter: Meter::default(), preview, thumbnail })
    }

    /// What the file says, and the sizes of what is made of it.
    #[must_use]
    pub fn described(&self) -> Described {
        let description = self.reader.description();
        Described {
            width: description.width,
            height: description.height,
            preview: self.preview.size(),
            thumbnail: self.thumbnail.size(),
            notes: self.notes.clone(),
        }
    }

    /// The next rows as light in half floats, red, green, blue and alpha; `None` after the last.
    ///
    /// # Errors
    /// Those of [`PictureReader::next_band`].
    pub fn next_rows(&mut self) -> Result<Option<Vec<u16>>, Error> {
        let Some(band) = self.reader.next_band()? else { return Ok(None) };
        self.light.of(band, 0.0, Some(&mut self.meter));
        let mut rows = Vec::with_capacity(band.rgb().len() * SAMPLES);
        for (i, rgb) in band.rgb().iter().enumerate() {
            let alpha = band.alpha().map_or(1.0, |alpha| alpha[i]);
            let [r, g, b] = rgb.map(half);
            rows.extend([r, g, b, half(alpha)]);
        }
        self.preview.add(band);
        self.thumbnail.add(band);
        Ok(Some(rows))
    }

    /// The smaller copy, once all rows were read: light in half floats as of [`OpenedPicture::next_rows`].
    #[must_use]
    pub fn preview(&self) -> Vec<u16> {
        self.preview.pixels()
    }

    /// The smallest copy, for the film strip.
    #[must_use]
    pub fn thumbnail(&self) -> Vec<u16> {
        self.thumbnail.pixels()
    }

    /// What was seen of its light so far.
    #[must_use]
    pub fn seen(&self) -> Seen {
        let bins = (STOPS[1] - STOPS[0]) as usize * BINS;
        Seen { auto_ev: self.meter.exposure(), histogram: self.meter.histogram(STOPS, bins), stops: STOPS }
    }
}
