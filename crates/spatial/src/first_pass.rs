use std::collections::VecDeque;
use std::ops::Range;

use crate::auto::{Decision, HalationProbe, SharpnessProbe};
use crate::chain::{Development, Finish};
use crate::error::{Error, ErrorKind};
use crate::frame::Frame;
use crate::halation::{Halation, HalationCells, HaloField};
use crate::planes::Planes;
use crate::sharpness::Sharpness;

/// What must be known of a whole picture before its first row can be finished: whether effects can be seen in it, and the light that
/// halation returns. Exposures go in from top to bottom as they are read.
///
/// ```
/// use onelight_spatial::{FilmFormat, FirstPass, Frame, Halation, HalationSettings};
/// # struct Screen;
/// # impl onelight_spatial::Finish for Screen {
/// #     fn display_linear(&self, amounts: [f64; 3]) -> [f64; 3] { amounts.map(|a| 10f64.powf(-a)) }
/// #     fn lab(&self, display_linear: [f64; 3]) -> [f64; 3] { display_linear.map(|v| 116.0 * v.cbrt() - 16.0) }
/// #     fn difference(&self, a: [f64; 3], b: [f64; 3]) -> f64 { (self.lab(a)[0] - self.lab(b)[0]).abs() }
/// # }
/// let frame = Frame::new([80, 60], FilmFormat::Super35.pitch(2048, 1.0)?)?;
/// let halation = Halation::new(HalationSettings::default())?;
/// let mut pass = FirstPass::new(frame).looking_for_halation(&halation)?.gathering_halation(&halation)?;
/// for _ in 0..3 {
///     let (planes, rows) = pass.add(20)?;
///     rows.for_each(|y| planes.row_mut(y).into_iter().for_each(|layer| layer.fill(0.1)));
///     pass.look(&|e: [f32; 3]| e, &Screen)?;
/// }
/// let seen = pass.finish(&|e: [f32; 3]| e, &Screen)?;
/// assert!(seen.halation.is_some_and(|decision| decision.to_string().ends_with("not visible, skipped")));
/// assert!(seen.halo.is_some());
/// # Ok::<(), onelight_spatial::Error>(())
/// ```
#[derive(Debug)]
pub struct FirstPass {
    frame: Frame,
    planes: Planes,
    came_in: usize,
    looked_at: usize,
    sharpness: Option<SharpnessProbe>,
    /// Rows of the blocks that the sharpness probe has still to see.
    blocks: VecDeque<Range<usize>>,
    halation: Option<HalationProbe>,
    cells: Option<HalationCells>,
}

/// What a [`FirstPass`] came to; `None` for what it did not look for.
#[derive(Debug)]
pub struct FirstPassResult {
    /// Whether sharpness can be seen.
    pub sharpness: Option<Decision>,
    /// Whether halation can be seen.
    pub halation: Option<Decision>,
    /// The light that halation returns.
    pub halo: Option<HaloField>,
}

impl FirstPass {
    /// Looking for nothing yet.
    #[must_use]
    pub fn new(frame: Frame) -> Self {
        Self {
            frame,
            planes: Planes::none(),
            came_in: 0,
            looked_at: 0,
            sharpness: None,
            blocks: VecDeque::new(),
            halation: None,
            cells: None,
        }
    }

    /// Looking whether sharpness can be seen.
    #[must_use]
    pub fn looking_for_sharpness(self, sharpness: &Sharpness) -> Self {
        let probe = SharpnessProbe::new(sharpness, &self.frame);
        Self { blocks: probe.exposure_rows().into(), sharpness: Some(probe), ..self }
    }

    /// Looking whether halation can be seen.
    ///
    /// # Errors
    /// If the picture has too many cells.
    pub fn looking_for_halation(self, halation: &Halation) -> Result<Self, Error> {
        Ok(Self { halation: Some(HalationProbe::new(halation, &self.frame)?), ..self })
    }

    /// Gathering the light that halation returns.
    ///
    /// # Errors
    /// If the picture has too many cells.
    pub fn gathering_halation(self, halation: &Halation) -> Result<Self, Error> {
        Ok(Self { cells: Some(HalationCells::new(halation, &self.frame)?), ..self })
    }

    /// Whether it has to see the picture at all.
    #[must_use]
    pub fn needs_picture(&self) -> bool {
        self.sharpness.is_some() || self.halation.is_some() || self.cells.is_some()
    }

    /// Planes with room for the next rows of exposures, and which rows these are: all of them are to be filled before
    /// [`FirstPass::look`].
    ///
    /// # Errors
    /// If they are none, more than the picture has left, or too many to hold.
    pub fn add(&mut self, rows: usize) -> Result<(&mut Planes, Range<usize>), Error> {
        let left = self.frame.height() - self.came_in;
        if !(1..=left).contains(&rows) {
            let (found, expected) = (format!("{rows} rows"), format!("1 to {left}, which the picture has left"));
            return Err(ErrorKind::Planes { what: "exposures", found, expected }.into());
        }
        let coming = self.came_in..self.came_in + rows;
        let first = self.blocks.front().map_or(coming.start, |rows| rows.start).min(self.looked_at);
        self.planes.move_on(self.frame.width(), first..coming.end)?;
        self.came_in = coming.end;
        Ok((&mut self.planes, coming))
    }

    /// Looks at the rows that were filled.
    ///
    /// # Errors
    /// None, if no row was left out.
    pub fn look(&mut self, development: &impl Development, finish: &impl Finish) -> Result<(), Error> {
        let new = self.looked_at..self.came_in;
        if let Some(cells) = &mut self.cells {
            cells.add_rows(&self.planes, new.clone())?;
        }
        if let Some(halation) = &mut self.halation {
            halation.add_rows(&self.planes, new)?;
        }
        if let Some(sharpness) = &mut self.sharpness {
            while let Some(rows) = self.blocks.pop_front_if(|rows| rows.end <= self.came_in) {
                sharpness.add(&self.planes.part(rows)?, development, finish)?;
            }
        }
        self.looked_at = self.came_in;
        Ok(())
    }

    /// What it came to, once all rows were looked at.
    ///
    /// # Errors
    /// If rows are missing.
    pub fn finish(self, development: &impl Development, finish: &impl Finish) -> Result<FirstPassResult, Error> {
        Ok(FirstPassResult {
            sharpness: self.sharpness.map(SharpnessProbe::finish).transpose()?,
            halation: self.halation.map(|probe| probe.finish(development, finish)).transpose()?,
            halo: self.cells.map(HalationCells::finish).transpose()?,
        })
    }
}
