use std::ops::Range;

use crate::chain::Development;
use crate::error::{Error, ErrorKind};
use crate::halation::HaloField;
use crate::planes::Planes;
use crate::stage::SpatialStage;

/// A stage on its way down one picture: exposures go in as they are read, amounts come out as soon as the rows about them are there.
///
/// Each row is scattered and developed once, whatever the bands; the bytes are those of [`SpatialStage::amounts`]. Held are the rows
/// between what came in and what goes out.
///
/// ```
/// use onelight_spatial::{Frame, Pitch, SpatialStage, StageRun};
/// use rayon::prelude::*;
/// let stage = SpatialStage::new(Frame::new([64, 100], Pitch::new(12.0, 12.0)?)?);
/// let mut run = StageRun::new(stage, None)?;
/// let mut finished = 0;
/// for _ in 0..2 {
///     let (planes, rows) = run.add(50)?;
///     planes.par_rows_mut(rows).for_each(|layers| layers.into_iter().for_each(|layer| layer.fill(0.25)));
///     let ready = run.ready();
///     let amounts = run.amounts(ready, &|e: [f32; 3]| e.map(f32::sqrt))?;
///     assert_eq!(amounts.row(finished)[2][63], 0.5);
///     finished = amounts.rows().end;
/// }
/// assert_eq!(finished, 100);
/// # Ok::<(), onelight_spatial::Error>(())
/// ```
#[derive(Debug)]
pub struct StageRun {
    stage: SpatialStage,
    halo: Option<HaloField>,
    exposures: Planes,
    developed: Planes,
    finished: Planes,
    /// Rows that came in, and rows that went out.
    came_in: usize,
    went_out: usize,
}

impl StageRun {
    /// At the top of a picture; `halo` is what [`SpatialStage::halation_cells`] came to, `None` without halation.
    ///
    /// # Errors
    /// If the halo is missing, not wanted, or of another picture.
    pub fn new(stage: SpatialStage, halo: Option<HaloField>) -> Result<Self, Error> {
        stage.check_halo(halo.as_ref())?;
        let [exposures, developed, finished] = std::array::from_fn(|_| Planes::none());
        Ok(Self { stage, halo, exposures, developed, finished, came_in: 0, went_out: 0 })
    }

    /// What it runs.
    #[must_use]
    pub fn stage(&self) -> &SpatialStage {
        &self.stage
    }

    /// Planes with room for the next rows of exposures, and which rows these are: all of them are to be filled.
    ///
    /// # Errors
    /// If they are none, more than the picture has left, or too many to hold.
    pub fn add(&mut self, rows: usize) -> Result<(&mut Planes, Range<usize>), Error> {
        let left = self.stage.frame().height() - self.came_in;
        if !(1..=left).contains(&rows) {
            let (found, expected) = (format!("{rows} rows"), format!("1 to {left}, which the picture has left"));
            return Err(ErrorKind::Planes { what: "exposures", found, expected }.into());
        }
        let first = self.developed.rows().end.saturating_sub(self.stage.scatter_reach()[1]).min(self.came_in);
        let coming = self.came_in..self.came_in + rows;
        self.exposures.move_on(self.stage.frame().width(), first..coming.end)?;
        self.came_in = coming.end;
        Ok((&mut self.exposures, coming))
    }

    /// How many of the next rows can be finished with the exposures that are there.
    #[must_use]
    pub fn ready(&self) -> usize {
        let (height, start) = (self.stage.frame().height(), self.went_out);
        let can_be = |rows: usize| self.stage.exposure_rows(start..start + rows).end <= self.came_in;
        let (mut ready, mut too_many) = (0, height - start + 1);
        while too_many - ready > 1 {
            let middle = ready + (too_many - ready) / 2;
            if can_be(middle) { ready = middle } else { too_many = middle }
        }
        ready
    }

    /// The amounts of dye of the next rows, at most as many as are [ready](StageRun::ready).
    ///
    /// # Errors
    /// If they are none, or not ready.
    pub fn amounts(&mut self, rows: usize, development: &impl Development) -> Result<&Planes, Error> {
        let ready = self.ready();
        if !(1..=ready).contains(&rows) {
            let (found, expected) = (format!("{rows} rows"), format!("1 to {ready}, which are ready"));
            return Err(ErrorKind::Planes { what: "amounts", found, expected }.into());
        }
        let rows = self.went_out..self.went_out + rows;
        let needed = self.stage.amount_rows(rows.clone());
        let new = self.developed.rows().end.max(needed.start)..needed.end.max(self.developed.rows().end);
        self.developed.move_on(self.stage.frame().width(), needed.start..new.end)?;
        if !new.is_empty() {
            self.stage.develop(&self.exposures, self.halo.as_ref(), &mut self.developed, new, development);
        }
        self.went_out = rows.end;
        self.stage.finish(&self.developed, &mut self.finished, rows)?;
        Ok(&self.finished)
    }
}
