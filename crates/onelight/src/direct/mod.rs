//! The direct form of a process: no table, the light through each film as a sum of a few exponentials.

mod fewest;
mod fit;
mod settings;
mod stages;
mod sum;
mod training;

use onelight_lut::DirectForm;

use crate::error::Error;
use crate::reference::Reference;
pub use settings::{DirectSettings, Nodes};
use settings::{check_count, check_limit};
use stages::Stages;
use training::{Probes, Training};

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
    /// If a setting is out of bounds, or no number of exponentials keeps the difference that it asks for.
    pub fn direct(&self, settings: &DirectSettings) -> Result<DirectForm, Error> {
        let stages = Stages::of(self);
        match settings.nodes {
            Nodes::Grid { step_nm } => self.direct_of(&stages.on_grid(step_nm)?),
            Nodes::GridUnderMaxDe(limit) => grid_under(self, &stages, limit),
            Nodes::Counts { projection, duplication } => {
                check_count("projection", projection)?;
                if stages.duplication.is_some() {
                    check_count("duplication", duplication)?;
                }
                self.direct_of(&stages.fitted(&Training::new(self)?, projection, duplication))
            }
            Nodes::UnderMaxDe(limit) => fewest::under(self, &stages, limit),
        }
    }
}

fn grid_under(film: &Reference, stages: &Stages, limit: f64) -> Result<DirectForm, Error> {
    check_limit(limit)?;
    let probes = Probes::new(film)?;
    for step_nm in [10, 5, 2] {
        let direct = film.direct_of(&stages.on_grid(step_nm)?)?;
        if probes.largest_miss(&direct) <= limit {
            return Ok(direct);
        }
    }
    film.direct_of(stages)
}
