//! A look that follows the keys of a viewer.

use onelight::lut::DirectForm;
use onelight::spatial::{Antihalation, FilmFormat, Frame, SpatialStage};
use onelight::{
    Aim, DirectSettings, EffectChoice, Effects, Error, FilmEffects, FilmProcess, FilmSteps, LiveDirect, White, Word,
};

/// The films that are gone through.
const STOCKS: [&str; 5] = ["kodak-5207", "kodak-5219", "kodak-portra-400", "kodak-ektachrome-100", "fuji-velvia-50"];
/// The formats that are gone through.
const FORMATS: [FilmFormat; 4] = [FilmFormat::Super35, FilmFormat::Super16, FilmFormat::Super8, FilmFormat::Film65];

/// What a key changes.
///
/// ```
/// use onelight_gpu_examples::live_look::Change;
/// assert_eq!(Change::of_letter('g'), Some(Change::Grain));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Change {
    /// Thirds of a stop.
    Exposure(i32),
    /// So many films further.
    Stock(i32),
    /// Printer points of a light: red, green, blue. Nothing where nothing is printed.
    Points(usize, i32),
    /// What a viewer takes for white: clear film, or the lamp.
    White,
    /// What grey becomes: neutral, or as the sheet says.
    Aim,
    /// Grain on or off.
    Grain,
    /// Scatter and adjacency on or off.
    Sharpness,
    /// Halation on or off.
    Halation,
    /// With the usual antihalation layer, or without one.
    Antihalation,
    /// The next format of film.
    Format,
}

impl Change {
    /// The change of a letter: `g`, `s` and `h` for the effects, `n` for no antihalation layer, `f` for the format, `w` for white, `a` for
    /// the aim, `r`, `t`, `b` and `R`, `T`, `B` for a printer point of red, green and blue more and less.
    #[must_use]
    pub fn of_letter(letter: char) -> Option<Self> {
        Some(match letter {
            'g' => Self::Grain,
            's' => Self::Sharpness,
            'h' => Self::Halation,
            'n' => Self::Antihalation,
            'f' => Self::Format,
            'w' => Self::White,
            'a' => Self::Aim,
            'r' | 'R' => Self::Points(0, if letter == 'r' { 1 } else { -1 }),
            't' | 'T' => Self::Points(1, if letter == 't' { 1 } else { -1 }),
            'b' | 'B' => Self::Points(2, if letter == 'b' { 1 } else { -1 }),
            _ => return None,
        })
    }
}

/// A film, its direct form, and what of it is on.
///
/// ```
/// use onelight_gpu_examples::live_look::{Change, LiveLook};
/// let mut look = LiveLook::new()?;
/// assert_eq!(look.title(), "kodak-5207  +0.0 stops");
/// look.change(Change::Exposure(2))?;
/// look.change(Change::Grain)?;
/// assert_eq!(look.title(), "kodak-5207  +0.7 stops  super35: grain");
/// assert!(look.stage([64, 36])?.is_some());
/// # Ok::<(), onelight::Error>(())
/// ```
pub struct LiveLook {
    stock: usize,
    thirds: i32,
    process: FilmProcess,
    live: LiveDirect,
    /// What is on, with the format that it would have.
    effects: Effects,
}

impl LiveLook {
    /// The first film without any effect.
    ///
    /// # Errors
    /// None: built-in films compile.
    pub fn new() -> Result<Self, Error> {
        let process = FilmProcess::for_camera(STOCKS[0])?;
        let live = LiveDirect::new(&process, DirectSettings::default())?;
        let (grain, sharpness) = (EffectChoice::Off, EffectChoice::Off);
        let effects = Effects { film_format: Some(FORMATS[0]), grain, sharpness, ..Effects::default() };
        Ok(Self { stock: 0, thirds: 0, process, live, effects })
    }

    /// Follows a key. Settings of light and grey are followed in milliseconds, other films are compiled.
    ///
    /// # Errors
    /// If no printer reaches the setting; the look stays as it was.
    pub fn change(&mut self, change: Change) -> Result<(), Error> {
        let (mut process, mut stock) = (self.process.clone(), self.stock);
        let toggled = |choice| if choice == EffectChoice::Off { EffectChoice::Auto } else { EffectChoice::Off };
        match change {
            Change::Exposure(thirds) => self.thirds += thirds,
            Change::Stock(step) => {
                stock = (stock as i32 + step).rem_euclid(STOCKS.len() as i32) as usize;
                process =
                    FilmProcess { aim: process.aim, white: process.white, ..FilmProcess::for_camera(STOCKS[stock])? };
            }
            Change::Points(layer, points) => {
                if let Some(print) = &mut process.print {
                    print.points[layer] += f64::from(points);
                }
            }
            Change::White => process.white = if process.white == White::Film { White::Lamp } else { White::Film },
            Change::Aim => process.aim = if process.aim == Aim::Neutral { Aim::Sheet } else { Aim::Neutral },
            Change::Grain => self.effects.grain = toggled(self.effects.grain),
            Change::Sharpness => self.effects.sharpness = toggled(self.effects.sharpness),
            Change::Halation => self.effects.halation = toggled(self.effects.halation),
            Change::Antihalation => {
                let usual = Antihalation::default();
                self.effects.antihalation = if self.effects.antihalation == usual { Antihalation::None } else { usual };
            }
            Change::Format => {
                let now = FORMATS.iter().position(|format| Some(*format) == self.effects.film_format);
                self.effects.film_format = Some(FORMATS[now.map_or(0, |now| (now + 1) % FORMATS.len())]);
            }
        }
        self.live.change(&process)?;
        (self.process, self.stock) = (process, stock);
        Ok(())
    }

    /// The direct form, with the exposure in its first matrix.
    ///
    /// # Errors
    /// If the exposure leaves what numbers hold.
    pub fn form(&self) -> Result<DirectForm, Error> {
        let form = self.live.form();
        Ok(form.clone().with_expose(form.parts().expose.brighter(self.thirds as f32 / 3.0))?)
    }

    /// The effects that are on, for a picture of so many pixels that fills the format's frame; `None` without any. A film whose sheet has
    /// no figures for an effect goes without it.
    ///
    /// # Errors
    /// If the pixels are too small for the format.
    pub fn stage(&self, [width, height]: [u32; 2]) -> Result<Option<SpatialStage>, Error> {
        let Some(effects) = self.film_effects()? else { return Ok(None) };
        let pitch = effects.pitch(width as usize, 1.0)?;
        let frame = Frame::new([width as usize, height as usize], pitch)?;
        let stage = effects.stage(&FilmSteps::direct(self.live.film(), self.live.form())?, frame)?;
        Ok(is_any(&stage).then_some(stage))
    }

    /// Film, exposure, settings that are not the usual ones, and the effects that are on.
    #[must_use]
    pub fn title(&self) -> String {
        let mut title = format!("{}  {:+.1} stops", STOCKS[self.stock], f64::from(self.thirds) / 3.0);
        let points = self.process.print.as_ref().map(|print| print.points).filter(|points| *points != [0.0; 3]);
        if let Some([red, green, blue]) = points {
            title += &format!("  points {red:+} {green:+} {blue:+}");
        }
        if self.process.aim == Aim::Sheet {
            title += &format!("  aim {}", self.process.aim.word());
        }
        if self.process.white == White::Lamp {
            title += &format!("  white {}", self.process.white.word());
        }
        let Effects { film_format, grain, sharpness, halation, antihalation, .. } = self.effects;
        let bare = if antihalation == Antihalation::None { "halation without its layer" } else { "halation" };
        let on = [(sharpness, "sharpness"), (grain, "grain"), (halation, bare)];
        let on: Vec<&str> =
            on.iter().filter(|(choice, _)| *choice != EffectChoice::Off).map(|(_, name)| *name).collect();
        if let Some(format) = film_format.filter(|_| !on.is_empty()) {
            title += &format!("  {format}: {}", on.join(", "));
        }
        title
    }

    /// Whether pictures differ from one to the next.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.effects.grain != EffectChoice::Off
    }

    fn film_effects(&self) -> Result<Option<FilmEffects>, Error> {
        let mut effects = self.effects;
        if effects.halation == EffectChoice::Off {
            effects.antihalation = Antihalation::default();
        }
        FilmEffects::new(&FilmProcess { effects, ..self.process.clone() })
    }
}

fn is_any(stage: &SpatialStage) -> bool {
    let numbers = stage.numbers();
    numbers.scatter.is_some() || numbers.adjacency.is_some() || numbers.grain.is_some() || numbers.halation.is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_change_what_they_say_and_the_title_tells() {
        let mut look = LiveLook::new().unwrap();
        let plain = look.form().unwrap();
        for (letter, end) in [
            ('r', "points +1 +0 +0"),
            ('B', "points +1 +0 -1"),
            ('a', "aim sheet"),
            ('w', "white lamp"),
            ('h', "super35: halation"),
            ('n', "super35: halation without its layer"),
            ('s', "super35: sharpness, halation without its layer"),
            ('f', "super16: sharpness, halation without its layer"),
        ] {
            look.change(Change::of_letter(letter).unwrap()).unwrap();
            assert!(look.title().ends_with(end), "{letter}: {}", look.title());
        }
        let numbers = look.stage([128, 72]).unwrap().unwrap().numbers();
        assert!(numbers.scatter.is_some() && numbers.halation.is_some() && numbers.grain.is_none());
        for letter in ['R', 'b', 'a', 'w', 'h', 's'] {
            look.change(Change::of_letter(letter).unwrap()).unwrap();
        }
        assert_eq!(look.title(), "kodak-5207  +0.0 stops");
        assert!(look.stage([128, 72]).unwrap().is_none());
        let (found, expected) = (look.form().unwrap().apply([0.5, 0.2, 0.1]), plain.apply([0.5, 0.2, 0.1]));
        assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 2e-3), "{found:?} {expected:?}");
        assert_eq!(Change::of_letter('x'), None);
    }

    #[test]
    fn films_without_figures_go_without_and_settings_out_of_reach_stay_out() {
        let mut look = LiveLook::new().unwrap();
        look.change(Change::Grain).unwrap();
        look.change(Change::Stock(-1)).unwrap();
        assert!(look.title().starts_with("fuji-velvia-50  "), "{}", look.title());
        assert!(look.stage([128, 72]).unwrap().is_none(), "no granularity of its own");
        look.change(Change::Stock(1)).unwrap();
        assert!(look.moves() && look.stage([128, 72]).unwrap().is_some());
        let before = look.form().unwrap();
        // Beyond 50 points there is no printer.
        let refused = (0..60).find_map(|_| look.change(Change::Points(0, 1)).err()).unwrap();
        assert!(refused.to_string().contains("50"), "{refused}");
        assert!(look.title().contains("points +50 +0 +0") && look.form().unwrap() != before);
    }
}
