use onelight_film::{AmountCurve, Density, DyeAmount, LogExposure, PerLayer, Stock, StockKind};

use crate::error::{Error, ErrorKind, expect_kind};
use crate::projection::Projection;

/// What an 18 % grey card should look like on the screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Aim {
    /// What the sheet says: the print's published aim densities, a reversal film's own exposure. Grey is then not perfectly
    /// grey (C* 1.4 on 2383) and about a stop darker than neutral.
    Sheet,
    /// An 18 % grey card is exactly neutral, at an [`EquivalentNeutralDensity`]. Darker and lighter greys keep the tint that
    /// the film gives them.
    #[default]
    Neutral,
}

/// The density of the neutral filter that a grey card on the screen looks like, 0.05 to 3. The default is the talk's 0.7
/// (\[Gotanda2010\]): display-linear 0.1995, nearly a grey card itself. Higher is a darker print.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct EquivalentNeutralDensity(f64);

impl EquivalentNeutralDensity {
    /// A density from 0.05 to 3.
    ///
    /// # Errors
    /// If it is another.
    pub fn new(density: f64) -> Result<Self, Error> {
        if (0.05..=3.0).contains(&density) {
            Ok(Self(density))
        } else {
            Err(ErrorKind::GreyDensity { found: density }.into())
        }
    }

    /// The number.
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

/// The exposures at which a print film's curves reach its aim densities: where its neutral lies.
///
/// # Errors
/// If the film is no print film, or a curve does not reach the aim.
pub fn print_mid_grey(print: &Stock) -> Result<PerLayer<LogExposure>, Error> {
    expect_kind(print, StockKind::Print)?;
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

/// The exposures that a grey card must give a print film whose layers make dye by `curves`; `density` is that of neutral aim.
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

/// The exposures that a grey card must give a reversal film; `own` are those of its sheet, `density` that of neutral aim.
///
/// # Errors
/// If the film is no reversal film, or the aim cannot be reached.
pub fn reversal_target(
    aim: Aim,
    density: EquivalentNeutralDensity,
    film: &Stock,
    own: PerLayer<LogExposure>,
    curves: PerLayer<&AmountCurve>,
    projection: &Projection,
) -> Result<PerLayer<LogExposure>, Error> {
    expect_kind(film, StockKind::Reversal)?;
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
