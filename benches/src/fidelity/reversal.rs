//! Which figures make one reversal film's colours stronger than another's.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use onelight::film::{SheetText, Stock};
use onelight::{FilmProcess, Films, InterImageChoice, Reference};
use onelight_stocks::DataSheet;

use super::chart::Scene;
use super::greys;
use super::negative::ALONE;
use crate::error::{Error, Result};

/// The films that are ordered, and whose figures are lent to the others.
pub(super) const FILMS: [&str; 3] = ["kodak-ektachrome-100", "fuji-velvia-50", "fuji-provia-100f"];
/// The film whose figures the others borrow, and that borrows theirs.
pub(super) const LENDER: &str = "fuji-provia-100f";

/// Median chroma of the chart, and gamma at a grey card, on a film of mixed figures.
#[derive(Debug, Clone, Copy)]
pub(super) struct Strength {
    pub(super) chroma: f64,
    pub(super) gamma: f64,
}

/// A film and what exchanging one set of its figures makes of it.
#[derive(Debug, Clone)]
pub(super) struct Exchanged {
    pub(super) id: &'static str,
    pub(super) own: Strength,
    /// With the lender's sensitivities, characteristic curves, dyes; cyan, magenta, yellow dye alone.
    pub(super) lent: [Strength; 6],
    /// Layers that do not inhibit each other.
    pub(super) alone: Strength,
}

/// Every film as it is, and with each set of figures of [`LENDER`].
pub(super) fn all(scene: &Scene) -> Result<Vec<Exchanged>> {
    let lender = sheet(LENDER)?;
    let mut found = Vec::new();
    for id in FILMS {
        let own = sheet(id)?;
        let strength = |film: Stock, inter_image| {
            let process = FilmProcess { inter_image, ..FilmProcess::for_camera(film.id())? };
            Ok::<_, Error>(of(scene, &process.compile_with(&Films { camera: film, print: None })?))
        };
        let lent = |film| strength(film, InterImageChoice::Film);
        let dyes = [CYAN, MAGENTA, YELLOW].map(|dye| mixed_dyes(own, lender, &[dye]));
        let [cyan, magenta, yellow] = dyes;
        found.push(Exchanged {
            id,
            own: lent(mixed(own, own)?)?,
            lent: [
                lent(mixed(lender, own)?)?,
                lent(mixed(own, lender)?)?,
                lent(mixed_dyes(own, lender, &[CYAN, MAGENTA, YELLOW])?)?,
                lent(cyan?)?,
                lent(magenta?)?,
                lent(yellow?)?,
            ],
            alone: strength(mixed(own, own)?, ALONE)?,
        });
    }
    Ok(found)
}

fn of(scene: &Scene, look: &Reference) -> Strength {
    Strength { chroma: scene.chart(|_, rgb| look.develop_linear(rgb)).median_chroma(), gamma: greys::gamma(look) }
}

fn sheet(id: &str) -> Result<&'static DataSheet> {
    onelight_stocks::find(id).ok_or_else(|| Error::new(format!("no stock {id}")))
}

/// A film of one's sensitivities and another's characteristic curves, with the dyes of whichever is not [`LENDER`].
fn mixed(sensitivity: &DataSheet, curves: &DataSheet) -> Result<Stock> {
    let own = if sensitivity.id == LENDER { curves } else { sensitivity };
    let toml = with_section(own.stock_toml, curves.stock_toml, "characteristic");
    let text = SheetText {
        id: own.id,
        stock_toml: &toml,
        sensitivity_csv: sensitivity.sensitivity_csv,
        characteristic_csv: curves.characteristic_csv,
        dye_density_csv: own.dye_density_csv,
    };
    Stock::parse(&text).map_err(|error| Error::of(own.id, error))
}

/// Columns of a file of dyes.
const CYAN: usize = 1;
const MAGENTA: usize = 2;
const YELLOW: usize = 3;

/// A film with some of its dyes exchanged for the lender's. How strong a unit of dye is does not matter: amounts are those that make
/// the film's own grey scale.
fn mixed_dyes(own: &DataSheet, lender: &DataSheet, columns: &[usize]) -> Result<Stock> {
    let toml = with_section(own.stock_toml, lender.stock_toml, "dye_density");
    let csv = with_columns(own.dye_density_csv, lender.dye_density_csv, columns);
    let text = SheetText {
        id: own.id,
        stock_toml: &toml,
        sensitivity_csv: own.sensitivity_csv,
        characteristic_csv: own.characteristic_csv,
        dye_density_csv: &csv,
    };
    Stock::parse(&text).map_err(|error| Error::of(own.id, error))
}

/// A table over wavelength with some columns of another, and without what is left of its neutral, which is no longer one; blank where
/// either ends.
fn with_columns(csv: &str, other: &str, columns: &[usize]) -> String {
    let rows = |csv: &str| -> BTreeMap<u32, Vec<String>> {
        let cells = csv.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
        cells.filter_map(|cells| Some((cells[0].parse().ok()?, cells))).collect()
    };
    let (own, other) = (rows(csv), rows(other));
    let mut mixed = "wavelength_nm,cyan,magenta,yellow,d_min,neutral\n".to_owned();
    for nm in own.keys().chain(other.keys()).collect::<BTreeSet<_>>() {
        let of = |rows: &BTreeMap<u32, Vec<String>>, column: usize| {
            rows.get(nm).map_or_else(String::new, |row| row[column].clone())
        };
        let dyes =
            [CYAN, MAGENTA, YELLOW].map(|column| of(if columns.contains(&column) { &other } else { &own }, column));
        let _ = writeln!(mixed, "{nm},{},,", dyes.join(","));
    }
    mixed
}

/// A stock.toml with one section of another.
fn with_section(toml: &str, other: &str, name: &str) -> String {
    let header = format!("[{name}]");
    let range = |text: &str| {
        let start = text.find(&header).unwrap_or(text.len());
        let end = text[start..].find("\n[").map_or(text.len(), |length| start + length);
        start..end
    };
    let mut mixed = toml.to_owned();
    mixed.replace_range(range(toml), &other[range(other)]);
    mixed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_film_of_its_own_figures_is_itself() {
        for id in FILMS {
            let own = sheet(id).unwrap();
            let mixed = mixed(own, own).unwrap();
            let process = FilmProcess::for_camera(id).unwrap();
            let film = process.compile_with(&Films { camera: mixed, print: None }).unwrap();
            let rgb = [0.4, 0.1, 0.05];
            assert_eq!(film.develop(rgb), process.compile().unwrap().develop(rgb), "{id}");
        }
    }

    #[test]
    fn sections_are_exchanged_and_nothing_else() {
        let (mine, other) = ("a = 1\n\n[x]\nb = 1\n\n[y]\nc = 1\n", "[w]\nq = 1\n\n[x]\nb = 2\n");
        assert_eq!(with_section(mine, other, "x"), "a = 1\n\n[x]\nb = 2\n\n[y]\nc = 1\n");
    }

    /// What docs/measured.md says of them: the dyes make the order, cyan most of it.
    #[test]
    fn dyes_make_the_order_and_nothing_is_lent_to_the_lender() {
        let found = all(&Scene::new().unwrap()).unwrap();
        assert!(found.windows(2).all(|pair| pair[0].own.chroma > pair[1].own.chroma), "{found:?}");
        for Exchanged { id, own, lent, .. } in &found {
            let change = lent.map(|lent| lent.chroma - own.chroma);
            if *id == LENDER {
                assert!(change.iter().all(|change| change.abs() < 1e-12), "{id}: {change:?}");
            } else {
                let [sensitivities, curves, dyes, cyan, magenta, yellow] = change;
                assert!(sensitivities.abs().max(curves.abs()) < 0.5 * dyes.abs(), "{id}: {change:?}");
                assert!(cyan < magenta.min(yellow) && cyan < -0.03, "{id}: {change:?}");
            }
        }
    }
}
