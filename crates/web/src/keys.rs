//! The keys of a look, as the page's controls turn them.

use onelight::baked::Target;
use onelight::spatial::FilmFormat;
use onelight::{
    Aim, DyeModel, EffectChoice, Image, InterImageChoice, Matching, PrintCurves, Process, ProcessKeys, Projector,
    StockKind, TransferCurve, White, WideGamut, Word, stock, usual_print,
};
use serde_json::{Map, Value, json};

use crate::error::Error;

/// What the page holds of a look: every key of `look.toml`, as JSON while controls turn it.
///
/// ```
/// use onelight_web::Keys;
/// let keys = Keys::from_json(r#"{ "camera": "fuji-velvia-50", "points": [1, 0, 0] }"#)?;
/// // A reversal film is shown as it is: it has no printer to set.
/// let keys = keys.fitting()?;
/// assert_eq!(keys.process()?.name(), "fuji-velvia-50");
/// assert!(keys.to_toml().contains("print = \"none\""));
/// # Ok::<(), onelight_web::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Keys(ProcessKeys);

impl Keys {
    /// Reads keys; those left out have their default.
    ///
    /// # Errors
    /// If it is no JSON, or holds an unknown key or word.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        Ok(Self(serde_json::from_str(text)?))
    }

    /// Reads a `look.toml`.
    ///
    /// # Errors
    /// As [`ProcessKeys::from_toml`]; and what [`Keys::process`] says.
    pub fn from_toml(text: &str) -> Result<Self, Error> {
        let keys = Self(ProcessKeys::from_toml("look.toml", text)?);
        keys.process()?;
        Ok(keys)
    }

    /// All keys as JSON.
    ///
    /// # Errors
    /// None: keys are words and numbers.
    pub fn to_json(&self) -> Result<String, Error> {
        Ok(serde_json::to_string(&self.0)?)
    }

    /// The look as text.
    #[must_use]
    pub fn to_toml(&self) -> String {
        self.0.to_toml()
    }

    /// The look that they describe.
    ///
    /// # Errors
    /// As [`ProcessKeys::process`]: films that do not fit together, numbers out of range, keys that change nothing.
    pub fn process(&self) -> Result<Process, Error> {
        Ok(self.0.process()?)
    }

    /// The usual look of the same films.
    #[must_use]
    pub fn usual(&self) -> Self {
        let (camera, print) = (self.0.camera.clone(), self.0.print.clone());
        Self(ProcessKeys { camera, print, ..ProcessKeys::default() })
    }

    /// The same with all that a form follows without being fitted anew as it usually is: light of the scene, grey, printer's points, white,
    /// the effect between layers.
    pub(crate) fn at_rest(&self) -> Self {
        let usual = ProcessKeys::default();
        Self(ProcessKeys {
            aim: usual.aim,
            neutral_density: usual.neutral_density,
            overexposure: usual.overexposure,
            inter_image: usual.inter_image,
            gamut: usual.gamut,
            points: usual.points,
            white: usual.white,
            ev: usual.ev,
            scene_white: usual.scene_white,
            input_space: usual.input_space,
            ..self.colours().0
        })
    }

    /// The same without what the film does to a picture rather than to a colour: looks with the same of these have the same colours.
    #[must_use]
    pub fn colours(&self) -> Self {
        let usual = ProcessKeys::default();
        Self(ProcessKeys {
            film_format: usual.film_format,
            grain: usual.grain,
            sharpness: usual.sharpness,
            halation: usual.halation,
            antihalation: usual.antihalation,
            seed: usual.seed,
            ..self.0.clone()
        })
    }

    pub(crate) fn keys(&self) -> &ProcessKeys {
        &self.0
    }

    pub(crate) fn into_keys(self) -> ProcessKeys {
        self.0
    }

    /// The same with another coding of what comes out.
    #[must_use]
    pub fn with_coding(&self, output_coding: TransferCurve) -> Self {
        Self(ProcessKeys { output_coding, ..self.0.clone() })
    }

    /// The same at another exposure, in stops.
    #[must_use]
    pub fn with_ev(&self, ev: f64) -> Self {
        Self(ProcessKeys { ev, ..self.0.clone() })
    }

    /// The same keys as far as they mean something to their films: what a page does when another film is chosen. A print that does not fit
    /// becomes the usual one, and settings of what is not there go back to their defaults.
    ///
    /// # Errors
    /// If there is no such film.
    pub fn fitting(&self) -> Result<Self, Error> {
        let mut keys = self.0.clone();
        let usual = ProcessKeys::default();
        let camera = stock(&keys.camera)?;
        let is_scan = keys.print.as_deref() == Some("scan") && camera.kind() == StockKind::Negative;
        let print = keys.print.as_deref().filter(|print| *print != "scan").map(stock).transpose()?;
        let fits =
            |print: &onelight::Stock| camera.kind().printed_on().contains(&print.kind()) && camera.is_printed_on(print);
        let print = match print.filter(fits) {
            None if is_scan => None,
            None if camera.kind() == StockKind::Negative => Some(stock(usual_print(camera.image()))?),
            kept => kept,
        };
        keys.print = print.as_ref().map(onelight::Stock::id).or(is_scan.then_some("scan")).map(str::to_owned);
        if is_scan {
            (keys.aim, keys.projector, keys.white) = (usual.aim, usual.projector, usual.white);
        }
        if print.is_none() {
            (keys.print_curves, keys.light, keys.filters) = (usual.print_curves, usual.light, usual.filters);
            (keys.beam_density, keys.calibration, keys.points) = (usual.beam_density, usual.calibration, usual.points);
            (keys.infrared, keys.glass, keys.red_tail) = (usual.infrared, usual.glass, usual.red_tail);
        }
        if print.as_ref().is_some_and(|print| print.image() == Image::Silver) {
            let [_, green, _] = keys.points;
            (keys.points, keys.print_curves, keys.red_tail) = ([green; 3], usual.print_curves, usual.red_tail);
        }
        if camera.image() == Image::Silver {
            keys.inter_image = InterImageChoice::Film;
        }
        if print.as_ref().unwrap_or(&camera).kind().is_reflective() && keys.projector != Projector::ViewingBooth {
            keys.projector = Projector::Display;
        }
        if keys.film_format.is_none() {
            keys = Self(keys).colours().0;
        }
        if keys.halation == EffectChoice::Off {
            keys.antihalation = usual.antihalation;
        }
        if keys.grain == EffectChoice::Off {
            keys.seed = usual.seed;
        }
        if keys.aim == Aim::Sheet {
            keys.neutral_density = usual.neutral_density;
        }
        if keys.dyes == DyeModel::Literal {
            keys.print_curves = usual.print_curves;
        }
        Ok(Self(keys))
    }
}

/// The name of the usual look of these keys' films among those that are shipped.
///
/// ```
/// use onelight_web::{Keys, look_name};
/// assert_eq!(look_name(&Keys::from_json("{}")?), "kodak-5207 kodak-2383");
/// # Ok::<(), onelight_web::Error>(())
/// ```
#[must_use]
pub fn look_name(keys: &Keys) -> String {
    format!("{} {}", keys.0.camera, keys.0.print.as_deref().unwrap_or("none"))
}

impl From<ProcessKeys> for Keys {
    fn from(keys: ProcessKeys) -> Self {
        Self(keys)
    }
}

/// The words that each control offers, with a line that says what each does, and the programs that looks are baked for.
///
/// ```
/// let choices = onelight_web::choices();
/// assert_eq!(choices["aim"][0]["word"], "neutral");
/// assert!(choices["for"].as_array().is_some_and(|programs| programs.len() > 5));
/// ```
#[must_use]
pub fn choices() -> Value {
    let mut all = Map::new();
    add::<Aim>(&mut all);
    add::<White>(&mut all);
    add::<Projector>(&mut all);
    add::<WideGamut>(&mut all);
    add::<DyeModel>(&mut all);
    add::<PrintCurves>(&mut all);
    add::<Matching>(&mut all);
    add::<EffectChoice>(&mut all);
    add::<Target>(&mut all);
    let formats = FilmFormat::named()
        .map(|(name, format)| json!({ "word": name, "help": format!("{} mm wide", format.width_mm()) }));
    all.insert("film_format".to_owned(), formats.collect());
    Value::Object(all)
}

fn add<T: Word>(all: &mut Map<String, Value>) {
    let words = T::ALL.iter().map(|(_, word, help)| json!({ "word": word, "help": help }));
    all.insert(T::KEY.to_owned(), words.collect());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::films::films;

    #[test]
    fn every_film_takes_the_place_of_every_other() {
        let films = films().unwrap();
        let turned = r#""points": [2, -1, 1], "interimage": "0.3,0.1", "aim": "sheet", "projector": "xenon""#;
        for film in films.iter().filter(|film| film.is_camera) {
            for print in ["kodak-2393", "kodak-2302", "kodak-endura-premier", "kodak-radiance-iii", "none"] {
                let text = format!(r#"{{ "camera": "{}", "print": "{print}", {turned} }}"#, film.id);
                let keys = Keys::from_json(&text).unwrap().fitting().unwrap();
                keys.process().unwrap_or_else(|error| panic!("{} on {print}: {error}", film.id));
                assert_eq!(keys.fitting().unwrap(), keys);
            }
        }
    }

    #[test]
    fn keys_go_there_and_back() {
        let keys = Keys::from_json(r#"{ "camera": "kodak-5219", "aim": "sheet", "overexposure": 1.5 }"#).unwrap();
        assert_eq!(Keys::from_json(&keys.to_json().unwrap()).unwrap(), keys);
        assert_eq!(Keys::from_toml(&keys.to_toml()).unwrap(), keys);
        assert!(Keys::from_json(r#"{ "aims": "sheet" }"#).unwrap_err().to_string().contains("aims"));
    }
}
