use std::f64::consts::{LN_2, LOG2_10};

use nalgebra::{Matrix3, Vector3};
use onelight_lut::{ExponentialSum, ExponentialTerm};
use onelight_printing::SpectralRow;

use crate::error::{Error, ErrorKind};
use crate::positive::Positive;
use crate::reference::Reference;

/// A wavelength of a grid that adds less than this part to each sum is left out. 10^-6 would cost 0.008 dE by 1 nm: what is dark
/// elsewhere is seen through such wavelengths.
const LEAST_PART: f64 = 1e-9;
/// Terms of a scan's rule: a channel each, and black.
const RULE_TERMS: usize = 4;

/// An [`ExponentialSum`] before it is rounded: `sum of weight 2^-(rate . x)`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sum(pub(super) Vec<Term>);

/// One exponential of a [`Sum`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Term {
    pub(super) rate: Vector3<f64>,
    pub(super) weight: Vector3<f64>,
}

impl Term {
    pub(super) fn exponential(&self, x: &Vector3<f64>) -> f64 {
        (-self.rate.dot(x)).exp2()
    }
}

impl From<&ExponentialSum> for Sum {
    fn from(sum: &ExponentialSum) -> Self {
        let wide = |v: [f32; 3]| Vector3::from(v.map(f64::from));
        Self(sum.terms().iter().map(|term| Term { rate: wide(term.rate), weight: wide(term.weight) }).collect())
    }
}

impl Sum {
    /// The sums over rows by 1 nm, `to` put behind them.
    pub(super) fn of(rows: &[SpectralRow], to: &Matrix3<f64>) -> Self {
        let term = |row: &SpectralRow| Term {
            rate: Vector3::from(row.dyes) * LOG2_10,
            weight: to * Vector3::from(row.weights) * 10f64.powf(-row.base),
        };
        Self(rows.iter().map(term).collect())
    }

    /// From dye in the camera film to the exposure of its print, or the light that a scan reads; none where it is shown itself.
    pub(super) fn behind(film: &Reference) -> Option<Self> {
        let rows = match film.positive() {
            Positive::Itself => return None,
            Positive::Print(print) => print.duplication.rows(),
            Positive::Scan(scan) => &scan.rows,
        };
        Some(Self::of(rows, &Matrix3::identity()))
    }

    /// From the last film's dye to linear RGB; of a scan its rule, which takes no more than a term for each channel and one for black.
    pub(super) fn shown(film: &Reference) -> Self {
        let Positive::Scan(scan) = film.positive() else {
            return Self::of(film.projection().rows(), film.rgb_from_light());
        };
        let gain = Vector3::from(scan.scan.gain().to_array());
        let channel = |c: usize| Term { rate: Vector3::ith(c, -LOG2_10), weight: scan.to_output.column(c) * gain[c] };
        let black = Term { rate: Vector3::zeros(), weight: -(scan.to_output * gain) };
        Self((0..3).map(channel).chain([black]).collect())
    }

    /// Whether it is a rule of no more terms than colours and black have, which is no sum over wavelengths and needs no fit.
    pub(super) fn is_rule(&self) -> bool {
        self.0.len() <= RULE_TERMS
    }

    /// This sum by 1 nm as one over every `step_nm`-th wavelength.
    ///
    /// Only the light that the dyes let pass is read by the coarse grid, as a cubic through four neighbours; lamp, filters,
    /// base and sensitivity, which are less smooth, are in the weights as they are. (Every n-th wavelength by itself, the
    /// trapezoidal rule, costs up to 0.4 dE at 5 nm, as it misses edges of the printer's filters.) Wavelengths that add next to
    /// nothing are left out: a quarter of them behind a negative.
    pub(super) fn on_grid(&self, step_nm: usize) -> Result<Self, Error> {
        if self.is_rule() {
            return Ok(self.clone());
        }
        let last = self.0.len().saturating_sub(1);
        if step_nm == 0 || !last.is_multiple_of(step_nm) || last / step_nm < 3 {
            let expected =
                format!("a whole number that divides the {last} nm of the film's grid, such as 1, 2, 5, 10 or 20");
            let what = "step of a direct form's grid in nm".to_owned();
            return Err(ErrorKind::Setting { what, found: step_nm as f64, expected }.into());
        }
        let nodes = self.0.iter().step_by(step_nm);
        let mut coarse: Vec<Term> = nodes.map(|term| Term { rate: term.rate, weight: Vector3::zeros() }).collect();
        for (i, term) in self.0.iter().enumerate() {
            // The four neighbours, two on each side where there are two.
            let first = (i / step_nm).saturating_sub(1).min(coarse.len() - 4);
            let at = i as f64 / step_nm as f64 - first as f64;
            for (node, share) in coarse[first..first + 4].iter_mut().zip(cubic(at)) {
                node.weight += term.weight * share;
            }
        }
        let all = coarse.iter().fold(Vector3::zeros(), |all: Vector3<f64>, node| all + node.weight.abs());
        coarse.retain(|node| (0..3).any(|j| node.weight[j].abs() > LEAST_PART * all[j]));
        Ok(Self(coarse))
    }

    pub(super) fn at(&self, x: &Vector3<f64>) -> Vector3<f64> {
        self.0.iter().map(|term| term.weight * term.exponential(x)).sum()
    }

    /// The derivative of sum i by variable k in row i, column k.
    pub(super) fn slope_at(&self, x: &Vector3<f64>) -> Matrix3<f64> {
        self.0.iter().map(|term| term.weight * term.rate.transpose() * (-LN_2 * term.exponential(x))).sum()
    }

    pub(super) fn rounded(&self) -> Result<ExponentialSum, Error> {
        let single = |v: Vector3<f64>| <[f64; 3]>::from(v).map(|v| v as f32);
        let term = |term: &Term| ExponentialTerm { rate: single(term.rate), weight: single(term.weight) };
        Ok(ExponentialSum::new(self.0.iter().map(term).collect())?)
    }
}

/// Lagrange's weights of values at 0, 1, 2 and 3 for the cubic through them, read at `t`.
fn cubic(t: f64) -> [f64; 4] {
    let [a, b, c, d] = [t, t - 1.0, t - 2.0, t - 3.0];
    [-b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0]
}
