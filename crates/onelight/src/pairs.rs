//! What is usually printed on what.

use onelight_film::{Stock, StockKind};

use crate::error::Error;
use crate::process::{FilmProcess, Printing, SCAN};
use crate::stocks::{stock, stock_ids};

/// What a film can be seen on, as the key `print` of `look.toml` names it: everything of a list that it is usually printed on, and for a
/// negative `scan`.
///
/// ```
/// use onelight::{seen_on, stock};
/// let stocks = [stock("kodak-2383")?, stock("kodak-polymax-fine-art")?, stock("kodak-endura-premier")?];
/// assert_eq!(seen_on(&stock("kodak-5207")?, &stocks), ["kodak-2383", "kodak-endura-premier", "scan"]);
/// assert!(seen_on(&stock("fuji-velvia-50")?, &stocks).is_empty());
/// # Ok::<(), onelight::Error>(())
/// ```
#[must_use]
pub fn seen_on<'a>(camera: &Stock, stocks: &'a [Stock]) -> Vec<&'a str> {
    let prints = stocks.iter().filter(|print| camera.is_printed_on(print)).map(Stock::id);
    prints.chain((camera.kind() == StockKind::Negative).then_some(SCAN)).collect()
}

/// Every camera film of a list as it is seen without a print, reversal film itself and a negative scanned, and on everything of the list
/// that it is usually printed on.
///
/// ```
/// use onelight::stock;
/// let stocks = [stock("kodak-5207")?, stock("kodak-2383")?, stock("fuji-velvia-50")?];
/// let names = |(camera, print): &(&onelight::Stock, Option<&onelight::Stock>)| {
///     (camera.id().to_owned(), print.map(|print| print.id().to_owned()))
/// };
/// let found: Vec<_> = onelight::pairs(&stocks).iter().map(names).collect();
/// let negative = || "kodak-5207".to_owned();
/// assert_eq!(found, [(negative(), None), (negative(), Some("kodak-2383".into())), ("fuji-velvia-50".into(), None)]);
/// # Ok::<(), onelight::Error>(())
/// ```
#[must_use]
pub fn pairs(stocks: &[Stock]) -> Vec<(&Stock, Option<&Stock>)> {
    let mut pairs = Vec::new();
    for camera in stocks.iter().filter(|stock| stock.kind().is_camera_film()) {
        pairs.push((camera, None));
        pairs.extend(stocks.iter().filter(|print| camera.is_printed_on(print)).map(|print| (camera, Some(print))));
    }
    pairs
}

/// The looks of all [`pairs`] of built-in stocks that one of `chosen` is in, and each variant of those once.
///
/// ```
/// let paper = [onelight::stock("kodak-endura-premier")?];
/// let looks = onelight::looks_with(&paper)?;
/// assert!(looks.len() > 10 && looks.iter().all(|look| look.print.is_some()));
/// # Ok::<(), onelight::Error>(())
/// ```
///
/// # Errors
/// None for the built-in stocks.
pub fn looks_with(chosen: &[Stock]) -> Result<Vec<FilmProcess>, Error> {
    let all: Vec<Stock> = stock_ids().map(stock).collect::<Result<_, _>>()?;
    let is_chosen = |stock: &Stock| chosen.iter().any(|chosen| chosen.id() == stock.id());
    let with_chosen =
        pairs(&all).into_iter().filter(|(camera, print)| is_chosen(camera) || print.is_some_and(is_chosen));
    let mut looks: Vec<_> = with_chosen.map(|(camera, print)| look(camera, print.map(Stock::id))).collect();
    for of in chosen {
        for variant in of.variants().map(|variant| format!("{}@{variant}", of.id())) {
            // The usual one goes by the name of the stock.
            if stock(&variant)?.id() == of.id() {
                continue;
            }
            if of.kind().is_camera_film() {
                looks.push(FilmProcess::for_camera(&variant)?);
            } else if let Some(camera) = all.iter().find(|camera| camera.is_printed_on(of)) {
                looks.push(look(camera, Some(&variant)));
            }
        }
    }
    Ok(looks)
}

/// A film on a print, or without one.
fn look(camera: &Stock, print: Option<&str>) -> FilmProcess {
    match print {
        None if camera.kind() == StockKind::Negative => FilmProcess::scanned(camera.id()),
        print => FilmProcess { camera: camera.id().into(), print: print.map(Printing::on), ..FilmProcess::default() },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::process::Process;

    #[test]
    fn a_chosen_paper_is_seen_behind_every_negative() {
        let paper = [stock("kodak-endura-premier").unwrap()];
        let negatives = stock_ids().map(|id| stock(id).unwrap()).filter(|film| film.is_printed_on(&paper[0])).count();
        assert_eq!(looks_with(&paper).unwrap().len(), negatives);
    }

    #[test]
    fn every_look_is_there_once() {
        let all: Vec<Stock> = stock_ids().map(|id| stock(id).unwrap()).collect();
        let looks = looks_with(&all).unwrap().into_iter();
        let mut names: Vec<String> = looks.map(|look| Process::from(look).name()).collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count);
    }
}
