//! The films, as the page lists them.

use onelight::{Image, Stock, StockKind, seen_on, stock, stock_ids, usual_print};
use serde::Serialize;

use crate::error::Error;

/// One film or paper: what its data sheet says of it in words, and what it is printed on.
///
/// ```
/// let films = onelight_web::films()?;
/// let velvia = films.iter().find(|film| film.id == "fuji-velvia-50").ok_or("no such film")?;
/// assert!(velvia.is_camera && velvia.usual_print.is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Serialize)]
pub struct Film {
    /// Its id in `look.toml`.
    pub id: String,
    /// The name on the box.
    pub name: String,
    /// Who made it.
    pub maker: String,
    /// What it is for: the `kind` of its data sheet.
    pub kind: &'static str,
    /// The same in words: `reversal film`.
    pub kind_name: &'static str,
    /// Whether its picture is of silver: black and white.
    pub is_silver: bool,
    /// Whether it goes into a camera.
    pub is_camera: bool,
    /// The year of the sheet or of the film.
    pub year: u16,
    /// Its speed; print films have none.
    pub exposure_index: Option<f64>,
    /// The light it is balanced for.
    pub balance: String,
    /// How it is developed.
    pub process: String,
    /// The data sheet.
    pub sheet: String,
    /// What stands in for figures that the sheet does not show, in a few words each.
    pub derived: Vec<&'static str>,
    /// Where the strength of its inter-image effect is from: measured, transferred, assumed; `None` for what has none.
    pub inter_image: Option<&'static str>,
    /// Development times and grades, to be put behind an `@`.
    pub variants: Vec<String>,
    /// What it is seen on, as the key `print` names it: films and papers in the order of the list, and `scan` for a negative.
    pub prints: Vec<String>,
    /// The print of a negative that names none.
    pub usual_print: Option<&'static str>,
}

/// All films and papers, in the order of their list.
///
/// # Errors
/// None: the built-in sheets are read by tests.
pub fn films() -> Result<Vec<Film>, Error> {
    let stocks: Vec<Stock> = stock_ids().map(stock).collect::<Result<_, _>>()?;
    Ok(stocks.iter().map(|film| described(film, &stocks)).collect())
}

fn described(film: &Stock, all: &[Stock]) -> Film {
    let kind = film.kind();
    Film {
        id: film.id().to_owned(),
        name: film.name().to_owned(),
        maker: film.maker().to_owned(),
        kind: kind.word(),
        kind_name: kind.name(),
        is_silver: film.image() == Image::Silver,
        is_camera: kind.is_camera_film(),
        year: film.year(),
        exposure_index: film.exposure_index(),
        balance: film.balance().to_owned(),
        process: film.process().to_owned(),
        sheet: film.sheet().to_owned(),
        derived: film.derived(),
        inter_image: film.inter_image().map(|(_, origin)| origin.word()),
        variants: film.variants().map(str::to_owned).collect(),
        prints: seen_on(film, all).into_iter().map(str::to_owned).collect(),
        usual_print: (kind == StockKind::Negative).then(|| usual_print(film.image())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_usual_print_is_among_the_prints() {
        let films = films().unwrap();
        assert_eq!(films.len(), stock_ids().count());
        for film in films.iter().filter(|film| film.is_camera) {
            let usual = film.usual_print.map(str::to_owned);
            assert_eq!(usual.is_some(), film.kind == "negative", "{}", film.id);
            assert!(usual.is_none_or(|usual| film.prints.contains(&usual)), "{}", film.id);
        }
        assert!(films.iter().all(|film| film.is_camera || film.prints.is_empty()));
    }
}
