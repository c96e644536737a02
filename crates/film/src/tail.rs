/// Least-squares slope of `y` over `x`; 0 for fewer than two points.
pub(crate) fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    if points.len() < 2 {
        return 0.0;
    }
    let (mean_x, mean_y) = (points.iter().map(|p| p.0).sum::<f64>() / n, points.iter().map(|p| p.1).sum::<f64>() / n);
    let covariance: f64 = points.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    let variance: f64 = points.iter().map(|(x, _)| (x - mean_x).powi(2)).sum();
    covariance / variance
}

#[cfg(test)]
mod tests {
    #[test]
    fn slope_of_a_line_is_its_slope() {
        let line: Vec<(f64, f64)> = (0..5).map(|i| (f64::from(i), 7.0 - 2.5 * f64::from(i))).collect();
        assert!((super::slope(&line) + 2.5).abs() < 1e-14);
    }
}
