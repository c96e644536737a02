use onelight_film::{AmountCurve, Density, DyeAmount, LogExposure, PerLayer, Stock, StockKind};

use crate::error::{Error, ErrorKind, expect_kind};
use crate::projection::Projection;

/// What an 18 % grey card should look like on the screen.
///
/// ```
/// use onelight_printing::Aim;
/// assert_eq!(Aim::default(), Aim::Neutral);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Aim {
    /// What the sheet says: the print's published aim densities, a reversal film's own exposure. Grey is then not perfectly
    /// grey and about a stop darker than in neutral aim.
    Sheet,
    /// An 18 % grey card is exactly neutral, at an [`EquivalentNeutralDensity`]. Darker and lighter greys keep the tint that
    /// the film gives them.
    #[default]
    Neutral,
}

/// The density of the neutral filter that a grey card on the screen looks like, 0.05 to 3. The default is the talk's 0.7
/// (\[Gotanda2010\]): display-linear 0.1995, nearly a grey card itself. Higher is a darker print.
///
/// ```
/// use onelight_printing::EquivalentNeutralDensity;
/// assert_eq!(EquivalentNeutralDensity::default().value(), 0.7);
/// let error = EquivalentNeutralDensity::new(7.0).unwrap_err();
/// assert_eq!(error.to_string(), "equivalent neutral density of a grey card: found 7, expected 0.05 to 3");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct EquivalentNeutralDensity(f64);

impl EquivalentNeutralDensity {
    /// A density from 0.05 to 3.
    ///
    /// # Errors
    /// If the density is outside 0.05 to 3, or not a number.
    pub fn new(density: f64) -> Result<Self, Error> {
        if (0.05..=3.0).contains(&density) {
            Ok(Self(density))
        } else {
            Err(ErrorKind::GreyDensity { found: density }.into())
        }
    }

    /// The density as a number, 0.05 to 3.
    #[must_use]
    pub fn value(self) -> f64 {
        self.0
    }
}

impl Default for EquivalentNeutralDensity {
    fn default() -> Self {
        Self(NEUTRAL_DENSITY)
    }
}

/// Equivalent neutral density of a grey card in neutral aim unless another is named (\[Gotanda2010\]).
pub const NEUTRAL_DENSITY: f64 = 0.7;

/// The exposures at which the curves of a print film or paper reach its aim densities: where its neutral lies.
///
/// ```
/// use onelight_film::{SheetText, Stock};
/// use onelight_printing::print_mid_grey;
/// # fn read(id: &str) -> Result<Stock, Box<dyn std::error::Error>> {
/// #     let f = onelight_stocks::find(id).ok_or("no such stock")?;
/// #     Ok(Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #         characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?)
/// # }
/// let print = read("kodak-2383")?;
/// let grey = print_mid_grey(&print)?;
/// let red = print.characteristic().red.density(grey.red);
/// assert!((red.0 - 1.09).abs() < 1e-9, "the aim of the sheet");
/// assert!(print_mid_grey(&read("kodak-5207")?).is_err_and(|error| error.is_wrong_kind()));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the film is a camera film, or a curve does not reach the aim.
pub fn print_mid_grey(print: &Stock) -> Result<PerLayer<LogExposure>, Error> {
    expect_kind(print, |kind| !kind.is_camera_film(), "print film or paper")?;
    let aim = print.aim().ok_or(ErrorKind::WrongKind {
        stock: print.id().to_owned(),
        found: "print film without an aim",
        expected: "print film with one",
    })?;
    print.characteristic().zip_map(aim.status_a, |curve, d| (curve, d)).try_map(|(curve, Density(d)), layer| {
        curve.log_exposure(Density(d)).ok_or_else(|| {
            let expected = format!("{:.3} to {:.3}", curve.d_min().0, curve.d_max().0);
            ErrorKind::Unreachable { stock: print.id().to_owned(), layer, found: format!("a density of {d}"), expected }
                .into()
        })
    })
}

/// The exposures that a grey card must give a print film whose layers make dye by `curves`; `density` is that of neutral aim. The
/// example of the crate prints by it.
///
/// # Errors
/// If the aim cannot be reached.
pub fn print_target(
    aim: Aim,
    density: EquivalentNeutralDensity,
    print: &Stock,
    curves: PerLayer<&AmountCurve>,
    projection: &Projection,
) -> Result<PerLayer<LogExposure>, Error> {
    match aim {
        Aim::Sheet => print_mid_grey(print),
        Aim::Neutral => exposures(print.id(), curves, projection.neutral_amounts(density.0, print.id())?),
    }
}

/// The exposures that a grey card must give a reversal or instant film that is shown itself; `own` are those of its sheet, `density` that of neutral aim.
///
/// ```
/// use onelight_film::{DyeModel, PerLayer, SheetText, Stock};
/// use onelight_printing::{Aim, EquivalentNeutralDensity, Projection, Projector, reversal_target};
/// use onelight_spectra::{RgbSpace, SpectralShape};
/// # fn read(id: &str) -> Result<Stock, Box<dyn std::error::Error>> {
/// #     let f = onelight_stocks::find(id).ok_or("no such stock")?;
/// #     Ok(Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #         characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?)
/// # }
/// let film = read("fuji-velvia-50")?;
/// let own = PerLayer::all(film.mid_grey()?);
/// let curves = DyeModel::Wedge.amounts(&film, own)?;
/// let projection = Projection::new(film.dyes_on(SpectralShape::VISIBLE)?, Projector::Display, &RgbSpace::SRGB)?;
/// let target =
///     reversal_target(Aim::Neutral, EquivalentNeutralDensity::default(), &film, own, curves.as_ref(), &projection)?;
/// let shown = projection.rgb(curves.as_ref().zip_map(target, |curve, h| curve.amount(h)));
/// assert!(shown.iter().all(|v| (v - 10f64.powf(-0.7)).abs() < 1e-9));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the film is neither, or the aim cannot be reached.
pub fn reversal_target(
    aim: Aim,
    density: EquivalentNeutralDensity,
    film: &Stock,
    own: PerLayer<LogExposure>,
    curves: PerLayer<&AmountCurve>,
    projection: &Projection,
) -> Result<PerLayer<LogExposure>, Error> {
    expect_kind(film, |kind| matches!(kind, StockKind::Reversal | StockKind::Instant), "reversal film")?;
    match aim {
        Aim::Sheet => Ok(own),
        Aim::Neutral => exposures(film.id(), curves, projection.neutral_amounts(density.0, film.id())?),
    }
}

fn exposures(
    stock: &str,
    curves: PerLayer<&AmountCurve>,
    amounts: PerLayer<DyeAmount>,
) -> Result<PerLayer<LogExposure>, Error> {
    curves.zip_map(amounts, |curve, a| (curve, a)).try_map(|(curve, amount), layer| {
        curve.log_exposure(amount).ok_or_else(|| {
            let (low, high) = curve.amount_range().into_inner();
            let (found, expected) =
                (format!("a dye amount of {:.3}", amount.0), format!("{:.3} to {:.3}", low.0, high.0));
            ErrorKind::Unreachable { stock: stock.to_owned(), layer, found, expected }.into()
        })
    })
}
