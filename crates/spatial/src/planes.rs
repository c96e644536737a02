use std::ops::Range;

use rayon::prelude::*;

use crate::error::{Error, ErrorKind};

/// Most numbers in a plane: 4 GiB of them.
const MAX_NUMBERS: usize = 1 << 30;
/// What exposures are held to, so that sums of them stay finite.
const MAX_EXPOSURE: f32 = 1e30;

/// How many numbers so many rows have, before they are allocated.
pub(crate) fn limited(what: &'static str, width: usize, rows: usize, most: usize) -> Result<usize, Error> {
    width.checked_mul(rows).filter(|count| (1..=most).contains(count)).ok_or_else(|| {
        let (found, expected) = (format!("{rows} rows of {width}"), format!("1 to {most} numbers"));
        ErrorKind::Planes { what, found, expected }.into()
    })
}

/// An exposure as it is believed: NaN counts as 0, none is negative or above 1e30.
#[inline(always)]
#[expect(clippy::manual_clamp, reason = "clamp hands NaN on")]
pub(crate) fn believed(exposure: f32) -> f32 {
    exposure.max(0.0).min(MAX_EXPOSURE)
}

/// Consecutive rows of a picture, a plane for each layer: exposures, or amounts of dye.
///
/// ```
/// use onelight_spatial::Planes;
/// let mut rows = Planes::new(1920, 540..548)?;
/// rows.row_mut(545)[0][7] = 0.5;
/// assert_eq!(rows.row(545)[0][7], 0.5);
/// # Ok::<(), onelight_spatial::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Planes {
    width: usize,
    rows: Range<usize>,
    layers: [Vec<f32>; 3],
}

impl Planes {
    /// Rows of zeros.
    ///
    /// # Errors
    /// If the rows are none, or a plane has more than 2^30 numbers.
    pub fn new(width: usize, rows: Range<usize>) -> Result<Self, Error> {
        let numbers = Self::limit(width, rows.len())?;
        Ok(Self { width, rows, layers: std::array::from_fn(|_| vec![0.0; numbers]) })
    }

    /// Makes these the planes of other rows; what is in them does not matter.
    pub(crate) fn reset(&mut self, width: usize, rows: Range<usize>) -> Result<(), Error> {
        let numbers = Self::limit(width, rows.len())?;
        self.layers.iter_mut().for_each(|layer| layer.resize(numbers, 0.0));
        (self.width, self.rows) = (width, rows);
        Ok(())
    }

    /// Makes these the planes of later rows: those that it has of them stay, what is in others does not matter.
    pub(crate) fn move_on(&mut self, width: usize, rows: Range<usize>) -> Result<(), Error> {
        let numbers = Self::limit(width, rows.len())?;
        let kept = rows.start.clamp(self.rows.start, self.rows.end)..self.rows.end;
        let numbers_of = |rows: &Range<usize>| rows.start * width..rows.end * width;
        if self.width == width && kept.start == rows.start {
            let from = numbers_of(&(kept.start - self.rows.start..kept.end - self.rows.start));
            self.layers.iter_mut().for_each(|layer| layer.copy_within(from.clone(), 0));
        }
        self.layers.iter_mut().for_each(|layer| layer.resize(numbers, 0.0));
        (self.width, self.rows) = (width, rows);
        Ok(())
    }

    /// No rows yet.
    pub(crate) fn none() -> Self {
        Self { width: 0, rows: 0..0, layers: [Vec::new(), Vec::new(), Vec::new()] }
    }

    fn limit(width: usize, rows: usize) -> Result<usize, Error> {
        limited("planes", width, rows, MAX_NUMBERS)
    }

    /// Pixels in a row.
    #[must_use]
    pub fn width(&self) -> usize {
        self.width
    }

    /// Which rows of the picture these are.
    #[must_use]
    pub fn rows(&self) -> Range<usize> {
        self.rows.clone()
    }

    /// The red, green and blue layer of a row of the picture, which must be among [`Planes::rows`]; the nearest one is given otherwise.
    #[must_use]
    pub fn row(&self, y: usize) -> [&[f32]; 3] {
        let start = self.start(y);
        self.layers.each_ref().map(|layer| &layer[start..start + self.width])
    }

    /// As [`Planes::row`], to be written.
    #[must_use]
    pub fn row_mut(&mut self, y: usize) -> [&mut [f32]; 3] {
        let (start, width) = (self.start(y), self.width);
        self.layers.each_mut().map(|layer| &mut layer[start..start + width])
    }

    /// Some of the rows, each with its three layers, for the threads of the current rayon pool; those that are not held are left out.
    ///
    /// ```
    /// use onelight_spatial::Planes;
    /// use rayon::prelude::*;
    /// let mut rows = Planes::new(1920, 540..548)?;
    /// rows.par_rows_mut(541..600).for_each(|[red, _, _]| red.fill(0.5));
    /// assert_eq!((rows.row(540)[0][7], rows.row(547)[0][7]), (0.0, 0.5));
    /// # Ok::<(), onelight_spatial::Error>(())
    /// ```
    pub fn par_rows_mut(&mut self, rows: Range<usize>) -> impl IndexedParallelIterator<Item = [&mut [f32]; 3]> {
        let width = self.width.max(1);
        let [red, green, blue] = self.layers_of_mut(rows);
        let layers = red.par_chunks_mut(width).zip(green.par_chunks_mut(width)).zip(blue.par_chunks_mut(width));
        layers.map(|((red, green), blue)| [red, green, blue])
    }

    /// A copy of some of the rows.
    ///
    /// # Errors
    /// If not all of them are held, or they are none.
    pub fn part(&self, rows: Range<usize>) -> Result<Self, Error> {
        if rows.start < self.rows.start || rows.end > self.rows.end {
            let found = format!("{} to {}", self.rows.start, self.rows.end);
            let expected = format!("{} to {}", rows.start, rows.end);
            return Err(ErrorKind::Planes { what: "rows", found, expected }.into());
        }
        Self::limit(self.width, rows.len())?;
        let numbers = (rows.start - self.rows.start) * self.width..(rows.end - self.rows.start) * self.width;
        Ok(Self {
            width: self.width,
            layers: self.layers.each_ref().map(|layer| layer[numbers.clone()].to_vec()),
            rows,
        })
    }

    pub(crate) fn layer_row(&self, layer: usize, y: usize) -> &[f32] {
        let start = self.start(y);
        &self.layers[layer][start..start + self.width]
    }

    /// The numbers of some of the rows, as far as they are held, layer by layer and row after row.
    pub(crate) fn layers_of_mut(&mut self, rows: Range<usize>) -> [&mut [f32]; 3] {
        let inside = |row: usize| (row.clamp(self.rows.start, self.rows.end) - self.rows.start) * self.width;
        let numbers = inside(rows.start)..inside(rows.end.max(rows.start));
        self.layers.each_mut().map(|layer| &mut layer[numbers.clone()])
    }

    fn start(&self, y: usize) -> usize {
        (y.clamp(self.rows.start, self.rows.end - 1) - self.rows.start) * self.width
    }
}
