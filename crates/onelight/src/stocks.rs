use onelight_film::{SheetText, Stock};

use crate::error::{Error, ErrorKind};
use crate::message::{cut, nearest};

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

#[cfg(test)]
mod tests {
    use super::*;

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
