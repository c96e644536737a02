use nalgebra::Matrix3;
use onelight_film::LogExposure;
use onelight_lut::{DirectForm, DirectParts, DirectPrint};

use super::fit::fit;
use super::sum::Sum;
use super::training::Training;
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
        Self {
            duplication: film.duplication().map(|stage| Sum::of(stage.rows(), &Matrix3::identity())),
            projection: Sum::of(film.projection().rows(), film.rgb_from_xyz()),
        }
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
}

impl Reference {
    /// These sums among the film's own matrix and curves.
    pub(super) fn direct_of(&self, stages: &Stages) -> Result<DirectForm, Error> {
        let print = match (&stages.duplication, self.print_curves()) {
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
