//! The quadratic programme behind the table of the smooth basis.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus, SupportedConeT};
use nalgebra::Matrix3;

use super::sensors::round_trip;
use crate::error::{Error, ErrorKind};

/// Largest error of the round trip that the solved basis may have before it is made exact.
const SOLVER_TOLERANCE: f64 = 1e-6;

/// The quadratic programme of \[MallettYuksel2019\]: reflectances >= 0, summing to 1, `sensors` seeing red, green and blue.
/// Unknowns: red, then green; blue is what is left of 1.
pub(super) fn least_non_negative(sensors: &[Vec<f64>; 3]) -> Result<[Vec<f64>; 3], Error> {
    let n = sensors[0].len();
    let constraints = constraints(sensors);
    let mut bounds = vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    bounds.extend(std::iter::repeat_n(0.0, 2 * n));
    bounds.extend(std::iter::repeat_n(1.0, n));
    let cones = [SupportedConeT::ZeroConeT(6), SupportedConeT::NonnegativeConeT(3 * n)];
    let failed = |problem: String| Error::from(ErrorKind::Basis { problem });
    let settings = DefaultSettingsBuilder::default()
        .verbose(false)
        .tol_gap_abs(1e-12)
        .tol_gap_rel(1e-12)
        .tol_feas(1e-12)
        .max_threads(1)
        .build()
        .map_err(|e| failed(e.to_string()))?;
    let mut solver = DefaultSolver::new(&curvature(n), &vec![0.0; 2 * n], &constraints, &bounds, &cones, settings)
        .map_err(|e| failed(e.to_string()))?;
    solver.solve();
    match solver.solution.status {
        SolverStatus::Solved | SolverStatus::AlmostSolved => polish(sensors, &solver.solution.x),
        status => Err(failed(format!("the quadratic programme ended with {status:?}, expected Solved"))),
    }
}

/// Removes what the interior point leaves: values a hair below 0 and a round trip that is exact to 1e-9 only.
fn polish(sensors: &[Vec<f64>; 3], solved: &[f64]) -> Result<[Vec<f64>; 3], Error> {
    let n = sensors[0].len();
    let clip = |v: f64| v.clamp(0.0, 1.0);
    let red: Vec<f64> = solved[..n].iter().copied().map(clip).collect();
    let green: Vec<f64> = solved[n..2 * n].iter().zip(&red).map(|(&g, r)| clip(g).min(1.0 - r)).collect();
    let blue: Vec<f64> = red.iter().zip(&green).map(|(r, g)| 1.0 - r - g).collect();
    let basis = [red, green, blue];
    let miss = (round_trip(sensors, &basis) - Matrix3::identity()).amax();
    if miss > SOLVER_TOLERANCE {
        let problem = format!("the round trip misses by {miss:e}, expected at most {SOLVER_TOLERANCE:e}");
        return Err(ErrorKind::Basis { problem }.into());
    }
    Ok(basis)
}

/// Second derivative of the sum of squared differences of red, green and 1 - red - green: upper triangle.
fn curvature(n: usize) -> CscMatrix<f64> {
    let second = |i: usize, j: usize| match i.abs_diff(j) {
        0 if i == 0 || i == n - 1 => 2.0,
        0 => 4.0,
        1 => -2.0,
        _ => 0.0,
    };
    // [[2, 1], [1, 2]] (x) second difference: blue's slope is minus that of red and green together.
    let entries = (0..2 * n).flat_map(|column| {
        let (block, j) = (column / n, column % n);
        (0..=block).flat_map(move |row_block| {
            let factor = if row_block == block { 2.0 } else { 1.0 };
            (j.saturating_sub(1)..=(j + 1).min(n - 1))
                .map(move |i| (row_block * n + i, column, factor * second(i, j)))
                .filter(|(row, column, _)| row <= column)
        })
    });
    from_entries(2 * n, 2 * n, entries)
}

/// Rows: `sensors` on red, on green; then -red <= 0, -green <= 0, red + green <= 1.
fn constraints(sensors: &[Vec<f64>; 3]) -> CscMatrix<f64> {
    let n = sensors[0].len();
    let entries = (0..2 * n).flat_map(|column| {
        let (block, i) = (column / n, column % n);
        let seen = (0..3).map(move |s| (3 * block + s, column, sensors[s][i]));
        seen.chain([(6 + column, column, -1.0), (6 + 2 * n + i, column, 1.0)])
    });
    from_entries(6 + 3 * n, 2 * n, entries)
}

fn from_entries(rows: usize, columns: usize, entries: impl Iterator<Item = (usize, usize, f64)>) -> CscMatrix<f64> {
    let (mut i, mut j, mut v) = (Vec::new(), Vec::new(), Vec::new());
    for (row, column, value) in entries {
        i.push(row);
        j.push(column);
        v.push(value);
    }
    CscMatrix::new_from_triplets(rows, columns, i, j, v)
}
