/// What a film and its light do at one wavelength: the light that passes adds `weights * 10^-(base + dyes . amounts)` to three
/// sums, which are exposures or tristimulus values. Tables and other fast forms are made from them.
///
/// ```
/// use onelight_film::{DyeAmount, Dyes, PerLayer};
/// use onelight_printing::{Projection, Projector, SpectralRow};
/// use onelight_spectra::{RgbSpace, SpectralDistribution, SpectralShape};
/// let grey = SpectralDistribution::from_fn(SpectralShape::VISIBLE, |_nm| 0.2)?;
/// let projection = Projection::new(Dyes::new(PerLayer::all(grey), None)?, Projector::Display, &RgbSpace::SRGB)?;
/// // Y by hand: dyes of 0.5 units each.
/// let y = |row: &SpectralRow| row.weights[1] * 10f64.powf(-(row.base + 0.5 * row.dyes.iter().sum::<f64>()));
/// let y: f64 = projection.rows().iter().map(y).sum();
/// assert!((y - projection.xyz(PerLayer::all(DyeAmount(0.5)))[1]).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
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
