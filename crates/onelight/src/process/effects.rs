use onelight_spatial::{Antihalation, FilmFormat};

use crate::error::{Error, ErrorKind};
use crate::word::{Word as _, words};

/// Whether an effect is run on a picture.
///
/// ```
/// use onelight::{EffectChoice, Word};
/// assert_eq!(EffectChoice::parse("auto")?, EffectChoice::Auto);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum EffectChoice {
    /// Never.
    Off,
    /// Always; a film whose sheet does not have the figures is refused.
    On,
    /// Where it can be seen, and the film's sheet has the figures.
    Auto,
}

words! {
    EffectChoice, "effect":
        EffectChoice::Off = "off" "never",
        EffectChoice::On = "on" "always",
        EffectChoice::Auto = "auto" "where it can be seen";
}

/// What the camera film does to a picture rather than to a colour: sharpness, halation and grain. They are no part of a table: whoever
/// develops pictures runs them ([`FilmEffects`](crate::FilmEffects)).
///
/// Without a film format nothing is run. With one, grain and sharpness are run where they can be seen; halation only where it is
/// asked for, as the density of the antihalation layer decides all of it and is on no sheet.
///
/// ```
/// use onelight::spatial::FilmFormat;
/// use onelight::{Effects, FilmProcess, Process};
/// let effects = Effects { film_format: Some(FilmFormat::Super16), ..Effects::default() };
/// let look = Process::from(FilmProcess { effects, ..FilmProcess::default() });
/// assert!(look.to_toml().contains("film_format = \"super16\""));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effects {
    /// How large the picture is on the film; `None` leaves all effects out.
    pub film_format: Option<FilmFormat>,
    /// Dye clouds.
    pub grain: EffectChoice,
    /// Scatter of light and adjacency of development.
    pub sharpness: EffectChoice,
    /// Light that returns from the back of the base.
    pub halation: EffectChoice,
    /// What keeps light from returning.
    pub antihalation: Antihalation,
    /// Another seed, another pattern of grain.
    pub seed: u32,
}

impl Default for Effects {
    fn default() -> Self {
        Self {
            film_format: None,
            grain: EffectChoice::Auto,
            sharpness: EffectChoice::Auto,
            halation: EffectChoice::Off,
            antihalation: Antihalation::default(),
            seed: 0,
        }
    }
}

impl Effects {
    /// Whether the numbers are within their ranges, and every setting changes something.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let refuse = |sentence: String| Err(ErrorKind::Contradiction(sentence).into());
        let usual = Self::default();
        let other_layer = self.antihalation != usual.antihalation;
        if self.film_format.is_none() {
            let choice = |key: &str, found: EffectChoice, idle: bool| idle.then(|| format!("{key} {}", found.word()));
            let idle = choice("grain", self.grain, self.grain == EffectChoice::On)
                .or(choice("sharpness", self.sharpness, self.sharpness == EffectChoice::On))
                .or(choice("halation", self.halation, self.halation != EffectChoice::Off))
                .or(other_layer.then(|| "antihalation".to_owned()))
                .or((self.seed != usual.seed).then(|| "seed".to_owned()));
            return idle.map_or(Ok(()), |idle| {
                refuse(format!(
                    "{idle} depends on how large the picture is on the film, expected film_format beside it, such as super35"
                ))
            });
        }
        if self.halation == EffectChoice::Off && other_layer {
            return refuse(
                "halation is off: antihalation changes nothing, expected it left out, or halation on or auto"
                    .to_owned(),
            );
        }
        if self.grain == EffectChoice::Off && self.seed != usual.seed {
            return refuse("grain is off: seed changes nothing, expected it left out, or grain on or auto".to_owned());
        }
        let density = self.antihalation.density();
        if (0.0..=Antihalation::MAX_DENSITY).contains(&density) {
            return Ok(());
        }
        Err(Error::setting("antihalation", density, 0.0, Antihalation::MAX_DENSITY))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(change: impl FnOnce(&mut Effects)) -> String {
        let mut effects = Effects::default();
        change(&mut effects);
        effects.check().map_or_else(|error| error.to_string(), |()| String::new())
    }

    #[test]
    fn what_changes_nothing_is_named() {
        assert_eq!(message(|_| {}), "");
        assert_eq!(message(|e| (e.grain, e.sharpness) = (EffectChoice::Off, EffectChoice::Off)), "");
        for (change, named) in [
            (Box::new(|e: &mut Effects| e.grain = EffectChoice::On) as Box<dyn Fn(&mut Effects)>, "grain on"),
            (Box::new(|e| e.sharpness = EffectChoice::On), "sharpness on"),
            (Box::new(|e| e.halation = EffectChoice::Auto), "halation auto"),
            (Box::new(|e| e.antihalation = Antihalation::None), "antihalation"),
            (Box::new(|e| e.seed = 7), "seed"),
        ] {
            let found = message(&change);
            assert!(found.starts_with(named) && found.contains("expected film_format"), "{found}");
            let with_format = message(|e| {
                e.film_format = Some(FilmFormat::Super35);
                e.halation = EffectChoice::Auto;
                change(e);
            });
            assert_eq!(with_format, "");
        }
        let super8 = |e: &mut Effects| e.film_format = Some(FilmFormat::Super8);
        assert!(
            message(|e| {
                super8(e);
                e.antihalation = Antihalation::None;
            })
            .starts_with("halation is off: antihalation changes nothing")
        );
        assert!(
            message(|e| {
                super8(e);
                (e.grain, e.seed) = (EffectChoice::Off, 3);
            })
            .starts_with("grain is off: seed changes nothing")
        );
        let density = message(|e| {
            super8(e);
            (e.halation, e.antihalation) = (EffectChoice::On, Antihalation::Density(9.0));
        });
        assert_eq!(density, "antihalation: found 9, expected 0 to 3");
    }
}
