use onelight_spatial::{Decision, Effect, FirstPass, Frame, Planes, SpatialStage, StageRun, Verdict, grain_decision};
use rayon::prelude::*;

use super::{FilmEffects, FilmSteps};
use crate::error::{Error, ErrorKind};
use crate::process::EffectChoice;

/// Greys whose grain is looked at, in halves of a stop about mid grey.
const HALVES: std::ops::RangeInclusive<i32> = -4..=4;
/// Rows for each thread that go through all steps together: what lies between the steps stays in the caches, and so few are not divided
/// further.
const ROWS: usize = 64;

/// The first look at a picture: which effects can be seen in it, and what halation needs of all of it. The example is at
/// [`FilmEffects`].
#[derive(Debug)]
pub struct FirstLook<'a> {
    effects: &'a FilmEffects,
    steps: FilmSteps<'a>,
    frame: Frame,
    pass: FirstPass,
}

/// The effects on their way down one picture: rows of scene light go in as they are read, display-coded rows come out as soon as those
/// about them are there. The bytes do not depend on how many rows go in at once, nor on the number of threads. The example is at
/// [`FilmEffects`].
#[derive(Debug)]
pub struct EffectsRun<'a> {
    steps: FilmSteps<'a>,
    run: StageRun,
    width: usize,
    reasons: Vec<String>,
    runs_any: bool,
}

impl FilmEffects {
    /// Looks at a picture of this size and place.
    ///
    /// # Errors
    /// If it has too many cells of halation.
    pub fn look_at<'a>(&'a self, steps: FilmSteps<'a>, frame: Frame) -> Result<FirstLook<'a>, Error> {
        let mut pass = FirstPass::new(frame);
        if let Some((sharpness, EffectChoice::Auto)) = &self.sharpness {
            pass = pass.looking_for_sharpness(sharpness);
        }
        if let Some((halation, choice)) = &self.halation {
            pass = pass.gathering_halation(halation)?;
            if *choice == EffectChoice::Auto {
                pass = pass.looking_for_halation(halation)?;
            }
        }
        Ok(FirstLook { effects: self, steps, frame, pass })
    }

    /// A whole picture that is in memory: scene-linear RGB of the look's input space, row by row, to display-coded RGB; and for each
    /// effect a sentence that says why it was run or not.
    ///
    /// ```
    /// use onelight::spatial::{FilmFormat, Frame};
    /// use onelight::{Effects, FilmEffects, FilmProcess, FilmSteps, Look};
    /// let effects = Effects { film_format: Some(FilmFormat::Super8), ..Effects::default() };
    /// let process = FilmProcess { effects, ..FilmProcess::for_camera("kodak-5219")? };
    /// let look = Look::Film(process.compile()?);
    /// let effects = FilmEffects::new(&process)?.ok_or("a film format was given")?;
    /// let frame = Frame::new([40, 30], effects.pitch(1024, 1.0)?)?;
    /// let (shown, reasons) = effects.develop(FilmSteps::of(&look, None)?, frame, &[[0.18; 3]; 40 * 30])?;
    /// assert_eq!((shown.len(), reasons.len()), (40 * 30, 2));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If the picture has not as many pixels as the frame, or as [`FilmEffects::look_at`].
    pub fn develop(
        &self,
        steps: FilmSteps<'_>,
        frame: Frame,
        linear: &[[f32; 3]],
    ) -> Result<(Vec<[f32; 3]>, Vec<String>), Error> {
        let (width, height) = (frame.width(), frame.height());
        if linear.len() != width * height {
            let found = linear.len();
            let sentence = format!("picture: found {found} pixels, expected {width} x {height} as its frame has");
            return Err(ErrorKind::Contradiction(sentence).into());
        }
        let band = width * rows_together();
        let mut first = self.look_at(steps, frame)?;
        if first.needs_picture() {
            linear.chunks(band).try_for_each(|rows| first.add(rows))?;
        }
        let mut run = first.finish()?;
        let mut shown = vec![[0.0; 3]; linear.len()];
        let mut rest = shown.as_mut_slice();
        for rows in linear.chunks(band) {
            run.add(rows)?;
            let (ready, below) = rest.split_at_mut(width * run.ready());
            if !ready.is_empty() {
                run.develop(ready)?;
            }
            rest = below;
        }
        let EffectsRun { reasons, .. } = run;
        Ok((shown, reasons))
    }
}

impl<'a> FirstLook<'a> {
    /// Whether the picture must be shown to it, all of it.
    #[must_use]
    pub fn needs_picture(&self) -> bool {
        self.pass.needs_picture()
    }

    /// Shows it the next rows: scene-linear RGB of the look's input space, from the top.
    ///
    /// # Errors
    /// If they are no whole rows, or more than the picture has left.
    pub fn add(&mut self, linear: &[[f32; 3]]) -> Result<(), Error> {
        let rows = whole_rows(linear.len(), self.frame.width())?;
        let (planes, rows) = self.pass.add(rows)?;
        expose(&self.steps, linear, planes, rows);
        Ok(self.pass.look(&self.steps, &self.steps)?)
    }

    /// What is to be done to the picture, once it was shown, if it [needed to be](FirstLook::needs_picture).
    ///
    /// # Errors
    /// If rows are missing.
    pub fn finish(self) -> Result<EffectsRun<'a>, Error> {
        let Self { effects, steps, frame, pass } = self;
        let seen = pass.finish(&steps, &steps)?;
        let mut reasons = effects.notes.clone();
        let mut is_run = |effect: Effect, choice: EffectChoice, seen: Option<&Decision>| {
            reasons.push(seen.map_or_else(|| format!("{effect}: on, as asked"), ToString::to_string));
            choice == EffectChoice::On || seen.is_some_and(|seen| seen.verdict() == Verdict::Visible)
        };
        let mut stage = SpatialStage::new(frame);
        let mut runs_any = false;
        if let Some((grain, choice)) = effects.grain(frame.pitch(), &steps)? {
            let greys = || steps.greys(HALVES.map(|half| 0.5 * f64::from(half)));
            let decision = (choice == EffectChoice::Auto).then(|| grain_decision(&grain, &frame, &greys(), &steps));
            if is_run(Effect::Grain, choice, decision.as_ref()) {
                (stage, runs_any) = (stage.with_grain(grain)?, true);
            }
        }
        let mut is_extrapolated = false;
        if let Some((sharpness, choice)) = &effects.sharpness
            && is_run(Effect::Sharpness, *choice, seen.sharpness.as_ref())
        {
            (stage, runs_any) = (stage.with_sharpness(sharpness), true);
            is_extrapolated = sharpness.is_extrapolated(frame.pitch());
        }
        let mut halo = None;
        if let Some((halation, choice)) = &effects.halation
            && is_run(Effect::Halation, *choice, seen.halation.as_ref())
        {
            (stage, runs_any, halo) = (stage.with_halation(halation.clone()), true, seen.halo);
        }
        if is_extrapolated {
            let pitch = frame.pitch().x_um().min(frame.pitch().y_um());
            reasons.push(format!(
                "sharpness: pixels of {pitch:.2} um show finer detail than the film's sheet does, whose curve is extrapolated there"
            ));
        }
        Ok(EffectsRun { run: StageRun::new(stage, halo)?, steps, width: frame.width(), reasons, runs_any })
    }
}

impl EffectsRun<'_> {
    /// Which effects are run and which are not, and why; a sentence each.
    #[must_use]
    pub fn reasons(&self) -> &[String] {
        &self.reasons
    }

    /// Whether any effect is run; where none is, the picture is what the look's form makes of each colour.
    #[must_use]
    pub fn runs_any(&self) -> bool {
        self.runs_any
    }

    /// Takes the next rows: scene-linear RGB of the look's input space, from the top.
    ///
    /// # Errors
    /// If they are no whole rows, or more than the picture has left.
    pub fn add(&mut self, linear: &[[f32; 3]]) -> Result<(), Error> {
        let rows = whole_rows(linear.len(), self.width)?;
        let (planes, rows) = self.run.add(rows)?;
        expose(&self.steps, linear, planes, rows);
        Ok(())
    }

    /// How many of the next rows can be developed with those that are there.
    #[must_use]
    pub fn ready(&self) -> usize {
        self.run.ready()
    }

    /// Develops as many of the next rows as `shown` has: display-coded RGB.
    ///
    /// # Errors
    /// If they are no whole rows, or not [ready](EffectsRun::ready).
    pub fn develop(&mut self, shown: &mut [[f32; 3]]) -> Result<(), Error> {
        let rows = whole_rows(shown.len(), self.width)?;
        if !(1..=self.run.ready()).contains(&rows) {
            // Which says what is wrong.
            self.run.amounts(rows, &self.steps)?;
        }
        for shown in shown.chunks_mut(self.width * rows_together()) {
            let amounts = self.run.amounts(shown.len() / self.width, &self.steps)?;
            let steps = &self.steps;
            shown
                .par_chunks_mut(self.width)
                .zip(amounts.rows())
                .for_each(|(shown, row)| steps.finish(amounts.row(row), shown));
        }
        Ok(())
    }
}

fn rows_together() -> usize {
    ROWS * rayon::current_num_threads()
}

fn expose(steps: &FilmSteps<'_>, linear: &[[f32; 3]], planes: &mut Planes, rows: std::ops::Range<usize>) {
    let width = planes.width();
    planes.par_rows_mut(rows).zip(linear.par_chunks(width)).for_each(|(layers, linear)| steps.expose(linear, layers));
}

/// How many rows so many pixels are.
fn whole_rows(pixels: usize, width: usize) -> Result<usize, Error> {
    if pixels.is_multiple_of(width) {
        return Ok(pixels / width);
    }
    let sentence = format!("rows of the picture: found {pixels} pixels, expected a multiple of its width, {width}");
    Err(ErrorKind::Contradiction(sentence).into())
}
