use std::fmt;

use onelight_film::{Image, StockKind};

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
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct OwnSheet {
    /// The stock's id, the name of its folder.
    pub id: String,
    /// The folder; in `look.toml` as seen from the folder of that file. This crate opens no paths.
    pub path: String,
    /// SHA-256 of the sheet's files in 64 hexadecimal digits: what
    /// `sha256sum stock.toml sensitivity.csv characteristic.csv dye_density.csv | sha256sum` says in the folder.
    pub sha256: String,
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
