//! Premultiplied and straight colour.

/// Divides each colour by its coverage.
pub(crate) fn straighten(rgb: &mut [[f32; 3]], alpha: &[f32]) {
    rgb.iter_mut().zip(alpha).for_each(|(colour, &alpha)| {
        if covers(alpha) {
            *colour = colour.map(|value| value / alpha);
        }
    });
}

/// One colour multiplied by its coverage: undoes [`straighten`].
pub(crate) fn premultiplied(colour: [f32; 3], alpha: f32) -> [f32; 3] {
    if covers(alpha) { colour.map(|value| value * alpha) } else { colour }
}

/// Light without coverage (alpha 0) is emission, which keeps its value; so does colour under an alpha that is no
/// coverage at all (negative, NaN, infinite, or too small to divide by).
fn covers(alpha: f32) -> bool {
    alpha.is_normal() && alpha > 0.0
}
