use onelight::certify::{MeanAndMax, to_six_stops};
use onelight::lut::Certificate;
use serde::Serialize;

/// CIEDE2000 of a form from its look.
#[derive(Debug, Clone, Copy, Default, Serialize)]
pub(super) struct Difference {
    /// Mean over all colours drawn.
    pub(super) mean: f64,
    /// The mean of the worst of five bands of four stops.
    pub(super) worst_band: f64,
    /// Exceeded by one colour in a hundred.
    pub(super) p99: f64,
    /// The largest found, followed uphill.
    pub(super) max: f64,
    /// The mean over the bands up to +6 stops.
    pub(super) mean_to_six: f64,
    /// The largest of those bands, not followed uphill.
    pub(super) max_to_six: f64,
}

impl Difference {
    pub(super) fn of(certificate: &Certificate) -> Self {
        let MeanAndMax { mean: mean_to_six, max: max_to_six } = to_six_stops(certificate);
        Self {
            mean: certificate.overall.mean,
            worst_band: certificate.headline_mean,
            p99: certificate.overall.p99,
            max: certificate.max_found,
            mean_to_six,
            max_to_six,
        }
    }
}
