use super::compared::{Compared, Difference};
use super::sampling_law::SamplingLaw;
use super::scene_coordinates::grey;
use crate::deviation::Deviation;
use crate::error::{Error, ErrorKind};

/// A map on greys, from the darkest to the brightest stop of the law.
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
/// let greys = certificate.neutral_axis;
/// assert!(greys.max <= 0.501 / 255.0);
/// // The film gets brighter with light, and so do its rounded values.
/// assert_eq!((greys.fall.luminance, greys.reference_fall.stops), (0.0, None));
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct NeutralAxis {
    /// The number of greys that were looked at.
    pub count: usize,
    /// The distance of neighbours, in stops.
    pub step: f64,
    /// The mean difference over all greys.
    pub mean: f64,
    /// The largest difference among the greys.
    pub max: f64,
    /// The exposure of the grey with the largest difference, in stops about mid grey.
    pub worst_stops: f64,
    /// Where the candidate gets darker with more light.
    pub fall: Fall,
    /// Where the reference itself does.
    pub reference_fall: Fall,
}

/// The largest fall of luminance from a grey to the next brighter one.
///
/// ```
/// // Luminance never falls: what a certificate of a good map says.
/// let none = onelight_lut::Fall::default();
/// assert_eq!((none.luminance, none.stops), (0.0, None));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Fall {
    /// By how much, in the unit of [`Maps::luminance`](crate::Maps::luminance); 0 if luminance never falls.
    pub luminance: f64,
    /// The brighter grey of the two, in stops about mid grey; none if luminance never falls.
    pub stops: Option<f64>,
}

/// The greys of the law, scene-linear, darkest first.
pub(super) fn greys(law: &SamplingLaw) -> impl Iterator<Item = [f64; 3]> {
    /// So that a step that divides the range reaches its end in spite of rounding.
    const SLACK: f64 = 1e-9;
    let last = ((law.stops[1] - law.stops[0]) / law.neutral_step + SLACK) as usize;
    let law = law.clone();
    (0..=last).map(move |index| [grey(stops_of(&law, index)); 3])
}

pub(super) fn measure(
    law: &SamplingLaw,
    greys: &Compared<'_>,
    difference: Difference<'_>,
    luminance: &dyn Fn(&[f64; 3]) -> f64,
) -> Result<NeutralAxis, Error> {
    let differences = greys.differences(difference);
    let (found, worst) = Deviation::with_worst_index(greys.colours, differences)?;
    Ok(NeutralAxis {
        count: found.count,
        step: law.neutral_step,
        mean: found.mean,
        max: found.max,
        worst_stops: stops_of(law, worst),
        fall: fall(law, greys.candidate, luminance, "luminance of the candidate on the neutral axis")?,
        reference_fall: fall(law, greys.reference, luminance, "luminance of the reference on the neutral axis")?,
    })
}

fn fall(
    law: &SamplingLaw,
    values: &[[f64; 3]],
    luminance: &dyn Fn(&[f64; 3]) -> f64,
    what: &'static str,
) -> Result<Fall, Error> {
    let luminances: Vec<f64> = values.iter().map(luminance).collect();
    if let Some(&found) = luminances.iter().find(|l| !l.is_finite()) {
        return Err(ErrorKind::Parameter { what, found, expected: "a finite number" }.into());
    }
    let mut largest = Fall::default();
    for (index, pair) in luminances.windows(2).enumerate() {
        let fall = pair[0] - pair[1];
        if fall > largest.luminance {
            largest = Fall { luminance: fall, stops: Some(stops_of(law, index + 1)) };
        }
    }
    Ok(largest)
}

fn stops_of(law: &SamplingLaw, index: usize) -> f64 {
    law.stops[0] + index as f64 * law.neutral_step
}
