//! The runner's fit of the plain form and its certificates, for those who measure them.

use anyhow::Result;
use onelight::lut::{Law, Lut3d, Search, Shaper};
use onelight::{Look, Process, WorkingSpace};
use onelight_benches::{Baker, Difference, Error, Form};

use crate::certificate::{Measure, to_six_stops};
use crate::compiled::{Fitted, fitted_plain, fitted_to};

/// What `bake` and `certify` use.
pub(crate) struct Runner;

impl Baker for Runner {
    fn shaper(&self, look: &Look, stops: Option<f64>) -> Result<Shaper, Error> {
        fitted_to(look, &Fitted::Look { stops }).map_err(said)
    }

    fn fit(&self, look: &Look, shaper: &Shaper, table: &Lut3d) -> Result<Lut3d, Error> {
        fitted_plain(look, shaper, table).map_err(said)
    }

    fn certify(
        &self,
        process: &Process,
        look: &Look,
        law: &Law,
        forms: &[&Form],
        step: &dyn Fn(),
    ) -> Result<Vec<Difference>, Error> {
        differences(process, look, law, forms, step).map_err(said)
    }
}

fn differences(process: &Process, look: &Look, law: &Law, forms: &[&Form], step: &dyn Fn()) -> Result<Vec<Difference>> {
    let measure = Measure::new(look, process)?;
    let samples = measure.samples(law, WorkingSpace::Srgb)?;
    step();
    let mut found = Vec::new();
    for form in forms {
        let certificate = measure.certify(&samples, |rgb| form.apply(rgb), Search::Ascent)?;
        let (mean_to_six, max_to_six) = to_six_stops(&certificate);
        found.push(Difference {
            mean: certificate.overall.mean,
            worst_band: certificate.headline_mean,
            p99: certificate.overall.p99,
            max: certificate.max_found,
            mean_to_six,
            max_to_six,
        });
        step();
    }
    Ok(found)
}

#[expect(clippy::needless_pass_by_value, reason = "map_err hands the error over")]
fn said(error: anyhow::Error) -> Error {
    Error::new(format!("{error:#}"))
}
