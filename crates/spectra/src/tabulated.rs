use crate::distribution::{Quantity, SpectralDistribution};
use crate::error::Error;
use crate::shape::SpectralShape;
use crate::table::Nodes;

/// What a table says beyond its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outside {
    /// Nothing: 0.
    Zero,
    /// The value of the nearest end.
    Held,
}

/// Nodes brought to a grid, linear between them (the CIE's rule for its illuminants and colour-matching functions).
///
/// # Errors
/// If a value is not allowed for `Q`.
pub fn linear<Q: Quantity>(
    nodes: &Nodes,
    shape: SpectralShape,
    outside: Outside,
) -> Result<SpectralDistribution<Q>, Error> {
    SpectralDistribution::from_fn(shape, |nm| linear_at(nodes, nm, outside))
}

fn linear_at(nodes: &Nodes, nm: f64, outside: Outside) -> f64 {
    let (x, y) = (&nodes.x, &nodes.y);
    let last = x.len() - 1;
    if nm < x[0] || nm > x[last] {
        return match outside {
            Outside::Zero => 0.0,
            Outside::Held => y[if nm < x[0] { 0 } else { last }],
        };
    }
    let i = x.partition_point(|&node| node <= nm).clamp(1, last) - 1;
    y[i] + (nm - x[i]) / (x[i + 1] - x[i]) * (y[i + 1] - y[i])
}
