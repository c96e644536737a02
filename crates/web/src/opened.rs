//! A picture file on its way to the page: light in half floats, a smaller copy, and what a meter says of it.

use onelight::{LightSeen, PictureLight, WorkingSpace};
use onelight_picture::{Channels, PictureReader};
use serde::Serialize;

use crate::error::Error;
use crate::film_look::SAMPLES;
use crate::read::{PictureFile, background};
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
/// let mut picture = OpenedPicture::new(file.into_inner(), "grey.exr", onelight::WorkingSpace::Srgb, "")?;
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
    light: PictureLight,
    notes: Vec<String>,
    seen: LightSeen,
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
    /// Whether the file holds coverage.
    pub has_alpha: bool,
    /// Pixels across the whole frame: of an OpenEXR file, of its display window.
    pub frame_width: usize,
    /// Where the first pixel lies in that frame.
    pub at: [i32; 2],
    /// Width of a pixel over its height.
    pub pixel_aspect: f64,
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
    /// Pixels that hold NaN, which counts as 0, or infinity.
    pub hard: usize,
}

impl OpenedPicture {
    /// Opens the picture in a file. `behind` says what lies behind a picture with alpha: `none`, `black`, or what `cargo xtask develop` does
    /// where nothing is named.
    ///
    /// # Errors
    /// Those of [`onelight_picture::open`]; chromaticities that make no colour space.
    pub fn new(file: Vec<u8>, name: &str, input: WorkingSpace, behind: &str) -> Result<Self, Error> {
        let file = PictureFile::new(file, name);
        let reading = file.reading(input, background(behind))?;
        let reader = file.open()?;
        let size = [reader.description().width, reader.description().height];
        let [preview, thumbnail] = [PREVIEW_PIXELS, THUMBNAIL_PIXELS].map(|pixels| Shrink::to(size, pixels));
        let (light, notes) = (reading.light, reading.notes);
        Ok(Self { reader, light, notes, seen: LightSeen::default(), preview, thumbnail })
    }

    /// What the file says, and the sizes of what is made of it.
    #[must_use]
    pub fn described(&self) -> Described {
        let description = self.reader.description();
        let windows = &description.windows;
        let at = [0, 1].map(|axis| windows.data_origin[axis].saturating_sub(windows.display_origin[axis]));
        Described {
            width: description.width,
            height: description.height,
            preview: self.preview.size(),
            thumbnail: self.thumbnail.size(),
            notes: self.notes.clone(),
            has_alpha: description.channels == Channels::Rgba,
            frame_width: windows.display_size[0],
            at,
            pixel_aspect: f64::from(windows.pixel_aspect),
        }
    }

    /// The next rows as light in half floats, red, green, blue and alpha; `None` after the last.
    ///
    /// # Errors
    /// Those of [`PictureReader::next_band`].
    pub fn next_rows(&mut self) -> Result<Option<Vec<u16>>, Error> {
        let Some(band) = self.reader.next_band()? else { return Ok(None) };
        self.light.expose(band, 0.0, None, Some(&mut self.seen));
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
        let LightSeen { hard, meter } = &self.seen;
        Seen { auto_ev: meter.exposure(), histogram: meter.histogram(STOPS, bins), stops: STOPS, hard: *hard }
    }
}
