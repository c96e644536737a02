use super::compared::{Compared, Difference};
use crate::deviation::Deviation;
use crate::error::{Error, ErrorKind};

/// The exposures of every named colour, in stops about the colour as it was given.
const STOPS: std::ops::RangeInclusive<i32> = -4..=4;
const EXPOSURES: usize = 9;

/// Named colours of the caller, such as the patches of a chart.
///
/// ```
/// use onelight_lut::ColourSet;
/// let skin = ColourSet::new("skin", [("light", [0.56, 0.39, 0.31]), ("dark", [0.16, 0.08, 0.06])])?;
/// assert_eq!(skin.name(), "skin");
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ColourSet {
    name: String,
    colours: Vec<(String, [f64; 3])>,
}

impl ColourSet {
    /// Colours with their names: scene-linear RGB as exposed for mid grey at
    /// [`SceneSampler::MID_GREY`](crate::SceneSampler::MID_GREY).
    ///
    /// # Errors
    ///
    /// If there is no colour, or one is not made of finite numbers.
    pub fn new<N: Into<String>>(
        name: impl Into<String>,
        colours: impl IntoIterator<Item = (N, [f64; 3])>,
    ) -> Result<Self, Error> {
        let colours: Vec<_> = colours.into_iter().map(|(name, colour)| (name.into(), colour)).collect();
        if colours.is_empty() {
            return Err(ErrorKind::NoSamples.into());
        }
        if let Some(&found) = colours.iter().flat_map(|(_, colour)| colour).find(|u| !u.is_finite()) {
            return Err(
                ErrorKind::Parameter { what: "channel of a named colour", found, expected: "a finite number" }.into()
            );
        }
        Ok(Self { name: name.into(), colours })
    }

    /// What the set is called.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }
}

/// The difference over a [`ColourSet`], each colour at -4 to +4 stops by 1.
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
/// let skin = &certificate.colour_sets[0];
/// assert_eq!((skin.name.as_str(), skin.worst_name.as_str(), skin.count), ("skin", "light", 9));
/// assert!(skin.mean <= skin.max && skin.max <= 0.501 / 255.0);
/// # Ok::<(), onelight_lut::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct SetDeviation {
    /// What the set is called.
    pub name: String,
    /// The number of colours times that of exposures.
    pub count: usize,
    /// The mean difference over all exposures.
    pub mean: f64,
    /// The largest difference, that of `worst`.
    pub max: f64,
    /// The name of the colour with the largest difference.
    pub worst_name: String,
    /// Its exposure, in stops about the colour as it was given.
    pub worst_stops: f64,
    /// The colour so exposed, scene-linear RGB.
    pub worst: [f64; 3],
}

/// Every colour at every exposure, colour by colour.
pub(super) fn exposed(set: &ColourSet) -> impl Iterator<Item = [f64; 3]> {
    set.colours.iter().flat_map(|(_, colour)| STOPS.map(|stops| colour.map(|u| u * f64::from(stops).exp2())))
}

pub(super) fn measure(
    sets: &[ColourSet],
    named: &Compared<'_>,
    difference: Difference<'_>,
) -> Result<Vec<SetDeviation>, Error> {
    let differences = named.differences(difference);
    let mut from = 0;
    sets.iter()
        .map(|set| {
            let range = from..from + set.colours.len() * EXPOSURES;
            from = range.end;
            let differences = &differences[range.clone()];
            let (found, worst) = Deviation::with_worst_index(&named.colours[range], differences.to_vec())?;
            Ok(SetDeviation {
                name: set.name.clone(),
                count: found.count,
                mean: found.mean,
                max: found.max,
                worst_name: set.colours[worst / EXPOSURES].0.clone(),
                worst_stops: f64::from(*STOPS.start()) + (worst % EXPOSURES) as f64,
                worst: found.worst,
            })
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exposures_are_as_many_as_said() {
        let set = ColourSet::new("set", [("a", [1.0, 2.0, 3.0]), ("b", [0.0; 3])]).unwrap();
        let all: Vec<_> = exposed(&set).collect();
        assert_eq!(all.len(), 2 * EXPOSURES);
        assert_eq!((all[0], all[4], all[8]), ([0.0625, 0.125, 0.1875], [1.0, 2.0, 3.0], [16.0, 32.0, 48.0]));
    }

    #[test]
    fn bad_sets_are_refused() {
        assert!(ColourSet::new("empty", [] as [(&str, [f64; 3]); 0]).is_err());
        assert!(ColourSet::new("nan", [("a", [0.0, f64::NAN, 0.0])]).is_err());
    }
}
