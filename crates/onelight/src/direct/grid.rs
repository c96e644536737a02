use std::f64::consts::LOG2_10;

use nalgebra::{Matrix3, Vector3};
use onelight_lut::{ExponentialSum, ExponentialTerm};
use onelight_printing::SpectralRow;

use crate::error::{Error, Kind};

/// The sums over rows by 1 nm as sums over every `step_nm`-th, `to` put behind them.
///
/// Only the light that the dyes let pass is read by the coarse grid, as a cubic through four neighbours; lamp, filters, base and
/// sensitivity, which are less smooth, are in the weights as they are. (Every n-th row by itself, the trapezoidal rule, costs up to
/// 0.4 dE at 5 nm, as it misses edges of the printer's filters.)
pub(super) fn sum(rows: &[SpectralRow], to: &Matrix3<f64>, step_nm: usize) -> Result<ExponentialSum, Error> {
    let last = rows.len().saturating_sub(1);
    if step_nm == 0 || !last.is_multiple_of(step_nm) || last / step_nm < 3 {
        let expected =
            format!("a whole number that divides the {last} nm of the film's grid, such as 1, 2, 5, 10 or 20");
        return Err(
            Kind::Setting { what: "step of a direct form's grid in nm", found: step_nm as f64, expected }.into()
        );
    }
    let mut weights = vec![Vector3::zeros(); last / step_nm + 1];
    for (i, row) in rows.iter().enumerate() {
        let light = to * Vector3::from(row.weights) * 10f64.powf(-row.base);
        // The four neighbours, two on each side where there are two.
        let first = (i / step_nm).saturating_sub(1).min(weights.len() - 4);
        let at = i as f64 / step_nm as f64 - first as f64;
        for (weight, share) in weights[first..first + 4].iter_mut().zip(cubic(at)) {
            *weight += light * share;
        }
    }
    let term = |(row, weight): (&SpectralRow, &Vector3<f64>)| ExponentialTerm {
        rate: row.dyes.map(|dye| (dye * LOG2_10) as f32),
        weight: weight.data.0[0].map(|w| w as f32),
    };
    Ok(ExponentialSum::new(rows.iter().step_by(step_nm).zip(&weights).map(term).collect())?)
}

/// Lagrange's weights of values at 0, 1, 2 and 3 for the cubic through them, read at `t`.
fn cubic(t: f64) -> [f64; 4] {
    let [a, b, c, d] = [t, t - 1.0, t - 2.0, t - 3.0];
    [-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0]
}
