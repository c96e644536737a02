use nalgebra::{Matrix3, Vector3};
use onelight_spectra::{SpectralDistribution, SpectralShape};

use crate::curve::{AmountCurve, CharacteristicCurve};
use crate::error::Error;
use crate::layer::PerLayer;
use crate::stock::Stock;

/// The range over which the neutral is fitted, in nm.
const NEUTRAL_NM: std::ops::RangeInclusive<f64> = 400.0..=700.0;

/// A negative: c_i (D_i - Dmin_i) / (Dmid_i - Dmin_i), c and the divisor from the published midscale neutral and D-min.
///
/// Both ends of the divisor are read off spectral curves and both of the dividend off the characteristic curve: the two
/// disagree about D-min by some hundredths, and mixing them doubles the distance from the wedge.
pub(super) fn amounts(stock: &Stock) -> Result<PerLayer<AmountCurve>, Error> {
    let Midscale { constants, density, clear } = Midscale::of(stock)?;
    let scaled = |curve: &CharacteristicCurve, c: f64, above: f64| -> Result<AmountCurve, Error> {
        let (log_exposure, d) = (curve.log_exposures(), curve.densities());
        let low = curve.d_min().0;
        if above <= 0.0 {
            return Err(Error::stock(stock.id(), "its midscale neutral is no denser than its D-min"));
        }
        let amount: Vec<f64> = d.iter().map(|d| c * (d - low) / above).collect();
        AmountCurve::new(log_exposure.to_vec(), &amount, stock.kind().direction())
    };
    let above = density.zip_map(clear, |mid, clear| mid - clear);
    let targets = constants.zip_map(above, |c, above| (c, above));
    stock.characteristic().zip_map(targets, |curve, (c, above)| scaled(curve, c, above)).try_map(|curve, _| curve)
}

/// The published midscale neutral: amounts of the three dyes that come nearest to it, its densities, and those of D-min.
struct Midscale {
    constants: PerLayer<f64>,
    density: PerLayer<f64>,
    clear: PerLayer<f64>,
}

impl Midscale {
    fn of(stock: &Stock) -> Result<Self, Error> {
        let shape = SpectralShape::VISIBLE;
        let dyes = stock.dyes_on(shape)?;
        let missing =
            |what| Error::stock(stock.id(), format!("the sheet shows no {what}, which matching constants need"));
        let neutral = stock.neutral().ok_or_else(|| missing("midscale neutral"))?.on(shape)?;
        let d_min = dyes.d_min().ok_or_else(|| missing("D-min"))?;
        let [c, m, y] = dyes.dyes().map(SpectralDistribution::values).to_array();
        let (mut square, mut product) = (Matrix3::zeros(), Vector3::zeros());
        for (i, _) in shape.wavelengths_nm().enumerate().filter(|(_, nm)| NEUTRAL_NM.contains(nm)) {
            let dye = Vector3::new(c[i], m[i], y[i]);
            square += dye * dye.transpose();
            product += dye * (neutral.values()[i] - d_min.values()[i]);
        }
        let solved =
            square.lu().solve(&product).ok_or_else(|| Error::stock(stock.id(), "its dyes are not independent"))?;
        let read = |film: &SpectralDistribution<_>| stock.densitometry().density(&film.transmittance()).map(|d| d.0);
        Ok(Self { constants: PerLayer::from(<[f64; 3]>::from(solved)), density: read(&neutral), clear: read(d_min) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stock::SheetText;

    #[test]
    fn midscale_of_5207_is_what_was_measured_elsewhere() {
        let files = onelight_stocks::find("kodak-5207").unwrap();
        let stock = Stock::parse(&SheetText {
            id: files.id,
            stock_toml: files.stock_toml,
            sensitivity_csv: files.sensitivity_csv,
            characteristic_csv: files.characteristic_csv,
            dye_density_csv: files.dye_density_csv,
        });
        let Midscale { constants, density, .. } = Midscale::of(&stock.unwrap()).unwrap();
        for (found, published) in constants.to_array().into_iter().zip([0.571, 0.620, 0.649]) {
            assert!((found - published).abs() < 6e-4, "{constants:?}");
        }
        for (found, published) in density.to_array().into_iter().zip([0.754, 1.198, 1.502]) {
            assert!((found - published).abs() < 6e-4, "{density:?}");
        }
    }
}
