use std::ops::RangeInclusive;

use crate::error::{Error, ErrorKind};

/// Monotone piecewise cubic through given nodes: no overshoot between them (\[FritschCarlson1980\], slopes of \[FritschButland1984\]).
///
/// ```
/// use onelight_spectra::Pchip;
/// let curve = Pchip::new(vec![0.0, 1.0, 2.0], vec![0.0, 1.0, 1.0])?;
/// assert_eq!(curve.at(1.0), 1.0);
/// assert!(curve.at(1.5) <= 1.0);
/// assert_eq!(curve.at(7.0), 1.0, "flat outside the nodes");
/// # Ok::<(), onelight_spectra::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Pchip {
    x: Vec<f64>,
    y: Vec<f64>,
    slope: Vec<f64>,
}

impl Pchip {
    /// The curve through the points `(x[i], y[i])`.
    ///
    /// # Errors
    /// If there are fewer than two nodes, the counts differ, a value is not finite, x does not increase, or two nodes lie so far or so
    /// steeply apart that the cubic between them is beyond float64.
    pub fn new(x: Vec<f64>, y: Vec<f64>) -> Result<Self, Error> {
        let refuse = |problem: String| Err(ErrorKind::Nodes { problem }.into());
        if x.len() != y.len() || x.len() < 2 {
            return refuse(format!(
                "{} abscissae and {} ordinates, expected as many of both and at least 2",
                x.len(),
                y.len()
            ));
        }
        if let Some(i) = (0..x.len()).find(|&i| !x[i].is_finite() || !y[i].is_finite()) {
            return refuse(format!("node {i} is ({}, {}), expected finite values", x[i], y[i]));
        }
        if let Some(pair) = x.windows(2).find(|pair| pair[0] >= pair[1]) {
            return refuse(format!("{} after {}, expected increasing abscissae", pair[1], pair[0]));
        }
        let slope = slopes(&x, &y);
        let is_cubic = |i: usize| {
            let (width, rise) = (x[i + 1] - x[i], y[i + 1] - y[i]);
            [width, rise, rise / width, slope[i], slope[i + 1]].iter().all(|v| (v * ROOM).is_finite())
        };
        if let Some(i) = (0..x.len() - 1).find(|&i| !is_cubic(i)) {
            return refuse(format!(
                "nodes {i} and {} are ({:e}, {:e}) and ({:e}, {:e}), expected a slope that float64 holds",
                i + 1,
                x[i],
                y[i],
                x[i + 1],
                y[i + 1]
            ));
        }
        Ok(Self { x, y, slope })
    }

    /// The abscissae of the nodes, increasing.
    #[must_use]
    pub fn x(&self) -> &[f64] {
        &self.x
    }

    /// The ordinates of the nodes.
    #[must_use]
    pub fn y(&self) -> &[f64] {
        &self.y
    }

    /// From the first abscissa to the last.
    #[must_use]
    pub fn range(&self) -> RangeInclusive<f64> {
        self.x[0]..=self.x[self.x.len() - 1]
    }

    /// The value at `x`; outside the nodes the value of the nearest one. NaN gives the first.
    #[must_use]
    pub fn at(&self, x: f64) -> f64 {
        let (i, t, h) = self.locate(x);
        let (a, b) = (self.slope[i] * h, self.slope[i + 1] * h);
        let rise = self.y[i + 1] - self.y[i];
        // Horner form of the Hermite cubic: exact at t = 0.
        let value = self.y[i] + t * (a + t * (3.0 * rise - 2.0 * a - b + t * (a + b - 2.0 * rise)));
        if t == 1.0 { self.y[i + 1] } else { value }
    }

    /// The slope at `x`; 0 outside the nodes.
    #[must_use]
    pub fn slope_at(&self, x: f64) -> f64 {
        if !self.range().contains(&x) {
            return 0.0;
        }
        let (i, t, h) = self.locate(x);
        let (a, b) = (self.slope[i] * h, self.slope[i + 1] * h);
        let rise = self.y[i + 1] - self.y[i];
        (a + t * (2.0 * (3.0 * rise - 2.0 * a - b) + 3.0 * t * (a + b - 2.0 * rise))) / h
    }

    /// The first abscissa at which the curve takes the value `y`, `None` beyond its ordinates. For curves that only rise
    /// or only fall: others may be crossed elsewhere too.
    #[must_use]
    pub fn solve(&self, y: f64) -> Option<f64> {
        let i = self.y.windows(2).position(|p| p[0] != p[1] && p[0].min(p[1]) <= y && y <= p[0].max(p[1]))?;
        let rising = self.y[i + 1] > self.y[i];
        let (mut low, mut high) = (self.x[i], self.x[i + 1]);
        loop {
            let middle = low + 0.5 * (high - low);
            if middle <= low || middle >= high {
                // Neighbouring floats: take the one whose value is nearer.
                let miss = |x: f64| (self.at(x) - y).abs();
                return Some(if miss(low) <= miss(high) { low } else { high });
            }
            if (self.at(middle) < y) == rising { low = middle } else { high = middle }
        }
    }

    /// Interval, position in it from 0 to 1, and its width.
    fn locate(&self, x: f64) -> (usize, f64, f64) {
        let (first, last) = self.range().into_inner();
        let x = x.max(first).min(last);
        let i = self.x.partition_point(|&node| node <= x).clamp(1, self.x.len() - 1) - 1;
        let h = self.x[i + 1] - self.x[i];
        (i, (x - self.x[i]) / h, h)
    }
}

/// Coefficients of a cubic and of its slope are less than this many times the rise between its nodes: slopes are three times the mean
/// one at most.
const ROOM: f64 = 64.0;

fn slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let h: Vec<f64> = x.windows(2).map(|p| p[1] - p[0]).collect();
    let m: Vec<f64> = y.windows(2).zip(&h).map(|(p, h)| (p[1] - p[0]) / h).collect();
    let n = m.len();
    if n == 1 {
        return vec![m[0]; 2];
    }
    let mut slope = vec![end_slope(h[0], h[1], m[0], m[1])];
    for i in 1..n {
        slope.push(if m[i - 1] * m[i] <= 0.0 {
            0.0
        } else {
            let (before, after) = (2.0 * h[i] + h[i - 1], h[i] + 2.0 * h[i - 1]);
            (before + after) / (before / m[i - 1] + after / m[i])
        });
    }
    slope.push(end_slope(h[n - 1], h[n - 2], m[n - 1], m[n - 2]));
    slope
}

/// Three-point slope at an end, kept from overshooting.
fn end_slope(h0: f64, h1: f64, m0: f64, m1: f64) -> f64 {
    let slope = ((2.0 * h0 + h1) * m0 - h0 * m1) / (h0 + h1);
    if slope * m0 <= 0.0 {
        0.0
    } else if m0 * m1 <= 0.0 && slope.abs() > 3.0 * m0.abs() {
        3.0 * m0
    } else {
        slope
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    fn staircase() -> Pchip {
        let x = vec![0.0, 0.7, 1.0, 2.5, 3.0, 4.0];
        let y = vec![0.0, 0.1, 2.0, 2.0, 2.2, 9.0];
        Pchip::new(x, y).unwrap()
    }

    #[test]
    fn passes_its_nodes_exactly_and_never_overshoots() {
        let curve = staircase();
        for (&x, &y) in curve.x().iter().zip(curve.y()) {
            assert_eq!(curve.at(x), y);
        }
        let values: Vec<f64> = (0..=4000).map(|i| curve.at(f64::from(i) / 1000.0)).collect();
        assert!(values.windows(2).all(|pair| pair[1] >= pair[0]));
    }

    #[test]
    fn a_straight_line_stays_straight() {
        let line = Pchip::new(vec![0.0, 1.0, 4.0, 5.0], vec![1.0, 3.0, 9.0, 11.0]).unwrap();
        for i in 0..=50 {
            let x = f64::from(i) / 10.0;
            assert_relative_eq!(line.at(x), 1.0 + 2.0 * x, epsilon = 1e-14);
            assert_relative_eq!(line.slope_at(x), 2.0, epsilon = 1e-13);
        }
    }

    #[test]
    fn slope_is_the_derivative() {
        let curve = staircase();
        for i in 1..400 {
            let x = f64::from(i) / 100.0 + 0.003;
            let difference = (curve.at(x + 1e-6) - curve.at(x - 1e-6)) / 2e-6;
            if x < 3.99 {
                assert_relative_eq!(curve.slope_at(x), difference, epsilon = 1e-4);
            }
        }
    }

    #[test]
    fn solve_undoes_at() {
        let rising = staircase();
        let falling = Pchip::new(rising.x().to_vec(), rising.y().iter().map(|y| -y).collect()).unwrap();
        for i in 0..=900 {
            let y = f64::from(i) / 100.0;
            assert_relative_eq!(rising.at(rising.solve(y).unwrap()), y, epsilon = 1e-13);
            assert_relative_eq!(falling.at(falling.solve(-y).unwrap()), -y, epsilon = 1e-13);
        }
        assert_eq!(rising.solve(9.001), None);
        assert_eq!(rising.solve(f64::NAN), None);
    }

    #[test]
    fn bad_nodes_are_refused() {
        assert!(Pchip::new(vec![0.0], vec![0.0]).is_err());
        assert!(Pchip::new(vec![0.0, 0.0], vec![0.0, 1.0]).is_err());
        assert!(Pchip::new(vec![0.0, 1.0], vec![0.0, f64::NAN]).is_err());
        assert!(Pchip::new(vec![0.0, 1.0], vec![0.0, 1.0, 2.0]).is_err());
    }
}
