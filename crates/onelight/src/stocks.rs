use onelight_film::{SheetText, Stock};

use crate::error::{Error, ErrorKind};
use crate::message::{PART_CHARACTERS, cut, nearest};

/// The ids of all built-in stocks: camera films, print films, papers. Those with variants (development times, grades) are listed by
/// their usual one; [`Stock::variants`] names the others.
pub fn stock_ids() -> impl Iterator<Item = &'static str> {
    onelight_stocks::ALL.iter().map(|sheet| sheet.id)
}

/// A built-in stock by its id, after an `@` a variant of it.
///
/// ```
/// assert_eq!(onelight::stock("kodak-portra-800@push-1")?.exposure_index(), Some(1600.0));
/// assert_eq!(onelight::stock("kodak-2383")?.process(), "ECP-2D");
/// let error = onelight::stock("kodak-5270").unwrap_err();
/// assert!(error.to_string().contains("kodak-5277") || error.to_string().contains("kodak-5207"));
/// # Ok::<(), onelight::Error>(())
/// ```
///
/// # Errors
/// If there is none (the message names the nearest if one is near), or it has no such variant.
pub fn stock(id: &str) -> Result<Stock, Error> {
    let folder = id.split_once('@').map_or(id, |(folder, _)| folder);
    let Some(files) = onelight_stocks::find(folder) else {
        return Err(ErrorKind::UnknownStock { found: cut(id), nearest: nearest(folder, stock_ids()) }.into());
    };
    Ok(Stock::parse(&SheetText {
        id,
        stock_toml: files.stock_toml,
        sensitivity_csv: files.sensitivity_csv,
        characteristic_csv: files.characteristic_csv,
        dye_density_csv: files.dye_density_csv,
    })?
    .with_figures(files.mtf_csv, files.granularity_csv)?)
}

/// The built-in stock that people mean by its id or by a part of its name, such as `velvia`, `Portra 400`, `5207` or
/// `portra-800@push-2`: small letters and capitals, spaces and hyphens are the same.
///
/// Where a part fits several, one that has it as whole words goes before one that does not, and one that `is_wanted` before others. Files should
/// hold the id: another year's list may have a second film that fits.
///
/// ```
/// use onelight::stock_named;
/// assert_eq!(stock_named("velvia", |_| true)?.id(), "fuji-velvia-50");
/// assert_eq!(stock_named("portra 800@push-2", |_| true)?.id(), "kodak-portra-800@push-2");
/// // Three films and a paper have it in their names; one of them is to print on.
/// let error = stock_named("portra", |stock| stock.kind().is_camera_film()).unwrap_err();
/// assert!(error.to_string().contains("kodak-portra-160, kodak-portra-400 and kodak-portra-800"));
/// assert_eq!(stock_named("portra", |stock| !stock.kind().is_camera_film())?.id(), "kodak-portra-endura");
/// # Ok::<(), onelight::Error>(())
/// ```
///
/// # Errors
/// If nothing fits, or several do: the message names them. A part has at least three letters or digits.
pub fn stock_named(name: &str, is_wanted: impl Fn(&Stock) -> bool) -> Result<Stock, Error> {
    let (film, variant) = name.split_once('@').map_or((name, None), |(film, variant)| (film, Some(variant)));
    let found = match onelight_stocks::find(film) {
        Some(_) => stock(film)?,
        None => only_one_named(name, film, is_wanted)?,
    };
    let Some(part) = variant else { return Ok(found) };
    let all: Vec<&str> = found.variants().collect();
    let exact = all.contains(&part);
    let fits: Vec<&str> =
        all.into_iter().filter(|name| !letters(part).is_empty() && letters(name).contains(&letters(part))).collect();
    let variant = match fits[..] {
        [only] if !exact => only,
        [_, _, ..] if !exact => {
            return Err(several(name, fits.iter().map(|fit| format!("{}@{fit}", found.id())).collect()));
        }
        // Where there is none, the message names all variants.
        _ => part,
    };
    stock(&format!("{}@{variant}", found.id()))
}

/// The stock that a part of a name fits, without variants.
fn only_one_named(name: &str, film: &str, is_wanted: impl Fn(&Stock) -> bool) -> Result<Stock, Error> {
    let part = letters(film);
    let mut fits: Vec<&'static str> = match part.chars().count() {
        PART_CHARACTERS.. => stock_ids().filter(|id| letters(id).contains(&part)).collect(),
        _ => Vec::new(),
    };
    if fits.iter().any(|id| has_words(id, &part)) {
        fits.retain(|id| has_words(id, &part));
    }
    let mut fits: Vec<Stock> = fits.into_iter().map(stock).collect::<Result<_, _>>()?;
    if fits.iter().any(&is_wanted) {
        fits.retain(&is_wanted);
    }
    match fits.len() {
        0 => Err(ErrorKind::UnknownStock { found: cut(name), nearest: nearest(film, stock_ids()) }.into()),
        1 => Ok(fits.remove(0)),
        _ => Err(several(name, fits.iter().map(|stock| stock.id().to_owned()).collect())),
    }
}

fn several(name: &str, fits: Vec<String>) -> Error {
    ErrorKind::SeveralStocks { found: cut(name), fits }.into()
}

/// A name without what people leave out or write differently.
fn letters(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// Whether some words of an id in a row, written as one, are `part`.
fn has_words(id: &str, part: &str) -> bool {
    let words: Vec<&str> = id.split('-').collect();
    (0..words.len()).any(|first| (first..words.len()).any(|last| words[first..=last].concat() == part))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_of_a_name_is_enough_where_it_fits_one() {
        let camera = |stock: &Stock| stock.kind().is_camera_film();
        for (name, expected) in [
            ("kodak-5207", "kodak-5207"),
            ("5207", "kodak-5207"),
            ("Velvia", "fuji-velvia-50"),
            ("velvia50", "fuji-velvia-50"),
            ("Portra 400", "kodak-portra-400"),
            ("tri-x", "kodak-tri-x-400"),
            ("max 400", "kodak-ultramax-400"),
            ("portra-800@push-1", "kodak-portra-800@push-1"),
            ("portra-800@2", "kodak-portra-800@push-2"),
        ] {
            assert_eq!(stock_named(name, camera).unwrap().id(), expected, "{name}");
        }
        for (name, expected) in
            [("2383", "kodak-2383"), ("portra", "kodak-portra-endura"), ("polymax", "kodak-polymax-fine-art")]
        {
            assert_eq!(stock_named(name, |stock| !camera(stock)).unwrap().id(), expected, "{name}");
        }
        // What is not wanted is still found, so that a message can say what it is.
        assert_eq!(stock_named("2383", camera).unwrap().id(), "kodak-2383");
    }

    #[test]
    fn every_id_and_every_variant_names_itself() {
        for id in stock_ids() {
            let usual = stock_named(id, |_| true).unwrap();
            assert_eq!(usual.id(), id);
            for variant in usual.variants() {
                let id = format!("{id}@{variant}");
                assert_eq!(stock_named(&id, |_| true).unwrap().id(), stock(&id).unwrap().id());
            }
        }
    }

    #[test]
    fn several_that_fit_are_all_named() {
        for (name, expected) in [
            ("pro-160", "\"pro-160\" fits fuji-pro-160c and fuji-pro-160s, expected more of one of these names"),
            ("portra-800@push", "fits kodak-portra-800@push-1 and kodak-portra-800@push-2, expected"),
            ("kodak", "and 2"),
            ("kodakchrome", "no stock is called \"kodakchrome\"; the nearest is kodak-kodachrome-64"),
            ("eterna-500", "fits fuji-eterna-500 and fuji-eterna-500-vivid"),
            ("50", "no stock is called \"50\""),
            ("---", "no stock is called \"---\""),
            ("5207@push", "kodak-5207: no variant"),
        ] {
            let error = stock_named(name, |_| true).unwrap_err();
            assert!(error.to_string().contains(expected), "{name}: {error}");
            assert!(error.to_string().len() < 400, "{error}");
        }
    }

    #[test]
    fn what_is_alike_is_suggested_and_nothing_else() {
        for (found, expected) in [
            ("kodak-5270", "kodak-5207"),
            ("KODAK-5219", "kodak-5219"),
            ("kodak5213", "kodak-5213"),
            ("5207", "kodak-5207"),
            ("2393", "kodak-2393"),
            ("velvia", "fuji-velvia-50"),
            ("velvia50", "fuji-velvia-50"),
            ("ektar", "kodak-ektar-100"),
            ("kodakchrome", "kodak-kodachrome-64"),
            ("eterna-500", "fuji-eterna-500"),
        ] {
            let nearest = nearest(found, stock_ids());
            assert!(
                nearest == Some(expected) || found == "kodak-5270" && nearest == Some("kodak-5277"),
                "{found}: {nearest:?}"
            );
        }
        for found in
            ["", " ", "x", "hello", "ultrafine", "konica", "no such stock", "none", "\u{4e00}", "\"", "look.toml"]
        {
            assert_eq!(nearest(found, stock_ids()), None, "{found}");
            assert_eq!(
                stock(found).unwrap_err().to_string(),
                format!("no stock is called {found:?}, expected a maker and a number, such as kodak-5207")
            );
        }
    }

    #[test]
    fn a_message_repeats_no_more_than_the_beginning() {
        let error = stock(&"kodak-5207".repeat(1000)).unwrap_err();
        assert!(error.is_unknown_stock() && error.to_string().len() < 200, "{error}");
        assert!(stock(&"x".repeat(65)).unwrap_err().to_string().contains(&format!("\"{}\"", "x".repeat(64))));
    }
}
