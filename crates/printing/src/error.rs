use std::fmt;

use onelight_film::{PerLayer, Stock, StockKind};
use onelight_spectra::SpectralShape;

/// What went wrong in this crate: one sentence that says what, where, what was found and what was expected.
///
/// ```
/// let error = onelight_printing::EquivalentNeutralDensity::new(f64::NAN).unwrap_err();
/// assert_eq!(error.to_string(), "equivalent neutral density of a grey card: found NaN, expected 0.05 to 3");
/// assert!(!error.is_unreachable_aim());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Error(ErrorKind);

#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ErrorKind {
    Spectra(onelight_spectra::Error),
    Film(onelight_film::Error),
    NegativeLight { negative: String, print: String, lights: PerLayer<f64> },
    Dependent { negative: String, print: String },
    Unreachable { stock: String, layer: &'static str, found: String, expected: String },
    GreyDensity { found: f64 },
    NoAmounts { stock: String, density: f64 },
    Grid { found: SpectralShape },
    WrongKind { stock: String, found: &'static str, expected: &'static str },
}

impl Error {
    /// Whether an aim cannot be reached: by any lights, any exposure, any amounts of dye.
    #[must_use]
    pub fn is_unreachable_aim(&self) -> bool {
        matches!(
            self.0,
            ErrorKind::NegativeLight { .. }
                | ErrorKind::Dependent { .. }
                | ErrorKind::Unreachable { .. }
                | ErrorKind::NoAmounts { .. }
        )
    }

    /// Whether a film was put where its kind does not belong.
    #[must_use]
    pub fn is_wrong_kind(&self) -> bool {
        matches!(self.0, ErrorKind::WrongKind { .. })
    }
}

/// # Errors
/// If the stock is not of a kind that `fits`; `expected` says which do.
pub(crate) fn expect_kind(stock: &Stock, fits: fn(StockKind) -> bool, expected: &'static str) -> Result<(), Error> {
    let kind = stock.kind();
    if fits(kind) {
        return Ok(());
    }
    Err(ErrorKind::WrongKind { stock: stock.id().to_owned(), found: kind.name(), expected }.into())
}

/// # Errors
/// If `camera` is not printed, or on nothing like `print`.
pub(crate) fn expect_pair(camera: &Stock, print: &Stock) -> Result<(), Error> {
    expect_kind(camera, |kind| !kind.printed_on().is_empty(), "negative or reversal film")?;
    let usual = camera.kind().printed_on();
    if usual.contains(&print.kind()) {
        return Ok(());
    }
    let expected = usual.first().map_or("", |kind| kind.name());
    Err(ErrorKind::WrongKind { stock: print.id().to_owned(), found: print.kind().name(), expected }.into())
}

impl From<ErrorKind> for Error {
    fn from(kind: ErrorKind) -> Self {
        Self(kind)
    }
}

impl From<onelight_spectra::Error> for Error {
    fn from(error: onelight_spectra::Error) -> Self {
        Self(ErrorKind::Spectra(error))
    }
}

impl From<onelight_film::Error> for Error {
    fn from(error: onelight_film::Error) -> Self {
        Self(ErrorKind::Film(error))
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            ErrorKind::Spectra(error) => error.fmt(f),
            ErrorKind::Film(error) => error.fmt(f),
            ErrorKind::NegativeLight { negative, print, lights: PerLayer { red, green, blue } } => write!(
                f,
                "{negative} on {print}: the aim needs printer lights of {red:.3}, {green:.3}, {blue:.3} (red, green, blue), expected all above 0"
            ),
            ErrorKind::Dependent { negative, print } => {
                write!(
                    f,
                    "{negative} on {print}: two printer lights do the same to the print, expected three different ones"
                )
            }
            ErrorKind::Unreachable { stock, layer, found, expected } => {
                write!(f, "{stock}: the aim needs {found} in the {layer} layer, expected {expected}")
            }
            ErrorKind::GreyDensity { found } => {
                write!(f, "equivalent neutral density of a grey card: found {found}, expected 0.05 to 3")
            }
            ErrorKind::NoAmounts { stock, density } => {
                write!(f, "{stock}: no amounts of its dyes make a neutral of density {density}")
            }
            ErrorKind::Grid { found } => write!(
                f,
                "dyes of a film to be projected: found them on {}..{} nm by {}, expected 380..780 nm by 1",
                found.first_nm(),
                found.last_nm(),
                found.step_nm()
            ),
            ErrorKind::WrongKind { stock, found, expected } => {
                write!(f, "{stock}: found a {found}, expected a {expected}")
            }
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.0 {
            // Their sentences are this error's own: only what lies behind them is new.
            ErrorKind::Spectra(error) => error.source(),
            ErrorKind::Film(error) => error.source(),
            _ => None,
        }
    }
}
