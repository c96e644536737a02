//! Looks that follow their controls: from shipped forms at once where numbers suffice, else with the film in milliseconds.

use onelight::lut::{DirectForm, Expose};
use onelight::printing::POINT_LOG_EXPOSURE;
use onelight::{ColourSpaces, DirectSettings, FilmProcess, LiveDirect, Process, ProcessKeys};

use crate::error::Error;
use crate::keys::Keys;

/// A pair of films whose direct form follows all controls ([`LiveDirect`]).
///
/// ```
/// use onelight_web::{Keys, MovingLook};
/// let keys = |points: &str| Keys::from_json(&format!(r#"{{ "points": {points} }}"#));
/// let mut look = MovingLook::new(&keys("[0, 0, 0]")?, None)?;
/// let before = look.form(&keys("[0, 0, 0]")?)?.apply([0.18; 3]);
/// let after = look.form(&keys("[2, 0, 0]")?)?.apply([0.18; 3]);
/// assert!(after[0] < before[0]);
/// # Ok::<(), onelight_web::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct MovingLook {
    /// The keys of `base`: what moves is as it usually is. The way to other keys begins there, so that the same keys have the same form
    /// whatever was turned before.
    keys: Keys,
    base: LiveDirect,
    usual: Option<DirectForm>,
}

impl MovingLook {
    /// The films of these keys; `usual` is the direct form of their usual look, where it was made before.
    ///
    /// # Errors
    /// If the keys do not go together; if the form is of no such look.
    pub fn new(keys: &Keys, usual: Option<DirectForm>) -> Result<Self, Error> {
        let keys = keys.at_rest();
        let (process, settings) = (film(&keys.process()?)?, DirectSettings::default());
        let base = match usual.clone().filter(|_| keys == keys.usual()) {
            Some(form) => LiveDirect::from_form(&process, settings, form)?,
            None => LiveDirect::new(&process, settings)?,
        };
        Ok(Self { keys, base, usual })
    }

    /// The direct form of these keys.
    ///
    /// # Errors
    /// If the keys do not go together.
    pub fn form(&mut self, keys: &Keys) -> Result<DirectForm, Error> {
        let process = film(&keys.process()?)?;
        if keys.at_rest() != self.keys {
            *self = Self::new(keys, self.usual.clone())?;
        }
        let mut live = self.base.clone();
        live.change(&process)?;
        Ok(live.form().clone())
    }
}

fn film(process: &Process) -> Result<FilmProcess, Error> {
    match process {
        Process::Film(film) => Ok(film.clone()),
        Process::First(_) | Process::Print(_) | Process::Tone(_) => Err(Error::without_film()),
    }
}

/// The look of these keys from the form of their films' usual look, where the light of the scene and the printer's points are all that
/// differs: no film is computed. `None` where anything else does.
///
/// Points act here on each layer of the print by itself; in truth a beam exposes its neighbours a little too, so that the exact
/// look ([`MovingLook`]) may differ by a code or two. It is for small pictures.
///
/// ```
/// use onelight_web::{FilmLook, Keys, quick_form};
/// let usual = FilmLook::new(&Keys::from_json("{}")?)?;
/// let warm = Keys::from_json(r#"{ "scene_white": "9000" }"#)?;
/// let [red, _, blue] = quick_form(&warm, usual.direct()?)?.ok_or("white alone moves")?.apply([0.18; 3]);
/// assert!(red > blue);
/// assert!(quick_form(&Keys::from_json(r#"{ "aim": "sheet" }"#)?, usual.direct()?)?.is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If a number is out of its range.
pub fn quick_form(keys: &Keys, usual: &DirectForm) -> Result<Option<DirectForm>, Error> {
    let own = keys.colours();
    let ProcessKeys { ev, scene_white, input_space, points, .. } = *own.keys();
    if Keys::from(ProcessKeys { ev, scene_white, input_space, points, ..keys.usual().into_keys() }) != own {
        return Ok(None);
    }
    let spaces = ColourSpaces { ev, scene_white, input_space, ..ColourSpaces::default() };
    let expose = Expose { input: spaces.input_rows()?, ..usual.parts().expose };
    let factors = points.map(|points| 10_f64.powf(points * POINT_LOG_EXPOSURE) as f32);
    Ok(Some(usual.clone().with_expose(expose)?.with_print_exposed(factors)?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FilmLook;

    fn keys(text: &str) -> Keys {
        Keys::from_json(text).unwrap().fitting().unwrap()
    }

    /// What points leave out: light of a beam that other layers see.
    const POINTS_TOLERANCE: f32 = 2.5 / 255.0;

    #[test]
    fn quick_forms_are_near_the_exact_ones() {
        for (text, tolerance) in [
            (r#"{ "scene_white": "4000" }"#, 1e-4),
            (r#"{ "ev": 1.5, "input_space": "rec2020" }"#, 1e-4),
            (r#"{ "points": [3, -2, 1] }"#, POINTS_TOLERANCE),
            (r#"{ "camera": "fuji-velvia-50", "scene_white": "3200" }"#, 1e-4),
        ] {
            let keys = keys(text);
            let usual = FilmLook::new(&keys.usual()).unwrap();
            let quick = quick_form(&keys, usual.direct().unwrap()).unwrap().unwrap();
            let usual = usual.direct().unwrap().clone();
            let exact = MovingLook::new(&keys, Some(usual)).unwrap().form(&keys).unwrap();
            for rgb in [[0.18; 3], [0.6, 0.2, 0.05], [0.02, 0.1, 0.4], [3.0, 2.5, 2.0]] {
                let pairs = quick.apply(rgb).into_iter().zip(exact.apply(rgb));
                pairs.for_each(|(quick, exact)| assert!((quick - exact).abs() < tolerance, "{text}: {quick} {exact}"));
            }
        }
    }

    #[test]
    fn the_way_to_a_look_does_not_matter() {
        let usual = FilmLook::new(&keys("{}")).unwrap().direct().unwrap().clone();
        let wanted = keys(r#"{ "points": [3, 0, -1], "neutral_density": 0.8 }"#);
        let there = MovingLook::new(&wanted, Some(usual.clone())).unwrap().form(&wanted).unwrap();
        let mut turned = MovingLook::new(&keys("{}"), Some(usual)).unwrap();
        for other in [r#"{ "aim": "sheet" }"#, r#"{ "points": [9, 9, 0] }"#, r#"{ "projector": "xenon" }"#] {
            turned.form(&keys(other)).unwrap();
        }
        assert_eq!(turned.form(&wanted).unwrap(), there);
    }

    #[test]
    fn what_needs_the_film_is_not_quick() {
        let usual = FilmLook::new(&keys("{}")).unwrap().direct().unwrap().clone();
        for text in [r#"{ "white": "lamp" }"#, r#"{ "neutral_density": 0.9 }"#, r#"{ "interimage": "none" }"#] {
            assert!(quick_form(&keys(text), &usual).unwrap().is_none(), "{text}");
        }
        // A film format changes no colour.
        assert!(quick_form(&keys(r#"{ "film_format": "super16", "grain": "on" }"#), &usual).unwrap().is_some());
    }
}
