use super::compared::{Compared, Difference};
use super::scene_coordinates::SceneCoordinates;
use crate::error::{Error, ErrorKind};

/// The exposure of the largest channel on each circle, in stops about mid grey.
const STOPS: [f64; 4] = [0.0, 2.0, 4.0, 6.0];

/// How much larger than the reference's a candidate's hue step may be.
pub(super) const ALLOWED_RATIO: f64 = 1.5;

/// Half-degree steps around a circle.
const STEPS: usize = 720;

/// Neighbours on a circle of fully saturated colours, half a degree of hue apart.
///
/// A map that is smooth elsewhere may crease where saturated hues pass a face or an edge of a table's cells.
/// Hues are those of the hexagon: red 0, yellow 60, green 120 degrees and so on.
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
/// for circle in &certificate.hue_steps {
///     assert!(circle.max <= 0.501 / 255.0, "at {} stops, hue {}", circle.stops, circle.max_hue);
/// }
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct HueSteps {
    /// The exposure of the largest channel, in stops about mid grey.
    pub stops: f64,
    /// The largest difference between neighbours, candidate.
    pub candidate: f64,
    /// Where that step starts, in degrees of hue.
    pub candidate_hue: f64,
    /// The largest difference between neighbours, reference.
    pub reference: f64,
    /// Where that step starts, in degrees of hue.
    pub reference_hue: f64,
    /// The candidate's largest over the reference's; none where the reference does not change at all.
    pub ratio: Option<f64>,
    /// The most by which a step of the candidate is larger than one and a half times the reference's at the same
    /// hue; 0 if none is. It shows a crease where the reference is smooth, however large its steps are elsewhere.
    pub excess: f64,
    /// Where that step starts, in degrees of hue.
    pub excess_hue: f64,
    /// The largest difference between candidate and reference on the circle.
    pub max: f64,
    /// Where, in degrees of hue.
    pub max_hue: f64,
}

/// Scene-linear colours, circle by circle.
pub(super) fn circles() -> impl Iterator<Item = [f64; 3]> {
    STOPS.into_iter().flat_map(|stops| {
        let hue = |index| index as f64 * 6.0 / STEPS as f64;
        (0..STEPS).map(move |index| SceneCoordinates { stops, saturation: 1.0, hue: hue(index) }.rgb())
    })
}

pub(super) fn measure(circles: &Compared<'_>, difference: Difference<'_>) -> Result<Vec<HueSteps>, Error> {
    let differences = circles.differences(difference);
    let parts = circles.reference.chunks_exact(STEPS).zip(circles.candidate.chunks_exact(STEPS));
    STOPS
        .into_iter()
        .zip(parts.zip(differences.chunks_exact(STEPS)))
        .map(|(stops, ((reference, candidate), differences))| {
            let reference = steps(reference, difference);
            let candidate = steps(candidate, difference);
            let excesses = candidate.iter().zip(&reference).map(|(c, r)| c - ALLOWED_RATIO * r);
            let (excess, excess_hue) = largest(excesses, "hue step of the candidate above the reference's")?;
            let (reference, reference_hue) = largest(reference.iter().copied(), "hue step of the reference")?;
            let (candidate, candidate_hue) = largest(candidate.iter().copied(), "hue step of the candidate")?;
            let (max, max_hue) = largest(differences.iter().copied(), "difference on a circle of hues")?;
            Ok(HueSteps {
                stops,
                candidate,
                candidate_hue,
                reference,
                reference_hue,
                ratio: (reference > 0.0).then(|| candidate / reference),
                excess,
                excess_hue,
                max,
                max_hue,
            })
        })
        .collect()
}

/// The difference from each colour to the next; the last goes back to the first.
fn steps(values: &[[f64; 3]], difference: Difference<'_>) -> Vec<f64> {
    let next = values.iter().cycle().skip(1);
    values.iter().zip(next).map(|(a, b)| difference(a, b)).collect()
}

/// The largest, not below 0, and its hue in degrees; the first of equal ones.
fn largest(values: impl Iterator<Item = f64>, what: &'static str) -> Result<(f64, f64), Error> {
    let mut found = (0.0, 0.0);
    for (index, value) in values.enumerate() {
        if !value.is_finite() {
            return Err(ErrorKind::Parameter { what, found: value, expected: "a finite number" }.into());
        }
        if value > found.0 {
            found = (value, index as f64 * 360.0 / STEPS as f64);
        }
    }
    Ok(found)
}
