use std::ops::Range;

use rayon::prelude::*;

use super::{Decision, Effect};
use crate::chain::{Development, Finish};
use crate::error::Error;
use crate::frame::Frame;
use crate::halation::{Halation, HalationCells};
use crate::planes::{Planes, believed};

/// Cells in um. Coarser ones take the light of a bright pixel for its dark neighbour's and run halation needlessly.
const CELL_UM: f64 = 60.0;
/// Differences below which halation is not seen.
const LEAST_DIFFERENCE: f64 = 0.5;
/// Exposures that halation raises by less than this share are not looked at: a hundredth of what the difference needs.
const LEAST_GAIN: f32 = 1e-4;

/// Looks whether halation can be seen: in cells of 60 um, on the darkest pixel of each, where it adds most.
///
/// It is left out where no cell changes by 0.5 dE. The example at [`Decision`] uses one.
#[derive(Debug)]
pub struct HalationProbe {
    cells: HalationCells,
    frame: Frame,
    /// For each cell, the exposures of the pixel whose sum is least.
    darkest: Vec<[f32; 3]>,
}

impl HalationProbe {
    /// For a picture.
    ///
    /// # Errors
    /// As [`HalationCells::new`].
    pub fn new(halation: &Halation, frame: &Frame) -> Result<Self, Error> {
        let cells = HalationCells::with_cells(halation, frame, CELL_UM)?;
        let [x, y] = cells.axes();
        Ok(Self { darkest: vec![[f32::INFINITY; 3]; x.count * y.count], cells, frame: *frame })
    }

    /// Adds the next rows of the picture's exposures, from top to bottom, each row once.
    ///
    /// # Errors
    /// As [`HalationCells::add`].
    pub fn add(&mut self, exposures: &Planes) -> Result<(), Error> {
        self.add_rows(exposures, exposures.rows())
    }

    /// Adds some of the rows of these planes.
    pub(crate) fn add_rows(&mut self, exposures: &Planes, rows: Range<usize>) -> Result<(), Error> {
        self.cells.add_rows(exposures, rows.clone())?;
        let [x, y] = self.cells.axes();
        for row in rows {
            let [red, green, blue] = exposures.row(row);
            let start = y.cell_of(row) * x.count;
            for (cell, darkest) in self.darkest[start..start + x.count].iter_mut().enumerate() {
                for i in x.pixels_of(cell) {
                    let pixel = [red[i], green[i], blue[i]].map(believed);
                    if pixel.iter().sum::<f32>() < darkest.iter().sum::<f32>() {
                        *darkest = pixel;
                    }
                }
            }
        }
        Ok(())
    }

    /// The decision, once all rows are there.
    ///
    /// # Errors
    /// If rows are missing.
    pub fn finish(self, development: &impl Development, finish: &impl Finish) -> Result<Decision, Error> {
        let [x, _] = self.cells.axes();
        let field = self.cells.finish()?;
        let raised = |(index, exposure): (usize, &[f32; 3])| {
            let cell = [index % x.count, index / x.count];
            let raised: [f32; 3] = std::array::from_fn(|layer| field.exposed_in_cell(layer, cell, exposure[layer]));
            let gains = |(e, raised): (&f32, &f32)| (raised - e).abs() > LEAST_GAIN * e;
            exposure.iter().zip(&raised).any(gains).then_some([*exposure, raised])
        };
        let rows = self.darkest.par_chunks(x.count).enumerate().map(|(row, darkest)| {
            let first = row * x.count;
            let pairs: Vec<[[f32; 3]; 2]> = (first..).zip(darkest).filter_map(raised).collect();
            let side = |i: usize| pairs.iter().map(|pair| pair[i]).collect::<Vec<[f32; 3]>>();
            let [without, with] = [side(0), side(1)].map(|exposures| shown(&exposures, development, finish));
            without.into_iter().zip(with).map(|(a, b)| finish.difference(a, b)).fold(0.0, f64::max)
        });
        let largest = rows.reduce(|| 0.0, f64::max);
        let measured = format!("at most {largest:.2} dE");
        Ok(Decision::new(Effect::Halation, largest >= LEAST_DIFFERENCE, &measured, &self.frame))
    }
}

/// Display-linear colours of exposures.
fn shown(exposures: &[[f32; 3]], development: &impl Development, finish: &impl Finish) -> Vec<[f64; 3]> {
    let [mut red, mut green, mut blue] =
        [0, 1, 2].map(|layer| exposures.iter().map(|e| e[layer]).collect::<Vec<f32>>());
    development.develop([&mut red, &mut green, &mut blue]);
    let amounts = red.iter().zip(&green).zip(&blue).map(|((r, g), b)| [*r, *g, *b].map(f64::from));
    finish.display_linear_of(&amounts.collect::<Vec<_>>())
}
