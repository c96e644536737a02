/// A log10 exposure; on absolute axes the exposure is in lux s.
///
/// ```
/// use onelight_film::LogExposure;
/// assert_eq!(LogExposure::of(0.01), LogExposure(-2.0));
/// assert_eq!(LogExposure::of(-1.0), LogExposure(-12.0), "no logarithm of what is not above 0");
/// ```
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct LogExposure(pub f64);

/// A density as a densitometer reads it: -log10 of a weighted transmittance, without a unit.
///
/// ```
/// use onelight_film::{CharacteristicCurve, Density, Direction};
/// let curve = CharacteristicCurve::new(vec![-1.0, 1.0], &[0.1, 1.3], Direction::Rising)?;
/// assert_eq!((curve.d_min(), curve.d_max()), (Density(0.1), Density(1.3)));
/// # Ok::<(), onelight_film::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct Density(pub f64);

/// How much of a dye there is, in units of its published curve: 1 has the spectral density of that curve, 2 twice as much.
///
/// ```
/// use onelight_film::{DyeAmount, Dyes, PerLayer};
/// use onelight_spectra::{SpectralDistribution, SpectralShape};
/// let dye = SpectralDistribution::from_fn(SpectralShape::VISIBLE, |_nm| 0.4)?;
/// let film = Dyes::new(PerLayer::all(dye), None)?.density(PerLayer::all(DyeAmount(0.5)));
/// assert!((film.values()[0] - 3.0 * 0.5 * 0.4).abs() < 1e-12);
/// # Ok::<(), onelight_film::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct DyeAmount(pub f64);

/// Exposures at or below this count as this much: no logarithm of 0.
pub const EXPOSURE_FLOOR: f64 = 1e-12;

impl LogExposure {
    /// The logarithm of an exposure, floored at [`EXPOSURE_FLOOR`]; NaN gives the floor.
    #[must_use]
    pub fn of(exposure: f64) -> Self {
        Self(exposure.max(EXPOSURE_FLOOR).log10())
    }

    /// The exposure itself: 10 to the power of the logarithm.
    #[must_use]
    pub fn exposure(self) -> f64 {
        10f64.powf(self.0)
    }
}
