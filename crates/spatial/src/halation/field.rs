use std::ops::Range;

use fearless_simd::{Level, dispatch};
use rayon::prelude::*;

use super::{Halation, PointSpread};
use crate::blur::{LANES, add_differences, copy_padded, lanes, whole_lanes};
use crate::cells::{CellAxis, CellRows, CellSums, ExpandedRows, Expansion};
use crate::error::{Error, ErrorKind};
use crate::frame::Frame;
use crate::planes::{Planes, believed, limited};

/// Cells in um: finer where the antihalation layer does not blur the ring.
const CELL_UM: f64 = 50.0;
const FINE_CELL_UM: f64 = 30.0;
const FINE_BELOW_DENSITY: f64 = 0.3;
/// Most cells of a picture: 256 MiB for each layer.
const MAX_CELLS: usize = 1 << 26;
/// Points along each side of a cell at which the ring's inside is summed.
const POINTS: i32 = 12;

/// Collects the exposure of a whole picture in cells of about 50 um, from which halation is made before any row can be finished.
///
/// ```
/// use onelight_spatial::{FilmFormat, Frame, Halation, HalationCells, HalationSettings, Planes};
/// let frame = Frame::new([64, 64], FilmFormat::Super35.pitch(2048, 1.0)?)?;
/// let mut cells = HalationCells::new(&Halation::new(HalationSettings::default())?, &frame)?;
/// for band in [0..30, 30..64] {
///     cells.add(&Planes::new(64, band)?)?;
/// }
/// let halo = cells.finish()?;
/// # Ok::<(), onelight_spatial::Error>(())
/// ```
#[derive(Debug)]
pub struct HalationCells {
    halation: Halation,
    frame: Frame,
    axes: [CellAxis; 2],
    next_row: usize,
    layers: [Option<LayerCells>; 3],
}

#[derive(Debug)]
struct LayerCells {
    sums: CellSums,
    row: Vec<f32>,
    cells: CellRows,
}

/// The light that returns everywhere in a picture, in cells.
///
/// ```
/// use onelight_spatial::{FilmFormat, Frame, Halation, HalationCells, HalationSettings, HaloField, Planes};
/// let frame = Frame::new([64, 64], FilmFormat::Super35.pitch(2048, 1.0)?)?;
/// let mut cells = HalationCells::new(&Halation::new(HalationSettings::default())?, &frame)?;
/// cells.add(&Planes::new(64, 0..64)?)?;
/// let halo: HaloField = cells.finish()?;
/// # Ok::<(), onelight_spatial::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct HaloField {
    frame: Frame,
    axes: [CellAxis; 2],
    expansion: Expansion,
    /// For each layer that halation reaches: by how much exposure goes towards the field, and the field, a mean of exposures.
    layers: [Option<(f32, CellRows)>; 3],
}

impl HalationCells {
    /// For the pictures of one frame.
    ///
    /// # Errors
    /// If the picture has more than 2^26 cells.
    pub fn new(halation: &Halation, frame: &Frame) -> Result<Self, Error> {
        Self::with_cells(halation, frame, halation.cell_um())
    }

    /// With cells of another size.
    pub(crate) fn with_cells(halation: &Halation, frame: &Frame, cell_um: f64) -> Result<Self, Error> {
        let [x, y] = cell_axes(frame, cell_um);
        limited("cells of halation", x.count, y.count, MAX_CELLS)?;
        let layers = halation.pull().map(|pull| {
            (pull > 0.0).then(|| LayerCells {
                sums: CellSums::new(frame.width()),
                row: vec![0.0; frame.width()],
                cells: CellRows::new(x.count, 0..y.count),
            })
        });
        Ok(Self { halation: halation.clone(), frame: *frame, axes: [x, y], next_row: 0, layers })
    }

    /// Cells along both axes.
    pub(crate) fn axes(&self) -> [CellAxis; 2] {
        self.axes
    }

    /// Adds the next rows of the picture's exposures, from top to bottom, each row once.
    ///
    /// # Errors
    /// If they are not the next rows, or not as wide as the picture.
    pub fn add(&mut self, exposures: &Planes) -> Result<(), Error> {
        self.add_rows(exposures, exposures.rows())
    }

    /// Adds some of the rows of these planes.
    pub(crate) fn add_rows(&mut self, exposures: &Planes, rows: Range<usize>) -> Result<(), Error> {
        let is_next = rows.start == self.next_row && rows.end <= self.frame.height();
        if !is_next || exposures.width() != self.frame.width() {
            let found = format!("rows {} to {} of {} pixels", rows.start, rows.end, exposures.width());
            let expected = format!(
                "rows from {} to at most {} of {} pixels",
                self.next_row,
                self.frame.height(),
                self.frame.width()
            );
            return Err(ErrorKind::Planes { what: "exposures for halation", found, expected }.into());
        }
        let [x, y] = self.axes;
        self.layers.par_iter_mut().enumerate().for_each(|(index, layer)| {
            let Some(layer) = layer else { return };
            for row in rows.clone() {
                for (clean, e) in layer.row.iter_mut().zip(exposures.layer_row(index, row)) {
                    *clean = believed(*e);
                }
                layer.sums.add(&layer.row);
                let cell = y.cell_of(row);
                if y.pixels_of(cell).end == row + 1 {
                    layer.sums.take(&x, layer.cells.row_mut(cell));
                }
            }
        });
        self.next_row = rows.end;
        Ok(())
    }

    /// The light that returns, once all rows are there.
    ///
    /// # Errors
    /// If rows are missing.
    pub fn finish(self) -> Result<HaloField, Error> {
        if self.next_row != self.frame.height() {
            let found = format!("{} rows", self.next_row);
            let expected = format!("all {} rows of the picture", self.frame.height());
            return Err(ErrorKind::Planes { what: "exposures for halation", found, expected }.into());
        }
        let pitch = self.frame.pitch();
        let kernel = HaloKernel::new(&self.halation, self.axes, [pitch.x_um(), pitch.y_um()]);
        let pull = self.halation.pull();
        let mut layers = [None, None, None];
        layers.par_iter_mut().zip(&self.layers).zip(pull).for_each(|((field, layer), pull)| {
            *field = layer.as_ref().map(|layer| (pull as f32, kernel.field(&layer.cells)));
        });
        Ok(HaloField { frame: self.frame, axes: self.axes, expansion: Expansion::new(&self.axes[0]), layers })
    }
}

impl Halation {
    /// Cells in um that the light which returns is worked out in.
    fn cell_um(&self) -> f64 {
        if self.settings.antihalation.density() < FINE_BELOW_DENSITY { FINE_CELL_UM } else { CELL_UM }
    }

    /// These cells along both axes of a picture.
    pub(crate) fn cell_axes(&self, frame: &Frame) -> [CellAxis; 2] {
        cell_axes(frame, self.cell_um())
    }
}

fn cell_axes(frame: &Frame, cell_um: f64) -> [CellAxis; 2] {
    let size = |pitch: f64| (cell_um / pitch).round().max(1.0) as usize;
    let (pitch, offset) = (frame.pitch(), frame.offset());
    let x = CellAxis::new(size(pitch.x_um()), offset[0], frame.width());
    let y = CellAxis::new(size(pitch.y_um()), offset[1], frame.height());
    [x, y]
}

impl HaloField {
    /// Whether it is that of a picture of this size and place; its number does not matter.
    pub(crate) fn is_of(&self, frame: &Frame) -> bool {
        self.frame.numbered(0) == frame.numbered(0)
    }

    /// What halation makes of an exposure of a layer in a cell.
    pub(crate) fn exposed_in_cell(&self, layer: usize, [x, y]: [usize; 2], exposure: f32) -> f32 {
        match &self.layers[layer] {
            Some((pull, field)) => exposure + pull * (field.row(y as isize)[x] - exposure),
            None => exposure,
        }
    }

    /// For a layer that halation reaches: by how much its exposure goes towards the field.
    pub(crate) fn pull(&self, layer: usize) -> Option<f32> {
        self.layers[layer].as_ref().map(|(pull, _)| *pull)
    }

    /// The field of a layer at row `y`, `width` pixels from `start`: its values at the rows of cells above and below, and how far towards the
    /// second the row lies.
    pub(crate) fn rows<'a>(
        &self,
        layer: usize,
        y: usize,
        start: usize,
        width: usize,
        rows: &'a mut ExpandedRows,
    ) -> Option<(&'a [f32], &'a [f32], f32)> {
        let (_, field) = self.layers[layer].as_ref()?;
        Some(rows.at(field, &self.axes[1], &self.expansion, y, start, width))
    }
}

/// The profile in cells: positive Gaussians, and the weights of what is lost inside the ring.
pub(crate) struct HaloKernel {
    level: Level,
    axes: [CellAxis; 2],
    /// Share of each Gaussian in what returns, and its standard deviation in pixels.
    gaussians: Vec<(f32, [f64; 2])>,
    /// For each row of cells at distance 0, 1, and so on: weight of the cell in the middle, and of those beside it.
    hole: Vec<(f32, Vec<f32>)>,
}

impl HaloKernel {
    pub(crate) fn gaussians(&self) -> &[(f32, [f64; 2])] {
        &self.gaussians
    }

    pub(crate) fn hole(&self) -> &[(f32, Vec<f32>)] {
        &self.hole
    }

    pub(crate) fn new(halation: &Halation, axes: [CellAxis; 2], pitch_um: [f64; 2]) -> Self {
        let returned = halation.returned;
        let gaussians = halation.gaussians.iter();
        let gaussians = gaussians.map(|(w, um)| ((w / returned) as f32, pitch_um.map(|pitch| um / pitch))).collect();
        let cell = [0, 1].map(|i| axes[i].size() as f64 * pitch_um[i]);
        let lost = halation.spread.smooth_returned() - returned;
        Self { level: Level::new(), axes, gaussians, hole: hole(&halation.spread, cell, lost / returned) }
    }

    /// Means of exposure weighted by what returns.
    fn field(&self, cells: &CellRows) -> CellRows {
        let mut field = self.without_hole(cells);
        let mut gain = CellRows::new(cells.width, cells.rows.clone());
        let [x, y] = &self.axes;
        for (share, sigma) in &self.gaussians {
            let blurred = cells.blurred_by(self.level, [x, y], *sigma);
            for ((gain, blurred), own) in gain.means.iter_mut().zip(&blurred.means).zip(&cells.means) {
                *gain += share * (blurred - own);
            }
        }
        for (field, gain) in field.means.iter_mut().zip(&gain.means) {
            // Four Gaussians are not the profile: about a single light they may miss the hole's inside by a little.
            *field = (*field + gain).max(0.0);
        }
        field
    }

    /// Each cell's own mean less what is lost of its neighbours' light.
    fn without_hole(&self, cells: &CellRows) -> CellRows {
        let reach = self.hole.iter().map(|(_, side)| side.len()).max().unwrap_or(0);
        let mut field = CellRows::new(cells.width, cells.rows.clone());
        let stride = whole_lanes(cells.width) + 2 * reach;
        let mut padded = vec![0.0; stride * cells.rows.len()];
        for (row, padded) in cells.rows.clone().zip(padded.chunks_exact_mut(stride)) {
            copy_padded(cells.row(row as isize), -(reach as isize), padded);
        }
        field.means.par_chunks_mut(cells.width).enumerate().for_each(|(y, out)| {
            dispatch!(self.level, _simd => self.hole_row(&padded, stride, reach, y, out));
        });
        field
    }

    #[inline(always)]
    fn hole_row(&self, padded: &[f32], stride: usize, reach: usize, y: usize, out: &mut [f32]) {
        let (rows, last) = (self.hole.len() - 1, padded.len() / stride - 1);
        for (block, out) in out.chunks_mut(LANES).enumerate() {
            let start = block * LANES + reach;
            let own = lanes(padded, y * stride + start);
            let mut lost = [0.0; LANES];
            for i in 0..=2 * rows {
                let (centre, side) = &self.hole[i.abs_diff(rows)];
                let at = (y + i).saturating_sub(rows).min(last) * stride + start;
                // The middle cell is its own mirror image.
                add_differences(&mut lost, 0.5 * centre, lanes(padded, at), lanes(padded, at), own);
                for (k, tap) in side.iter().enumerate() {
                    add_differences(&mut lost, *tap, lanes(padded, at - k - 1), lanes(padded, at + k + 1), own);
                }
            }
            for ((out, own), lost) in out.iter_mut().zip(own).zip(lost) {
                *out = own - lost;
            }
        }
    }
}

/// Weights of the cells inside the ring, by rows at distance 0, 1, and so on; all of them together sum to `sum`.
fn hole(spread: &PointSpread, cell_um: [f64; 2], sum: f64) -> Vec<(f32, Vec<f32>)> {
    let reach = cell_um.map(|cell| (spread.ring_um() / cell + 0.5).floor() as i32);
    let weight = |dx: i32, dy: i32| {
        let along = |d: i32, i: i32, cell: f64| (f64::from(d) + (f64::from(i) + 0.5) / f64::from(POINTS) - 0.5) * cell;
        let points = (0..POINTS * POINTS).map(|i| (i % POINTS, i / POINTS));
        let at = |(i, j)| spread.lost(along(dx, i, cell_um[0]).hypot(along(dy, j, cell_um[1])));
        points.map(at).sum::<f64>()
    };
    let rows: Vec<Vec<f64>> = (0..=reach[1]).map(|dy| (0..=reach[0]).map(|dx| weight(dx, dy)).collect()).collect();
    let twice = |d: usize| if d == 0 { 1.0 } else { 2.0 };
    let all: f64 = rows
        .iter()
        .enumerate()
        .map(|(dy, row)| row.iter().enumerate().map(|(dx, w)| twice(dx) * twice(dy) * w).sum::<f64>())
        .sum();
    let scaled = |w: f64| (w * sum / all) as f32;
    rows.into_iter().map(|row| (scaled(row[0]), row[1..].iter().map(|w| scaled(*w)).collect())).collect()
}
