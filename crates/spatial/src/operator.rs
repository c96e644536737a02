//! Blurs along one axis as sparse rows of weights.

use crate::cells::{CellAxis, coarse_cells};

/// A linear map along one axis of a picture, the same for every row or column: each number that comes out is a weighted sum of `count`
/// neighbours that go in. Edges are in the weights.
///
/// The example at [`StageNumbers`](crate::StageNumbers) applies one.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisMap {
    /// Neighbours in a sum.
    pub count: usize,
    /// For each number that comes out, the first of its neighbours.
    pub first: Vec<u32>,
    /// `count` weights for each number that comes out: those of the red, green and blue layer, and an unused one.
    pub weights: Vec<[f32; 4]>,
}

/// For each number that comes out, which numbers go in and their weights, in rising order.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Operator(Vec<Vec<(usize, f64)>>);

impl Operator {
    pub(crate) fn identity(count: usize) -> Self {
        Self((0..count).map(|i| vec![(i, 1.0)]).collect())
    }

    /// Symmetric taps of the neighbours at distance 1, 2, and so on; the ends repeat.
    pub(crate) fn taps(count: usize, side: &[f32]) -> Self {
        let centre = 1.0 - 2.0 * side.iter().map(|tap| f64::from(*tap)).sum::<f64>();
        Self::of(count, |i| {
            let beside = side.iter().enumerate().flat_map(|(d, tap)| {
                let tap = f64::from(*tap);
                [(i.saturating_sub(d + 1), tap), ((i + d + 1).min(count - 1), tap)]
            });
            beside.chain([(i, centre)]).collect()
        })
    }

    /// Means over the pixels of each cell.
    pub(crate) fn means(axis: &CellAxis) -> Self {
        Self::of(axis.count, |cell| {
            let pixels = axis.pixels_of(cell);
            let share = 1.0 / pixels.len() as f64;
            pixels.map(|pixel| (pixel, share)).collect()
        })
    }

    /// Pixels between the centres of cells.
    pub(crate) fn expansion(axis: &CellAxis) -> Self {
        Self::of(axis.pixels(), |pixel| {
            let (a, b, t) = axis.between(pixel);
            vec![(a, 1.0 - f64::from(t)), (b, f64::from(t))]
        })
    }

    /// Pixels to cells, blurred there, and back.
    pub(crate) fn in_cells(axis: &CellAxis, side: &[f32]) -> Self {
        Self::expansion(axis).after(&Self::taps(axis.count, side)).after(&Self::means(axis))
    }

    /// This one applied to what `first` makes.
    fn after(&self, first: &Self) -> Self {
        let row = |row: &Vec<(usize, f64)>| {
            row.iter().flat_map(|(middle, w)| first.0[*middle].iter().map(move |(i, v)| (*i, w * v))).collect()
        };
        Self::of(self.0.len(), |i| row(&self.0[i]))
    }

    /// Rows of weights, those of one number together.
    fn of(count: usize, row: impl Fn(usize) -> Vec<(usize, f64)>) -> Self {
        let together = |mut row: Vec<(usize, f64)>| {
            row.sort_by_key(|(i, _)| *i);
            let mut sums: Vec<(usize, f64)> = Vec::with_capacity(row.len());
            for (i, w) in row {
                match sums.last_mut() {
                    Some((last, sum)) if *last == i => *sum += w,
                    _ => sums.push((i, w)),
                }
            }
            sums
        };
        Self((0..count).map(|i| together(row(i))).collect())
    }
}

/// A Gaussian of `sigma` pixels over cells, along each axis, as `CellRows::blurred_by` makes it.
pub(crate) fn blur_operators(axes: [&CellAxis; 2], sigma: [f64; 2]) -> [Operator; 2] {
    let (coarse, taps) = coarse_cells(axes, sigma);
    [0, 1].map(|i| match &coarse {
        Some(coarse) => Operator::in_cells(&coarse[i], &taps[i]),
        None => Operator::taps(axes[i].count, &taps[i]),
    })
}

/// Three operators of one length as one map.
pub(crate) fn across_layers(layers: &[Operator; 3]) -> AxisMap {
    let outputs = layers[0].0.len();
    let ends = |i: usize| {
        let rows = layers.iter().map(|layer| &layer.0[i]);
        let first = rows.clone().filter_map(|row| row.first()).map(|(i, _)| *i).min().unwrap_or(0);
        let last = rows.filter_map(|row| row.last()).map(|(i, _)| *i).max().unwrap_or(0);
        (first, last)
    };
    let inputs = (0..outputs).map(|i| ends(i).1 + 1).max().unwrap_or(1);
    let count = (0..outputs).map(|i| ends(i).1 - ends(i).0 + 1).max().unwrap_or(1);
    let mut map = AxisMap { count, first: Vec::with_capacity(outputs), weights: vec![[0.0; 4]; count * outputs] };
    for i in 0..outputs {
        let first = ends(i).0.min(inputs - count);
        map.first.push(first as u32);
        for (k, layer) in layers.iter().enumerate() {
            for (at, weight) in &layer.0[i] {
                map.weights[i * count + at - first][k] = *weight as f32;
            }
        }
    }
    map
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_sum_to_one_and_edges_repeat() {
        let axis = CellAxis::new(4, 3, 30);
        for operator in
            [Operator::taps(30, &[0.2, 0.1]), Operator::in_cells(&axis, &[0.25]), Operator::expansion(&axis)]
        {
            for row in &operator.0 {
                assert!((row.iter().map(|(_, w)| w).sum::<f64>() - 1.0).abs() < 1e-6, "{row:?}");
            }
        }
        let taps = Operator::taps(30, &[0.2, 0.1]);
        let near = |row: &[(usize, f64)], expected: &[(usize, f64)]| {
            row.len() == expected.len() && row.iter().zip(expected).all(|(a, b)| a.0 == b.0 && (a.1 - b.1).abs() < 1e-6)
        };
        assert!(near(&taps.0[0], &[(0, 0.7), (1, 0.2), (2, 0.1)]), "{:?}", taps.0[0]);
        assert!(near(&taps.0[29], &[(27, 0.1), (28, 0.2), (29, 0.7)]));
        let map = across_layers(&[taps.clone(), Operator::identity(30), taps]);
        assert_eq!((map.count, map.first[0], map.first[29], map.weights.len()), (5, 0, 25, 150));
        assert_eq!(map.weights[29 * 5 + 4][1], 1.0);
    }
}
