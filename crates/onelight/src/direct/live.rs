//! A direct form that follows the settings of its process.

use nalgebra::Matrix3;
use onelight_lut::DirectForm;

use super::fit::{LARGEST_MISS, misses, refine};
use super::settings::{DirectSettings, Nodes};
use super::stages::Stages;
use super::sum::{Sum, Term};
use super::training::Training;
use crate::error::{Error, ErrorKind};
use crate::films::Films;
use crate::process::FilmProcess;
use crate::reference::Reference;

/// A film with its direct form, both of which follow changes of the process in milliseconds: what sliders hold.
///
/// A change that leaves dyes and spectra as they are (points, aim, density of grey, overexposure, white, gamut, inter-image effect)
/// starts from the exponentials of the form: light through the negative and onto the screen is then the same sum with other
/// weights, which a matrix takes from the old ones. The exposure of the print, of whose three beams each layer sees a little, is
/// then fitted by a few steps. Where that would miss, and for other stocks and lamps, all is fitted as [`Reference::direct`] does it.
///
/// Exposure and balance of the scene's light need no film: [`DirectForm::with_expose`] moves them in microseconds.
///
/// ```
/// use onelight::{DirectSettings, FilmProcess, LiveDirect, Printing};
/// let mut process = FilmProcess::default();
/// let mut live = LiveDirect::new(&process, DirectSettings::default())?;
/// process.print = Some(Printing { points: [2.0, 0.0, -1.0], ..Printing::default() });
/// live.change(&process)?;
/// let (exact, fast) = (live.film().develop([0.5, 0.3, 0.1]), live.form().apply([0.5, 0.3, 0.1]));
/// assert!(exact.iter().zip(fast).all(|(exact, fast)| (exact - f64::from(fast)).abs() < 0.002));
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct LiveDirect {
    settings: DirectSettings,
    process: FilmProcess,
    films: Films,
    film: Reference,
    form: DirectForm,
    fitted: Fitted,
}

/// What was fitted last. All changes since begin with it, so that a slider's way back and forth does not add up.
#[derive(Debug, Clone)]
struct Fitted {
    /// The film's own sums.
    full: Stages,
    /// As many exponentials as the settings ask for.
    few: Stages,
}

/// Colours that a sum which is not fitted anew is fitted to: an eighth as many as otherwise.
const COLOURS: usize = 128;

impl LiveDirect {
    /// Compiles the process and makes its direct form.
    ///
    /// # Errors
    /// As [`FilmProcess::compile`] and [`Reference::direct`].
    pub fn new(process: &FilmProcess, settings: DirectSettings) -> Result<Self, Error> {
        let films = Films::of_film(process)?;
        let film = process.compile_with(&films)?;
        let full = Stages::of(&film);
        let few = film.direct_stages(&full, &settings)?;
        let form = film.direct_of(&few)?;
        Ok(Self { settings, process: process.clone(), films, film, form, fitted: Fitted { full, few } })
    }

    /// The same with a form that was made of this process before, which saves fitting one: as a file holds it, or
    /// [`LiveDirect::form`].
    ///
    /// ```
    /// use onelight::{DirectSettings, FilmProcess, LiveDirect};
    /// let process = FilmProcess::for_camera("fuji-velvia-50")?;
    /// let form = process.compile()?.direct(&DirectSettings::default())?;
    /// let mut live = LiveDirect::from_form(&process, DirectSettings::default(), form)?;
    /// live.change(&FilmProcess { neutral_density: 0.9, ..process })?;
    /// let (exact, fast) = (live.film().develop([0.5, 0.3, 0.1]), live.form().apply([0.5, 0.3, 0.1]));
    /// assert!(exact.iter().zip(fast).all(|(exact, fast)| (exact - f64::from(fast)).abs() < 0.002));
    /// # Ok::<(), onelight::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`FilmProcess::compile`]; and if the form has a print where the process has none, or the other way round.
    pub fn from_form(process: &FilmProcess, settings: DirectSettings, form: DirectForm) -> Result<Self, Error> {
        let films = Films::of_film(process)?;
        let film = process.compile_with(&films)?;
        let full = Stages::of(&film);
        let parts = form.parts();
        let duplication = parts.print.as_ref().map(|print| Sum::from(&print.exposure));
        if duplication.is_some() != full.duplication.is_some() {
            let found = if duplication.is_some() { "a print" } else { "no print" };
            let sentence = format!("the form has {found}, expected one that was made of {}", film.name());
            return Err(ErrorKind::Contradiction(sentence).into());
        }
        let few = Stages { duplication, projection: Sum::from(&parts.projection) };
        Ok(Self { settings, process: process.clone(), films, film, form, fitted: Fitted { full, few } })
    }

    /// Follows the process: film and form are those of `process` from then on.
    ///
    /// # Errors
    /// As [`LiveDirect::new`]; film and form stay as they were then.
    pub fn change(&mut self, process: &FilmProcess) -> Result<(), Error> {
        if *process == self.process {
            return Ok(());
        }
        let print = |process: &FilmProcess| process.print.as_ref().map(|print| print.film.clone());
        let films = if process.camera == self.process.camera && print(process) == print(&self.process) {
            self.films.clone()
        } else {
            Films::of_film(process)?
        };
        let film = process.compile_with(&films)?;
        let full = Stages::of(&film);
        let moved = match self.settings.nodes {
            Nodes::Usual | Nodes::Counts { .. } => self.fitted.moved_to(&film, &full)?,
            // Ready at once, or to be searched for.
            Nodes::Grid { .. } | Nodes::GridUnderMaxDe(_) | Nodes::UnderMaxDe(_) => None,
        };
        let (form, fitted) = match moved {
            Some(few) => (film.direct_of(&few)?, self.fitted.clone()),
            None => {
                let few = film.direct_stages(&full, &self.settings)?;
                (film.direct_of(&few)?, Fitted { full, few })
            }
        };
        *self = Self { settings: self.settings, process: process.clone(), films, film, form, fitted };
        Ok(())
    }

    /// The film as the process describes it, exact.
    #[must_use]
    pub fn film(&self) -> &Reference {
        &self.film
    }

    /// Its direct form.
    #[must_use]
    pub fn form(&self) -> &DirectForm {
        &self.form
    }
}

impl Fitted {
    /// The sums of another film, begun with this one's; none where they would miss.
    fn moved_to(&self, film: &Reference, full: &Stages) -> Result<Option<Stages>, Error> {
        let Some(projection) = moved(&self.full.projection, &self.few.projection, &full.projection) else {
            return Ok(None);
        };
        if projection.left > NOTHING_LEFT {
            return Ok(None);
        }
        let duplication = match (&self.full.duplication, &self.few.duplication, &full.duplication) {
            (Some(before), Some(few), Some(after)) => match moved(before, few, after) {
                Some(moved) if moved.left > NOTHING_LEFT => {
                    let samples = Training::of(film, COLOURS)?.duplication.unwrap_or_default();
                    let sum = refine(moved.few, &samples);
                    if misses(&sum, &samples).into_iter().any(|miss| miss > LARGEST_MISS) {
                        return Ok(None);
                    }
                    Some(sum)
                }
                Some(moved) => Some(moved.few),
                None => return Ok(None),
            },
            (None, None, None) => None,
            _ => return Ok(None),
        };
        Ok(Some(Stages { duplication, projection: projection.few }))
    }
}

/// A sum of few exponentials, taken to where the sum that it stands for has gone.
struct Moved {
    few: Sum,
    /// The largest part of a weight of the full sum that the way there does not explain.
    left: f64,
}

/// Parts of weights that are but rounding.
const NOTHING_LEFT: f64 = 1e-9;

/// `few` stands for `before`, and moved for `after`, which has the same rates; none if it has others.
fn moved(before: &Sum, few: &Sum, after: &Sum) -> Option<Moved> {
    let pairs = || before.0.iter().zip(&after.0);
    if before.0.len() != after.0.len() || pairs().any(|(before, after)| before.rate != after.rate) {
        return None;
    }
    // The matrix that takes the weights of one sum nearest to those of the other.
    let (mut square, mut product) = (Matrix3::zeros(), Matrix3::zeros());
    for (before, after) in pairs() {
        square += before.weight * before.weight.transpose();
        product += after.weight * before.weight.transpose();
    }
    let matrix = product * square.try_inverse()?;
    let left = pairs().map(|(before, after)| (after.weight - matrix * before.weight).amax()).fold(0.0, f64::max);
    let most = after.0.iter().map(|term| term.weight.amax()).fold(f64::MIN_POSITIVE, f64::max);
    let few = few.0.iter().map(|term| Term { weight: matrix * term.weight, ..*term }).collect();
    Some(Moved { few: Sum(few), left: left / most })
}

#[cfg(test)]
mod tests {
    use onelight_printing::{Aim, Projector, White};

    use super::*;
    use crate::direct::training::Probes;
    use crate::process::Printing;

    /// The most that the usual exponentials miss any built-in film by within the sRGB primaries.
    const USUAL_LIMIT: f64 = 0.13;

    fn negative() -> FilmProcess {
        FilmProcess::for_camera("kodak-5207").unwrap()
    }

    fn with_points(points: [f64; 3]) -> FilmProcess {
        FilmProcess { print: Some(Printing { points, ..negative().print.unwrap() }), ..negative() }
    }

    fn miss(live: &LiveDirect) -> f64 {
        Probes::new(live.film()).unwrap().largest_miss(live.form())
    }

    #[test]
    fn settings_of_light_and_grey_are_not_fitted_anew_and_keep_the_promise() {
        let mut live = LiveDirect::new(&negative(), DirectSettings::default()).unwrap();
        for process in [
            with_points([3.0, -2.0, 1.0]),
            with_points([-12.0, 12.0, 0.0]),
            FilmProcess { aim: Aim::Sheet, ..negative() },
            FilmProcess { neutral_density: 1.0, ..negative() },
            FilmProcess { overexposure: 2.0, ..negative() },
            FilmProcess { white: White::Lamp, ..negative() },
        ] {
            let film = process.compile().unwrap();
            assert!(live.fitted.moved_to(&film, &Stages::of(&film)).unwrap().is_some(), "{process:?}");
            live.change(&process).unwrap();
            let found = miss(&live);
            assert!(found <= USUAL_LIMIT, "{found}: {process:?}");
        }
        // The way there does not matter.
        let mut direct = LiveDirect::new(&negative(), DirectSettings::default()).unwrap();
        live.change(&with_points([3.0, -2.0, 1.0])).unwrap();
        direct.change(&with_points([3.0, -2.0, 1.0])).unwrap();
        assert_eq!(live.form(), direct.form());
        live.change(&negative()).unwrap();
        let (found, wanted) = (live.form().apply([0.5, 0.2, 0.1]), live.film().develop([0.5, 0.2, 0.1]));
        assert!(found.into_iter().zip(wanted).all(|(found, wanted)| (f64::from(found) - wanted).abs() < 1e-3));
    }

    #[test]
    fn a_form_from_a_file_is_followed_as_its_own() {
        let own = LiveDirect::new(&negative(), DirectSettings::default()).unwrap();
        let mut live = LiveDirect::from_form(&negative(), DirectSettings::default(), own.form().clone()).unwrap();
        for process in [with_points([3.0, -2.0, 1.0]), FilmProcess { aim: Aim::Sheet, ..negative() }] {
            live.change(&process).unwrap();
            let found = miss(&live);
            assert!(found <= USUAL_LIMIT, "{found}: {process:?}");
        }
        let reversal = FilmProcess::for_camera("fuji-velvia-50").unwrap();
        let error = LiveDirect::from_form(&reversal, DirectSettings::default(), own.form().clone()).unwrap_err();
        assert!(error.to_string().contains("the form has a print"), "{error}");
    }

    #[test]
    fn what_has_other_spectra_is_fitted_anew() {
        let mut live = LiveDirect::new(&negative(), DirectSettings::default()).unwrap();
        for process in [
            FilmProcess { projector: Projector::Xenon, ..negative() },
            FilmProcess::for_camera("fuji-velvia-50").unwrap(),
        ] {
            live.change(&process).unwrap();
            let anew = process.compile().unwrap().direct(&DirectSettings::default()).unwrap();
            assert_eq!(*live.form(), anew);
        }
        let before = live.form().clone();
        assert!(live.change(&FilmProcess { neutral_density: 9.0, ..negative() }).is_err());
        assert_eq!(*live.form(), before);
    }
}
