use super::sampling_law::SamplingLaw;
use crate::deviation::Deviation;
use crate::error::Error;
use crate::scene_sampler::SceneSampler;

/// The difference over the drawn colours of one range of exposure.
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
/// let darkest = &certificate.bands[0];
/// println!("{} to {} stops: {}", darkest.stops[0], darkest.stops[1], darkest.deviation.mean);
/// assert!(darkest.stops[0] < darkest.stops[1]);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Band {
    /// The range of the largest channel, in stops about mid grey; the lower end belongs to the band.
    pub stops: [f64; 2],
    /// The differences; serialised beside `stops`, not below a name of their own.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub deviation: Deviation,
}

/// The drawn colours by exposure, darkest first.
pub(super) fn bands(law: &SamplingLaw, colours: &[[f64; 3]], differences: &[f64]) -> Result<Vec<Band>, Error> {
    let [low, high] = law.stops;
    let count = (((high - low) / law.band_width).ceil() as usize).max(1);
    let mut members: Vec<(Vec<[f64; 3]>, Vec<f64>)> = vec![(Vec::new(), Vec::new()); count];
    for (colour, difference) in colours.iter().zip(differences) {
        let stops = (colour.iter().copied().fold(0.0, f64::max) / SceneSampler::MID_GREY).log2();
        // A float to integer cast saturates, so rounding at the ends cannot leave the list.
        let index = (((stops - low) / law.band_width) as usize).min(count - 1);
        members[index].0.push(*colour);
        members[index].1.push(*difference);
    }
    let filled = members.into_iter().enumerate().filter(|(_, (colours, _))| !colours.is_empty());
    filled
        .map(|(index, (colours, differences))| {
            let from = low + index as f64 * law.band_width;
            let stops = [from, (from + law.band_width).min(high)];
            Ok(Band { stops, deviation: Deviation::of(&colours, differences)? })
        })
        .collect()
}
