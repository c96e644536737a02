//! The limits that must hold, and why. A figure without a limit is measured only: how far a table or a sum of exponentials lies
//! from its film is what certificates are for.

use super::implementations::Kind;
use super::measure::{Quantity, Row};

/// Luminance of the film itself on rising greys: a sum of 401 positive terms, rounded in float64.
const FALL_EXACT: f64 = 1e-12;
/// Of a form in float64: its entries and weights are float32, and two neighbours may be rounded apart by 6e-8 each; in densities
/// that is 2.3 times as much light.
const FALL_STORED: f64 = 3e-7;
/// Of a form in float32. Greys fall where the curve is flat, near white: there each term of a sum is wrong by 2.5e-7 of itself at
/// most (`exp2`), terms of either sign come to four times their sum, and two neighbours count.
const FALL_SINGLE: f64 = 2e-6;

/// Float32 against float64, sRGB-coded. At 16 stops a logarithm is wrong by 1.4e-6 stops (its polynomial, and the rounding of a
/// number near 16), the place on a curve's table of 40 stops by 2e-6 more; a print repeats both. The steepest looks rise by 1 in
/// code for each stop. A plain table's coordinate is wrong by 3e-7, and the code rises by less than 10 over the table.
const ROUNDING: f64 = 1e-5;
const ROUNDING_PLAIN: f64 = 3e-6;
/// Vectors against the definition: what `PixelMap` promises, the same errors once more. A card's `log2` and `exp2` may be as
/// wrong again (WGSL's demands), so a card is allowed both.
const VECTORS: f64 = 1e-5;
/// Codes of 8 bits: a value near the edge of two codes falls either way.
const CODES: f64 = 1.0;

/// Steps of the direct form beyond the film's, dE: opposite differences at both neighbours, which are 0.13 at most each, come one
/// after the other on ramps as coarse as a tenth of a stop only in part.
const EXCESS_DIRECT: f64 = 0.13;
/// The direct form's promise for all pairs of films.
const FILM_DIRECT: f64 = 0.13;

/// The most that a quantity may be in a row; `None` where it is measured and has no limit.
pub(super) fn limit(row: &Row, quantity: Quantity) -> Option<f64> {
    match (quantity, row.kind, row.form.as_str()) {
        (Quantity::NotFinite, ..) => Some(0.0),
        (Quantity::Fall, _, "film") => Some(FALL_EXACT),
        (Quantity::Fall, Kind::Float64, _) => Some(FALL_STORED),
        (Quantity::Fall, ..) => Some(FALL_SINGLE),
        (Quantity::Rounding, Kind::Card, _) => Some(ROUNDING + VECTORS),
        (Quantity::Rounding, _, "plain") => Some(ROUNDING_PLAIN),
        (Quantity::Rounding, ..) => Some(ROUNDING),
        (Quantity::Vectors, ..) => Some(VECTORS),
        (Quantity::Codes, ..) => Some(CODES),
        (Quantity::Excess, _, "direct") => Some(EXCESS_DIRECT),
        (Quantity::Film, _, "direct") => Some(FILM_DIRECT),
        (Quantity::Step | Quantity::Excess | Quantity::Film | Quantity::Forms, ..) => None,
    }
}
