use onelight::Look;
use onelight::WorkingSpace;
use onelight::certify::{Certifier, to_six_stops};
use onelight::lut::{SamplingLaw, Search};
use serde::Serialize;

use crate::error::Result;
use crate::form::Form;

/// CIEDE2000 of a form from its look.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Difference {
    /// Over all colours.
    pub mean: f64,
    /// The mean of the worst of five bands of four stops.
    pub worst_band: f64,
    /// Exceeded by one colour in a hundred.
    pub p99: f64,
    /// The largest found, followed uphill.
    pub max: f64,
    /// The mean over the bands up to +6 stops.
    pub mean_to_six: f64,
    /// The largest of those bands, not followed uphill.
    pub max_to_six: f64,
}

/// How far each form lies from the look over colours drawn by a law; `step` is called after the colours are developed and after
/// each form.
///
/// # Errors
/// If the law or the look's spaces are impossible.
pub(crate) fn differences(look: &Look, law: &SamplingLaw, forms: &[&Form], step: &dyn Fn()) -> Result<Vec<Difference>> {
    let certifier = Certifier::new(look)?;
    let samples = certifier.samples(law, WorkingSpace::Srgb)?;
    step();
    let mut found = Vec::new();
    for form in forms {
        let certificate = certifier.certify(&samples, |rgb| form.apply(rgb), Search::Ascent)?;
        let to_six = to_six_stops(&certificate);
        found.push(Difference {
            mean: certificate.overall.mean,
            worst_band: certificate.headline_mean,
            p99: certificate.overall.p99,
            max: certificate.max_found,
            mean_to_six: to_six.mean,
            max_to_six: to_six.max,
        });
        step();
    }
    Ok(found)
}
