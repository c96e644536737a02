//! Curves over log exposure: density ([`CharacteristicCurve`]) and amount of dye ([`AmountCurve`]).

mod amount;
mod characteristic;
mod direction;
mod isotonic;

pub use amount::AmountCurve;
pub use characteristic::CharacteristicCurve;
pub use direction::Direction;
