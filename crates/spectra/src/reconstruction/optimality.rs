//! The conditions of optimality (Karush, Kuhn, Tucker) of the quadratic programme behind the table of the smooth basis.
//!
//! Three reflectances, nowhere negative and with the sum 1 at every wavelength, are seen by the sensors as red, green and blue, and the
//! sum of the squared differences between neighbours is the least. A multiplier for every sensor on every reflectance turns the slope of
//! that sum into prices. At the optimum no wavelength can be moved from one reflectance to another at a gain: what is above 0 has the
//! least of the three prices.

use nalgebra::{SMatrix, SVector};

/// A reflectance above this is off its bound: its price has to be the least.
const OFF_BOUND: f64 = 1e-3;

/// How far three feasible reflectances are from the optimum.
#[derive(Debug)]
pub(super) struct Distance {
    /// What the sum of squares can still fall by, at most. It is an upper bound whatever the multipliers are, since the sum is convex.
    pub(super) gap: f64,
    /// Largest difference between the price of a reflectance off its bound and the least price at its wavelength.
    pub(super) slope: f64,
}

impl Distance {
    pub(super) fn of(sensors: &[Vec<f64>; 3], basis: &[Vec<f64>; 3]) -> Option<Self> {
        let slopes: [Vec<f64>; 3] = std::array::from_fn(|k| slope(&basis[k]));
        let multipliers = multipliers(sensors, basis, &slopes)?;
        let (mut gap, mut largest) = (0.0, 0f64);
        for i in 0..sensors[0].len() {
            let prices: [f64; 3] =
                std::array::from_fn(|k| slopes[k][i] + of_primary(&seen(sensors, i), k).dot(&multipliers));
            let least = prices.iter().copied().fold(f64::INFINITY, f64::min);
            for (price, reflectance) in prices.iter().zip(basis).map(|(price, basis)| (price - least, basis[i])) {
                gap += price * reflectance;
                if reflectance > OFF_BOUND {
                    largest = largest.max(price);
                }
            }
        }
        Some(Self { gap, slope: largest })
    }
}

/// The multipliers that make equal, in the sense of least squares, the prices of all that is off its bound: three for red, three for green.
/// Blue needs none, because the sum is 1.
fn multipliers(sensors: &[Vec<f64>; 3], basis: &[Vec<f64>; 3], slopes: &[Vec<f64>; 3]) -> Option<SVector<f64, 6>> {
    let (mut square, mut right) = (SMatrix::<f64, 6, 6>::zeros(), SVector::<f64, 6>::zeros());
    for i in 0..sensors[0].len() {
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            if basis[a][i].min(basis[b][i]) > OFF_BOUND {
                let seen = seen(sensors, i);
                let row = of_primary(&seen, a) - of_primary(&seen, b);
                square += row * row.transpose();
                right += row * (slopes[b][i] - slopes[a][i]);
            }
        }
    }
    square.lu().solve(&right)
}

/// What the three sensors see of one wavelength.
fn seen(sensors: &[Vec<f64>; 3], i: usize) -> [f64; 3] {
    std::array::from_fn(|s| sensors[s][i])
}

/// The same as coefficients of the multipliers of one primary.
fn of_primary(seen: &[f64; 3], primary: usize) -> SVector<f64, 6> {
    SVector::from_fn(|row, _| if row / 3 == primary { seen[row % 3] } else { 0.0 })
}

/// Slope of the sum of squared differences between neighbours, in each value.
fn slope(values: &[f64]) -> Vec<f64> {
    let mut slope = vec![0.0; values.len()];
    for (i, pair) in values.windows(2).enumerate() {
        let rise = 2.0 * (pair[1] - pair[0]);
        slope[i] -= rise;
        slope[i + 1] += rise;
    }
    slope
}
