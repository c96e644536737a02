/// What a film and its light do at one wavelength: the light that passes adds `weights * 10^-(base + dyes . amounts)` to three
/// sums, which are exposures or tristimulus values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectralRow {
    /// Density of one unit of each dye: cyan, magenta, yellow.
    pub dyes: [f64; 3],
    /// Density of the film without any.
    pub base: f64,
    /// What each sum gets of light that passes unhindered; step of the grid and trapezoid included.
    pub weights: [f64; 3],
}

/// Sum over wavelengths of weights times 10^-(base + dyes . amounts).
pub(crate) fn transmitted(rows: &[SpectralRow], amounts: [f64; 3]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for SpectralRow { dyes, base, weights } in rows {
        let density = base + dyes[0] * amounts[0] + dyes[1] * amounts[1] + dyes[2] * amounts[2];
        let passed = (-std::f64::consts::LN_10 * density).exp();
        for (sum, weight) in sum.iter_mut().zip(weights) {
            *sum += weight * passed;
        }
    }
    sum
}
