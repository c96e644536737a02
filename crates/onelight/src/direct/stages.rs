use std::ops::RangeInclusive;

use onelight_film::LogExposure;
use onelight_lut::{DirectForm, DirectParts, DirectPrint};

use super::fit::{LARGEST_MISS, fit, misses};
use super::settings::Nodes;
use super::sum::Sum;
use super::training::{Sample, Training};
use crate::error::Error;
use crate::reference::Reference;
use crate::structured::{coding, over_log2};

/// Both sums of a process.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Stages {
    /// From dye in the negative to print exposure.
    pub(super) duplication: Option<Sum>,
    /// From dye in the film on the screen to linear RGB.
    pub(super) projection: Sum,
}

impl Stages {
    /// The film itself, by 1 nm.
    pub(super) fn of(film: &Reference) -> Self {
        Self { duplication: Sum::behind(film), projection: Sum::shown(film) }
    }

    pub(super) fn on_grid(&self, step_nm: usize) -> Result<Self, Error> {
        let duplication = self.duplication.as_ref().map(|sum| sum.on_grid(step_nm)).transpose()?;
        Ok(Self { duplication, projection: self.projection.on_grid(step_nm)? })
    }

    pub(super) fn fitted(&self, training: &Training, projection: usize, duplication: usize) -> Self {
        let first = || {
            let (sum, samples) = self.duplication.as_ref().zip(training.duplication.as_deref())?;
            Some(fit(sum, samples, duplication))
        };
        let (duplication, projection) = rayon::join(first, || fit(&self.projection, &training.projection, projection));
        Self { duplication, projection }
    }

    /// Each stage by the fewest terms of the usual that come near enough to colours which it was not fitted to, or by the most of them.
    pub(super) fn usual(&self, training: &Training, judges: &Training) -> Self {
        let first = || {
            let (full, samples) = self.duplication.as_ref().zip(training.duplication.as_deref())?;
            let judges = judges.duplication.as_deref().unwrap_or_default();
            let counts = if self.projection.is_rule() { Nodes::USUAL_SCAN } else { Nodes::USUAL_DUPLICATION };
            Some(near(full, samples, judges, counts))
        };
        let last = || near(&self.projection, &training.projection, &judges.projection, Nodes::USUAL_PROJECTION);
        let (duplication, projection) = rayon::join(first, last);
        Self { duplication, projection }
    }
}

/// `full` by the fewest terms of `counts` with which no judge is missed by more than [`LARGEST_MISS`], or by the most.
fn near(full: &Sum, samples: &[Sample], judges: &[Sample], counts: RangeInclusive<usize>) -> Sum {
    let mut sum = fit(full, samples, *counts.start());
    for count in counts.skip(1) {
        if misses(&sum, judges).into_iter().all(|miss| miss <= LARGEST_MISS) {
            break;
        }
        sum = fit(full, samples, count);
    }
    sum
}

impl Reference {
    /// These sums among the film's own matrix and curves.
    pub(super) fn direct_of(&self, stages: &Stages) -> Result<DirectForm, Error> {
        let print = match (&stages.duplication, self.curves_behind()) {
            (Some(sum), Some(curves)) => {
                let layers = curves.to_array();
                let curves = over_log2(curves, |layer, h| layers[layer].amount(LogExposure(h)).0)?;
                Some(DirectPrint { exposure: sum.rounded()?, curves })
            }
            _ => None,
        };
        let camera = self.camera_curves().to_array();
        let parts = DirectParts {
            expose: self.expose(),
            develop: self.develop_form(|layer, h| camera[layer].amount(LogExposure(h)).0)?,
            print,
            projection: stages.projection.rounded()?,
            coding: coding(self.coding().curve)?,
        };
        Ok(DirectForm::new(parts)?)
    }
}
