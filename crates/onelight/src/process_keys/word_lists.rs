//! Keys of `look.toml` whose values are no single word of a list.

use onelight_film::InterImage;
use onelight_printing::Calibration;
use onelight_spatial::{Antihalation, FilmFormat};
use onelight_spectra::SceneWhite;

use crate::error::{Error, ErrorKind};
use crate::message::cut;
use crate::process::{InterImageChoice, SCAN};

/// What `print` is for a word: the id of a film, `scan`, or `None` for `none`.
pub(super) fn parse_print(word: &str) -> Result<Option<String>, Error> {
    match word {
        "none" => Ok(None),
        SCAN => Ok(Some(word.to_owned())),
        _ => match ["none", SCAN].into_iter().find(|meant| word.eq_ignore_ascii_case(meant)) {
            Some(meant) => {
                let expected = format!("the id of a print film, or {meant} (did you mean \"{meant}\"?)");
                Err(ErrorKind::Word { what: "print", found: word.to_owned(), expected }.into())
            }
            None => Ok(Some(word.to_owned())),
        },
    }
}

/// What `calibration` is for a word: `exact`, or a number of iterations.
pub(super) fn parse_calibration(word: &str) -> Result<Calibration, Error> {
    let count = || word.parse().ok().filter(|count| *count <= 30).map(Calibration::Iterations);
    let found = if word == "exact" { Some(Calibration::Exact) } else { count() };
    found.ok_or_else(|| {
        let expected = "exact, or 0 to 30 iterations".to_owned();
        ErrorKind::Word { what: "calibration", found: cut(word), expected }.into()
    })
}

/// What `interimage` is for a word: `film`, `none`, `negative`, `reversal`, or two numbers.
pub(super) fn parse_inter_image(word: &str) -> Result<InterImageChoice, Error> {
    match word {
        "film" => Ok(InterImageChoice::Film),
        _ => Ok(InterImageChoice::Fixed(InterImage::parse(word)?)),
    }
}

/// What `scene_white` is for a word: `none`, or kelvin and a tint.
pub(super) fn parse_scene_white(word: &str) -> Result<Option<SceneWhite>, Error> {
    let numbers: Result<Vec<f64>, _> = word.split(',').map(|number| number.trim().parse()).collect();
    let (kelvin, tint) = match (word, numbers.as_deref()) {
        ("none", _) => return Ok(None),
        (_, Ok(&[kelvin])) => (kelvin, 0.0),
        (_, Ok(&[kelvin, tint])) => (kelvin, tint),
        _ => {
            let expected = "none, or kelvin and a tint such as 3200 or 5600,10".to_owned();
            return Err(ErrorKind::Word { what: "scene_white", found: cut(word), expected }.into());
        }
    };
    Ok(Some(SceneWhite::new(kelvin, tint)?))
}

/// What `film_format` is for a word: a name, a width, or `None` for `none`.
pub(super) fn parse_film_format(word: &str) -> Result<Option<FilmFormat>, Error> {
    match word {
        "none" => Ok(None),
        _ => Ok(Some(word.parse()?)),
    }
}

/// What `antihalation` is for a word: a density, or `none`.
pub(super) fn parse_antihalation(word: &str) -> Result<Antihalation, Error> {
    let density = || word.parse().ok().filter(|d| (0.0..=Antihalation::MAX_DENSITY).contains(d));
    let found = if word == "none" { Some(Antihalation::None) } else { density().map(Antihalation::Density) };
    found.ok_or_else(|| {
        let expected = format!("a density from 0 to {}, or none", Antihalation::MAX_DENSITY);
        ErrorKind::Word { what: "antihalation", found: cut(word), expected }.into()
    })
}

/// `filters`: a list of numbers as words.
pub(super) mod filters {
    use onelight_printing::{Filters, Wratten};
    use serde::{Deserialize, Deserializer, Serializer, de};

    use crate::word::Word;

    pub(crate) fn serialize<S: Serializer>(filters: &Filters, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(filters.iter().map(Word::word))
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Filters, D::Error> {
        let words = Vec::<String>::deserialize(deserializer)?;
        let filters: Result<Vec<Wratten>, _> = words.iter().map(|word| Wratten::parse(word)).collect();
        Ok(Filters::of(&filters.map_err(de::Error::custom)?))
    }
}

/// `calibration`: `"exact"`, or a number of iterations.
pub(super) mod calibration {
    use onelight_printing::Calibration;
    use serde::{Deserialize, Deserializer, Serializer, de};

    pub(crate) fn serialize<S: Serializer>(calibration: &Calibration, serializer: S) -> Result<S::Ok, S::Error> {
        match calibration {
            Calibration::Exact => serializer.serialize_str("exact"),
            Calibration::Iterations(count) => serializer.collect_str(count),
        }
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Calibration, D::Error> {
        super::parse_calibration(&String::deserialize(deserializer)?).map_err(de::Error::custom)
    }
}

/// `interimage`: `"film"`, `"none"`, `"negative"`, `"reversal"`, or two numbers as `"0.6,0.06"`.
pub(super) mod inter_image {
    use serde::{Deserialize, Deserializer, Serializer, de};

    use crate::process::InterImageChoice;

    pub(crate) fn serialize<S: Serializer>(choice: &InterImageChoice, serializer: S) -> Result<S::Ok, S::Error> {
        match choice {
            InterImageChoice::Film => serializer.serialize_str("film"),
            InterImageChoice::Fixed(fixed) => serializer.collect_str(fixed),
        }
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<InterImageChoice, D::Error> {
        super::parse_inter_image(&String::deserialize(deserializer)?).map_err(de::Error::custom)
    }
}

/// `scene_white`: `"none"`, or kelvin and a tint as `"3200"` or `"5600,10"`.
pub(super) mod scene_white {
    use onelight_spectra::SceneWhite;
    use serde::{Deserialize, Deserializer, Serializer, de};

    #[expect(clippy::ref_option, reason = "the signature serde asks for")]
    pub(crate) fn serialize<S: Serializer>(white: &Option<SceneWhite>, serializer: S) -> Result<S::Ok, S::Error> {
        match white {
            None => serializer.serialize_str("none"),
            Some(white) if white.tint() == 0.0 => serializer.collect_str(&white.kelvin()),
            Some(white) => serializer.collect_str(&format_args!("{},{}", white.kelvin(), white.tint())),
        }
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<SceneWhite>, D::Error> {
        super::parse_scene_white(&String::deserialize(deserializer)?).map_err(de::Error::custom)
    }
}

/// `film_format`: a name, a width such as `"24.9mm"`, or `"none"`.
pub(super) mod film_format {
    use onelight_spatial::FilmFormat;
    use serde::{Deserialize, Deserializer, Serializer, de};

    #[expect(clippy::ref_option, reason = "the signature serde asks for")]
    pub(crate) fn serialize<S: Serializer>(format: &Option<FilmFormat>, serializer: S) -> Result<S::Ok, S::Error> {
        match format {
            Some(format) => serializer.collect_str(format),
            None => serializer.serialize_str("none"),
        }
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<FilmFormat>, D::Error> {
        super::parse_film_format(&String::deserialize(deserializer)?).map_err(de::Error::custom)
    }
}

/// `antihalation`: a density, or `"none"`.
pub(super) mod antihalation {
    use onelight_spatial::Antihalation;
    use serde::{Deserialize, Deserializer, Serializer, de};

    pub(crate) fn serialize<S: Serializer>(layer: &Antihalation, serializer: S) -> Result<S::Ok, S::Error> {
        match layer {
            Antihalation::Density(density) => serializer.collect_str(density),
            Antihalation::None => serializer.serialize_str("none"),
        }
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Antihalation, D::Error> {
        super::parse_antihalation(&String::deserialize(deserializer)?).map_err(de::Error::custom)
    }
}

/// `print`: an id, `"scan"` or `"none"`.
pub(super) mod print {
    use serde::{Deserialize, Deserializer, Serializer, de};

    #[expect(clippy::ref_option, reason = "the signature serde asks for")]
    pub(crate) fn serialize<S: Serializer>(print: &Option<String>, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(print.as_deref().unwrap_or("none"))
    }

    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<String>, D::Error> {
        super::parse_print(&String::deserialize(deserializer)?).map_err(de::Error::custom)
    }
}
