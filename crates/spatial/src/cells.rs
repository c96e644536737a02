//! Cells: blocks of pixels counted from the frame's origin, their means, and the way back to pixels.

use std::ops::Range;

use fearless_simd::{Level, dispatch};

use crate::blur::{LANES, across_rows, along_row, copy_padded, whole_lanes};
use crate::taps::Taps;

/// The same where blurs are added and taken from each other, and what is left must be right.
const CELLS_PER_SIGMA_OF_SUMS: f64 = 2.5;
/// A blur is made in cells of as many pixels as leave its standard deviation at least so many cells wide.
pub(crate) const CELLS_PER_SIGMA: f64 = 1.4;

/// Cells along one axis of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct CellAxis {
    /// Pixels in a cell.
    size: usize,
    /// Where the picture begins in the frame, in pixels.
    offset: i64,
    /// Pixels of the picture.
    pixels: usize,
    /// The first cell that holds a pixel, counted from the frame's origin.
    first: i64,
    /// Cells that hold pixels.
    pub(crate) count: usize,
}

impl CellAxis {
    pub(crate) fn new(size: usize, offset: i32, pixels: usize) -> Self {
        Self { size: 1, offset: 0, pixels, first: i64::from(offset), count: pixels }.of_cells(size)
    }

    /// Pixels in a cell.
    pub(crate) fn size(&self) -> usize {
        self.size
    }

    /// Pixels of the picture.
    pub(crate) fn pixels(&self) -> usize {
        self.pixels
    }

    /// The picture's pixels in a cell.
    pub(crate) fn pixels_of(&self, cell: usize) -> Range<usize> {
        let start = (self.first + cell as i64) * self.size as i64 - self.offset;
        let inside = |pixel: i64| pixel.clamp(0, self.pixels as i64) as usize;
        inside(start)..inside(start + self.size as i64)
    }

    /// The cell that holds a pixel of the picture.
    pub(crate) fn cell_of(&self, pixel: usize) -> usize {
        ((pixel as i64 + self.offset).div_euclid(self.size as i64) - self.first) as usize
    }

    /// The two cells between whose centres a pixel lies, and how far towards the second; at an edge twice the same.
    pub(crate) fn between(&self, pixel: usize) -> (usize, usize, f32) {
        let size = self.size as i64;
        // In half pixels: the pixel's centre from the first cell's centre.
        let place = 2 * (pixel as i64 + self.offset) + 1 - size;
        let lower = place.div_euclid(2 * size);
        let t = place.rem_euclid(2 * size) as f32 / (2 * size) as f32;
        let inside = |cell: i64| (cell - self.first).clamp(0, self.count as i64 - 1) as usize;
        (inside(lower), inside(lower + 1), t)
    }

    /// Cells of these cells.
    fn of_cells(&self, size: usize) -> Self {
        let (size, offset, pixels) = (size.max(1), self.first, self.count);
        let of = |cell: i64| (cell + offset).div_euclid(size as i64);
        let first = of(0);
        Self { size, offset, pixels, first, count: (of(pixels as i64 - 1) - first) as usize + 1 }
    }

    /// Variance, in square pixels, that the mean over cells and the way back add to a blur.
    pub(crate) fn own_variance(&self) -> f64 {
        let size = self.size as f64;
        let phases = 2 * self.size as i64;
        let bilinear = (0..self.size as i64).map(|i| {
            let t = (2 * i + 1 - self.size as i64).rem_euclid(phases) as f64 / phases as f64;
            t * (1.0 - t) * size * size
        });
        (size * size - 1.0) / 12.0 + bilinear.sum::<f64>() / size
    }
}

/// Taps over cells for a Gaussian of `sigma` pixels, what cells blur by themselves taken off.
pub(crate) fn cell_taps(axis: &CellAxis, sigma: f64) -> Taps {
    let left = (sigma * sigma - axis.own_variance()).max(0.0).sqrt();
    Taps::of(left / axis.size as f64)
}

/// The coarser cells in which a Gaussian of `sigma` pixels is made, where these are fine enough for it by themselves none, and its taps.
pub(crate) fn coarse_cells(axes: [&CellAxis; 2], sigma: [f64; 2]) -> (Option<[CellAxis; 2]>, [Vec<f32>; 2]) {
    let sizes = [0, 1].map(|i| (sigma[i] / (axes[i].size as f64 * CELLS_PER_SIGMA_OF_SUMS)).floor().max(1.0) as usize);
    if sizes == [1, 1] {
        return (None, [0, 1].map(|i| cell_taps(axes[i], sigma[i]).rounded()));
    }
    // The finer cells blur as well, in their own pixels.
    let coarse = [0, 1].map(|i| axes[i].of_cells(sizes[i]));
    let taps = [0, 1].map(|i| {
        let size = axes[i].size as f64;
        let own = axes[i].own_variance() / (size * size);
        let sigma = ((sigma[i] / size).powi(2) - own).max(0.0).sqrt();
        cell_taps(&coarse[i], sigma).rounded()
    });
    (Some(coarse), taps)
}

/// Rows of means of cells.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CellRows {
    pub(crate) width: usize,
    /// Which rows of cells these are.
    pub(crate) rows: Range<usize>,
    pub(crate) means: Vec<f32>,
}

impl CellRows {
    pub(crate) fn new(width: usize, rows: Range<usize>) -> Self {
        Self { width, means: vec![0.0; width * rows.len()], rows }
    }

    /// The nearest row that is held.
    pub(crate) fn row(&self, y: isize) -> &[f32] {
        let y = y.clamp(self.rows.start as isize, self.rows.end as isize - 1) as usize - self.rows.start;
        &self.means[y * self.width..(y + 1) * self.width]
    }

    pub(crate) fn row_mut(&mut self, y: usize) -> &mut [f32] {
        let y = y - self.rows.start;
        &mut self.means[y * self.width..(y + 1) * self.width]
    }

    /// These rows blurred, with those about them; beyond the first and last row held they repeat, as the cells at the ends of a row do.
    pub(crate) fn blurred(&self, level: Level, x: &[f32], y: &[f32], rows: Range<usize>) -> Self {
        let mut blurred = Self::new(self.width, rows);
        dispatch!(level, _simd => self.blur_into(x, y, &mut blurred));
        blurred
    }

    #[inline(always)]
    fn blur_into(&self, x: &[f32], y: &[f32], blurred: &mut Self) {
        let stride = whole_lanes(self.width);
        let mut padded = vec![0.0; stride + 2 * x.len()];
        let mut across = vec![0.0; stride * (blurred.rows.len() + 2 * y.len())];
        for (row, across) in across.chunks_exact_mut(stride).enumerate() {
            let row = (blurred.rows.start + row) as isize - y.len() as isize;
            copy_padded(self.row(row), -(x.len() as isize), &mut padded);
            along_row(x, &padded, across);
        }
        for (row, out) in blurred.means.chunks_exact_mut(self.width).enumerate() {
            for (block, out) in out.chunks_mut(LANES).enumerate() {
                let sum = across_rows(y, &across, stride, row + y.len(), block * LANES);
                out.copy_from_slice(&sum[..out.len()]);
            }
        }
    }

    /// These rows, all there are of a picture, blurred by a Gaussian of `sigma` pixels: wide ones in coarser cells still, which are counted
    /// from the frame's origin as these are.
    pub(crate) fn blurred_by(&self, level: Level, axes: [&CellAxis; 2], sigma: [f64; 2]) -> Self {
        let (coarse, taps) = coarse_cells(axes, sigma);
        let Some(coarse) = coarse else {
            return self.blurred(level, &taps[0], &taps[1], self.rows.clone());
        };
        let [x, y] = &coarse;
        let mut means = Self::new(x.count, 0..y.count);
        let mut sums = CellSums::new(self.width);
        for cell in 0..y.count {
            for row in y.pixels_of(cell) {
                sums.add(self.row(row as isize));
            }
            sums.take(x, means.row_mut(cell));
        }
        let means = means.blurred(level, &taps[0], &taps[1], 0..y.count);
        let expansion = Expansion::new(x);
        let mut blurred = Self::new(self.width, self.rows.clone());
        let mut rows = ExpandedRows::default();
        for row in self.rows.clone() {
            let (upper, lower, t) = rows.at(&means, y, &expansion, row, 0, self.width);
            for ((out, upper), lower) in blurred.row_mut(row).iter_mut().zip(upper).zip(lower) {
                *out = upper + t * (lower - upper);
            }
        }
        blurred
    }
}

/// Sums rows of pixels until they fill a row of cells, as differences to first pixels: uniform cells have exactly their own mean.
#[derive(Debug, Clone)]
pub(crate) struct CellSums {
    first: Vec<f32>,
    sums: Vec<f32>,
    rows: usize,
}

impl CellSums {
    pub(crate) fn new(pixels: usize) -> Self {
        Self { first: vec![0.0; pixels], sums: vec![0.0; pixels], rows: 0 }
    }

    /// Adds a row of pixels.
    pub(crate) fn add(&mut self, row: &[f32]) {
        if self.rows == 0 {
            self.first.copy_from_slice(row);
            self.sums.fill(0.0);
        } else {
            for ((sum, first), v) in self.sums.iter_mut().zip(&self.first).zip(row) {
                *sum += v - first;
            }
        }
        self.rows += 1;
    }

    /// Writes the means of the cells, and starts again.
    pub(crate) fn take(&mut self, axis: &CellAxis, means: &mut [f32]) {
        for (cell, mean) in means.iter_mut().enumerate() {
            let pixels = axis.pixels_of(cell);
            let first = self.first[pixels.start];
            let mut sum = 0.0;
            for x in pixels.clone() {
                sum += self.sums[x] + self.rows as f32 * (self.first[x] - first);
            }
            *mean = (first + sum / (self.rows * pixels.len()) as f32).max(0.0);
        }
        self.rows = 0;
    }
}

/// A row of cells brought to pixels: for each pixel two cells and a share.
#[derive(Debug, Clone)]
pub(crate) struct Expansion(Vec<(u32, u32, f32)>);

impl Expansion {
    pub(crate) fn new(axis: &CellAxis) -> Self {
        let between = |pixel| {
            let (a, b, t) = axis.between(pixel);
            (a as u32, b as u32, t)
        };
        Self((0..axis.pixels).map(between).collect())
    }

    /// The pixels from `start` of the row.
    pub(crate) fn expand(&self, cells: &[f32], start: usize, out: &mut [f32]) {
        for (out, (a, b, t)) in out.iter_mut().zip(&self.0[start..]) {
            let (a, b) = (cells[*a as usize], cells[*b as usize]);
            *out = a + t * (b - a);
        }
    }
}

/// The two rows of cells between which a row of pixels lies, brought to pixels once for all the rows between them.
#[derive(Debug, Default)]
pub(crate) struct ExpandedRows {
    upper: Vec<f32>,
    lower: Vec<f32>,
    held: Option<(usize, usize)>,
}

impl ExpandedRows {
    /// Forgets what is held: the next rows are of other cells or columns.
    pub(crate) fn clear(&mut self) {
        self.held = None;
    }

    /// Both rows for row `y` of pixels, `width` of them from `start`, and how far towards the second it lies.
    pub(crate) fn at(
        &mut self,
        cells: &CellRows,
        axis: &CellAxis,
        expansion: &Expansion,
        y: usize,
        start: usize,
        width: usize,
    ) -> (&[f32], &[f32], f32) {
        let (above, below, t) = axis.between(y);
        if self.held != Some((above, below)) {
            self.upper.resize(width, 0.0);
            self.lower.resize(width, 0.0);
            expansion.expand(cells.row(above as isize), start, &mut self.upper);
            expansion.expand(cells.row(below as isize), start, &mut self.lower);
            self.held = Some((above, below));
        }
        (&self.upper, &self.lower, t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_counted_from_the_frames_origin() {
        let whole = CellAxis::new(4, 0, 30);
        let crop = CellAxis::new(4, 10, 20);
        assert_eq!((whole.count, crop.count), (8, 6));
        assert_eq!(crop.pixels_of(0), 0..2, "the crop's first cell holds two of its pixels");
        assert_eq!(whole.pixels_of(3), 12..16);
        assert_eq!(crop.pixels_of(1), 2..6);
        for pixel in 3..19 {
            let ((a, b, t), (c, d, u)) = (whole.between(pixel + 10), crop.between(pixel));
            if b < 7 {
                assert_eq!((a, b, t), (c + 2, d + 2, u), "{pixel}");
            }
            assert_eq!(whole.cell_of(pixel + 10), crop.cell_of(pixel) + 2);
        }
        let negative = CellAxis::new(4, -3, 5);
        assert_eq!((negative.count, negative.pixels_of(0), negative.pixels_of(1)), (2, 0..3, 3..5));
    }

    #[test]
    fn cells_of_one_pixel_change_nothing() {
        let axis = CellAxis::new(1, 5, 9);
        assert_eq!(axis.own_variance(), 0.0);
        assert!((0..9).all(|pixel| axis.between(pixel) == (pixel, (pixel + 1).min(8), 0.0)));
    }

    #[test]
    fn a_gaussian_over_cells_has_the_variance_asked_for() {
        for size in [2usize, 4, 7] {
            let pixels = 4001;
            let axis = CellAxis::new(size, 0, pixels);
            let sigma = 2.1 * size as f64;
            let taps = cell_taps(&axis, sigma).rounded();
            // The mean over all phases of a point's image.
            let mut variance = 0.0;
            for phase in 0..size {
                let mut row = vec![0.0; pixels];
                row[2000 + phase] = 1.0;
                let mut sums = CellSums::new(pixels);
                sums.add(&row);
                let mut cells = CellRows::new(axis.count, 0..1);
                sums.take(&axis, cells.row_mut(0));
                let blurred = cells.blurred(Level::new(), &taps, &[], 0..1);
                let mut out = vec![0.0; pixels];
                Expansion::new(&axis).expand(blurred.row(0), 0, &mut out);
                let square = |(x, v): (usize, &f32)| (x as f64 - (2000 + phase) as f64).powi(2) * f64::from(*v);
                variance += out.iter().enumerate().map(square).sum::<f64>() / size as f64;
            }
            assert!((variance.sqrt() / sigma - 1.0).abs() < 0.01, "{size}: {} for {sigma}", variance.sqrt());
        }
    }

    #[test]
    fn coarser_cells_blur_alike() {
        let pixels = 900;
        let axes = [CellAxis::new(3, 7, pixels), CellAxis::new(1, 0, 1)];
        let mut cells = CellRows::new(axes[0].count, 0..1);
        for (i, mean) in cells.row_mut(0).iter_mut().enumerate() {
            *mean = ((i * 37) % 64) as f32 + if i > 150 { 90.0 } else { 0.0 };
        }
        let sigma = 42.0;
        let taps = cell_taps(&axes[0], sigma).rounded();
        let exact = cells.blurred(Level::new(), &taps, &[], 0..1);
        let coarse = cells.blurred_by(Level::new(), [&axes[0], &axes[1]], [sigma, 0.0]);
        // Away from the edges, where the one repeats a cell and the other a cell of cells.
        for (exact, coarse) in exact.means.iter().zip(&coarse.means).skip(60).take(180) {
            assert!((exact - coarse).abs() < 1.5, "{exact} {coarse}");
        }
    }
}
