use onelight_spectra::SpectralShape;

use crate::curve::AmountCurve;
use crate::dye_densitometer::DyeDensitometer;
use crate::error::{Error, ErrorKind};
use crate::layer::PerLayer;
use crate::quantity::DyeAmount;
use crate::stock::Stock;

/// Newton's method ends when a density is met this closely.
const DENSITY_TOLERANCE: f64 = 1e-11;
const MAX_ITERATIONS: usize = 60;

/// Each curve read as a separation exposure: at every exposure the amount of its own dye that gives its density alone.
pub(super) fn amounts(stock: &Stock) -> Result<PerLayer<AmountCurve>, Error> {
    let dyes = stock.dyes_on(SpectralShape::VISIBLE)?;
    let reader = DyeDensitometer::new(&dyes, stock.densitometry());
    let layers = PerLayer { red: 0, green: 1, blue: 2 };
    stock.characteristic().zip_map(layers, |curve, layer| (curve, layer)).try_map(|(curve, layer), _| {
        let mut amount = 0.5;
        let mut amounts = Vec::with_capacity(curve.densities().len());
        for (&h, &density) in curve.log_exposures().iter().zip(curve.densities()) {
            let found = alone(&reader, layer, density, amount);
            amount = found.ok_or_else(|| ErrorKind::Unmixing { stock: stock.id().to_owned(), offset: h })?;
            amounts.push(amount);
        }
        AmountCurve::new(curve.log_exposures().to_vec(), &amounts, stock.kind().direction())
    })
}

/// The amount of one dye alone that gives a density in its own channel; `None` if there is none.
fn alone(reader: &DyeDensitometer, layer: usize, density: f64, start: f64) -> Option<f64> {
    let mut amounts = [0.0; 3];
    amounts[layer] = start;
    for _ in 0..MAX_ITERATIONS {
        let (read, slope) = reader.density_and_slope(PerLayer::from(amounts).map(DyeAmount));
        let miss = read.to_array()[layer].0 - density;
        if miss.abs() < DENSITY_TOLERANCE {
            return Some(amounts[layer]);
        }
        amounts[layer] -= (miss / slope[layer][layer]).clamp(-1.0, 1.0);
        if !amounts[layer].is_finite() {
            return None;
        }
    }
    None
}
