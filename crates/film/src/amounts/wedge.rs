use onelight_spectra::SpectralShape;

use crate::curve::AmountCurve;
use crate::dye_densitometer::DyeDensitometer;
use crate::error::{Error, ErrorKind};
use crate::layer::PerLayer;
use crate::quantity::{Density, DyeAmount, LogExposure};
use crate::stock::{Stock, StockKind};

/// Offsets along the wedge are at most this far apart, in log10 exposure.
const STEP: f64 = 0.01;

/// Amounts along the neutral wedge: the same offset from `mid_grey` in all layers.
pub(super) fn amounts(stock: &Stock, mid_grey: PerLayer<LogExposure>) -> Result<PerLayer<AmountCurve>, Error> {
    let dyes = stock.dyes_on(SpectralShape::VISIBLE)?;
    let reader = DyeDensitometer::new(&dyes, stock.densitometry());
    let base = if stock.kind() == StockKind::Negative {
        // Sheet and spectral curve disagree by some hundredths at D-min: keep the spectral one, add what the curve adds.
        let clear = reader.density(PerLayer::all(DyeAmount(0.0)));
        stock.characteristic().zip_map(clear, |c, d| d.0 - c.d_min().0)
    } else {
        PerLayer::all(0.0)
    };
    let (from, to) = range(stock, mid_grey);
    let steps = ((to - from) / STEP).ceil().max(1.0);
    let offsets: Vec<f64> = (0..=steps as usize).map(|i| from + (to - from) * i as f64 / steps).collect();
    let mut found: [Vec<f64>; 3] = Default::default();
    let (mut amount, mut before) = (PerLayer::all(DyeAmount(0.5)), None);
    for &offset in &offsets {
        let at = mid_grey.map(|h| LogExposure(h.0 + offset));
        let target = stock.characteristic().zip_map(at, |curve, h| curve.density(h).0);
        let target = target.zip_map(base, |d, b| Density(d + b));
        // The curves go on as they went: a step less for Newton's method.
        let straight_on = before.map_or(amount, |before: PerLayer<DyeAmount>| {
            amount.zip_map(before, |now, before| DyeAmount(2.0 * now.0 - before.0))
        });
        let unmixed = reader.unmix(target, straight_on).or_else(|| reader.unmix(target, amount));
        let unmixed = unmixed.ok_or_else(|| ErrorKind::Unmixing { stock: stock.id().to_owned(), offset })?;
        before = (offset > from).then_some(amount);
        amount = unmixed;
        for (curve, a) in found.iter_mut().zip(amount.to_array()) {
            curve.push(a.0);
        }
    }
    let direction = stock.kind().direction();
    let curve =
        |h: LogExposure, a: Vec<f64>| AmountCurve::new(offsets.iter().map(|o| h.0 + o).collect(), &a, direction);
    mid_grey.zip_map(PerLayer::from(found), curve).try_map(|curve, _| curve)
}

fn range(stock: &Stock, mid_grey: PerLayer<LogExposure>) -> (f64, f64) {
    let ends = stock.characteristic().zip_map(mid_grey, |curve, h| {
        let (first, last) = curve.range().into_inner();
        (first.0 - h.0, last.0 - h.0)
    });
    let [a, b, c] = ends.to_array();
    (a.0.min(b.0).min(c.0), a.1.max(b.1).max(c.1))
}
