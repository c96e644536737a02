use std::sync::LazyLock;

use onelight::film::{
    AmountCurve, CharacteristicCurve, Density, DyeAmount, DyeModel, ExposureMatrix, LogExposure, Matching, PerLayer,
    SheetText, Stock, StockKind,
};
use onelight::printing::{
    Aim, Duplication, EquivalentNeutralDensity, Printer, Projection, Projector, print_mid_grey, print_target,
    reversal_target,
};
use onelight::spectra::{Basis, Reconstruction, RgbSpace, SpectralShape};

use super::{HARD, Met, OneIn, refused};

/// The line between two files of a stock.
const BETWEEN: &str = "\n%\n";

/// A sheet that is read has finite monotone curves, and either goes through exposure, printing and projection with finite
/// results or errs. Films are made for one input in `compiled`.
///
/// The bytes are `stock.toml`, `sensitivity.csv`, `characteristic.csv` and `dye_density.csv`, with a line `%` between them.
pub fn check(bytes: &[u8], compiled: OneIn) -> Met {
    let Ok(text) = std::str::from_utf8(bytes) else { return Met::Refused };
    let mut files = text.split(BETWEEN);
    let mut file = || files.next().unwrap_or_default();
    let sheet = SheetText {
        id: "film",
        stock_toml: file(),
        sensitivity_csv: file(),
        characteristic_csv: file(),
        dye_density_csv: file(),
    };
    let stock = match Stock::parse(&sheet) {
        Ok(stock) => stock,
        Err(error) => return refused(&error),
    };
    stock.characteristic().map(curve);
    if compiled.holds(bytes)
        && let Err(error) = on_screen(&stock)
    {
        return refused(&error);
    }
    Met::Read
}

fn curve(curve: &CharacteristicCurve) {
    let mut hard = HARD.map(f64::from).map(|h| if h.is_nan() { 0.0 } else { h });
    hard.sort_by(f64::total_cmp);
    let densities = hard.map(|h| curve.density(LogExposure(h)).0);
    let (least, most) = (curve.d_min().0, curve.d_max().0);
    assert!(densities.iter().all(|d| (least..=most).contains(d)), "{densities:?} beyond {least} to {most}");
    let rising = densities.is_sorted();
    let falling = densities.iter().rev().is_sorted();
    assert!(rising || falling, "{densities:?}");
    assert!(curve.density(LogExposure(f64::NAN)).0.is_finite());
    if let Some(h) = curve.log_exposure(Density(0.5 * (least + most))) {
        assert!(h.0.is_finite());
    }
}

/// The film on its way to the screen, with built-in films beside it.
fn on_screen(stock: &Stock) -> Result<(), onelight::Error> {
    static PARTNERS: LazyLock<Vec<Stock>> = LazyLock::new(|| {
        let ids = ["kodak-5207", "kodak-2383", "fuji-velvia-50", "kodak-radiance-iii", "kodak-5222", "kodak-2302"];
        ids.iter().filter_map(|id| onelight::stock(id).ok()).collect()
    });

    let grey = own_grey(stock)?;
    let amounts = match DyeModel::Wedge.amounts(stock, grey) {
        Ok(amounts) => amounts,
        Err(error) => {
            refused(&error);
            DyeModel::Literal.amounts(stock, grey)?
        }
    };
    let held = amounts.as_ref().zip_map(grey, AmountCurve::amount);
    assert!(held.to_array().iter().all(|amount| amount.0.is_finite()), "{held:?}");

    if stock.kind().is_camera_film() {
        let basis = Basis::new(Reconstruction::Smooth)?;
        for matching in [Matching::Grey, Matching::Absolute] {
            match ExposureMatrix::new(stock, &basis, matching, grey) {
                Ok(exposure) => {
                    let exposed = exposure.expose([0.18, 1e30, 0.0]).to_array();
                    assert!(exposed.iter().all(|h| h.is_finite()), "{exposed:?}");
                }
                // Only where the sheet's axis is one of lux s.
                Err(error) => _ = refused(&error),
            }
        }
    }
    if matches!(stock.kind(), StockKind::Reversal | StockKind::Instant) {
        let projection = projection(stock)?;
        let density = EquivalentNeutralDensity::default();
        let target = reversal_target(Aim::Neutral, density, stock, grey, amounts.as_ref(), &projection)?;
        shown(&projection, amounts.as_ref().zip_map(target, AmountCurve::amount));
    }
    if let Some(print) = PARTNERS.iter().find(|print| stock.is_printed_on(print)) {
        printed(stock, print, held)?;
    }
    if let Some(negative) = PARTNERS.iter().find(|negative| negative.is_printed_on(stock)) {
        let grey = own_grey(negative)?;
        let curves = DyeModel::Wedge.amounts(negative, grey)?;
        printed(negative, stock, curves.as_ref().zip_map(grey, AmountCurve::amount))?;
    }
    Ok(())
}

/// Where a grey card lies on the curves.
fn own_grey(stock: &Stock) -> Result<PerLayer<LogExposure>, onelight::Error> {
    Ok(if stock.kind().is_camera_film() { PerLayer::all(stock.mid_grey()?) } else { print_mid_grey(stock)? })
}

/// A grey card in `negative`, printed on `print`.
fn printed(negative: &Stock, print: &Stock, grey: PerLayer<DyeAmount>) -> Result<(), onelight::Error> {
    let projection = projection(print)?;
    let print_curves = DyeModel::Wedge.amounts(print, print_mid_grey(print)?)?;
    let density = EquivalentNeutralDensity::default();
    let target = print_target(Aim::Neutral, density, print, print_curves.as_ref(), &projection)?;
    let printer = Duplication::new(negative, print, Printer::default())?;
    let printer = printer.lit(printer.calibrate(grey, target)?);
    shown(&projection, print_curves.as_ref().zip_map(printer.expose(grey), AmountCurve::amount));
    Ok(())
}

fn projection(stock: &Stock) -> Result<Projection, onelight::Error> {
    Ok(Projection::new(stock.dyes_on(SpectralShape::VISIBLE)?, Projector::Display, &RgbSpace::SRGB)?)
}

fn shown(projection: &Projection, dye: PerLayer<DyeAmount>) {
    let rgb = projection.rgb(dye);
    assert!(rgb.iter().all(|v| v.is_finite()), "{dye:?} became {rgb:?}");
}
