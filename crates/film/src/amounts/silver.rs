use crate::curve::{AmountCurve, CharacteristicCurve};
use crate::error::Error;
use crate::layer::PerLayer;
use crate::stock::Stock;

/// Black and white: silver of density 1 is the unit, and the densities of the sheet hold base and fog.
pub(super) fn amounts(stock: &Stock) -> Result<PerLayer<AmountCurve>, Error> {
    let amounts = |curve: &CharacteristicCurve| {
        AmountCurve::new(curve.log_exposures().to_vec(), curve.densities(), stock.kind().direction())
    };
    stock.characteristic().try_map(|curve, _| amounts(curve))
}
