//! The direct form of a process: no table, the light through each film as a sum of a few exponentials.

mod grid;

use nalgebra::Matrix3;
use onelight_film::LogExposure;
use onelight_lut::{DirectForm, DirectParts, DirectPrint};

use crate::error::Error;
use crate::reference::Reference;
use crate::structured::{coding, over_log2, rows};

/// Where the exponentials of a direct form come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Nodes {
    /// The wavelengths of an even grid, unfitted. 1 nm is the film itself in float32; 5 nm costs 0.01 dE at most, 10 nm 0.2.
    Grid {
        /// Distance in nm: a whole number that divides the ranges of the film's grids, such as 1, 2, 5, 10 or 20.
        step_nm: usize,
    },
}

/// How [`Reference::direct`] makes its form.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DirectSettings {
    /// Where the exponentials come from.
    pub nodes: Nodes,
}

impl Default for DirectSettings {
    fn default() -> Self {
        Self { nodes: Nodes::Grid { step_nm: 5 } }
    }
}

impl Reference {
    /// The direct form: unlimited scene range, no table.
    ///
    /// ```
    /// let film = onelight::Process::for_camera("fuji-velvia-50")?.compile()?;
    /// let direct = film.direct(&Default::default())?;
    /// let (exact, fast) = (film.develop([0.5, 0.2, 40.0]), direct.apply([0.5, 0.2, 40.0]));
    /// assert!((exact[0] - f64::from(fast[0])).abs() < 0.001);
    /// # Ok::<(), onelight::Error>(())
    /// ```
    ///
    /// # Errors
    /// If a setting is out of bounds.
    pub fn direct(&self, settings: &DirectSettings) -> Result<DirectForm, Error> {
        let camera = self.camera_curves().to_array();
        let print = match (self.duplication(), self.print_curves()) {
            (Some(duplication), Some(curves)) => {
                let exposure = match settings.nodes {
                    Nodes::Grid { step_nm } => grid::sum(duplication.rows(), &Matrix3::identity(), step_nm)?,
                };
                let layers = curves.to_array();
                let amounts = |layer: usize, h: f64| layers[layer].amount(LogExposure(h)).0;
                Some(DirectPrint { exposure, curves: over_log2(curves, amounts)? })
            }
            _ => None,
        };
        let projection = match settings.nodes {
            Nodes::Grid { step_nm } => grid::sum(self.projection().rows(), self.rgb_from_xyz(), step_nm)?,
        };
        let parts = DirectParts {
            input: rows(self.to_srgb()),
            exposure: rows(self.exposure_matrix().matrix()),
            curves: over_log2(self.camera_curves(), |layer, h| camera[layer].amount(LogExposure(h)).0)?,
            print,
            projection,
            coding: coding(self.coding()),
        };
        Ok(DirectForm::new(parts)?)
    }
}
