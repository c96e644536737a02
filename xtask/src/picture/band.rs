//! Pictures in bands of rows, so that memory does not grow with their height.

use std::ops::Range;

use anyhow::{Result, bail};
use rayon::prelude::*;

use super::limits::grow;

/// How many pixels a band has, unless a row of the file's blocks has more: enough to keep all threads busy, few enough
/// that three bands take no more than some tens of MiB.
pub(super) const BAND_PIXELS: usize = 1 << 20;

/// Rows of a picture that lie together, all of its width.
#[derive(Debug, Default)]
pub(crate) struct Band {
    /// Its first row, counted from the top of the data window.
    pub(crate) top: usize,
    /// Width of the data window, in pixels.
    pub(crate) width: usize,
    /// Straight (not premultiplied) colours, top row first.
    pub(crate) rgb: Vec<[f32; 3]>,
    /// Coverage, as many as there are colours.
    pub(crate) alpha: Option<Vec<f32>>,
}

impl Band {
    /// How many rows it has.
    pub(crate) fn rows(&self) -> usize {
        self.rgb.len().checked_div(self.width).unwrap_or(0)
    }

    /// The same, borrowed.
    pub(crate) fn view(&self) -> BandView<'_> {
        BandView { top: self.top, width: self.width, rgb: &self.rgb, alpha: self.alpha.as_deref() }
    }

    /// Its rows, to be filled or changed on all threads.
    pub(crate) fn rows_mut(&mut self) -> impl IndexedParallelIterator<Item = RowMut<'_>> {
        self.some_rows_mut(0..self.rows())
    }

    /// Some of its rows.
    pub(super) fn some_rows_mut(&mut self, rows: Range<usize>) -> impl IndexedParallelIterator<Item = RowMut<'_>> {
        let width = self.width.max(1);
        let pixels = rows.start * width..rows.end * width;
        let mut alpha = self.alpha.as_mut().map(|alpha| alpha[pixels.clone()].chunks_exact_mut(width));
        let rows = self.rgb[pixels].chunks_exact_mut(width);
        let rows: Vec<RowMut<'_>> =
            rows.map(|rgb| RowMut { rgb, alpha: alpha.as_mut().and_then(Iterator::next) }).collect();
        rows.into_par_iter()
    }

    /// Makes it `rows` rows from `top` of a picture; what it held before stays where no one overwrites it.
    pub(super) fn become_rows(&mut self, top: usize, rows: usize, width: usize, channels: Channels) -> Result<()> {
        (self.top, self.width) = (top, width);
        grow(&mut self.rgb, rows * width, [0.0; 3])?;
        match channels {
            Channels::Rgb => self.alpha = None,
            Channels::Rgba => grow(self.alpha.get_or_insert_default(), rows * width, 0.0)?,
        }
        Ok(())
    }
}

/// A row of a band.
pub(crate) struct RowMut<'a> {
    /// Its colours.
    pub(crate) rgb: &'a mut [[f32; 3]],
    /// Its coverage.
    pub(crate) alpha: Option<&'a mut [f32]>,
}

/// A [`Band`] that is owned elsewhere.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BandView<'a> {
    pub(crate) top: usize,
    pub(crate) width: usize,
    pub(crate) rgb: &'a [[f32; 3]],
    pub(crate) alpha: Option<&'a [f32]>,
}

impl<'a> BandView<'a> {
    /// Colours and coverage of one row.
    pub(super) fn row(&self, row: usize) -> (&'a [[f32; 3]], Option<&'a [f32]>) {
        let pixels = row * self.width..(row + 1) * self.width;
        (&self.rgb[pixels.clone()], self.alpha.map(|alpha| &alpha[pixels]))
    }

    /// How many rows it has, if it is what comes next in a picture of `size`, whose row `next` has not come yet.
    pub(super) fn checked_rows(&self, next: usize, [width, height]: [usize; 2], channels: Channels) -> Result<usize> {
        let rows = self.rgb.len().checked_div(self.width).unwrap_or(0);
        let whole = self.width == width && rows * width == self.rgb.len();
        let covered = self.alpha.map(<[f32]>::len) == (channels == Channels::Rgba).then_some(self.rgb.len());
        if !whole || !covered || self.top != next || next + rows > height {
            bail!(
                "{} colours from row {} of a picture of {width} x {height} pixels cannot be written after row {next}",
                self.rgb.len(),
                self.top
            );
        }
        Ok(rows)
    }
}

/// What a pixel holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Channels {
    /// Colour.
    Rgb,
    /// Colour and coverage.
    Rgba,
}

impl Channels {
    /// Samples of a pixel.
    pub(crate) fn count(self) -> usize {
        match self {
            Self::Rgb => 3,
            Self::Rgba => 4,
        }
    }
}

/// An open picture that is read from top to bottom.
pub(super) trait Bands: Send {
    /// Fills `band` with the next rows; without rows where there are no more.
    fn next_into(&mut self, band: &mut Band) -> Result<()>;

    /// What that takes.
    fn holds(&self) -> Holds;
}

/// The most that a reader holds while it fills a band.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Holds {
    /// Pixels of the band.
    pub(crate) band_pixels: u64,
    /// Bytes of all else.
    pub(crate) bytes_beside: u64,
}

/// A picture that is written from top to bottom.
pub(crate) trait BandSink: Send {
    /// Takes the next rows.
    ///
    /// # Errors
    /// If they are not the next ones or not as wide as the picture, or cannot be written.
    fn write(&mut self, band: BandView<'_>) -> Result<()>;
}

/// How many blocks of `block_rows` rows make a band of a picture `width` pixels wide.
pub(super) fn blocks_in_band(width: usize, block_rows: usize) -> usize {
    (BAND_PIXELS / width.saturating_mul(block_rows).max(1)).max(1)
}
