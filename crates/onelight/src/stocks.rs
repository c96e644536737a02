use onelight_film::{SheetText, Stock};

use crate::error::{Error, Kind};

/// The ids of all built-in stocks: negatives, reversal films, print films.
pub fn stock_ids() -> impl Iterator<Item = &'static str> {
    onelight_stocks::ALL.iter().map(|sheet| sheet.id)
}

/// A built-in stock by its id.
///
/// ```
/// assert_eq!(onelight::stock("kodak-2383")?.process(), "ECP-2D");
/// let error = onelight::stock("kodak-5270").unwrap_err();
/// assert!(error.to_string().contains("kodak-5277") || error.to_string().contains("kodak-5207"));
/// # Ok::<(), onelight::Error>(())
/// ```
///
/// # Errors
/// If there is none (the message names the nearest).
pub fn stock(id: &str) -> Result<Stock, Error> {
    let Some(files) = onelight_stocks::find(id) else {
        let nearest = nearest(id, stock_ids()).unwrap_or("kodak-5207").to_owned();
        return Err(Kind::UnknownStock { found: id.to_owned(), nearest }.into());
    };
    Ok(Stock::parse(&SheetText {
        id: files.id,
        stock_toml: files.stock_toml,
        sensitivity_csv: files.sensitivity_csv,
        characteristic_csv: files.characteristic_csv,
        dye_density_csv: files.dye_density_csv,
    })?)
}

/// The candidate that looks most like `found`.
pub(crate) fn nearest<'a>(found: &str, candidates: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    // Beyond a word's length nothing more can be mistyped; it also bounds the work on hostile input.
    let found: String = found.chars().take(64).collect::<String>().to_lowercase();
    candidates.max_by(|a, b| strsim::jaro_winkler(&found, a).total_cmp(&strsim::jaro_winkler(&found, b)))
}
