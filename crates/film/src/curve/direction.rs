/// Whether more light makes more density (negative, print) or less (reversal).
///
/// ```
/// use onelight_film::{Direction, StockKind};
/// assert_eq!(StockKind::Reversal.direction(), Direction::Falling);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// More light makes more density: negatives and prints.
    Rising,
    /// More light makes less density: reversal film.
    Falling,
}

impl Direction {
    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Rising => 1.0,
            Self::Falling => -1.0,
        }
    }
}
