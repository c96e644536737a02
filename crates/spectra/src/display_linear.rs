use std::ops::Deref;

/// RGB of a display's light, not coded: 1 is its white, what lies beyond 0 to 1 it cannot show. Primaries are the display's.
///
/// A type of its own, because a look gives coded and linear values of one colour: three plain numbers are then coded, or light of
/// the scene. It reads as an array.
///
/// ```
/// use onelight_spectra::{DisplayLinear, TransferCurve};
/// let light = TransferCurve::Srgb.decode_rgb([0.5, 1.0, 0.0]);
/// assert_eq!(light[1], 1.0);
/// assert!((TransferCurve::Srgb.encode_rgb(light)[0] - 0.5).abs() < 1e-12);
/// assert_eq!(DisplayLinear([0.2; 3]).map(|v| v * 5.0), [1.0; 3]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DisplayLinear(pub [f64; 3]);

impl Deref for DisplayLinear {
    type Target = [f64; 3];

    fn deref(&self) -> &[f64; 3] {
        &self.0
    }
}
