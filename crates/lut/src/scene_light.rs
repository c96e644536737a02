//! Scene light in float32, as every form takes it.

use crate::error::{Error, ErrorKind};
use crate::number::Number;

/// A 3x3 matrix, row by row: `out[i] = sum over k of rows[i][k] in[k]`.
pub type Rows = [[f32; 3]; 3];

/// The matrix that leaves colours as they are.
pub const IDENTITY: Rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The brightest scene light, 1 being diffuse white: more would overflow `f32` in the matrices.
pub const SCENE_MAX: f32 = 1e30;

/// The smallest exposure whose logarithm is taken: 0 has none.
pub const LOG_FLOOR: f32 = 1e-12;

/// A channel of scene light as the forms read it: 0 for NaN, within ±[`SCENE_MAX`] otherwise.
///
/// ```
/// use onelight_lut::{SCENE_MAX, finite};
/// assert_eq!([f32::NAN, f32::NEG_INFINITY, 0.18].map(finite), [0.0, -SCENE_MAX, 0.18]);
/// ```
#[inline]
pub fn finite(channel: f32) -> f32 {
    finite_in(channel)
}

/// [`finite`] in `f32` or `f64`.
#[inline]
pub(crate) fn finite_in<N: Number>(channel: N) -> N {
    let max = N::of(SCENE_MAX);
    if channel.partial_cmp(&channel).is_some() { channel.max(-max).min(max) } else { N::ZERO }
}

/// The logarithm to base 2 of at least [`LOG_FLOOR`].
#[inline]
pub(crate) fn log2_above_floor<N: Number>(exposure: N) -> N {
    exposure.max(N::of(LOG_FLOOR)).log2()
}

/// The product of `rows` and a colour.
#[inline]
pub(crate) fn times<N: Number>(rows: &Rows, [x, y, z]: [N; 3]) -> [N; 3] {
    rows.map(|row| N::of(row[0]) * x + N::of(row[1]) * y + N::of(row[2]) * z)
}

/// Refuses a matrix with a number that is not finite.
pub(crate) fn check_rows(what: &'static str, rows: &Rows) -> Result<(), Error> {
    match rows.iter().flatten().find(|v| !v.is_finite()) {
        Some(&found) => Err(ErrorKind::Parameter { what, found: f64::from(found), expected: "a finite number" }.into()),
        None => Ok(()),
    }
}
