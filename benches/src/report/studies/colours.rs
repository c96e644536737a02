//! The colours that studies measure on.

use onelight::lut::{SceneSampler, deviation};
use onelight::{DisplayLinear, Reference};
use serde::Serialize;

use crate::error::Result;
use crate::report::scope::Scope;

/// Mean and largest CIEDE2000 from the film.
#[derive(Debug, Clone, Copy, Serialize)]
pub(in crate::report) struct Miss {
    pub(in crate::report) mean: f64,
    pub(in crate::report) max: f64,
}

/// Scene colours of all exposures and saturations, and the film to compare with.
pub(super) struct Colours<'a> {
    film: &'a Reference,
    colours: Vec<[f64; 3]>,
}

impl<'a> Colours<'a> {
    pub(super) fn new(film: &'a Reference, scope: Scope) -> Result<Self> {
        let count = match scope {
            Scope::Full => 1 << 14,
            Scope::Quick => 1 << 9,
        };
        Ok(Self { film, colours: SceneSampler::new(-10.0..=10.0)?.take(count).collect() })
    }

    /// How far a map from scene-linear to display-linear RGB lies from the film.
    pub(super) fn miss(&self, map: impl Fn([f64; 3]) -> DisplayLinear + Sync) -> Result<Miss> {
        self.miss_between(|rgb| self.film.develop_linear(rgb), map)
    }

    pub(super) fn miss_between(
        &self,
        reference: impl Fn([f64; 3]) -> DisplayLinear + Sync,
        map: impl Fn([f64; 3]) -> DisplayLinear + Sync,
    ) -> Result<Miss> {
        let difference = self.film.difference()?;
        let found = deviation(&self.colours, reference, map, |a, b| difference.between(*a, *b))?;
        Ok(Miss { mean: found.mean, max: found.max })
    }

    /// The same for a map to display-coded RGB in `f32`.
    pub(super) fn miss_coded(&self, map: impl Fn([f32; 3]) -> [f32; 3] + Sync) -> Result<Miss> {
        let coding = self.film.coding();
        self.miss(|rgb| coding.decode_rgb(map(rgb.map(|v| v as f32)).map(f64::from)))
    }
}
