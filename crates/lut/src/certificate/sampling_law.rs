use crate::error::{Error, ErrorKind};

/// Which colours a [`Certificate`](crate::Certificate) looks at, so that figures can be compared.
///
/// The colours drawn are those of [`SceneSampler`](crate::SceneSampler): the largest channel uniform in stops
/// about mid grey, saturation uniform, the six orders of channels alike.
///
/// ```
/// # use onelight_lut::SamplingLaw;
/// let thorough = SamplingLaw { count: 1 << 18, ..SamplingLaw::default() };
/// assert_eq!(thorough.stops, [-10.0, 10.0]);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SamplingLaw {
    /// Where the generator starts. A map must not have been fitted to colours of the same seed.
    pub seed: u64,
    /// How many colours are drawn.
    pub count: usize,
    /// The range of the largest channel, in stops about mid grey.
    pub stops: [f64; 2],
    /// The width of a band, in stops; bands start at the darkest stop, and the last may be narrower.
    pub band_width: f64,
    /// How many of the worst colours are followed uphill.
    pub ascents: usize,
    /// How many evaluations each of them has on average; those that lead get more.
    pub ascent_steps: usize,
    /// The distance of neighbouring greys on the neutral axis, in stops.
    pub neutral_step: f64,
    /// How many of the drawn colours are looked at for folds, beside the greys.
    pub fold_places: usize,
}

impl SamplingLaw {
    /// The usual seed. Samples to fit to start from others, such as 0, that of
    /// [`SceneSampler::new`](crate::SceneSampler::new).
    pub const SEED: u64 = 271_828;

    /// Names the first field that cannot be used.
    pub(super) fn check(&self) -> Result<(), Error> {
        /// 4 million colours, 100 MB for each list of them.
        const MAX_COUNT: usize = 1 << 22;
        let sizes = [
            ("sample of a certificate", self.count, 1, MAX_COUNT),
            ("set of ascents of a certificate", self.ascents, 0, MAX_COUNT),
            ("budget of an ascent", self.ascent_steps, 0, 1 << 16),
            ("sample of places for folds", self.fold_places, 0, MAX_COUNT),
        ];
        for (what, found, min, max) in sizes {
            if !(min..=max).contains(&found) {
                return Err(ErrorKind::Size { what, found, min, max }.into());
            }
        }
        let widths = [
            ("width of a certificate's band in stops", self.band_width),
            ("distance of a certificate's greys in stops", self.neutral_step),
        ];
        for (what, found) in widths {
            if !(1e-3..=128.0).contains(&found) {
                return Err(ErrorKind::Parameter { what, found, expected: "a number from 0.001 to 128" }.into());
            }
        }
        Ok(())
    }
}

impl Default for SamplingLaw {
    /// 2^14 colours from -10 to +10 stops in bands of four; 100 ascents of 40 evaluations; greys by 1/8 stop.
    fn default() -> Self {
        Self {
            seed: Self::SEED,
            count: 1 << 14,
            stops: [-10.0, 10.0],
            band_width: 4.0,
            ascents: 100,
            ascent_steps: 40,
            neutral_step: 0.125,
            fold_places: 1 << 10,
        }
    }
}

/// How [`certify`](crate::certify) looks for the largest difference.
///
/// ```
/// assert_ne!(onelight_lut::Search::Ascent, onelight_lut::Search::SamplesOnly);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Search {
    /// Among the drawn colours, then uphill from the worst of them. Evaluates the reference again.
    Ascent,
    /// Among the drawn colours only: cheap, for trying many candidates.
    SamplesOnly,
}
