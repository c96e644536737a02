use std::ops::Range;

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

    pub(crate) fn layer_row(&self, layer: usize, y: usize) -> &[f32] {
        let start = self.start(y);
        &self.layers[layer][start..start + self.width]
    }

    /// All numbers of the layers, row after row.
    pub(crate) fn layers_mut(&mut self) -> [&mut [f32]; 3] {
        self.layers.each_mut().map(Vec::as_mut_slice)
    }

    fn start(&self, y: usize) -> usize {
        (y.clamp(self.rows.start, self.rows.end - 1) - self.rows.start) * self.width
    }
}
