//! The direct form of a process: no table, the light through each film as a sum of a few exponentials.

mod fewest;
mod fit;
mod live;
mod settings;
mod stages;
mod sum;
mod training;

use onelight_lut::DirectForm;

use crate::error::Error;
use crate::reference::Reference;
pub use live::LiveDirect;
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
        self.direct_of(&self.direct_stages(&Stages::of(self), settings)?)
    }

    /// The sums that the settings ask for, of the film's own by 1 nm.
    fn direct_stages(&self, full: &Stages, settings: &DirectSettings) -> Result<Stages, Error> {
        match settings.nodes {
            Nodes::Grid { step_nm } => full.on_grid(step_nm),
            Nodes::GridUnderMaxDe(limit) => grid_under(self, full, limit),
            Nodes::Usual => {
                let (training, judges) = rayon::join(|| Training::new(self), || Training::judges(self));
                Ok(full.usual(&training?, &judges?))
            }
            Nodes::Counts { projection, duplication } => {
                check_count("projection", projection)?;
                if full.duplication.is_some() {
                    check_count("duplication", duplication)?;
                }
                Ok(full.fitted(&Training::new(self)?, projection, duplication))
            }
            Nodes::UnderMaxDe(limit) => fewest::under(self, full, limit),
        }
    }
}

fn grid_under(film: &Reference, full: &Stages, limit: f64) -> Result<Stages, Error> {
    check_limit(limit)?;
    let probes = Probes::new(film)?;
    for step_nm in [10, 5, 2] {
        let stages = full.on_grid(step_nm)?;
        if probes.largest_miss(&film.direct_of(&stages)?) <= limit {
            return Ok(stages);
        }
    }
    Ok(full.clone())
}
