//! Least slope: minimise the sum of squared differences between neighbours of the three reflectances.

use nalgebra::{DMatrix, Matrix3, Vector3};

use crate::built_in::BuiltInTable;
use crate::error::{Error, ErrorKind};

/// The smoothest reflectances that are nowhere negative: the quadratic programme of \[MallettYuksel2019\], solved once.
/// A test holds it to the conditions of optimality.
pub(super) fn least_non_negative() -> Result<[Vec<f64>; 3], Error> {
    let table = BuiltInTable::parse("smooth_basis.csv", include_str!("../../data/smooth_basis.csv"))?;
    let column = |name| table.points(name).map(|points| points.y);
    let (red, green) = (column("red")?, column("green")?);
    let blue = red.iter().zip(&green).map(|(r, g)| 1.0 - r - g).collect();
    Ok([red, green, blue])
}

/// The smoothest, negative or not: one linear system for each primary.
pub(super) fn least(sensors: &[Vec<f64>; 3]) -> Result<[Vec<f64>; 3], Error> {
    let n = sensors[0].len();
    let mut system = DMatrix::<f64>::zeros(n + 3, n + 3);
    for i in 0..n {
        system[(i, i)] = if i == 0 || i == n - 1 { 1.0 } else { 2.0 };
        if i + 1 < n {
            system[(i, i + 1)] = -1.0;
            system[(i + 1, i)] = -1.0;
        }
        for (s, row) in sensors.iter().enumerate() {
            system[(n + s, i)] = row[i];
            system[(i, n + s)] = row[i];
        }
    }
    let mut right = DMatrix::<f64>::zeros(n + 3, 3);
    right.fixed_view_mut::<3, 3>(n, 0).copy_from(&Matrix3::from_diagonal(&Vector3::repeat(1.0)));
    let solved = system.lu().solve(&right);
    let solved = solved.ok_or_else(|| ErrorKind::Basis { problem: "the sensors are not independent".to_owned() })?;
    Ok(std::array::from_fn(|k| solved.column(k).iter().take(n).copied().collect()))
}
