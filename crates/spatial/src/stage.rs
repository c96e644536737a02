use std::ops::Range;

use fearless_simd::Level;
use rayon::prelude::*;

use crate::cells::{CellRows, CellSums, Expansion};
use crate::chain::Development;
use crate::error::{Error, ErrorKind};
use crate::format::Pitch;
use crate::frame::Frame;
use crate::grain::Grain;
use crate::halation::{Halation, HalationCells, HaloField};
use crate::planes::Planes;
use crate::sharpness::{AdjacencyBlur, LayerBlurs, Sharpness};
use crate::strip::{Scratch, TILE, Tile, add_grain, adjacency_layer, expose_layer};

/// Rows of a strip, which one thread works on.
const STRIP: usize = 64;

/// The effects of a film on one picture: from exposures to amounts of dye, a band of rows at a time.
///
/// `E -> scatter -> halation -> development -> adjacency -> grain -> amounts`. What is left out costs nothing. The rows that come out are the
/// same to the bit for any division into bands and any number of threads. Beyond the picture's edges its edge pixels repeat. Hard exposures
/// have one result: NaN and negative ones count as 0, none is above 1e30.
///
/// ```
/// use onelight_spatial::{FilmFormat, Frame, Halation, HalationSettings, Planes, SpatialStage};
/// let frame = Frame::new([300, 200], FilmFormat::Super35.pitch(2048, 1.0)?)?;
/// let stage = SpatialStage::new(frame).with_halation(Halation::new(HalationSettings::default())?);
/// // The picture's exposures: one bright light.
/// let exposures = |rows: std::ops::Range<usize>| -> Result<Planes, onelight_spatial::Error> {
///     let mut planes = Planes::new(300, rows)?;
///     if planes.rows().contains(&100) {
///         planes.row_mut(100)[0][150] = 1e4;
///     }
///     Ok(planes)
/// };
/// // All of them once for the halo, then again for each band.
/// let mut cells = stage.halation_cells()?.ok_or("no halation")?;
/// cells.add(&exposures(0..200)?)?;
/// let halo = cells.finish()?;
/// for band in [0..96, 96..200] {
///     let needed = exposures(stage.exposure_rows(band.clone()))?;
///     let amounts = stage.amounts(&needed, Some(&halo), band, &|e: [f32; 3]| e.map(|e| e.sqrt()))?;
///     assert!(amounts.row(95)[0][130] > 0.0 || amounts.rows().start == 96);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct SpatialStage {
    frame: Frame,
    blurs: Option<[LayerBlurs; 3]>,
    halation: Option<Halation>,
    grain: Option<Grain>,
    level: Level,
}

/// Memory of a stage's rows, kept from band to band.
///
/// ```
/// use onelight_spatial::{Frame, Pitch, Planes, SpatialStage, StageBuffers};
/// let stage = SpatialStage::new(Frame::new([64, 100], Pitch::new(12.0, 12.0)?)?);
/// let mut buffers = StageBuffers::default();
/// for band in [0..50, 50..100] {
///     let exposures = Planes::new(64, stage.exposure_rows(band.clone()))?;
///     let amounts = stage.amounts_in(&mut buffers, &exposures, None, band.clone(), &|e: [f32; 3]| e)?;
///     assert_eq!(amounts.rows(), band);
/// }
/// # Ok::<(), onelight_spatial::Error>(())
/// ```
#[derive(Debug)]
pub struct StageBuffers {
    developed: Planes,
    finished: Planes,
}

impl Default for StageBuffers {
    fn default() -> Self {
        Self { developed: Planes::none(), finished: Planes::none() }
    }
}

impl SpatialStage {
    /// Without any effect: development alone.
    #[must_use]
    pub fn new(frame: Frame) -> Self {
        Self { frame, blurs: None, halation: None, grain: None, level: Level::new() }
    }

    /// With scatter and adjacency.
    #[must_use]
    pub fn with_sharpness(self, sharpness: &Sharpness) -> Self {
        Self { blurs: Some(sharpness.in_pixels(&self.frame)), ..self }
    }

    /// With halation, which needs the whole picture's exposures first ([`SpatialStage::halation_cells`]).
    #[must_use]
    pub fn with_halation(self, halation: Halation) -> Self {
        Self { halation: Some(halation), ..self }
    }

    /// With grain.
    ///
    /// # Errors
    /// If it was made for pixels of another size than this frame's.
    pub fn with_grain(self, grain: Grain) -> Result<Self, Error> {
        let (found, expected) = (grain.pitch(), self.frame.pitch());
        if found != expected {
            let um = |pitch: Pitch| format!("pixels of {} by {} um", pitch.x_um(), pitch.y_um());
            return Err(ErrorKind::Planes { what: "grain", found: um(found), expected: um(expected) }.into());
        }
        Ok(Self { grain: Some(grain), ..self })
    }

    /// The same for another picture of the same size and place in its frame: the next of a sequence.
    #[must_use]
    pub fn numbered(self, number: u32) -> Self {
        Self { frame: self.frame.numbered(number), ..self }
    }

    /// The picture.
    #[must_use]
    pub fn frame(&self) -> &Frame {
        &self.frame
    }

    pub(crate) fn blurs(&self) -> Option<&[LayerBlurs; 3]> {
        self.blurs.as_ref()
    }

    pub(crate) fn halation(&self) -> Option<&Halation> {
        self.halation.as_ref()
    }

    pub(crate) fn grain(&self) -> Option<&Grain> {
        self.grain.as_ref()
    }

    /// How far light scatters, in pixels along both axes.
    pub(crate) fn scatter_reach(&self) -> [usize; 2] {
        let reach = |axis: usize| self.layers().filter_map(|l| l.scatter.as_ref()).map(|s| s.reach(axis)).max();
        [0, 1].map(|axis| reach(axis).unwrap_or(0))
    }

    /// Sharpness alone, for a part of the picture.
    pub(crate) fn for_part(&self, part: Frame) -> Self {
        let blurs = self.blurs.as_ref().map(|blurs| blurs.each_ref().map(|layer| layer.for_part(&part)));
        Self { blurs, ..Self::new(part) }
    }

    /// What must be fed with all exposures before [`SpatialStage::amounts`]; `None` without halation.
    ///
    /// # Errors
    /// If the picture has too many cells.
    pub fn halation_cells(&self) -> Result<Option<HalationCells>, Error> {
        self.halation.as_ref().map(|halation| HalationCells::new(halation, &self.frame)).transpose()
    }

    /// The rows of exposures that the amounts of these rows depend on. Rows beyond the picture count as its last, none as one.
    #[must_use]
    pub fn exposure_rows(&self, rows: Range<usize>) -> Range<usize> {
        let start = rows.start.min(self.frame.height() - 1);
        let rows = start..rows.end.clamp(start + 1, self.frame.height());
        self.widened(self.amount_rows(rows), self.scatter_reach()[1])
    }

    /// The rows of developed amounts that the amounts of these rows depend on.
    pub(crate) fn amount_rows(&self, rows: Range<usize>) -> Range<usize> {
        let mut all = rows.clone();
        for adjacency in self.layers().filter_map(|layer| layer.adjacency.as_ref()) {
            let needed = match &adjacency.blur {
                AdjacencyBlur::Pixels([_, y]) => self.widened(rows.clone(), y.len()),
                AdjacencyBlur::Cells([_, y], [_, taps]) => {
                    let cells = needed_cells(y, &rows, taps.len());
                    y.pixels_of(cells.start).start..y.pixels_of(cells.end - 1).end
                }
            };
            all = all.start.min(needed.start)..all.end.max(needed.end);
        }
        all
    }

    fn widened(&self, rows: Range<usize>, margin: usize) -> Range<usize> {
        rows.start.saturating_sub(margin)..(rows.end + margin).min(self.frame.height())
    }

    fn layers(&self) -> impl Iterator<Item = &LayerBlurs> {
        self.blurs.iter().flatten()
    }

    /// The amounts of dye of `rows`. `exposures` holds at least the rows of [`SpatialStage::exposure_rows`]; `halo` is what
    /// [`SpatialStage::halation_cells`] came to, `None` without halation.
    ///
    /// # Errors
    /// If `rows` are none or not of the picture, exposures are missing, or the halo is missing or not wanted.
    pub fn amounts(
        &self,
        exposures: &Planes,
        halo: Option<&HaloField>,
        rows: Range<usize>,
        development: &impl Development,
    ) -> Result<Planes, Error> {
        let mut buffers = StageBuffers::default();
        self.amounts_in(&mut buffers, exposures, halo, rows, development)?;
        Ok(buffers.finished)
    }

    /// The same in memory that is used again: for band after band.
    ///
    /// # Errors
    /// As [`SpatialStage::amounts`].
    pub fn amounts_in<'a>(
        &self,
        buffers: &'a mut StageBuffers,
        exposures: &Planes,
        halo: Option<&HaloField>,
        rows: Range<usize>,
        development: &impl Development,
    ) -> Result<&'a Planes, Error> {
        self.check(exposures, halo, &rows)?;
        let StageBuffers { developed, finished } = buffers;
        developed.reset(self.frame.width(), self.amount_rows(rows.clone()))?;
        let all = developed.rows();
        self.develop(exposures, halo, developed, all, development);
        if self.grain.is_none() && self.layers().all(|layer| layer.adjacency.is_none()) {
            std::mem::swap(developed, finished);
            return Ok(finished);
        }
        self.finish(developed, finished, rows)?;
        Ok(finished)
    }

    /// Adjacency and grain: the amounts of `rows` from developed ones, of which those of [`SpatialStage::amount_rows`] are there.
    pub(crate) fn finish(&self, developed: &Planes, finished: &mut Planes, rows: Range<usize>) -> Result<(), Error> {
        let cells: Vec<_> = (0..3).into_par_iter().map(|layer| self.adjacency_cells(developed, layer, &rows)).collect();
        finished.reset(self.frame.width(), rows.clone())?;
        self.for_each_strip(finished, rows, |tile, scratch, strip| {
            for (layer, cells) in cells.iter().enumerate() {
                let mut out: Vec<&mut [f32]> = strip.iter_mut().map(|rows| &mut *rows[layer]).collect();
                let adjacency = self.blurs.as_ref().and_then(|blurs| blurs[layer].adjacency.as_ref());
                adjacency_layer(self.level, (developed, layer), tile, adjacency, cells.as_ref(), scratch, &mut out);
            }
            if let Some(grain) = &self.grain {
                add_grain(self.level, grain, self.frame.number(), tile, self.frame.offset(), scratch, strip);
            }
        });
        Ok(())
    }

    fn check(&self, exposures: &Planes, halo: Option<&HaloField>, rows: &Range<usize>) -> Result<(), Error> {
        let refuse = |what, found: String, expected: String| Err(ErrorKind::Planes { what, found, expected }.into());
        if rows.is_empty() || rows.end > self.frame.height() {
            let found = format!("{} to {}", rows.start, rows.end);
            return refuse("rows", found, format!("some of 0 to {}", self.frame.height()));
        }
        let (needed, given) = (self.exposure_rows(rows.clone()), exposures.rows());
        if given.start > needed.start || given.end < needed.end || exposures.width() != self.frame.width() {
            let found = format!("rows {} to {} of {} pixels", given.start, given.end, exposures.width());
            let expected = format!("rows {} to {} of {} pixels", needed.start, needed.end, self.frame.width());
            return refuse("exposures", found, expected);
        }
        self.check_halo(halo)
    }

    pub(crate) fn check_halo(&self, halo: Option<&HaloField>) -> Result<(), Error> {
        let refuse = |what, found: String, expected: String| Err(ErrorKind::Planes { what, found, expected }.into());
        match (&self.halation, halo) {
            (Some(_), None) => refuse("halo", "none".to_owned(), "that of the whole picture's exposures".to_owned()),
            (None, Some(_)) => refuse("halo", "one".to_owned(), "none without halation".to_owned()),
            (Some(_), Some(halo)) if !halo.is_of(&self.frame) => refuse(
                "halo",
                "that of another picture".to_owned(),
                "that of this one's size, pitch and offset".to_owned(),
            ),
            _ => Ok(()),
        }
    }

    /// Some rows of `developed` after scatter, halation and development.
    pub(crate) fn develop(
        &self,
        exposures: &Planes,
        halo: Option<&HaloField>,
        developed: &mut Planes,
        rows: Range<usize>,
        development: &impl Development,
    ) {
        self.for_each_strip(developed, rows, |tile, scratch, strip| {
            for layer in 0..3 {
                let mut out: Vec<&mut [f32]> = strip.iter_mut().map(|rows| &mut *rows[layer]).collect();
                let scatter = self.blurs.as_ref().and_then(|blurs| blurs[layer].scatter.as_ref());
                expose_layer(self.level, (exposures, layer), tile, scatter, halo, scratch, &mut out);
            }
            for rows in strip {
                development.develop(rows.each_mut().map(|row| &mut **row));
            }
        });
    }

    /// The blurred cells of a layer that the amounts of `rows` need, if its adjacency is made in cells.
    fn adjacency_cells(&self, amounts: &Planes, layer: usize, rows: &Range<usize>) -> Option<(CellRows, Expansion)> {
        let adjacency = self.blurs.as_ref()?[layer].adjacency.as_ref()?;
        let AdjacencyBlur::Cells([x, y], [x_taps, y_taps]) = &adjacency.blur else { return None };
        let mut cells = CellRows::new(x.count, needed_cells(y, rows, y_taps.len()));
        let mut sums = CellSums::new(amounts.width());
        for cell in cells.rows.clone() {
            for row in y.pixels_of(cell) {
                sums.add(amounts.layer_row(layer, row));
            }
            sums.take(x, cells.row_mut(cell));
        }
        let blurred = cells.blurred(self.level, x_taps, y_taps, needed_cells(y, rows, 0));
        Some((blurred, Expansion::new(x)))
    }

    /// Hands the tiles of all strips of some rows to `work`, strips on the threads of the current pool.
    fn for_each_strip(
        &self,
        planes: &mut Planes,
        rows: Range<usize>,
        work: impl Fn(Tile, &mut Scratch, &mut [[&mut [f32]; 3]]) + Sync,
    ) {
        let (width, height, first) = (planes.width(), self.frame.height(), rows.start);
        let [red, green, blue] = planes.layers_of_mut(rows);
        let strips = red.par_chunks_mut(STRIP * width).zip(green.par_chunks_mut(STRIP * width));
        let strips = strips.zip(blue.par_chunks_mut(STRIP * width)).enumerate();
        strips.for_each_init(Scratch::default, |scratch, (index, ((red, green), blue))| {
            let rows = red.len() / width;
            for x in (0..width).step_by(TILE) {
                let tile = Tile { x, width: TILE.min(width - x), y: first + index * STRIP, rows, height };
                let columns = x..x + tile.width;
                let rows =
                    red.chunks_exact_mut(width).zip(green.chunks_exact_mut(width)).zip(blue.chunks_exact_mut(width));
                let mut strip: Vec<[&mut [f32]; 3]> = rows
                    .map(|((r, g), b)| [&mut r[columns.clone()], &mut g[columns.clone()], &mut b[columns.clone()]])
                    .collect();
                work(tile, scratch, &mut strip);
            }
        });
    }
}

/// The rows of cells between which the pixels of `rows` lie, and `margin` more on either side.
fn needed_cells(axis: &crate::cells::CellAxis, rows: &Range<usize>, margin: usize) -> Range<usize> {
    let (first, last) = (axis.between(rows.start).0, axis.between(rows.end - 1).1);
    first.saturating_sub(margin)..(last + 1 + margin).min(axis.count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::Pitch;

    /// All vector instructions of this machine.
    fn levels() -> Vec<Level> {
        let best = Level::new();
        #[cfg(target_arch = "x86_64")]
        {
            let mut levels: Vec<Level> = best.as_sse2().map(Level::Sse2).into_iter().collect();
            levels.extend(best.as_sse4_2().map(Level::Sse4_2));
            levels.extend(best.as_avx2().map(Level::Avx2));
            levels.push(best);
            levels
        }
        #[cfg(not(target_arch = "x86_64"))]
        vec![best]
    }

    #[test]
    fn vectors_of_any_length_give_the_same_bytes() {
        let f = onelight_stocks::find("kodak-5219").unwrap();
        let stock = onelight_film::Stock::parse(&onelight_film::SheetText {
            id: f.id,
            stock_toml: f.stock_toml,
            sensitivity_csv: f.sensitivity_csv,
            characteristic_csv: f.characteristic_csv,
            dye_density_csv: f.dye_density_csv,
        });
        let stock = stock.unwrap().with_figures(f.mtf_csv, f.granularity_csv).unwrap();
        let frame = Frame::new([333, 70], Pitch::new(6.1, 6.1).unwrap()).unwrap();
        let granularity = crate::AmountGranularity::of_stock(&stock).unwrap();
        let stage = SpatialStage::new(frame)
            .with_sharpness(&Sharpness::of_stock(&stock).unwrap())
            .with_grain(Grain::new(granularity, frame.pitch(), crate::GrainSettings::default()).unwrap())
            .unwrap()
            .with_halation(Halation::new(crate::HalationSettings::default()).unwrap());
        let mut exposures = Planes::new(333, 0..70).unwrap();
        for y in 0..70 {
            for row in exposures.row_mut(y) {
                row.iter_mut().enumerate().for_each(|(x, e)| *e = ((x * 13 + y * 29) % 61) as f32 / 17.0);
            }
        }
        let mut cells = stage.halation_cells().unwrap().unwrap();
        cells.add(&exposures).unwrap();
        let halo = cells.finish().unwrap();
        let amounts = |level| {
            let stage = SpatialStage { level, ..stage.clone() };
            stage.amounts(&exposures, Some(&halo), 0..70, &|e: [f32; 3]| e.map(f32::sqrt)).unwrap()
        };
        let best = amounts(Level::new());
        assert!(levels().into_iter().all(|level| amounts(level) == best));
    }
}
