use std::fmt::{self, Write as _};

use onelight_film::{Image, SheetText, StockKind};
use sha2::{Digest, Sha256};

use crate::error::Error;
use crate::stocks::stock;

/// The camera film of a process that names none: what \[Gotanda2010\] calls K-negative.
pub const DEFAULT_CAMERA: &str = "kodak-5207";
/// The print film of a colour negative that names none.
pub const DEFAULT_PRINT: &str = "kodak-2383";
/// The print film of a black and white negative that names none.
pub const DEFAULT_SILVER_PRINT: &str = "kodak-2302";

/// Which stock a process uses: a built-in one, or a data sheet of one's own.
///
/// ```
/// use onelight::{FilmProcess, StockRef};
/// let film = FilmProcess::for_camera("kodak-5219")?;
/// assert_eq!(film.camera, StockRef::from("kodak-5219"));
/// assert_eq!(film.camera.id(), "kodak-5219");
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum StockRef {
    /// A built-in stock by its id; [`crate::stock_ids`] lists all.
    BuiltIn(String),
    /// A data sheet of one's own. Its text is not held here: [`crate::Process::compile_with`] takes the stock.
    Own(OwnSheet),
}

/// Where a data sheet of one's own is, and how to tell whether it is still the same.
///
/// ```
/// use onelight::{FilmProcess, OwnSheet, SheetText, StockRef};
/// # let [stock_toml, sensitivity_csv, characteristic_csv, dye_density_csv] = ["a\n", "b\n", "c\n", "d\n"];
/// // The four files of the folder as they are, read by whoever opens paths.
/// let text = SheetText { id: "mine", stock_toml, sensitivity_csv, characteristic_csv, dye_density_csv };
/// let sheet = OwnSheet::new("films/mine", &text);
/// assert!(sheet.sha256.starts_with("f58aa57f"));
/// let film = FilmProcess { camera: StockRef::Own(sheet), ..FilmProcess::default() };
/// assert_eq!(film.camera.id(), "mine");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct OwnSheet {
    /// The stock's id, the name of its folder.
    pub id: String,
    /// The folder; in `look.toml` as seen from the folder of that file. This crate opens no paths.
    pub path: String,
    /// SHA-256 of the sheet's files in 64 hexadecimal digits: what
    /// `sha256sum stock.toml sensitivity.csv characteristic.csv dye_density.csv | sha256sum` says in the folder; `mtf.csv` and
    /// `granularity.csv` come behind them where they are there.
    pub sha256: String,
}

impl OwnSheet {
    /// The sheet in the folder `path`, with the digest of its text. [`Stock::parse`](crate::Stock::parse) says whether it is a sheet.
    #[must_use]
    pub fn new(path: impl Into<String>, text: &SheetText<'_>) -> Self {
        Self::with_figures(path, text, None, None)
    }

    /// The same, of a sheet with the texts of `mtf.csv` and `granularity.csv`, which [`Stock::with_figures`](crate::Stock::with_figures)
    /// reads.
    #[must_use]
    pub fn with_figures(
        path: impl Into<String>,
        text: &SheetText<'_>,
        mtf_csv: Option<&str>,
        granularity_csv: Option<&str>,
    ) -> Self {
        let files = [
            ("stock.toml", text.stock_toml),
            ("sensitivity.csv", text.sensitivity_csv),
            ("characteristic.csv", text.characteristic_csv),
            ("dye_density.csv", text.dye_density_csv),
            ("mtf.csv", mtf_csv.unwrap_or_default()),
            ("granularity.csv", granularity_csv.unwrap_or_default()),
        ];
        // Black and white has no dyes, and no file of them; not every sheet has the last two.
        let files = files.iter().filter(|(_, text)| !text.is_empty());
        let lines: String = files.map(|(name, text)| format!("{}  {name}\n", sha256(text))).collect();
        Self { id: text.id.to_owned(), path: path.into(), sha256: sha256(&lines) }
    }
}

/// In hexadecimal digits.
fn sha256(text: &str) -> String {
    Sha256::digest(text).iter().fold(String::new(), |mut digits, byte| {
        let _ = write!(digits, "{byte:02x}");
        digits
    })
}

impl StockRef {
    /// The stock's id, such as `kodak-5207`.
    #[must_use]
    pub fn id(&self) -> &str {
        match self {
            Self::BuiltIn(id) => id,
            Self::Own(sheet) => &sheet.id,
        }
    }

    /// The data sheet, unless the stock is built in.
    #[must_use]
    pub fn own_sheet(&self) -> Option<&OwnSheet> {
        match self {
            Self::BuiltIn(_) => None,
            Self::Own(sheet) => Some(sheet),
        }
    }
}

impl From<&str> for StockRef {
    fn from(id: &str) -> Self {
        Self::BuiltIn(id.to_owned())
    }
}

impl From<String> for StockRef {
    fn from(id: String) -> Self {
        Self::BuiltIn(id)
    }
}

impl fmt::Display for StockRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.id())
    }
}

/// The key `camera` where no film is in the camera and codes of a scanned negative are printed.
pub(crate) const NO_CAMERA: &str = "none";

/// The key `print` where a negative is scanned and not printed.
pub(crate) const SCAN: &str = "scan";

/// The print film of a negative that names none.
#[must_use]
pub fn usual_print(image: Image) -> &'static str {
    match image {
        Image::Dye => DEFAULT_PRINT,
        Image::Silver => DEFAULT_SILVER_PRINT,
    }
}

/// The print film that goes with a built-in camera film unless another is named.
pub(crate) fn default_print(camera: &str) -> Result<Option<&'static str>, Error> {
    let stock = stock(camera)?;
    match stock.kind() {
        StockKind::Negative => Ok(Some(usual_print(stock.image()))),
        StockKind::Reversal | StockKind::Instant => Ok(None),
        kind @ (StockKind::Print | StockKind::Paper | StockKind::ReversalPrint) => {
            Err(Error::not_for_a_camera(camera, kind))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The digest was made by `sha256sum` of GNU coreutils.
    #[test]
    fn the_digest_is_that_of_sha256sum() {
        let text = SheetText {
            id: "mine",
            stock_toml: "a\n",
            sensitivity_csv: "b\n",
            characteristic_csv: "c\n",
            dye_density_csv: "d\n",
        };
        let expected = "f58aa57f78cd2898a864f5e9a2ba77c3dc61b9e276ed80185cc1ad7f8563dc16";
        assert_eq!(OwnSheet::new("films/mine", &text).sha256, expected);
        assert_ne!(OwnSheet::new("films/mine", &SheetText { dye_density_csv: "e\n", ..text }).sha256, expected);
    }
}
