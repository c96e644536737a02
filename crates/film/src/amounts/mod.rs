//! From the densities of characteristic curves to amounts of dye.

mod constants;
mod literal;
mod principal;
mod silver;
mod wedge;

use crate::curve::AmountCurve;
use crate::error::Error;
use crate::layer::PerLayer;
use crate::quantity::LogExposure;
use crate::stock::{Image, Stock, StockKind};

/// How densities of the characteristic curves become amounts of dye. docs/talk.md says how far the three are apart.
///
/// ```
/// use onelight_film::{DyeModel, PerLayer, SheetText, Stock};
/// # let f = onelight_stocks::find("kodak-5207").ok_or("no such stock")?;
/// # let stock = Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #     characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?;
/// let mid_grey = stock.mid_grey()?;
/// let curves = DyeModel::Wedge.amounts(&stock, PerLayer::all(mid_grey))?;
/// let cyan = curves.red.amount(mid_grey);
/// assert!((0.3..0.9).contains(&cyan.0), "in units of the sheet's cyan curve: {cyan:?}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum DyeModel {
    /// Characteristic curves are integral densities: on the neutral wedge the three amounts together must give the
    /// densities that the sheet's densitometer reads.
    #[default]
    Wedge,
    /// \[Gotanda2010\] read literally: each layer's density is its own dye's amount, and on a negative one matching constant
    /// scales all three.
    Literal,
    /// The talk's formula with what it needs to hold: on a negative amount = c (D - Dmin) / (Dmid - Dmin) with a constant c for
    /// each dye and Dmid read off the published midscale neutral by the sheet's densitometer. Prints and reversal films as
    /// [`DyeModel::Wedge`].
    Constants,
}

impl DyeModel {
    /// The amount curve of each layer. `mid_grey` is the point of the three curves at which a neutral lies: the reference
    /// exposure of a camera film, the exposure of the aim of a print film.
    ///
    /// # Errors
    /// If no amounts give the densities of the sheet, or the sheet lacks what the model needs.
    pub fn amounts(self, stock: &Stock, mid_grey: PerLayer<LogExposure>) -> Result<PerLayer<AmountCurve>, Error> {
        match self {
            // One layer, whose density is its amount: the models are the same.
            _ if stock.image() == Image::Silver => silver::amounts(stock),
            Self::Literal => literal::amounts(stock, mid_grey),
            Self::Constants if stock.kind() == StockKind::Negative => constants::amounts(stock),
            Self::Wedge | Self::Constants => wedge::amounts(stock, mid_grey),
        }
    }
}

/// What the three characteristic curves of a print film's sheet are. Sheets seldom say; docs/stocks.md says what depends on it.
///
/// ```
/// use onelight_film::{PerLayer, PrintCurves, SheetText, Stock};
/// # let f = onelight_stocks::find("kodak-2383").ok_or("no such stock")?;
/// # let stock = Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #     characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?;
/// let curves = PrintCurves::principal_amounts(&stock)?;
/// assert!(curves.red.amount_range().end().0 > 1.0);
/// assert_eq!(PrintCurves::default(), PrintCurves::Neutral);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum PrintCurves {
    /// One neutral scale: at each point all three dyes are there, and a [`DyeModel`] takes them apart.
    #[default]
    Neutral,
    /// Three separation exposures: each curve holds the dye of its own layer alone.
    Principal,
}

impl PrintCurves {
    /// The amount curve of each layer if its characteristic curve holds its own dye alone ([`PrintCurves::Principal`]).
    ///
    /// # Errors
    /// If no amount of a dye gives a density of its curve.
    pub fn principal_amounts(stock: &Stock) -> Result<PerLayer<AmountCurve>, Error> {
        principal::amounts(stock)
    }
}
