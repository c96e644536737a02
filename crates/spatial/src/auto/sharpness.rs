use std::ops::Range;

use rayon::prelude::*;

use super::{Decision, Effect};
use crate::chain::{Development, Finish};
use crate::error::{Error, ErrorKind};
use crate::frame::Frame;
use crate::planes::Planes;
use crate::sharpness::Sharpness;
use crate::stage::SpatialStage;

/// Side in pixels of a block.
const BLOCK: usize = 8;
/// Sides of the squares that a block stands for: the first of these that gives [`ENOUGH_BLOCKS`], or the last.
const SQUARES: [usize; 3] = [64, 32, 16];
const ENOUGH_BLOCKS: usize = 256;
/// What is far away changes little and costs much: pixels about a block beyond those that light scatters from.
const MARGIN: usize = 12;
/// The difference that a hundredth of the pixels must reach.
const LEAST_DIFFERENCE: f64 = 0.35;

/// Looks whether sharpness can be seen: through the whole chain, with and without it, on one block of 8 by 8 pixels in every 64 by 64;
/// in every 32 by 32 or 16 by 16 of pictures below a million pixels.
///
/// It is left out where 99 of 100 pixels change by less than 0.35 dE.
///
/// ```
/// # use onelight_film::{SheetText, Stock};
/// # use onelight_spatial::{FilmFormat, Frame, Planes, Sharpness, SharpnessProbe, Verdict};
/// # struct Screen;
/// # impl onelight_spatial::Finish for Screen {
/// #     fn display_linear(&self, amounts: [f64; 3]) -> [f64; 3] { amounts.map(|a| 10f64.powf(-a)) }
/// #     fn lab(&self, display_linear: [f64; 3]) -> [f64; 3] { display_linear.map(|v| 116.0 * v.cbrt() - 16.0) }
/// #     fn difference(&self, a: [f64; 3], b: [f64; 3]) -> f64 { (self.lab(a)[0] - self.lab(b)[0]).abs() }
/// # }
/// # let f = onelight_stocks::find("kodak-5207").ok_or("no such stock")?;
/// # let stock = Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #     characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?
/// #     .with_figures(f.mtf_csv, f.granularity_csv)?;
/// let frame = Frame::new([256, 128], FilmFormat::Super35.pitch(2048, 1.0)?)?;
/// let mut probe = SharpnessProbe::new(&Sharpness::of_stock(&stock)?, &frame);
/// for rows in probe.exposure_rows() {
///     probe.add(&Planes::new(256, rows)?, &|e: [f32; 3]| e, &Screen)?;
/// }
/// assert_eq!(probe.finish()?.verdict(), Verdict::NotVisible, "a black frame");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SharpnessProbe {
    stage: SpatialStage,
    /// Side of the square that each block stands for.
    square: usize,
    /// Rows of blocks that were looked at.
    looked_at: usize,
    margin: [usize; 2],
    differences: Vec<f64>,
}

impl SharpnessProbe {
    /// For a picture.
    #[must_use]
    pub fn new(sharpness: &Sharpness, frame: &Frame) -> Self {
        let stage = SpatialStage::new(*frame).with_sharpness(sharpness);
        let margin = stage.scatter_reach().map(|reach| reach + MARGIN);
        let enough = |side: &&usize| frame.width().saturating_mul(frame.height()) / (*side * *side) >= ENOUGH_BLOCKS;
        let square = *SQUARES.iter().find(enough).unwrap_or(&SQUARES[2]);
        Self { stage, square, looked_at: 0, margin, differences: Vec::new() }
    }

    /// The rows of exposures of each row of blocks, from top to bottom: what [`SharpnessProbe::add`] wants.
    #[must_use]
    pub fn exposure_rows(&self) -> Vec<Range<usize>> {
        self.rows_of_blocks().into_iter().map(|rows| self.widened(rows)).collect()
    }

    /// Looks at the next row of blocks.
    ///
    /// # Errors
    /// If these are not its exposures.
    pub fn add(
        &mut self,
        exposures: &Planes,
        development: &impl Development,
        finish: &impl Finish,
    ) -> Result<(), Error> {
        let frame = *self.stage.frame();
        let rows = self.rows_of_blocks().get(self.looked_at).cloned();
        let given = exposures.rows();
        let is_next = |rows: &Range<usize>| self.widened(rows.clone()) == given && exposures.width() == frame.width();
        let Some(rows) = rows.filter(is_next) else {
            let found = format!("rows {} to {} of {} pixels", given.start, given.end, exposures.width());
            let expected = format!("the next of the rows that `exposure_rows` lists, of {} pixels", frame.width());
            return Err(ErrorKind::Planes { what: "exposures for sharpness", found, expected }.into());
        };
        self.looked_at += 1;
        let columns = blocks(self.square, frame.offset()[0], frame.width());
        let look = |columns: &Range<usize>| self.block(exposures, columns.clone(), rows.clone(), development, finish);
        let found: Vec<Vec<f64>> = columns.par_iter().map(look).collect::<Result<_, Error>>()?;
        self.differences.extend(found.into_iter().flatten());
        Ok(())
    }

    /// The decision, once all rows of blocks were looked at.
    ///
    /// # Errors
    /// If rows are missing.
    pub fn finish(mut self) -> Result<Decision, Error> {
        let all = self.rows_of_blocks().len();
        if self.looked_at != all {
            let (found, expected) = (format!("{} rows of blocks", self.looked_at), format!("all {all}"));
            return Err(ErrorKind::Planes { what: "exposures for sharpness", found, expected }.into());
        }
        self.differences.sort_by(f64::total_cmp);
        let rank = (0.99 * self.differences.len() as f64) as usize;
        let p99 = self.differences.get(rank).copied().unwrap_or(0.0);
        let measured = format!("{p99:.2} dE for 1 pixel in 100");
        Ok(Decision::new(Effect::Sharpness, p99 >= LEAST_DIFFERENCE, &measured, self.stage.frame()))
    }

    fn rows_of_blocks(&self) -> Vec<Range<usize>> {
        blocks(self.square, self.stage.frame().offset()[1], self.stage.frame().height())
    }

    fn widened(&self, rows: Range<usize>) -> Range<usize> {
        within(rows, self.margin[1], self.stage.frame().height())
    }

    /// The differences of a block's pixels.
    fn block(
        &self,
        exposures: &Planes,
        columns: Range<usize>,
        rows: Range<usize>,
        development: &impl Development,
        finish: &impl Finish,
    ) -> Result<Vec<f64>, Error> {
        let frame = self.stage.frame();
        let across = within(columns.clone(), self.margin[0], frame.width());
        let down = exposures.rows();
        let [x, y] = frame.offset();
        let window = Frame::new([across.len(), down.len()], frame.pitch())?
            .at([x.wrapping_add(across.start as i32), y.wrapping_add(down.start as i32)]);
        let mut part = Planes::new(across.len(), 0..down.len())?;
        for row in 0..down.len() {
            for (part, whole) in part.row_mut(row).into_iter().zip(exposures.row(row + down.start)) {
                part.copy_from_slice(&whole[across.clone()]);
            }
        }
        let [with, without] = [self.stage.for_part(window), SpatialStage::new(window)];
        let inside = rows.start - down.start..rows.end - down.start;
        let with = with.amounts(&part, None, inside.clone(), development)?;
        let without = without.amounts(&part, None, inside.clone(), development)?;
        let pixels = |planes: &Planes| {
            let pixel = |x: usize, y: usize| planes.row(y).map(|layer| f64::from(layer[x - across.start]));
            let row = |y: usize| columns.clone().map(move |x| pixel(x, y));
            finish.display_linear_of(&inside.clone().flat_map(row).collect::<Vec<_>>())
        };
        let shown = pixels(&with).into_iter().zip(pixels(&without));
        Ok(shown.map(|(with, without)| finish.difference(with, without)).collect())
    }
}

/// Where the blocks of one axis lie in a picture, counted from the frame's origin; one in the middle of a picture that has none.
fn blocks(square: usize, offset: i32, pixels: usize) -> Vec<Range<usize>> {
    let first = (square as i64 - BLOCK as i64) / 2 - i64::from(offset).rem_euclid(square as i64);
    let starts = (0..).map(|i| first + i * square as i64).take_while(|start| start + BLOCK as i64 <= pixels as i64);
    let found: Vec<Range<usize>> =
        starts.filter(|start| *start >= 0).map(|start| start as usize..start as usize + BLOCK).collect();
    if found.is_empty() {
        let start = pixels.saturating_sub(BLOCK) / 2;
        return std::iter::once(start..(start + BLOCK).min(pixels)).collect();
    }
    found
}

fn within(range: Range<usize>, margin: usize, count: usize) -> Range<usize> {
    range.start.saturating_sub(margin)..(range.end + margin).min(count)
}
