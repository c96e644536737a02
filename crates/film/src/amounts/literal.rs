use onelight_spectra::{SpectralDistribution, SpectralShape};

use crate::curve::{AmountCurve, CharacteristicCurve};
use crate::error::Error;
use crate::layer::PerLayer;
use crate::quantity::LogExposure;
use crate::stock::{Stock, StockKind};

/// The range over which the neutral is fitted, in nm.
const NEUTRAL_FROM_NM: f64 = 400.0;
const NEUTRAL_TO_NM: f64 = 700.0;

/// Prints and reversal film: amount = density. Negatives: c (D - Dmin) / (Dmid - Dmin), one c for all layers.
pub(super) fn amounts(stock: &Stock, mid_grey: PerLayer<LogExposure>) -> Result<PerLayer<AmountCurve>, Error> {
    let direction = stock.kind().direction();
    let scaled = |curve: &CharacteristicCurve, h: LogExposure| -> Result<AmountCurve, Error> {
        let (log_exposure, density) = (curve.log_exposures(), curve.densities());
        let amount: Vec<f64> = if stock.kind() == StockKind::Negative {
            let (low, mid) = (curve.d_min().0, curve.density(h).0);
            if mid <= low {
                return Err(Error::stock(stock.id(), "mid grey lies on the toe of a characteristic curve"));
            }
            let c = matching_constant(stock)?;
            density.iter().map(|d| c * (d - low) / (mid - low)).collect()
        } else {
            density.to_vec()
        };
        AmountCurve::new(log_exposure.to_vec(), &amount, direction)
    };
    stock.characteristic().zip_map(mid_grey, scaled).try_map(|curve, _| curve)
}

/// The c that brings the sum of the dyes nearest to the published neutral less D-min, in least squares.
fn matching_constant(stock: &Stock) -> Result<f64, Error> {
    let shape = SpectralShape::VISIBLE;
    let dyes = stock.dyes_on(shape)?;
    let missing = |what| Error::stock(stock.id(), format!("the sheet shows no {what}, which literal dyes need"));
    let neutral = stock.neutral().ok_or_else(|| missing("midscale neutral"))?.on(shape)?;
    let d_min = dyes.d_min().ok_or_else(|| missing("D-min"))?;
    let [c, m, y] = dyes.dyes().map(SpectralDistribution::values).to_array();
    let (mut square, mut product) = (0.0, 0.0);
    for (i, nm) in shape.wavelengths_nm().enumerate() {
        if (NEUTRAL_FROM_NM..=NEUTRAL_TO_NM).contains(&nm) {
            let sum = c[i] + m[i] + y[i];
            square += sum * sum;
            product += sum * (neutral.values()[i] - d_min.values()[i]);
        }
    }
    Ok(product / square)
}
