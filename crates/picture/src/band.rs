//! Pictures in bands of rows, so that memory does not grow with their height.

use std::ops::Range;

use rayon::prelude::*;

use crate::{
    description::Channels,
    error::{Error, WriteProblem},
    limits::grow,
};

/// How many pixels a band has, unless a row of the file's blocks has more: enough to keep all threads busy, few enough
/// that three bands take no more than some tens of MiB.
pub(crate) const BAND_PIXELS: usize = 1 << 20;

/// Rows of a picture that lie together, all of its width.
///
/// A reader fills it; [`Band::default`] is one without rows, to begin with. Colours are straight (not premultiplied), values
/// those of the file: NaN, infinities and negatives are kept.
///
/// ```
/// # use std::io::Cursor;
/// # use onelight_picture::{Limits, Picture, Source, open};
/// # let mut file = Cursor::new(Vec::new());
/// # Picture::opaque(4, 2, vec![[0.5; 3]; 8], Source::Exr).write_exr(&mut file, &[])?;
/// let mut reader = open(file, "small.exr", Limits::default())?;
/// let band = reader.next_band()?.expect("a picture has at least one band");
/// assert_eq!((band.top(), band.rows(), band.width()), (0, 2, 4));
///
/// // One stop brighter: twice the light.
/// band.rgb_mut().iter_mut().for_each(|rgb| *rgb = rgb.map(|v| 2.0 * v));
/// assert_eq!(band.rgb()[7], [1.0; 3]);
/// # Ok::<(), onelight_picture::Error>(())
/// ```
#[derive(Debug, Default)]
pub struct Band {
    top: usize,
    width: usize,
    rgb: Vec<[f32; 3]>,
    alpha: Option<Vec<f32>>,
}

impl Band {
    /// Its first row, counted from the top of the data window.
    pub fn top(&self) -> usize {
        self.top
    }

    /// How many rows it has: none after the last of the picture.
    pub fn rows(&self) -> usize {
        self.rgb.len().checked_div(self.width).unwrap_or(0)
    }

    /// Width of the data window, in pixels.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Straight (not premultiplied) colours, top row first.
    pub fn rgb(&self) -> &[[f32; 3]] {
        &self.rgb
    }

    /// The same, to be changed in place.
    pub fn rgb_mut(&mut self) -> &mut [[f32; 3]] {
        &mut self.rgb
    }

    /// Coverage, as many values as there are colours, 1 where a pixel is opaque; `None` where the picture has no alpha.
    pub fn alpha(&self) -> Option<&[f32]> {
        self.alpha.as_deref()
    }

    /// The same, to be changed in place.
    pub fn alpha_mut(&mut self) -> Option<&mut [f32]> {
        self.alpha.as_deref_mut()
    }

    /// Makes it opaque: its colours stay as they are, without coverage.
    pub fn leave_out_alpha(&mut self) {
        self.alpha = None;
    }

    /// The whole band, as a [`BandSink`](crate::BandSink) takes it.
    pub fn view(&self) -> BandView<'_> {
        BandView { top: self.top, width: self.width, rgb: &self.rgb, alpha: self.alpha.as_deref() }
    }

    /// Its rows from the top, to be changed on all threads of the current rayon pool.
    pub fn rows_mut(&mut self) -> impl IndexedParallelIterator<Item = RowMut<'_>> {
        self.some_rows_mut(0..self.rows())
    }

    /// Some of its rows, counted from its first.
    pub(crate) fn some_rows_mut(&mut self, rows: Range<usize>) -> impl IndexedParallelIterator<Item = RowMut<'_>> {
        let width = self.width.max(1);
        let pixels = rows.start * width..rows.end * width;
        let mut alpha = self.alpha.as_mut().map(|alpha| alpha[pixels.clone()].chunks_exact_mut(width));
        let rows = self.rgb[pixels].chunks_exact_mut(width);
        let rows: Vec<RowMut<'_>> =
            rows.map(|rgb| RowMut { rgb, alpha: alpha.as_mut().and_then(Iterator::next) }).collect();
        rows.into_par_iter()
    }

    /// Makes it `rows` rows from `top` of a picture; what it held before stays where no one overwrites it.
    pub(crate) fn become_rows(
        &mut self,
        top: usize,
        rows: usize,
        width: usize,
        channels: Channels,
    ) -> Result<(), Error> {
        (self.top, self.width) = (top, width);
        grow(&mut self.rgb, rows * width, [0.0; 3])?;
        match channels {
            Channels::Rgb => self.alpha = None,
            Channels::Rgba => grow(self.alpha.get_or_insert_default(), rows * width, 0.0)?,
        }
        Ok(())
    }
}

/// One row of a [`Band`], to be changed in place.
///
/// ```
/// # use onelight_picture::{Band, RowMut};
/// use rayon::prelude::*;
///
/// fn one_stop_brighter(band: &mut Band) {
///     band.rows_mut().for_each(|RowMut { rgb, .. }| rgb.iter_mut().flatten().for_each(|v| *v *= 2.0));
/// }
/// # one_stop_brighter(&mut Band::default());
/// ```
#[derive(Debug)]
pub struct RowMut<'a> {
    /// Straight colours, from the left.
    pub rgb: &'a mut [[f32; 3]],
    /// Coverage, one value a colour; `None` where the picture has no alpha.
    pub alpha: Option<&'a mut [f32]>,
}

/// Rows that are owned elsewhere, as a [`BandSink`](crate::BandSink) takes them.
///
/// Nothing is checked before they are written.
///
/// ```
/// # use onelight_picture::BandView;
/// // Rows 10 and 11 of a picture three pixels wide.
/// let rgb = [[0.18; 3]; 6];
/// let view = BandView { top: 10, width: 3, rgb: &rgb, alpha: None };
/// # assert_eq!(view.rgb.len(), 2 * view.width);
/// ```
#[derive(Debug, Clone, Copy)]
pub struct BandView<'a> {
    /// The first row, counted from the top of the data window.
    pub top: usize,
    /// Width of the data window, in pixels.
    pub width: usize,
    /// Straight (not premultiplied) colours, top row first.
    pub rgb: &'a [[f32; 3]],
    /// Coverage, as many values as there are colours; `None` where the picture has no alpha.
    pub alpha: Option<&'a [f32]>,
}

impl<'a> BandView<'a> {
    /// Colours and coverage of one row.
    pub(crate) fn row(&self, row: usize) -> (&'a [[f32; 3]], Option<&'a [f32]>) {
        let pixels = row * self.width..(row + 1) * self.width;
        (&self.rgb[pixels.clone()], self.alpha.map(|alpha| &alpha[pixels]))
    }

    /// How many rows it has, if it is what comes next in a picture of `size`, whose row `next` has not come yet.
    pub(crate) fn checked_rows(
        &self,
        next: usize,
        [width, height]: [usize; 2],
        channels: Channels,
    ) -> Result<usize, Error> {
        let rows = self.rgb.len().checked_div(self.width).unwrap_or(0);
        let whole = self.width == width && rows * width == self.rgb.len();
        let covered = self.alpha.map(<[f32]>::len) == (channels == Channels::Rgba).then_some(self.rgb.len());
        if !whole || !covered || self.top != next || next + rows > height {
            let (colours, top) = (self.rgb.len(), self.top);
            return Err(WriteProblem::Rows { colours, top, size: [width, height], next }.into());
        }
        Ok(rows)
    }
}

/// An open picture that is read from top to bottom.
pub(crate) trait Bands: Send {
    /// Fills `band` with the next rows; without rows where there are no more.
    fn next_into(&mut self, band: &mut Band) -> Result<(), Error>;

    /// How much memory filling a band takes at most.
    fn memory(&self) -> ReadingMemory;
}

/// The most memory that a reader holds while it fills a band.
///
/// A program that reads, computes and writes side by side holds three bands of `band_pixels`, each of 12 bytes a pixel (16
/// with coverage), and `bytes_beside` once.
///
/// ```
/// # use std::io::Cursor;
/// # use onelight_picture::{Limits, Picture, Source, open};
/// # let mut file = Cursor::new(Vec::new());
/// # Picture::opaque(4, 2, vec![[0.5; 3]; 8], Source::Exr).write_exr(&mut file, &[])?;
/// let reader = open(file, "small.exr", Limits::default())?;
/// assert_eq!(reader.memory().band_pixels, 4 * 2);
/// # Ok::<(), onelight_picture::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ReadingMemory {
    /// Pixels of the largest band.
    pub band_pixels: u64,
    /// Bytes of all else: what is packed, unpacked and on its way.
    pub bytes_beside: u64,
}

/// How many blocks of `block_rows` rows make a band of a picture `width` pixels wide.
pub(crate) fn blocks_in_band(width: usize, block_rows: usize) -> usize {
    (BAND_PIXELS / width.saturating_mul(block_rows).max(1)).max(1)
}
