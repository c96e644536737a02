//! Measurements behind the choices: wavelengths, curve tables, buffers, and how cost grows.

mod curves;
mod growth;
mod spectral;

use anyhow::Result;
use onelight::Reference;
use onelight::lut::{SceneSampler, deviation};
use serde::Serialize;

pub(super) use curves::CurveRow;
pub(super) use growth::{Growth, Measured, growth};
pub(super) use spectral::{ExposureRow, GridRow};

use super::forms::Scope;
use super::frame::Frame;
use super::measure::{Look, Prepared};
use crate::buffers;
use crate::progress::bar;

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
    pub(super) fn of(prepared: &Prepared, look: &Look, scope: Scope) -> Result<Self> {
        let colours = Colours::new(&prepared.film, scope)?;
        let progress = bar("studies", 4);
        let grids = spectral::grids(prepared, look, &colours)?;
        progress.inc(1);
        let exposure = spectral::exposure(prepared, &colours)?;
        progress.inc(1);
        let curves = curves::curves(prepared, &colours)?;
        progress.inc(1);
        let mut steps = Vec::new();
        let film = onelight::Look::from(prepared.film.clone());
        for case in &buffers::CASES {
            steps.push((case.name, buffers::largest_step(case, &film)?));
        }
        progress.finish_and_clear();
        Ok(Self { grids, exposure, curves, buffers: steps })
    }
}

/// Mean and largest CIEDE2000 from the film.
#[derive(Debug, Clone, Copy, Serialize)]
pub(super) struct Miss {
    pub(super) mean: f64,
    pub(super) max: f64,
}

/// Scene colours of all exposures and saturations, and the film to compare with.
struct Colours<'a> {
    film: &'a Reference,
    colours: Vec<[f64; 3]>,
}

impl<'a> Colours<'a> {
    fn new(film: &'a Reference, scope: Scope) -> Result<Self> {
        let count = match scope {
            Scope::Full => 1 << 14,
            Scope::Quick => 1 << 9,
        };
        Ok(Self { film, colours: SceneSampler::new(-10.0..=10.0)?.take(count).collect() })
    }

    /// How far a map from scene-linear to display-linear RGB lies from the film.
    fn miss(&self, map: impl Fn([f64; 3]) -> [f64; 3] + Sync) -> Result<Miss> {
        self.miss_between(|rgb| self.film.develop_linear(rgb), map)
    }

    fn miss_between(
        &self,
        reference: impl Fn([f64; 3]) -> [f64; 3] + Sync,
        map: impl Fn([f64; 3]) -> [f64; 3] + Sync,
    ) -> Result<Miss> {
        let difference = self.film.difference()?;
        let found = deviation(&self.colours, reference, map, |a, b| difference.between(*a, *b))?;
        Ok(Miss { mean: found.mean, max: found.max })
    }

    /// The same for a map to display-coded RGB in `f32`.
    fn miss_coded(&self, map: impl Fn([f32; 3]) -> [f32; 3] + Sync) -> Result<Miss> {
        let coding = self.film.coding();
        self.miss(|rgb| map(rgb.map(|v| v as f32)).map(|v| coding.decode(f64::from(v))))
    }
}

/// Rounds of each timing.
pub(super) fn rounds(scope: Scope) -> usize {
    match scope {
        Scope::Full => 15,
        Scope::Quick => 3,
    }
}

/// The picture that a scope is timed on.
pub(super) fn frame(scope: Scope) -> Result<Frame> {
    Frame::new(match scope {
        Scope::Full => (960, 540),
        Scope::Quick => (160, 90),
    })
}
