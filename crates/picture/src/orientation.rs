//! Turning a picture the way it was taken.

use rayon::prelude::*;

use crate::{
    band::{Band, Bands, ReadingMemory, blocks_in_band},
    description::{Channels, Description, Windows},
    error::Error,
    limits::{Limits, grow},
};

/// What has to be done to a picture as it is stored, by the eight cases of EXIF and TIFF.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct Orientation {
    /// Rows become columns, before all else.
    transposed: bool,
    mirrored_left_right: bool,
    mirrored_top_bottom: bool,
}

impl Orientation {
    /// Of the number that EXIF and TIFF give: 1 to 8; others and none leave the picture as it is.
    pub(crate) fn from_exif(number: Option<u64>) -> Self {
        let [transposed, mirrored_left_right, mirrored_top_bottom] = match number {
            Some(2) => [false, true, false],
            Some(3) => [false, true, true],
            Some(4) => [false, false, true],
            Some(5) => [true, false, false],
            Some(6) => [true, true, false],
            Some(7) => [true, true, true],
            Some(8) => [true, false, true],
            _ => [false; 3],
        };
        Self { transposed, mirrored_left_right, mirrored_top_bottom }
    }

    /// Whether there is nothing to do.
    pub(crate) fn is_upright(self) -> bool {
        self == Self::default()
    }
}

/// The bands of a picture turned upright, and its description as it is then.
pub(crate) fn upright<'a>(
    orientation: Orientation,
    mut description: Description,
    bands: Box<dyn Bands + 'a>,
    limits: &Limits,
) -> Result<(Description, Box<dyn Bands + 'a>), Error> {
    if orientation.is_upright() {
        return Ok((description, bands));
    }
    let stored = [description.width, description.height];
    if orientation.transposed || orientation.mirrored_top_bottom {
        let samples = description.channels.count() as u64;
        let bytes = description.pixels().saturating_mul(samples * size_of::<f32>() as u64);
        limits.check_bytes("a picture that is stored turned", stored.map(|side| side as u64), bytes)?;
    }
    if orientation.transposed {
        (description.width, description.height) = (stored[1], stored[0]);
        description.windows = Windows::of_size(description.width, description.height);
    }
    description.notes.push("turned the picture upright, as the file says".to_owned());
    let size = [description.width, description.height];
    let channels = description.channels;
    let turned = Turned { bands, orientation, stored, size, channels, rgb: Vec::new(), alpha: Vec::new(), next: 0 };
    Ok((description, Box::new(turned)))
}

/// A picture that is turned: held whole where its first row is not the first of the file.
struct Turned<'a> {
    bands: Box<dyn Bands + 'a>,
    orientation: Orientation,
    /// Width and height as stored.
    stored: [usize; 2],
    /// Width and height upright.
    size: [usize; 2],
    channels: Channels,
    rgb: Vec<[f32; 3]>,
    alpha: Vec<f32>,
    next: usize,
}

impl Bands for Turned<'_> {
    fn next_into(&mut self, band: &mut Band) -> Result<(), Error> {
        let Orientation { transposed, mirrored_left_right, mirrored_top_bottom } = self.orientation;
        if !transposed && !mirrored_top_bottom {
            self.bands.next_into(band)?;
            band.rows_mut().for_each(|row| {
                row.rgb.reverse();
                if let Some(alpha) = row.alpha {
                    alpha.reverse();
                }
            });
            return Ok(());
        }
        if self.next == 0 {
            self.hold()?;
        }
        let ([width, height], stored_width) = (self.size, self.stored[0]);
        let rows = blocks_in_band(width, 1).min(height - self.next);
        band.become_rows(self.next, rows, width, self.channels)?;
        let place = |x: usize, y: usize| {
            let x = if mirrored_left_right { width - 1 - x } else { x };
            let y = if mirrored_top_bottom { height - 1 - y } else { y };
            if transposed { x * stored_width + y } else { y * stored_width + x }
        };
        let (first, rgb, coverage) = (self.next, &self.rgb, &self.alpha);
        band.rows_mut().enumerate().for_each(|(y, row)| {
            for (x, colour) in row.rgb.iter_mut().enumerate() {
                *colour = rgb[place(x, first + y)];
            }
            for (x, alpha) in row.alpha.into_iter().flatten().enumerate() {
                *alpha = coverage[place(x, first + y)];
            }
        });
        self.next += rows;
        Ok(())
    }

    fn memory(&self) -> ReadingMemory {
        let inner = self.bands.memory();
        let [width, height] = self.size;
        let pixels = width as u64 * height as u64;
        let whole = self.orientation.transposed || self.orientation.mirrored_top_bottom;
        let held = if whole { pixels * 4 * self.channels.count() as u64 } else { 0 };
        let band_pixels = width as u64 * blocks_in_band(width, 1).min(height) as u64;
        ReadingMemory {
            band_pixels: if whole { band_pixels } else { inner.band_pixels },
            // The band as stored is held beside the one that is made of it.
            bytes_beside: inner.bytes_beside + held + if whole { inner.band_pixels * 16 } else { 0 },
        }
    }
}

impl Turned<'_> {
    /// Reads all of the picture as it is stored.
    fn hold(&mut self) -> Result<(), Error> {
        let count = self.stored[0] * self.stored[1];
        self.rgb.clear();
        self.alpha.clear();
        grow(&mut self.rgb, count, [0.0; 3])?;
        if self.channels == Channels::Rgba {
            grow(&mut self.alpha, count, 0.0)?;
        }
        let mut band = Band::default();
        loop {
            self.bands.next_into(&mut band)?;
            if band.rows() == 0 {
                return Ok(());
            }
            let first = band.top() * self.stored[0];
            self.rgb[first..first + band.rgb().len()].copy_from_slice(band.rgb());
            if let Some(alpha) = band.alpha() {
                self.alpha[first..first + alpha.len()].copy_from_slice(alpha);
            }
        }
    }
}
