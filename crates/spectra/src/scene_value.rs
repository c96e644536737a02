/// The scene-linear value of an 18 % grey card that is properly exposed, where white is 1.
///
/// ```
/// use onelight_spectra::{MID_GREY, SceneCurve};
/// // Where cameras put it: 0.41 in S-Log3, code 420 of 1023.
/// assert_eq!((SceneCurve::SLog3.encode(MID_GREY) * 1023.0).round(), 420.0);
/// ```
pub const MID_GREY: f64 = 0.18;

/// The brightest scene value that counts, and minus this the darkest: beyond it a 3x3 matrix in float32 would overflow.
pub const SCENE_MAX: f64 = 1e30;

/// A scene value that arithmetic can be done with: NaN counts as 0, infinities and what lies beyond ±[`SCENE_MAX`] as that.
///
/// ```
/// use onelight_spectra::{SCENE_MAX, finite};
/// assert_eq!([f64::NAN, f64::NEG_INFINITY, -0.5].map(finite), [0.0, -SCENE_MAX, -0.5]);
/// ```
#[must_use]
pub fn finite(value: f64) -> f64 {
    if value.is_nan() { 0.0 } else { value.clamp(-SCENE_MAX, SCENE_MAX) }
}
