//! `stock.toml` as written.

use serde::Deserialize;

use crate::error::{Error, ErrorKind};
use crate::printable::printable;

use super::facts::{ExposureAxis, MidGrey, Normalisation, Origin, StockKind, Uncertainty};
use crate::densitometry::Densitometry;

/// The version of the format that this crate reads.
pub(super) const VERSION: u32 = 1;

/// Most bytes of a `stock.toml`: more than any sheet needs.
const MAX_BYTES: usize = 64 * 1024;
/// Most characters of a reader's message, which may repeat what the file has.
const MESSAGE_CHARACTERS: usize = 300;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Sheet {
    pub(super) version: u32,
    pub(super) id: String,
    pub(super) name: String,
    pub(super) maker: String,
    pub(super) kind: StockKind,
    pub(super) exposure_index: Option<f64>,
    pub(super) balance: String,
    pub(super) process: String,
    pub(super) year: u16,
    pub(super) sheet: String,
    pub(super) sensitivity: SensitivitySection,
    pub(super) characteristic: CharacteristicSection,
    pub(super) dye_density: DyeSection,
    pub(super) aim: Option<AimSection>,
    pub(super) mtf: Option<FigureSection>,
    pub(super) granularity: Option<FigureSection>,
    pub(super) uncertainty: Uncertainty,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SensitivitySection {
    pub(super) origin: Origin,
    pub(super) criterion: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CharacteristicSection {
    pub(super) origin: Origin,
    pub(super) densitometry: Densitometry,
    pub(super) axis: ExposureAxis,
    pub(super) mid_grey: Option<MidGrey>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct DyeSection {
    pub(super) origin: Origin,
    pub(super) normalisation: Normalisation,
    #[serde(default)]
    pub(super) base: f64,
    pub(super) d_min: Option<Origin>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AimSection {
    pub(super) origin: Origin,
    pub(super) status_a: [f64; 3],
}

/// A figure that not every sheet has: `[mtf]`, `[granularity]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FigureSection {
    pub(super) origin: Option<Origin>,
    /// Whose points the digitisation repeats, in words: such figures are refused.
    pub(super) copied_from: Option<String>,
    /// Lowest densities of the curves in the figure of granularity.
    pub(super) d_min: Option<[f64; 3]>,
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
        ("base", Some(sheet.dye_density.base), 0.0..=1.0),
        ("status_a", sheet.aim.as_ref().map(|aim| aim.status_a[0]), 0.0..=5.0),
        ("status_a", sheet.aim.as_ref().map(|aim| aim.status_a[1]), 0.0..=5.0),
        ("status_a", sheet.aim.as_ref().map(|aim| aim.status_a[2]), 0.0..=5.0),
    ];
    let d_min = sheet.granularity.as_ref().and_then(|figure| figure.d_min).unwrap_or_default();
    let numbers = numbers.into_iter().chain(d_min.map(|d| ("d_min", Some(d), 0.0..=5.0)));
    for (name, value, allowed) in numbers {
        if let Some(value) = value
            && !allowed.contains(&value)
        {
            let expected = format!("{name}: found {value}, expected {} to {}", allowed.start(), allowed.end());
            return Err(problem(line_of(text, name), expected));
        }
    }
    let needs = match sheet.kind {
        StockKind::Print if sheet.aim.is_none() => Some("a print film needs [aim]"),
        StockKind::Negative | StockKind::Reversal if sheet.characteristic.mid_grey.is_none() => {
            Some("a camera film needs mid_grey in [characteristic]")
        }
        StockKind::Negative | StockKind::Reversal if sheet.aim.is_some() => Some("only print films have an [aim]"),
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
