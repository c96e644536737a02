//! `stock.toml` as written.

use serde::Deserialize;

use crate::error::{Error, ErrorKind};
use crate::inter_image::{InterImage, InterImageOrigin};
use crate::printable::printable;

use super::facts::{ExposureAxis, FilmSize, Image, MidGrey, Normalisation, Origin, StockKind, Uncertainty};
use crate::curve::Direction;
use crate::densitometry::Densitometry;

/// The version of the format that this crate reads.
pub(super) const VERSION: u32 = 1;

/// Most bytes of a `stock.toml`: more than any sheet needs.
const MAX_BYTES: usize = 64 * 1024;
/// Most characters of a reader's message, which may repeat what the file has.
const MESSAGE_CHARACTERS: usize = 300;

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Sheet {
    pub(super) version: u32,
    pub(super) id: String,
    pub(super) name: String,
    pub(super) maker: String,
    pub(super) kind: StockKind,
    #[serde(default)]
    pub(super) image: Image,
    pub(super) exposure_index: Option<f64>,
    pub(super) balance: String,
    pub(super) process: String,
    #[serde(default)]
    pub(super) formats: Vec<FilmSize>,
    pub(super) year: u16,
    pub(super) sheet: String,
    pub(super) sensitivity: SensitivitySection,
    pub(super) characteristic: CharacteristicSection,
    pub(super) dye_density: Option<DyeSection>,
    pub(super) aim: Option<AimSection>,
    pub(super) mtf: Option<FigureSection>,
    pub(super) granularity: Option<FigureSection>,
    /// Name of the curves without an `@`; a stock with variants may leave it out.
    pub(super) usual_variant: Option<String>,
    #[serde(default)]
    pub(super) variant: Vec<VariantSection>,
    pub(super) inter_image: Option<InterImageSection>,
    pub(super) uncertainty: Uncertainty,
}

/// Other curves of the same stock: a development time, a grade of paper.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct VariantSection {
    pub(super) name: String,
    pub(super) exposure_index: Option<f64>,
    pub(super) process: Option<String>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SensitivitySection {
    pub(super) origin: Origin,
    pub(super) criterion: Option<f64>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CharacteristicSection {
    pub(super) origin: Origin,
    pub(super) densitometry: Densitometry,
    pub(super) axis: ExposureAxis,
    pub(super) mid_grey: Option<MidGrey>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DyeSection {
    pub(super) origin: Origin,
    pub(super) normalisation: Normalisation,
    #[serde(default)]
    pub(super) base: f64,
    pub(super) d_min: Option<Origin>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AimSection {
    pub(super) origin: Origin,
    /// Of a picture in dye: red, green, blue.
    pub(super) status_a: Option<[f64; 3]>,
    /// Of a picture in silver.
    pub(super) visual: Option<f64>,
}

impl AimSection {
    /// The one of the two that is there.
    pub(super) fn densities(&self) -> [f64; 3] {
        self.status_a.or_else(|| self.visual.map(|d| [d; 3])).unwrap_or_default()
    }
}

/// A figure that not every sheet has: `[mtf]`, `[granularity]`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FigureSection {
    pub(super) origin: Option<Origin>,
    /// Whose points the digitisation repeats, in words: such figures are refused.
    pub(super) copied_from: Option<String>,
    /// Lowest densities of the curves in the figure of granularity.
    pub(super) d_min: Option<[f64; 3]>,
}

impl Sheet {
    /// The variant that is asked for, `None` for the usual one; its speed and process become the stock's.
    pub(super) fn choose(&mut self, asked: Option<&str>) -> Result<Option<String>, Error> {
        let Some(asked) = asked else { return Ok(None) };
        if self.usual_variant.as_deref() == Some(asked) {
            return Ok(None);
        }
        let Some(variant) = self.variant.iter().find(|variant| variant.name == asked) else {
            let names: Vec<&str> =
                self.usual_variant.iter().chain(self.variant.iter().map(|v| &v.name)).map(String::as_str).collect();
            let expected = if names.is_empty() { "none".to_owned() } else { names.join(", ") };
            let found = format!("no variant is called {:?}, expected {expected}", printable(asked, 40));
            return Err(Error::stock(&self.id, found));
        };
        self.exposure_index = variant.exposure_index.or(self.exposure_index);
        if let Some(process) = &variant.process {
            self.process.clone_from(process);
        }
        Ok(Some(variant.name.clone()))
    }
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct InterImageSection {
    pub(super) near: f64,
    pub(super) far: f64,
    pub(super) origin: InterImageOrigin,
}

pub(super) fn parse(file: &str, text: &str) -> Result<Sheet, Error> {
    let problem = |line: u64, problem: String| Error::from(ErrorKind::Sheet { file: file.to_owned(), line, problem });
    if text.len() > MAX_BYTES {
        return Err(problem(1, format!("{} bytes, expected at most {MAX_BYTES}", text.len())));
    }
    let sheet: Sheet = toml::from_str(text).map_err(|error| {
        let start = error.span().map_or(0, |span| span.start);
        let line = text.bytes().take(start).filter(|byte| *byte == b'\n').count() as u64 + 1;
        problem(line, printable(error.message().trim_end(), MESSAGE_CHARACTERS))
    })?;
    if sheet.version != VERSION {
        return Err(problem(line_of(text, "version"), format!("version: found {}, expected {VERSION}", sheet.version)));
    }
    let numbers = [
        ("exposure_index", sheet.exposure_index, 0.1..=1e6),
        ("criterion", sheet.sensitivity.criterion, 0.01..=3.0),
        ("base", sheet.dye_density.as_ref().map(|dyes| dyes.base), 0.0..=1.0),
        ("near", sheet.inter_image.as_ref().map(|pair| pair.near), 0.0..=InterImage::MAX),
        ("far", sheet.inter_image.as_ref().map(|pair| pair.far), 0.0..=InterImage::MAX),
    ];
    let aim = sheet.aim.as_ref().map(AimSection::densities).unwrap_or_default();
    let aim = aim.map(|d| (if sheet.image == Image::Silver { "visual" } else { "status_a" }, Some(d), 0.0..=5.0));
    let speeds = sheet.variant.iter().map(|variant| ("exposure_index", variant.exposure_index, 0.1..=1e6));
    let d_min = sheet.granularity.as_ref().and_then(|figure| figure.d_min).unwrap_or_default();
    let numbers = numbers.into_iter().chain(aim).chain(speeds).chain(d_min.map(|d| ("d_min", Some(d), 0.0..=5.0)));
    for (name, value, allowed) in numbers {
        if let Some(value) = value
            && !allowed.contains(&value)
        {
            let expected = format!("{name}: found {value}, expected {} to {}", allowed.start(), allowed.end());
            return Err(problem(line_of(text, name), expected));
        }
    }
    if let Some(name) = unusable_variant(&sheet) {
        let found = format!("variant: found {:?}, expected names of their own: {VARIANT_NAMES}", printable(name, 40));
        return Err(problem(line_of(text, "[[variant"), found));
    }
    let visual = sheet.characteristic.densitometry == Densitometry::Visual;
    let needs = match sheet.kind.is_camera_film() {
        false if sheet.aim.is_none() => Some("what is printed on needs [aim]"),
        true if sheet.characteristic.mid_grey.is_none() => Some("a camera film needs mid_grey in [characteristic]"),
        true if sheet.aim.is_some() => Some("only what is printed on has an [aim]"),
        _ if (sheet.image == Image::Silver) != visual => {
            Some("image = \"silver\" and densitometry = \"visual\" go together")
        }
        _ if (sheet.image == Image::Silver) != sheet.dye_density.is_none() => {
            Some("a picture in dye needs [dye_density], one in silver has none")
        }
        _ if sheet.image == Image::Silver && sheet.kind.direction() == Direction::Falling => {
            Some("a picture in silver is of kind negative, print or paper")
        }
        _ if sheet
            .aim
            .as_ref()
            .is_some_and(|aim| aim.visual.is_some() != visual || aim.status_a.is_some() == visual) =>
        {
            Some("[aim] needs visual for a picture in silver, else status_a")
        }
        _ if sheet.characteristic.mid_grey == Some(MidGrey::Speed) && sheet.exposure_index.is_none() => {
            Some("mid_grey = \"speed\" needs an exposure_index")
        }
        _ => None,
    };
    match needs {
        Some(needed) => Err(problem(line_of(text, "kind"), needed.to_owned())),
        None => Ok(sheet),
    }
}

/// What a variant may be called.
const VARIANT_NAMES: &str = "1 to 32 of a-z, 0-9 and -";

/// The first variant with a name that cannot be written after an `@`, or that is there twice.
fn unusable_variant(sheet: &Sheet) -> Option<&str> {
    let names: Vec<&str> =
        sheet.usual_variant.iter().map(String::as_str).chain(sheet.variant.iter().map(|v| v.name.as_str())).collect();
    let fits = |name: &str| {
        (1..=32).contains(&name.len())
            && name.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-')
    };
    (0..names.len()).find(|&i| !fits(names[i]) || names[..i].contains(&names[i])).map(|i| names[i])
}

/// Line of the first assignment to `key`, 1 if there is none.
fn line_of(text: &str, key: &str) -> u64 {
    (1..).zip(text.lines()).find(|(_, line)| line.trim_start().starts_with(key)).map_or(1, |(number, _)| number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sheet_of_a_million_lines_is_refused() {
        let error = parse("film/stock.toml", &"version = 1\n".repeat(1_000_000)).unwrap_err();
        assert_eq!(error.to_string(), "film/stock.toml:1: 12000000 bytes, expected at most 65536");
    }

    #[test]
    fn a_message_repeats_no_more_than_the_beginning() {
        let key = "k\u{e4}".repeat(9000);
        for text in [format!("version = 1\n{key} = 1\n"), format!("version = \"{key}\"\n"), format!("kind = '{key}'\n")]
        {
            let sentence = parse("film/stock.toml", &text).unwrap_err().to_string();
            assert!(sentence.len() < 700 && sentence.starts_with("film/stock.toml:"), "{sentence}");
        }
    }
}
