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
    let held = |nm: f64| match (nodes.x.first(), &nodes.y[..]) {
        (Some(&first), [low, ..]) if nm < first => *low,
        (_, [.., high]) => *high,
        _ => 0.0,
    };
    SpectralDistribution::from_fn(shape, |nm| match (nodes.at(nm), outside) {
        (Some(value), _) => value,
        (None, Outside::Zero) => 0.0,
        (None, Outside::Held) => held(nm),
    })
}

impl Nodes {
    /// The value at `x`, linear between the nodes, `None` outside them.
    #[must_use]
    pub fn at(&self, x: f64) -> Option<f64> {
        // As many as have both: the fields are open.
        linear_at(|i| self.x[i], &self.y[..self.y.len().min(self.x.len())], x)
    }
}

/// The value at `at` of the straight lines through the points `(x(i), y[i])`, `None` outside them; `x` increases.
pub(crate) fn linear_at(x: impl Fn(usize) -> f64, y: &[f64], at: f64) -> Option<f64> {
    let last = y.len().checked_sub(1)?;
    if last == 0 || !(x(0)..=x(last)).contains(&at) {
        return (last == 0 && x(0) == at).then(|| y[0]);
    }
    let (mut low, mut high) = (0, last);
    while high - low > 1 {
        let middle = low.midpoint(high);
        if x(middle) <= at { low = middle } else { high = middle }
    }
    Some(y[low] + (at - x(low)) / (x(high) - x(low)) * (y[high] - y[low]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nodes(x: &[f64], y: &[f64]) -> Nodes {
        Nodes { x: x.to_vec(), y: y.to_vec(), lines: vec![1; x.len()] }
    }

    #[test]
    fn a_line_through_uneven_nodes_stays_a_line() {
        let line = nodes(&[0.0, 1.0, 1.5, 7.0, 8.0], &[3.0, 5.0, 6.0, 17.0, 19.0]);
        for i in 0..=80 {
            let x = f64::from(i) / 10.0;
            assert!((line.at(x).unwrap() - (3.0 + 2.0 * x)).abs() < 1e-12, "{x}");
        }
        assert_eq!([line.at(-1e-9), line.at(8.1), line.at(f64::NAN)], [None; 3]);
    }

    #[test]
    fn corners_lie_at_the_nodes() {
        let bent = nodes(&[400.0, 500.0, 600.0], &[1.0, 0.0, 4.0]);
        assert_eq!([400.0, 450.0, 500.0, 525.0, 600.0].map(|x| bent.at(x)), [1.0, 0.5, 0.0, 1.0, 4.0].map(Some));
        assert_eq!(nodes(&[5.0], &[2.0]).at(5.0), Some(2.0));
        assert_eq!(nodes(&[], &[]).at(5.0), None);
        assert_eq!(nodes(&[1.0, 2.0, 3.0], &[7.0, 9.0]).at(2.5), None);
    }

    #[test]
    fn beyond_the_ends_is_what_is_asked_for() {
        let table = nodes(&[400.0, 700.0], &[2.0, 5.0]);
        let on = |outside| {
            linear::<crate::quantity::Power>(&table, SpectralShape::VISIBLE, outside).unwrap().values().to_vec()
        };
        let (zero, held) = (on(Outside::Zero), on(Outside::Held));
        assert_eq!((zero[0], zero[20], zero[320], zero[400]), (0.0, 2.0, 5.0, 0.0));
        assert_eq!((held[0], held[20], held[320], held[400]), (2.0, 2.0, 5.0, 5.0));
    }
}
