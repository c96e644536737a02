//! What must hold, and why.

use super::measure::Quantity;

/// The most that a quantity may be for a form computed in a way; `None` where it is told only.
pub(super) fn limit(_form: &str, _way: &str, quantity: Quantity) -> Option<f64> {
    match quantity {
        Quantity::NotFinite => Some(0.0),
        _ => None,
    }
}
