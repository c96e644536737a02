mod ascent;
mod bands;
mod colour_set;
mod compared;
mod folds;
mod hue_steps;
mod neutral_axis;
mod samples;
mod sampling_law;
mod scene_coordinates;
#[cfg(test)]
mod tests;
mod verdict;

use std::sync::atomic::{AtomicUsize, Ordering};

pub use self::bands::Band;
pub use self::colour_set::{ColourSet, SetDeviation};
use self::compared::{Difference, Map, OnProgress};
pub use self::folds::Folds;
pub use self::hue_steps::HueSteps;
pub use self::neutral_axis::{Fall, NeutralAxis};
pub use self::samples::Samples;
pub use self::sampling_law::{SamplingLaw, Search};
use crate::deviation::Deviation;
use crate::error::Error;

/// What [`certify`] compares and how. Any closures do; they are called from all threads.
///
/// ```
/// use onelight_lut::Maps;
/// let film = |rgb: [f64; 3]| rgb.map(|u| u / (u + 0.18));
/// let maps = Maps {
///     reference: film,
///     candidate: |rgb| film(rgb).map(|v| (v * 255.0).round() / 255.0),
///     difference: |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max),
///     luminance: |v: &[f64; 3]| (v[0] + v[1] + v[2]) / 3.0,
/// };
/// assert!((maps.difference)(&film([0.18; 3]), &(maps.candidate)([0.18; 3])) < 0.5 / 255.0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Maps<R, C, D, L> {
    /// The map to be reproduced, `Fn([f64; 3]) -> [f64; 3]`: scene-linear RGB to display-linear RGB, 1 being the
    /// most that the display shows.
    pub reference: R,
    /// The map to be measured, from and to the same as the reference.
    pub candidate: C,
    /// How far two display-linear colours lie apart, `Fn(&[f64; 3], &[f64; 3]) -> f64`, for instance CIEDE2000.
    /// The reference's, or the earlier neighbour's, comes first.
    pub difference: D,
    /// The luminance of a display-linear colour, `Fn(&[f64; 3]) -> f64`, 1 at white.
    pub luminance: L,
}

/// How far a map lies from its reference, and what it breaks: the result of [`certify`].
///
/// Differences are in the unit of [`Maps::difference`], colours scene-linear RGB, stops relative to mid grey
/// ([`SceneSampler::MID_GREY`](crate::SceneSampler::MID_GREY)). The names of fields are those of the
/// serialised form.
///
/// ```
/// # use onelight_lut::{ColourSet, Maps, Samples, SamplingLaw, Search, certify};
/// # let film = |rgb: [f64; 3]| rgb.map(|u| u / (u + 0.18));
/// # let skin = ColourSet::new("skin", [("light", [0.56, 0.39, 0.31])])?;
/// # let samples = Samples::new(&SamplingLaw { count: 1 << 8, ..SamplingLaw::default() }, &[skin], film, |_| {})?;
/// # let maps = Maps {
/// #     reference: film,
/// #     candidate: |rgb| film(rgb).map(|v| (v * 255.0).round() / 255.0),
/// #     difference: |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max),
/// #     luminance: |v: &[f64; 3]| (v[0] + v[1] + v[2]) / 3.0,
/// # };
/// # let certificate = certify(&samples, &maps, Search::SamplesOnly, |_| {})?;
/// // A film rounded to 8 bits, of which the certificate says by how much.
/// assert!(certificate.max_found <= 0.501 / 255.0 && !certificate.passed(0.4 / 255.0));
/// assert!(certificate.bands.iter().all(|band| band.deviation.mean <= certificate.headline_mean));
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Certificate {
    /// Which colours were looked at.
    pub law: SamplingLaw,
    /// Whether the worst of them were followed uphill.
    pub search: Search,
    /// The mean difference of the worst band.
    pub headline_mean: f64,
    /// The largest difference among the law's colours and those that the ascents met.
    pub max_found: f64,
    /// The colour where it was found.
    pub max_found_at: [f64; 3],
    /// All colours of the law together, without the ascents.
    pub overall: Deviation,
    /// The same by exposure, darkest first. A band without a colour is left out.
    pub bands: Vec<Band>,
    /// The greys from the darkest to the brightest stop of the law.
    pub neutral_axis: NeutralAxis,
    /// The caller's own colours over exposure, in the order given.
    pub colour_sets: Vec<SetDeviation>,
    /// Places where the candidate turns space inside out.
    pub folds: Folds,
    /// Steps along circles of full saturation, darkest first.
    pub hue_steps: Vec<HueSteps>,
}

/// Measures a candidate on all colours of `samples`, on all threads.
///
/// The reference's values there are those that `samples` holds; [`Maps::reference`] itself is called by the
/// ascents of [`Search::Ascent`] only. The result does not depend on the number of threads.
///
/// `progress` is called from any thread with the number of evaluations of the candidate so far, in no certain
/// order; [`Samples::evaluations`] bounds it.
///
/// ```
/// use onelight_lut::{ColourSet, SamplingLaw, Maps, Samples, Search, certify};
///
/// let film = |rgb: [f64; 3]| rgb.map(|u| u / (u + 0.18));
/// let law = SamplingLaw { count: 1 << 10, ..SamplingLaw::default() };
/// let skin = ColourSet::new("skin", [("light", [0.56, 0.39, 0.31]), ("dark", [0.16, 0.08, 0.06])])?;
/// let samples = Samples::new(&law, &[skin], film, |_done| {})?;
///
/// let maps = Maps {
///     reference: film,
///     candidate: |rgb| film(rgb).map(|v| (v * 1023.0).round() / 1023.0),
///     difference: |a: &[f64; 3], b: &[f64; 3]| (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max),
///     luminance: |v: &[f64; 3]| (v[0] + v[1] + v[2]) / 3.0,
/// };
/// let certificate = certify(&samples, &maps, Search::Ascent, |_done| {})?;
/// assert!(certificate.max_found > 0.49 / 1023.0 && certificate.max_found <= 0.501 / 1023.0);
/// assert!(!certificate.passed(0.4 / 1023.0));
/// # Ok::<(), onelight_lut::Error>(())
/// ```
///
/// # Errors
///
/// If a difference or a luminance is not finite; the error names the first such colour of the law, where it is
/// one of them.
pub fn certify<R, C, D, L>(
    samples: &Samples,
    maps: &Maps<R, C, D, L>,
    search: Search,
    progress: impl Fn(usize) + Sync,
) -> Result<Certificate, Error>
where
    R: Fn([f64; 3]) -> [f64; 3] + Sync,
    C: Fn([f64; 3]) -> [f64; 3] + Sync,
    D: Fn(&[f64; 3], &[f64; 3]) -> f64 + Sync,
    L: Fn(&[f64; 3]) -> f64 + Sync,
{
    let Maps { reference, candidate, difference, luminance } = maps;
    measured(samples, &Maps { reference, candidate, difference, luminance }, search, &progress)
}

/// [`Maps`] whose closures are not known.
type AnyMaps<'a> = Maps<Map<'a>, Map<'a>, Difference<'a>, &'a dyn Fn(&[f64; 3]) -> f64>;

fn measured(
    samples: &Samples,
    maps: &AnyMaps<'_>,
    search: Search,
    progress: OnProgress<'_>,
) -> Result<Certificate, Error> {
    let law = samples.law();
    let done = AtomicUsize::new(0);
    let count_more = |more: usize| progress(done.fetch_add(more, Ordering::Relaxed) + more);
    let candidate = samples.evaluate(maps.candidate, &count_more);

    let drawn = samples.drawn(&candidate);
    let differences = drawn.differences(maps.difference);
    let overall = Deviation::of(drawn.colours, differences.clone())?;
    let bands = bands::bands(law, drawn.colours, &differences)?;
    let (max_found, max_found_at) = match search {
        Search::SamplesOnly => (overall.max, overall.worst),
        Search::Ascent => {
            let measure = |rgb| (maps.difference)(&(maps.reference)(rgb), &(maps.candidate)(rgb));
            ascent::largest(law, drawn.colours, &differences, &measure, &count_more)?
        }
    };
    Ok(Certificate {
        law: law.clone(),
        search,
        headline_mean: bands.iter().map(|band| band.deviation.mean).fold(0.0, f64::max),
        max_found,
        max_found_at,
        overall,
        bands,
        neutral_axis: neutral_axis::measure(law, &samples.greys(&candidate), maps.difference, maps.luminance)?,
        colour_sets: colour_set::measure(samples.sets(), &samples.named(&candidate), maps.difference)?,
        folds: folds::count(&samples.stencils(&candidate)),
        hue_steps: hue_steps::measure(&samples.circles(&candidate), maps.difference)?,
    })
}
