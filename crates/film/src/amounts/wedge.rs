use std::f64::consts::LN_10;

use nalgebra::{Matrix3, Vector3};
use onelight_spectra::{SpectralDistribution, SpectralShape};

use crate::curve::AmountCurve;
use crate::densitometry::Densitometry;
use crate::dye::Dyes;
use crate::error::{Error, ErrorKind};
use crate::layer::PerLayer;
use crate::quantity::LogExposure;
use crate::stock::{Stock, StockKind};

/// Offsets along the wedge are at most this far apart, in log10 exposure.
const STEP: f64 = 0.01;
/// Newton's method ends when the densities are met this closely.
const DENSITY_TOLERANCE: f64 = 1e-11;
const MAX_ITERATIONS: usize = 60;

/// Amounts along the neutral wedge: the same offset from `mid_grey` in all layers.
pub(super) fn amounts(stock: &Stock, mid_grey: PerLayer<LogExposure>) -> Result<PerLayer<AmountCurve>, Error> {
    let dyes = stock.dyes_on(SpectralShape::VISIBLE)?;
    let reader = Reader::new(&dyes, stock.densitometry());
    let base = match stock.kind() {
        // Sheet and spectral curve disagree by some hundredths at D-min: keep the spectral one, add what the curve adds.
        StockKind::Negative => {
            let clear = reader.density(Vector3::zeros());
            stock.characteristic().zip_map(PerLayer::from([clear.x, clear.y, clear.z]), |c, d| d - c.d_min().0)
        }
        StockKind::Reversal | StockKind::Print => PerLayer::all(0.0),
    };
    let (from, to) = range(stock, mid_grey);
    let steps = ((to - from) / STEP).ceil().max(1.0);
    let offsets: Vec<f64> = (0..=steps as usize).map(|i| from + (to - from) * i as f64 / steps).collect();
    let mut found: [Vec<f64>; 3] = Default::default();
    let (mut amount, mut before) = (Vector3::repeat(0.5), None);
    for &offset in &offsets {
        let at = mid_grey.map(|h| LogExposure(h.0 + offset));
        let target = stock.characteristic().zip_map(at, |curve, h| curve.density(h).0);
        let target = Vector3::from(target.zip_map(base, |d, b| d + b).to_array());
        // The curves go on as they went: a step less for Newton's method.
        let straight_on = before.map_or(amount, |before: Vector3<f64>| 2.0 * amount - before);
        let unmixed = reader.unmix(target, straight_on).or_else(|| reader.unmix(target, amount));
        let unmixed = unmixed.ok_or_else(|| ErrorKind::Unmixing { stock: stock.id().to_owned(), offset })?;
        before = (offset > from).then_some(amount);
        amount = unmixed;
        for (curve, a) in found.iter_mut().zip(amount.iter()) {
            curve.push(*a);
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

/// A densitometer over three dyes: rows ready for the inner loop.
struct Reader {
    /// Per wavelength: the three unit densities, the base, the three responses.
    rows: Vec<([f64; 3], f64, [f64; 3])>,
}

impl Reader {
    fn new(dyes: &Dyes, densitometry: Densitometry) -> Self {
        let [c, m, y] = dyes.dyes().map(SpectralDistribution::values).to_array();
        let [r, g, b] = densitometry.responses().as_ref().map(SpectralDistribution::values).to_array();
        let base = |i: usize| dyes.d_min().map_or(0.0, |d| d.values()[i]);
        let rows = (0..c.len()).map(|i| ([c[i], m[i], y[i]], base(i), [r[i], g[i], b[i]]));
        Self { rows: rows.filter(|(_, _, response)| response.iter().any(|&v| v > 0.0)).collect() }
    }

    fn density(&self, amount: Vector3<f64>) -> Vector3<f64> {
        self.density_and_slope(amount).0
    }

    /// Densities, and their derivative by the amounts.
    fn density_and_slope(&self, amount: Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
        let (mut passed, mut weighted) = (Vector3::zeros(), Matrix3::zeros());
        for (dye, base, response) in &self.rows {
            let dye = Vector3::from(*dye);
            let light = Vector3::from(*response) * (-LN_10 * (base + dye.dot(&amount))).exp();
            passed += light;
            weighted += light * dye.transpose();
        }
        let slope = Matrix3::from_fn(|i, j| weighted[(i, j)] / passed[i]);
        (passed.map(|p: f64| -p.log10()), slope)
    }

    fn unmix(&self, target: Vector3<f64>, start: Vector3<f64>) -> Option<Vector3<f64>> {
        let mut amount = start;
        for _ in 0..MAX_ITERATIONS {
            let (density, slope) = self.density_and_slope(amount);
            let miss = density - target;
            if miss.amax() < DENSITY_TOLERANCE {
                return Some(amount);
            }
            // Far steps overshoot where one dye hides another.
            let step = slope.lu().solve(&miss)?;
            amount -= step * (1.0 / step.amax()).min(1.0);
            if !amount.iter().all(|a| a.is_finite()) {
                return None;
            }
        }
        None
    }
}
