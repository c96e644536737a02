//! What the camera film of a look does to a picture: sharpness, halation and grain.

mod picture;
mod steps;

use onelight_film::Stock;
use onelight_spatial::{
    AmountGranularity, Antihalation, Effect, FilmFormat, Frame, Grain, GrainSettings, Halation, HalationSettings,
    Pitch, Sharpness, SpatialStage,
};

pub use picture::{EffectsRun, FirstLook};
pub use steps::FilmSteps;

use crate::error::Error;
use crate::films::Films;
use crate::process::{EffectChoice, Effects, FilmProcess};

/// The effects of a look's camera film, for pictures of any size.
///
/// 1. [`FilmEffects::look_at`]: which effects a picture needs, and what must be known of all of it; shown the picture only where
///    [`FirstLook::needs_picture`]
/// 2. [`FirstLook::finish`] gives an [`EffectsRun`], which takes the picture's rows and gives them back developed
///
/// ```
/// use onelight::spatial::{FilmFormat, Frame};
/// use onelight::{Effects, FilmEffects, FilmProcess, FilmSteps, Look};
/// let effects = Effects { film_format: Some(FilmFormat::Super16), ..Effects::default() };
/// let process = FilmProcess { effects, ..FilmProcess::default() };
/// let look = Look::Film(process.compile()?);
/// let effects = FilmEffects::new(&process)?.ok_or("a film format was given")?;
///
/// let picture = vec![[0.18_f32; 3]; 64 * 48];
/// let frame = Frame::new([64, 48], effects.pitch(2048, 1.0)?)?;
/// let mut first = effects.look_at(FilmSteps::of(&look, None)?, frame)?;
/// if first.needs_picture() {
///     first.add(&picture)?;
/// }
/// let mut run = first.finish()?;
/// assert!(run.reasons()[0].starts_with("grain: "));
/// run.add(&picture)?;
/// let mut shown = vec![[0.0; 3]; 64 * run.ready()];
/// run.develop(&mut shown)?;
/// assert!(shown.iter().any(|rgb| (rgb[0] - 0.48).abs() > 0.01), "grain");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct FilmEffects {
    format: FilmFormat,
    sharpness: Option<(Sharpness, EffectChoice)>,
    halation: Option<(Halation, EffectChoice)>,
    grain: Option<(AmountGranularity, GrainSettings, EffectChoice)>,
    /// What there is to say of every picture.
    notes: Vec<String>,
}

impl FilmEffects {
    /// Those of a process with a built-in camera film; `None` without a film format.
    ///
    /// # Errors
    /// If an effect was asked for whose figures the film's sheet does not have, or a number is out of its range.
    pub fn new(process: &FilmProcess) -> Result<Option<Self>, Error> {
        Self::with(process, &Films::of_film(process)?)
    }

    /// The same with these films instead of those that the process names.
    ///
    /// # Errors
    /// As [`FilmEffects::new`].
    pub fn with(process: &FilmProcess, films: &Films) -> Result<Option<Self>, Error> {
        let Effects { film_format, grain, sharpness, halation, antihalation, seed } = process.effects;
        process.effects.check()?;
        let Some(format) = film_format else { return Ok(None) };
        let mut notes = Vec::new();
        let camera = &films.camera;
        let sharpness = figures(Effect::Sharpness, sharpness, &mut notes, || Ok(Sharpness::of_stock(camera)?))?;
        let granularity = figures(Effect::Grain, grain, &mut notes, || Ok(AmountGranularity::of_stock(camera)?))?;
        let grain = granularity.map(|(granularity, choice)| {
            let usual = GrainSettings { seed, ..GrainSettings::default() };
            let settings = if process.print.is_some() { usual } else { GrainSettings { print_blur_um: 0.0, ..usual } };
            (granularity, settings, choice)
        });
        let halation = match halation {
            EffectChoice::Off => None,
            choice => {
                let halation = Halation::new(HalationSettings { antihalation, ..HalationSettings::default() })?;
                notes.push(assumed(&halation, camera));
                Some((halation, choice))
            }
        };
        Ok(Some(Self { format, sharpness, halation, grain, notes }))
    }

    /// How large the picture is on the film.
    #[must_use]
    pub fn format(&self) -> FilmFormat {
        self.format
    }

    /// The size of a pixel on the film, of a frame of so many pixels in a row whose pixels are `pixel_aspect` times as wide as high.
    ///
    /// # Errors
    /// If pixels are too small or too large, or the aspect is not between 1/8 and 8.
    pub fn pitch(&self, width: usize, pixel_aspect: f64) -> Result<Pitch, Error> {
        Ok(self.format.pitch(width, pixel_aspect)?)
    }

    /// A stage with every effect that is not off, whether it can be seen or not: for a graphics card, and for whoever looks at no picture
    /// before it is shown.
    ///
    /// ```
    /// use onelight::spatial::{FilmFormat, Frame};
    /// use onelight::{Effects, FilmEffects, FilmProcess, FilmSteps};
    /// let effects = Effects { film_format: Some(FilmFormat::Super16), ..Effects::default() };
    /// let process = FilmProcess { effects, ..FilmProcess::default() };
    /// let film = process.compile()?;
    /// let direct = film.direct(&Default::default())?;
    /// let effects = FilmEffects::new(&process)?.ok_or("a film format was given")?;
    /// let frame = Frame::new([64, 48], effects.pitch(2048, 1.0)?)?;
    /// let stage = effects.stage(&FilmSteps::direct(&film, &direct)?, frame)?;
    /// assert!(stage.numbers().grain.is_some() && stage.numbers().halation.is_none());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If a number of grain is out of its range: none that a process lets through.
    pub fn stage(&self, steps: &FilmSteps<'_>, frame: Frame) -> Result<SpatialStage, Error> {
        let mut stage = SpatialStage::new(frame);
        if let Some((grain, _)) = self.grain(frame.pitch(), steps)? {
            stage = stage.with_grain(grain)?;
        }
        if let Some((sharpness, _)) = &self.sharpness {
            stage = stage.with_sharpness(sharpness);
        }
        if let Some((halation, _)) = &self.halation {
            stage = stage.with_halation(halation.clone());
        }
        Ok(stage)
    }

    /// About how much memory an [`EffectsRun`] takes for a picture that comes in bands of so many pixels, with the bands that wait for
    /// those below them.
    #[must_use]
    pub fn bytes(&self, frame: &Frame, band_pixels: u64) -> u64 {
        /// Exposures, developed and finished amounts of three layers.
        const PLANES: u64 = 3 * 3 * 4;
        /// A pixel of a band, with alpha.
        const WAITING: u64 = 4 * 4;
        let stage = SpatialStage::new(*frame);
        let stage = self.sharpness.iter().fold(stage, |stage, (sharpness, _)| stage.with_sharpness(sharpness));
        let middle = frame.height() / 2;
        let about = (stage.exposure_rows(middle..middle + 1).len() * frame.width()) as u64;
        (PLANES + WAITING).saturating_mul(band_pixels.saturating_add(about))
    }

    /// Grain for pixels of this size, which keeps the mean of large areas.
    fn grain(&self, pitch: Pitch, steps: &FilmSteps<'_>) -> Result<Option<(Grain, EffectChoice)>, Error> {
        /// Greys along which the mean is kept, in quarters of a stop about mid grey.
        const QUARTERS: std::ops::RangeInclusive<i32> = -28..=36;
        let Some((granularity, settings, choice)) = &self.grain else { return Ok(None) };
        let grain = Grain::new(granularity.clone(), pitch, *settings)?;
        let greys = steps.greys(QUARTERS.map(|quarter| 0.25 * f64::from(quarter)));
        Ok(Some((grain.keeping_mean(&greys, steps), *choice)))
    }
}

/// What an effect needs of a sheet; `notes` gets why it is left out where it is not there.
fn figures<T>(
    effect: Effect,
    choice: EffectChoice,
    notes: &mut Vec<String>,
    read: impl FnOnce() -> Result<T, Error>,
) -> Result<Option<(T, EffectChoice)>, Error> {
    match (choice, read) {
        (EffectChoice::Off, _) => Ok(None),
        (EffectChoice::On, read) => Ok(Some((read()?, choice))),
        (EffectChoice::Auto, read) => match read() {
            Ok(found) => Ok(Some((found, choice))),
            Err(error) if error.is_not_published() => {
                notes.push(format!("{effect}: skipped, as {error}"));
                Ok(None)
            }
            Err(error) => Err(error),
        },
    }
}

/// What halation rests on.
fn assumed(halation: &Halation, camera: &Stock) -> String {
    let share = 100.0 * halation.returned_light();
    let returned = format!("{share:.2} % of the light at the back of the film returns");
    match halation.settings().antihalation {
        Antihalation::Density(density) => format!(
            "halation: an antihalation layer of density {density} is assumed for {}, as no sheet states it: {returned}",
            camera.id()
        ),
        Antihalation::None => format!("halation: {} without its antihalation layer: {returned}", camera.id()),
    }
}
