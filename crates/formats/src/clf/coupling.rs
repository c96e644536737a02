//! Coupled layers in a chain of three channels: a small table of log exposures.

use onelight_lut::{Coupling, Develop, Domain, Lut1d, Lut3d};

use super::op::Op;
use crate::error::Error;

/// Nodes of the table along each side. docs/performance.md has the error and the size of other numbers.
const SIZE: usize = 33;
/// Points of the curve before it: nodes lie on its points.
const POINTS: usize = 4096;
/// The part of nodes that lie at equal steps, whatever the curve.
const EVEN: f64 = 0.2;

/// From log2 exposures over `unit`, as coordinates 0 to 1, to those at which the curves are read, over their own domain as 0 to 1.
///
/// A chain has three channels, and coupled layers need six numbers: the log exposures and what acts on the neighbours. So a table
/// holds the moved log exposures over the log exposures themselves. `h + matrix q` is a sum of functions of one channel each, for
/// which interpolation in a table is that of each function along its axis; nodes are put where these bend.
pub(super) fn ops(develop: &Develop, coupling: &Coupling, unit: &Domain) -> Result<[Op; 2], Error> {
    let (axis, positions) = axes(coupling, unit)?;
    let [from, to] = [develop.curves.domain().min(), develop.curves.domain().max()];
    let node = |i: usize| {
        let h: [f64; 3] = [positions[i % SIZE][0], positions[i / SIZE % SIZE][1], positions[i / SIZE / SIZE][2]];
        let q = coupling.curves.apply(h.map(|h| h as f32)).map(f64::from);
        std::array::from_fn(|c| {
            let shift: f64 = coupling.matrix[c].iter().zip(q).map(|(m, q)| f64::from(*m) * q).sum();
            ((h[c] + shift - f64::from(from[c])) / (f64::from(to[c]) - f64::from(from[c]))) as f32
        })
    };
    let table = Lut3d::new(SIZE, (0..SIZE * SIZE * SIZE).map(node).collect())?;
    Ok([Op::Lut1d(axis), Op::Lut3d(table, onelight_lut::Interpolation::Tetrahedral)])
}

/// The domain that holds the curves' and what acts: beyond it nothing changes.
pub(super) fn unit(develop: &Develop, coupling: &Coupling) -> Result<Domain, Error> {
    let (curves, acting) = (develop.curves.domain(), coupling.curves.domain());
    let least = std::array::from_fn(|c| curves.min()[c].min(acting.min()[c]));
    let most = std::array::from_fn(|c| curves.max()[c].max(acting.max()[c]));
    Ok(Domain::new(least, most)?)
}

/// The curve from a unit domain to the table's coordinate, and the log exposures of the nodes.
fn axes(coupling: &Coupling, unit: &Domain) -> Result<(Lut1d, Vec<[f64; 3]>), Error> {
    let mut places = [[0; SIZE]; 3];
    for (c, places) in places.iter_mut().enumerate() {
        *places = nodes(&bends(coupling, unit, c));
    }
    let at = |c: usize, point: usize| {
        let t = point as f64 / (POINTS - 1) as f64;
        f64::from(unit.min()[c]) * (1.0 - t) + f64::from(unit.max()[c]) * t
    };
    let coordinate = |c: usize, point: usize| {
        let places = &places[c];
        let cell = places.partition_point(|&place| place <= point).clamp(1, SIZE - 1);
        let (low, high) = (places[cell - 1], places[cell]);
        let part = (point - low) as f64 / (high - low) as f64;
        (((cell - 1) as f64 + part) / (SIZE - 1) as f64) as f32
    };
    let entries = (0..POINTS).map(|point| std::array::from_fn(|c| coordinate(c, point)));
    let positions = (0..SIZE).map(|node| std::array::from_fn(|c| at(c, places[c][node])));
    Ok((Lut1d::new(Domain::UNIT, entries.collect())?, positions.collect()))
}

/// How many nodes each point of the axis is worth: the root of the curve's second difference, which makes the error between nodes
/// alike everywhere.
fn bends(coupling: &Coupling, unit: &Domain, channel: usize) -> Vec<f64> {
    let value = |point: usize| {
        let t = point as f64 / (POINTS - 1) as f64;
        let h = f64::from(unit.min()[channel]) * (1.0 - t) + f64::from(unit.max()[channel]) * t;
        f64::from(coupling.curves.apply([h as f32; 3])[channel])
    };
    // Over a hundredth of the axis: the curve itself is a polygon of fewer points than this axis has.
    const REACH: usize = POINTS / 100;
    (0..POINTS)
        .map(|point| {
            let (low, high) = (point.saturating_sub(REACH), (point + REACH).min(POINTS - 1));
            (value(low) + value(high) - 2.0 * value((low + high) / 2)).abs().sqrt()
        })
        .collect()
}

/// Points that are nodes: the ends, and between them shares of the same worth.
fn nodes(worth: &[f64]) -> [usize; SIZE] {
    let all: f64 = worth.iter().sum::<f64>().max(f64::MIN_POSITIVE);
    let even = EVEN / (1.0 - EVEN) * all / worth.len() as f64;
    let total = all + even * worth.len() as f64;
    let (mut found, mut sum, mut next) = ([0; SIZE], 0.0, 1);
    for (point, worth) in worth.iter().enumerate() {
        sum += worth + even;
        while next < SIZE - 1 && sum >= total * next as f64 / (SIZE - 1) as f64 {
            // No two nodes at one point.
            found[next] = point.max(found[next - 1] + 1).min(POINTS - SIZE + next);
            next += 1;
        }
    }
    for (i, found) in found.iter_mut().enumerate().skip(next) {
        *found = POINTS - SIZE + i;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bent() -> (Develop, Coupling) {
        let q = |h: f64| 2.0 / (1.0 + (-0.8 * h).exp());
        let matrix = [[0.9, -0.8, -0.1], [-0.8, 1.6, -0.8], [-0.1, -0.8, 0.9]];
        let coupling = Coupling { curves: Lut1d::sample(256, [-9.0, 8.0], q).unwrap(), matrix };
        (Develop { coupling: None, curves: Lut1d::sample(64, [-8.0, 9.0], |h| h).unwrap() }, coupling)
    }

    #[test]
    fn nodes_rise_and_reach_both_ends() {
        let (_, coupling) = bent();
        let unit = Domain::common(-9.0, 9.0).unwrap();
        for channel in 0..3 {
            let nodes = nodes(&bends(&coupling, &unit, channel));
            assert_eq!((nodes[0], nodes[SIZE - 1]), (0, POINTS - 1));
            assert!(nodes.windows(2).all(|pair| pair[0] < pair[1]), "{nodes:?}");
        }
        assert!(nodes(&[0.0; POINTS]).windows(2).all(|pair| pair[0] < pair[1]));
    }

    #[test]
    fn the_table_is_the_coupling() {
        let (develop, coupling) = bent();
        let unit = unit(&develop, &coupling).unwrap();
        let [axis, table] = ops(&develop, &coupling, &unit).unwrap();
        let mut largest = 0f64;
        for i in 0..4000 {
            let h = [7.0, 11.0, 13.0].map(|p| -9.0 + 18.0 * (f64::from(i) * p / 97.0).fract());
            let found = table.apply(axis.apply(h.map(|h| (h + 9.0) / 18.0)));
            let q = coupling.curves.apply(h.map(|h| h as f32)).map(f64::from);
            for c in 0..3 {
                let shift: f64 = coupling.matrix[c].iter().zip(q).map(|(m, q)| f64::from(*m) * q).sum();
                largest = largest.max((found[c] * 17.0 - 8.0 - h[c] - shift).abs());
            }
        }
        assert!(largest < 0.02, "{largest} stops");
    }
}
