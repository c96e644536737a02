//! Halation: light that returns from the back of the base.

#[cfg(test)]
mod exactness;
mod field;
mod gaussians;
mod spread;

use onelight_film::PerLayer;

pub(crate) use field::HaloKernel;
pub use field::{HalationCells, HaloField};
pub use spread::FilmBase;

use crate::constant::{ANTIHALATION_DENSITY, RETURNED_TO_BLUE, RETURNED_TO_GREEN, RETURNED_TO_RED, checked};
use crate::error::Error;
use gaussians::smooth_gaussians;
use spread::PointSpread;

/// Densities of antihalation layers that are worked with.
const DENSITIES: [f64; 2] = [0.0, Antihalation::MAX_DENSITY];
const SHARES: [f64; 2] = [0.0, 1.0];

/// What keeps light from returning.
///
/// ```
/// use onelight_spatial::Antihalation;
/// assert_eq!(Antihalation::default().density(), 0.8);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Antihalation {
    /// A layer of this density, passed twice; on no sheet.
    Density(f64),
    /// The layer is taken off, as some still films are sold: the same film otherwise.
    None,
}

impl Antihalation {
    /// The largest density that is worked with: beyond, nothing returns that could be seen.
    pub const MAX_DENSITY: f64 = 3.0;

    /// Density of the layer; 0 without one.
    #[must_use]
    pub fn density(self) -> f64 {
        match self {
            Self::Density(density) => density,
            Self::None => 0.0,
        }
    }
}

impl Default for Antihalation {
    fn default() -> Self {
        Self::Density(ANTIHALATION_DENSITY.value)
    }
}

/// What halation depends on. No sheet of a camera film says any of it.
///
/// ```
/// use onelight_spatial::{Antihalation, HalationSettings};
/// let stripped = HalationSettings { antihalation: Antihalation::None, ..Default::default() };
/// assert_eq!(stripped.returned.red, 0.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalationSettings {
    /// What the emulsion is coated on.
    pub base: FilmBase,
    /// What keeps light from returning.
    pub antihalation: Antihalation,
    /// Share of the light that has returned that exposes each layer, 0 to 1.
    pub returned: PerLayer<f64>,
}

impl Default for HalationSettings {
    fn default() -> Self {
        let returned =
            PerLayer { red: RETURNED_TO_RED.value, green: RETURNED_TO_GREEN.value, blue: RETURNED_TO_BLUE.value };
        Self { base: FilmBase::default(), antihalation: Antihalation::default(), returned }
    }
}

/// Halation of a film.
///
/// Each layer's exposure becomes `(E + tau H*E) / (1 + tau F)`, H the light that returns about a point, F all of it, tau the share that
/// exposes the layer. Uniform areas are unchanged: their halation is in the characteristic curves already.
///
/// ```
/// use onelight_spatial::{Halation, HalationSettings};
/// let halation = Halation::new(HalationSettings::default())?;
/// assert!((halation.ring_um() - 247.5).abs() < 0.1);
/// assert!(halation.returned_light() < 0.002, "the antihalation layer swallows the rest");
/// # Ok::<(), onelight_spatial::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Halation {
    settings: HalationSettings,
    spread: PointSpread,
    /// All the light that returns.
    returned: f64,
    /// Shares and standard deviations in um of the smooth part.
    gaussians: [(f64, f64); 4],
}

impl Halation {
    /// From its settings.
    ///
    /// # Errors
    /// If the density is not 0 to 3, or a share not 0 to 1.
    pub fn new(settings: HalationSettings) -> Result<Self, Error> {
        let density = checked("density of the antihalation layer", settings.antihalation.density(), DENSITIES, "")?;
        settings.returned.try_map(|share, _| checked("share of returned light", share, SHARES, ""))?;
        let spread = PointSpread::new(settings.base, density);
        Ok(Self { settings, spread, returned: spread.returned(), gaussians: smooth_gaussians(&spread) })
    }

    /// What it was made from.
    #[must_use]
    pub fn settings(&self) -> HalationSettings {
        self.settings
    }

    /// Radius of the ring about a small light, in um: where reflection at the back becomes total.
    #[must_use]
    pub fn ring_um(&self) -> f64 {
        self.spread.ring_um()
    }

    /// Share of the light at the back of the emulsion that returns to it.
    #[must_use]
    pub fn returned_light(&self) -> f64 {
        self.returned
    }

    /// By how much a layer's exposure goes towards the mean of what returns: tau F / (1 + tau F).
    pub(crate) fn pull(&self) -> [f64; 3] {
        self.settings.returned.to_array().map(|tau| tau * self.returned / (1.0 + tau * self.returned))
    }
}
