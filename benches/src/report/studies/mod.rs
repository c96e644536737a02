//! Measurements behind the choices: wavelengths, curve tables, buffers, and how cost grows.

mod colours;
mod curves;
mod effects;
mod growth;
mod picture_effects;
mod spectral;

use serde::Serialize;

pub(super) use curves::CurveRow;
pub(super) use effects::EffectRow;
pub(super) use growth::{Growth, Measured, growth};
pub(super) use picture_effects::PictureEffectRow;
pub(super) use spectral::{ExposureRow, GridRow};

use self::colours::Colours;
pub(super) use self::colours::Miss;
use super::measure::{Look, Prepared};
use super::scope::Scope;
use crate::buffers;
use crate::error::Result;
use crate::progress::{OnProgress, Steps};

/// The studies of one look.
#[derive(Debug, Serialize)]
pub(super) struct Studies {
    /// Wavelengths of projection and printing, of the direct form.
    pub(super) grids: Vec<GridRow>,
    /// Wavelengths of the exposure matrix.
    pub(super) exposure: Vec<ExposureRow>,
    /// Points of the curves' tables.
    pub(super) curves: Vec<CurveRow>,
    /// Largest step on a grey ramp behind a frame buffer: name, CIEDE2000.
    pub(super) buffers: Vec<(&'static str, f64)>,
}

impl Studies {
    pub(super) fn of(prepared: &Prepared, look: &Look, scope: Scope, progress: OnProgress<'_>) -> Result<Self> {
        let colours = Colours::new(&prepared.film, scope)?;
        let progress = Steps::new("studies", 4, progress);
        let grids = spectral::grids(prepared, look, &colours)?;
        progress.step();
        let exposure = spectral::exposure(prepared, &colours)?;
        progress.step();
        let curves = curves::curves(prepared, &colours)?;
        progress.step();
        let mut steps = Vec::new();
        let film = onelight::Look::from(prepared.film.clone());
        for case in &buffers::CASES {
            steps.push((case.name, buffers::largest_step(case, &film)?));
        }
        Ok(Self { grids, exposure, curves, buffers: steps })
    }
}
