use std::fmt;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::colour_set::ColourSet;
use super::compared::{Compared, Map, OnProgress};
use super::sampling_law::{SamplingLaw, Search};
use super::{colour_set, folds, hue_steps, neutral_axis};
use crate::deviation::Deviation;
use crate::error::Error;
use crate::scene_sampler::SceneSampler;

/// All colours of a [`SamplingLaw`] with the reference's values there: made once, then held against any number of
/// candidates by [`certify`](crate::certify()).
///
/// ```
/// use onelight_lut::{Samples, SamplingLaw};
/// let law = SamplingLaw { count: 256, ..SamplingLaw::default() };
/// let samples = Samples::new(&law, &[], |rgb| rgb.map(|u| u / (u + 0.18)), |_colours_done| {})?;
/// let brighter = |rgb: [f64; 3]| rgb.map(|u| u / (u + 0.17));
/// let found = samples.deviation(brighter, |a, b| (a[1] - b[1]).abs())?;
/// assert!(found.max > 0.01 && found.max < 0.02);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone)]
pub struct Samples {
    law: SamplingLaw,
    sets: Vec<ColourSet>,
    /// Scene-linear; one list for all parts, so that threads share it evenly.
    colours: Vec<[f64; 3]>,
    /// What the reference makes of each place, display-linear RGB.
    reference: Vec<[f64; 3]>,
    parts: Parts,
}

/// Which part of the list is what.
#[derive(Clone, Debug)]
struct Parts {
    drawn: Range<usize>,
    greys: Range<usize>,
    named: Range<usize>,
    circles: Range<usize>,
    stencils: Range<usize>,
}

impl Samples {
    /// Evaluates the reference, scene-linear RGB to display-linear RGB, at every colour of a law and of the
    /// caller's own sets, on all threads.
    ///
    /// `progress` is called from any thread with the number of colours done so far, in no certain order; there
    /// are [`Samples::evaluations`] of [`Search::SamplesOnly`], about twice the law's count where that is 2^14.
    ///
    /// # Errors
    ///
    /// If a field of the law is out of bounds; the error names it.
    pub fn new(
        law: &SamplingLaw,
        sets: &[ColourSet],
        reference: impl Fn([f64; 3]) -> [f64; 3] + Sync,
        progress: impl Fn(usize) + Sync,
    ) -> Result<Self, Error> {
        Self::of_map(law, sets, &reference, &progress)
    }

    fn of_map(
        law: &SamplingLaw,
        sets: &[ColourSet],
        reference: Map<'_>,
        progress: OnProgress<'_>,
    ) -> Result<Self, Error> {
        law.check()?;
        let sampler = SceneSampler::with_seed(law.stops[0]..=law.stops[1], law.seed)?;
        let mut colours: Vec<[f64; 3]> = sampler.clone().take(law.count).collect();
        let drawn = 0..colours.len();
        colours.extend(neutral_axis::greys(law));
        let greys = drawn.end..colours.len();
        colours.extend(sets.iter().flat_map(colour_set::exposed));
        let named = greys.end..colours.len();
        colours.extend(hue_steps::circles());
        let circles = named.end..colours.len();
        let centres = neutral_axis::greys(law).chain(sampler.take(law.fold_places));
        colours.extend(centres.flat_map(folds::stencil));
        let stencils = circles.end..colours.len();

        let done = AtomicUsize::new(0);
        let reference = values(&colours, reference, &|more| progress(done.fetch_add(more, Ordering::Relaxed) + more));
        let parts = Parts { drawn, greys, named, circles, stencils };
        Ok(Self { law: law.clone(), sets: sets.to_vec(), colours, reference, parts })
    }

    /// The law that the colours follow.
    #[must_use]
    pub fn law(&self) -> &SamplingLaw {
        &self.law
    }

    /// The most evaluations of a candidate that [`certify`](crate::certify()) makes; ascents may end earlier.
    #[must_use]
    pub fn evaluations(&self, search: Search) -> usize {
        match search {
            Search::SamplesOnly => self.colours.len(),
            Search::Ascent => self.colours.len() + self.law.ascents.min(self.law.count) * self.law.ascent_steps,
        }
    }

    /// How far a candidate lies from the reference over the drawn colours alone: the cheapest figure, and the
    /// same as [`Certificate::overall`](crate::Certificate::overall).
    ///
    /// # Errors
    ///
    /// If a difference is not finite; the error names the first such colour.
    pub fn deviation(
        &self,
        candidate: impl Fn([f64; 3]) -> [f64; 3] + Sync,
        difference: impl Fn(&[f64; 3], &[f64; 3]) -> f64 + Sync,
    ) -> Result<Deviation, Error> {
        let colours = &self.colours[self.parts.drawn.clone()];
        let candidate = values(colours, &candidate, &|_| {});
        let compared =
            Compared { colours, reference: &self.reference[self.parts.drawn.clone()], candidate: &candidate };
        Deviation::of(colours, compared.differences(&difference))
    }

    pub(super) fn evaluate(&self, candidate: Map<'_>, count_more: OnProgress<'_>) -> Vec<[f64; 3]> {
        values(&self.colours, candidate, count_more)
    }

    pub(super) fn sets(&self) -> &[ColourSet] {
        &self.sets
    }

    pub(super) fn drawn<'a>(&'a self, candidate: &'a [[f64; 3]]) -> Compared<'a> {
        self.part(&self.parts.drawn, candidate)
    }

    pub(super) fn greys<'a>(&'a self, candidate: &'a [[f64; 3]]) -> Compared<'a> {
        self.part(&self.parts.greys, candidate)
    }

    pub(super) fn named<'a>(&'a self, candidate: &'a [[f64; 3]]) -> Compared<'a> {
        self.part(&self.parts.named, candidate)
    }

    pub(super) fn circles<'a>(&'a self, candidate: &'a [[f64; 3]]) -> Compared<'a> {
        self.part(&self.parts.circles, candidate)
    }

    pub(super) fn stencils<'a>(&'a self, candidate: &'a [[f64; 3]]) -> Compared<'a> {
        self.part(&self.parts.stencils, candidate)
    }

    /// `candidate` has as many entries as `colours`: it comes from [`Samples::evaluate`].
    fn part<'a>(&'a self, range: &Range<usize>, candidate: &'a [[f64; 3]]) -> Compared<'a> {
        Compared {
            colours: &self.colours[range.clone()],
            reference: &self.reference[range.clone()],
            candidate: &candidate[range.clone()],
        }
    }
}

/// Without the tens of thousands of colours.
impl fmt::Debug for Samples {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Samples").field("law", &self.law).field("parts", &self.parts).finish_non_exhaustive()
    }
}

fn values(colours: &[[f64; 3]], map: Map<'_>, count_more: OnProgress<'_>) -> Vec<[f64; 3]> {
    /// Large beside the cost of reporting progress, small beside all colours.
    const CHUNK: usize = 256;
    let mut values = vec![[0.0; 3]; colours.len()];
    values.par_chunks_mut(CHUNK).zip(colours.par_chunks(CHUNK)).for_each(|(values, colours)| {
        for (value, &colour) in values.iter_mut().zip(colours) {
            *value = map(colour);
        }
        count_more(colours.len());
    });
    values
}
