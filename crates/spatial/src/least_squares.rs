use nalgebra::{DMatrix, DVector};

const MAX_STEPS: usize = 200;
/// A step that lowers the sum of squares by less than this share of it ends the search.
const ENOUGH: f64 = 1e-12;
/// Distance for derivatives by differences, of parameters about 1.
const NUDGE: f64 = 1e-6;

/// The parameters within bounds that make the sum of squared residuals least, and that sum: steps from `start` as \[Marquardt1963\] damps them,
/// parameters at a bound standing still while they would leave it.
pub(crate) fn minimise(residuals: impl Fn(&[f64]) -> Vec<f64>, start: &[f64], bounds: &[[f64; 2]]) -> (Vec<f64>, f64) {
    let clamp = |p: Vec<f64>| p.iter().zip(bounds).map(|(v, [low, high])| v.clamp(*low, *high)).collect::<Vec<f64>>();
    let square = |r: &[f64]| r.iter().map(|r| r * r).sum::<f64>();
    let mut at = clamp(start.to_vec());
    let mut found = residuals(&at);
    let mut cost = square(&found);
    let mut damping = 1e-3;
    for _ in 0..MAX_STEPS {
        let columns: Vec<DVector<f64>> = (0..at.len())
            .map(|i| {
                let mut near = at.clone();
                let nudge = if at[i] + NUDGE > bounds[i][1] { -NUDGE } else { NUDGE };
                near[i] += nudge;
                let there = residuals(&near);
                DVector::from_iterator(found.len(), there.iter().zip(&found).map(|(a, b)| (a - b) / nudge))
            })
            .collect();
        let slope = DMatrix::from_columns(&columns);
        let gradient = slope.transpose() * DVector::from_column_slice(&found);
        let held =
            |i: usize| (at[i] <= bounds[i][0] && gradient[i] > 0.0) || (at[i] >= bounds[i][1] && gradient[i] < 0.0);
        let free: Vec<usize> = (0..at.len()).filter(|&i| !held(i)).collect();
        if free.is_empty() {
            break;
        }
        let normal = DMatrix::from_fn(free.len(), free.len(), |i, j| columns[free[i]].dot(&columns[free[j]]));
        let downhill = DVector::from_fn(free.len(), |i, _| -gradient[free[i]]);
        let mut gained = false;
        while damping < 1e12 {
            let mut damped = normal.clone();
            for i in 0..free.len() {
                damped[(i, i)] += damping * (normal[(i, i)] + 1e-12);
            }
            let Some(step) = damped.lu().solve(&downhill) else {
                damping *= 10.0;
                continue;
            };
            let mut next = at.clone();
            for (k, &i) in free.iter().enumerate() {
                next[i] += step[k];
            }
            let next = clamp(next);
            let there = residuals(&next);
            let lower = square(&there);
            if lower < cost {
                gained = cost - lower > ENOUGH * cost;
                (at, found, cost) = (next, there, lower);
                damping = (damping * 0.3).max(1e-12);
                break;
            }
            damping *= 10.0;
        }
        if !gained {
            break;
        }
    }
    (at, cost)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_parameters_of_a_curve_and_stops_at_bounds() {
        let curve = |p: &[f64], x: f64| p[0] * (-p[1] * x).exp();
        let data: Vec<f64> = (0..20).map(|i| curve(&[1.3, 0.4], f64::from(i))).collect();
        let residuals = |p: &[f64]| data.iter().zip(0..).map(|(y, i)| curve(p, f64::from(i)) - y).collect::<Vec<f64>>();
        let (free, cost) = minimise(residuals, &[0.5, 1.0], &[[0.0, 5.0], [0.0, 5.0]]);
        assert!((free[0] - 1.3).abs() < 1e-6 && (free[1] - 0.4).abs() < 1e-6 && cost < 1e-12, "{free:?}");
        let (held, _) = minimise(residuals, &[0.5, 1.0], &[[0.0, 1.0], [0.0, 5.0]]);
        assert_eq!(held[0], 1.0);
    }
}
