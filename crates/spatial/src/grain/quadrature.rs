//! Means over normal numbers: Gauss and Hermite's rule with seven nodes for each layer.

/// Nodes and weights for a normal number of variance 1 \[Abramowitz1964\] (25.4.46, scaled).
const RULE: [(f64, f64); 7] = [
    (-3.750_439_717_725_742, 0.000_548_268_855_972_217_8),
    (-2.366_759_410_734_541, 0.030_757_123_967_586_5),
    (-1.154_405_394_739_968, 0.240_123_178_605_012_7),
    (0.0, 0.457_142_857_142_857_1),
    (1.154_405_394_739_968, 0.240_123_178_605_012_7),
    (2.366_759_410_734_541, 0.030_757_123_967_586_5),
    (3.750_439_717_725_742, 0.000_548_268_855_972_217_8),
];

/// Three independent normal numbers of mean 0 and variance 1: nodes and weights, which sum to 1.
pub(crate) fn normal_nodes() -> impl Iterator<Item = ([f64; 3], f64)> {
    RULE.into_iter().flat_map(|(x, wx)| {
        RULE.into_iter().flat_map(move |(y, wy)| RULE.into_iter().map(move |(z, wz)| ([x, y, z], wx * wy * wz)))
    })
}

#[cfg(test)]
mod tests {
    use super::normal_nodes;

    #[test]
    fn moments_of_normal_numbers() {
        let mean = |f: fn([f64; 3]) -> f64| normal_nodes().map(|(z, weight)| weight * f(z)).sum::<f64>();
        assert!((mean(|_| 1.0) - 1.0).abs() < 1e-14);
        assert!(mean(|[x, y, _]| x * y).abs() < 1e-14);
        assert!((mean(|[x, y, _]| x * x * y * y) - 1.0).abs() < 1e-12);
        // The log-normal distribution.
        assert!((mean(|[_, _, z]| (0.5 * z).exp()) - 0.125f64.exp()).abs() < 1e-9);
    }
}
