//! How far a baked look lies from the exact one: certificates, by one call or colour set by colour set.
//!
//! ```
//! use onelight::baked::Recipe;
//! use onelight::certify::CertifySettings;
//! use onelight::lut::{SamplingLaw, Search};
//! let look = onelight::Process::default().look()?;
//! let baked = look.baked(&Recipe::cube(17))?;
//! // Few colours for a quick answer; the default takes 32768 and follows the worst of them.
//! let law = SamplingLaw { count: 1 << 10, ..SamplingLaw::default() };
//! let report = look.certify(&baked, &CertifySettings { law, search: Search::SamplesOnly })?;
//! assert!(report.srgb.overall.mean < 0.5);
//! println!("{report}");
//! # Ok::<(), onelight::Error>(())
//! ```

use std::fmt;

use nalgebra::{Matrix3, Vector3};
use onelight_lut::{Certificate, ColourSet, Maps, Samples, SamplingLaw, Search, certify};
use onelight_spectra::{Basis, Chromaticity, DisplayDifference, DisplayLinear, Reconstruction, color_checker};
use serde::Serialize;

use crate::baked::Coordinate;
use crate::error::Error;
use crate::look::Look;
use crate::scene::{MID_GREY, multiply};
use crate::word::WorkingSpace;

/// Which colours a certificate looks at, and how hard.
///
/// ```
/// use onelight::certify::CertifySettings;
/// use onelight::lut::{SamplingLaw, Search};
/// let quick = CertifySettings { law: SamplingLaw { count: 1 << 10, ..SamplingLaw::default() }, search: Search::SamplesOnly };
/// assert!(quick.law.count < CertifySettings::default().law.count);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct CertifySettings {
    /// Which colours, over which exposures.
    pub law: SamplingLaw,
    /// Whether the worst of them are followed uphill.
    pub search: Search,
}

impl Default for CertifySettings {
    fn default() -> Self {
        Self { law: SamplingLaw::default(), search: Search::Ascent }
    }
}

/// The colours that a map can take.
///
/// ```
/// use onelight::certify::{Certifier, CertifySettings, Gamut};
/// # use onelight::lut::{SamplingLaw, Search};
/// # let settings = CertifySettings { law: SamplingLaw { count: 1 << 8, ..SamplingLaw::default() }, search: Search::SamplesOnly };
/// let look = onelight::Process::default().look()?;
/// let exact = |rgb: [f32; 3]| look.develop(rgb.map(f64::from)).map(|v| v as f32);
/// let report = Certifier::new(&look)?.report(exact, Gamut::Srgb, &settings)?;
/// assert!(report.rec2020.is_none());
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Gamut {
    /// Those within sRGB's primaries: a plain table holds what is inside of its own.
    Srgb,
    /// Those within Rec.2020's primaries too.
    Wide,
}

/// What was found of a baked look; CIEDE2000 from the exact one. As text it is a few lines for people.
///
/// ```
/// # use onelight::baked::{Form, Recipe};
/// # use onelight::certify::CertifySettings;
/// # use onelight::lut::{SamplingLaw, Search};
/// # let settings = CertifySettings { law: SamplingLaw { count: 1 << 8, ..SamplingLaw::default() }, search: Search::SamplesOnly };
/// let look = onelight::Process::default().look()?;
/// let found = look.certify(&look.baked(&Recipe::cube(17))?, &settings)?;
/// println!("{found}");
/// assert!(found.srgb.overall.mean < 0.5 && found.rec2020.is_none());
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Certified {
    /// On colours within sRGB's primaries.
    pub srgb: Certificate,
    /// On colours within Rec.2020; `None` for plain tables, which hold what is inside their own primaries only.
    pub rec2020: Option<Certificate>,
    /// The exact look's own tint of greys.
    pub tint: Tint,
}

/// The tint that a look gives to greys: chroma C* of CIELAB.
///
/// ```
/// use onelight::certify::Certifier;
/// let look = onelight::Process::default().look()?;
/// let tint = Certifier::new(&look)?.tint();
/// assert!(tint.mid_grey < 1e-6, "neutral aim");
/// assert!(tint.largest > 3.0 && tint.stops > 1.0, "bright greys keep the film's tint");
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Tint {
    /// C* of an 18 % grey card.
    pub mid_grey: f64,
    /// The largest of all greys from -10 to +10 stops.
    pub largest: f64,
    /// The exposure of that grey in stops about 18 %.
    pub stops: f64,
}

/// Mean and largest difference of some colours, as over a range of exposures.
///
/// ```
/// # use onelight::baked::Recipe;
/// # use onelight::certify::{CertifySettings, to_six_stops};
/// # use onelight::lut::{SamplingLaw, Search};
/// # let settings = CertifySettings { law: SamplingLaw { count: 1 << 8, ..SamplingLaw::default() }, search: Search::SamplesOnly };
/// let look = onelight::Process::default().look()?;
/// let all = look.certify(&look.baked(&Recipe::cube(17))?, &settings)?.srgb;
/// let usual = to_six_stops(&all);
/// assert!(usual.mean <= usual.max && usual.max <= all.max_found);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MeanAndMax {
    /// Mean difference of all colours, CIEDE2000.
    pub mean: f64,
    /// The largest difference found, CIEDE2000.
    pub max: f64,
}

impl MeanAndMax {
    /// Of these differences, added in their order; 0 where there are none.
    ///
    /// ```
    /// use onelight::certify::MeanAndMax;
    /// assert_eq!(MeanAndMax::of(&[0.5, 1.5]).to_string(), "1.000 CIEDE2000 in the mean and 1.500 at most");
    /// ```
    #[must_use]
    pub fn of(differences: &[f64]) -> Self {
        let mean = differences.iter().sum::<f64>() / differences.len().max(1) as f64;
        Self { mean, max: differences.iter().copied().fold(0.0, f64::max) }
    }
}

impl fmt::Display for MeanAndMax {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:.3} CIEDE2000 in the mean and {:.3} at most", self.mean, self.max)
    }
}

/// A look with all that measuring several forms against it needs.
///
/// ```
/// use onelight::WorkingSpace;
/// use onelight::certify::Certifier;
/// use onelight::lut::{SamplingLaw, Search};
/// let look = onelight::Process::default().look()?;
/// let certifier = Certifier::new(&look)?;
/// let samples = certifier.samples(&SamplingLaw { count: 1 << 8, ..SamplingLaw::default() }, WorkingSpace::Srgb)?;
/// // The look itself in float32 differs by its rounding alone.
/// let exact = |rgb: [f32; 3]| look.develop(rgb.map(f64::from)).map(|v| v as f32);
/// assert!(certifier.certify(&samples, exact, Search::SamplesOnly)?.max_found < 0.001);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug)]
pub struct Certifier<'a> {
    look: &'a Look,
    difference: DisplayDifference,
    luminance: Vector3<f64>,
    /// Scene-linear RGB of what the film gets as white.
    white: [f64; 3],
    coding: Option<Coordinate>,
}

impl<'a> Certifier<'a> {
    /// Ready to measure against a look.
    ///
    /// # Errors
    /// None for the built-in spaces.
    pub fn new(look: &'a Look) -> Result<Self, Error> {
        let (difference, luminance) = (look.difference()?, look.spaces().luminance()?);
        let white = look.spaces().white_rgb()?;
        Ok(Self { look, difference, luminance, white, coding: None })
    }

    /// The same for a form that takes a coding of light ([`Baked::coordinate`](crate::baked::Baked::coordinate)). Exposures end
    /// with the coding, and colours outside of it count as what it holds of them: no table can know what its input does not
    /// say. `None` leaves everything as it is.
    #[must_use]
    pub fn within_coding(self, coding: Option<&Coordinate>) -> Self {
        Self { coding: coding.cloned(), ..self }
    }

    /// The colours that `law` draws, in the primaries of `space`, and the ColorChecker, each with the exact look's result.
    ///
    /// # Errors
    /// If the law is out of range.
    pub fn samples(&self, law: &SamplingLaw, space: WorkingSpace) -> Result<Samples, Error> {
        let to_input = self.to_input(space)?;
        let exact = |rgb| *self.look.develop_linear(self.held(multiply(&to_input, rgb)));
        Ok(Samples::new(&self.within(law), &[checker(space)?], exact, |_| {})?)
    }

    /// Measures a map (the look's input space to display-coded) on samples in sRGB primaries.
    ///
    /// # Errors
    /// If a result of the map is not finite.
    pub fn certify(
        &self,
        samples: &Samples,
        map: impl Fn([f32; 3]) -> [f32; 3] + Sync,
        search: Search,
    ) -> Result<Certificate, Error> {
        self.certify_in(WorkingSpace::Srgb, samples, map, search)
    }

    /// Measures a map (the look's input space to display-coded) on samples in the primaries of `space`.
    ///
    /// # Errors
    /// If a result of the map is not finite.
    pub fn certify_in(
        &self,
        space: WorkingSpace,
        samples: &Samples,
        map: impl Fn([f32; 3]) -> [f32; 3] + Sync,
        search: Search,
    ) -> Result<Certificate, Error> {
        let to_input = self.to_input(space)?;
        let coding = self.look.coding();
        let maps = Maps {
            reference: |rgb| *self.look.develop_linear(self.held(multiply(&to_input, rgb))),
            candidate: |rgb: [f64; 3]| {
                let input = multiply(&to_input, rgb).map(|v| v as f32);
                *coding.decode_rgb(map(input).map(f64::from))
            },
            difference: |a: &[f64; 3], b: &[f64; 3]| self.difference.between(DisplayLinear(*a), DisplayLinear(*b)),
            luminance: |v: &[f64; 3]| self.luminance.dot(&Vector3::from(*v)),
        };
        Ok(certify(samples, &maps, search, |_| {})?)
    }

    /// All that is said of a map (the look's input space to display-coded): what [`Look::certify`] says of a baked look.
    ///
    /// # Errors
    /// If the settings are out of range, or a result of the map is not finite.
    pub fn report(
        &self,
        map: impl Fn([f32; 3]) -> [f32; 3] + Sync,
        gamut: Gamut,
        settings: &CertifySettings,
    ) -> Result<Certified, Error> {
        let CertifySettings { law, search } = settings;
        let srgb = self.certify(&self.samples(law, WorkingSpace::Srgb)?, &map, *search)?;
        let rec2020 = match gamut {
            Gamut::Wide => {
                let samples = self.samples(law, WorkingSpace::Rec2020)?;
                Some(self.certify_in(WorkingSpace::Rec2020, &samples, &map, *search)?)
            }
            Gamut::Srgb => None,
        };
        Ok(Certified { srgb, rec2020, tint: self.tint() })
    }

    /// The look's own tint of greys.
    #[must_use]
    pub fn tint(&self) -> Tint {
        let white = self.white;
        let chroma = |stops: f64| {
            let grey = white.map(|v| v * MID_GREY * stops.exp2());
            let [_, a, b] = self.difference.lab(self.look.develop_linear(grey));
            a.hypot(b)
        };
        let greys = (-80..=80).map(|i| f64::from(i) / 8.0).map(|stops| (chroma(stops), stops));
        let (largest, stops) = greys.fold((0.0, 0.0), |most, grey| if grey.0 > most.0 { grey } else { most });
        Tint { mid_grey: chroma(0.0), largest, stops }
    }

    /// What the coding holds of a colour.
    fn held(&self, linear: [f64; 3]) -> [f64; 3] {
        self.coding.as_ref().map_or(linear, |coding| coding.held(linear))
    }

    /// The law up to the brightest grey of the coding, by eighths of a stop.
    fn within(&self, law: &SamplingLaw) -> SamplingLaw {
        let Some(coding) = &self.coding else { return law.clone() };
        let end = ((coding.max() / MID_GREY).log2() * 8.0).floor() / 8.0;
        let [low, high] = law.stops;
        SamplingLaw { stops: [low, high.min(end).max(low)], ..law.clone() }
    }

    fn to_input(&self, space: WorkingSpace) -> Result<Matrix3<f64>, Error> {
        let white = Chromaticity::black_body_6500_k();
        Ok(space.space().to_about(&self.look.spaces().input_space.space(), white)?)
    }
}

/// The ColorChecker under the white of the scene, in the primaries of `space`.
fn checker(space: WorkingSpace) -> Result<ColourSet, Error> {
    let basis = Basis::new(Reconstruction::Smooth)?;
    let white = Chromaticity::black_body_6500_k();
    let from_srgb = WorkingSpace::Srgb.space().to_about(&space.space(), white)?;
    let patches = color_checker().iter().map(|patch| {
        let rgb = basis.rgb_of(&basis.white().reflected_by(&patch.reflectance));
        // One patch, cyan, lies a little outside sRGB.
        (patch.name.as_str(), multiply(&from_srgb, rgb).map(|v| v.max(0.0)))
    });
    Ok(ColourSet::new("ColorChecker", patches)?)
}

impl Certified {
    /// What keeps it from being as good as promised: largest difference over `limit` (CIEDE2000), greys that get darker with
    /// more light, folds. Empty if nothing does.
    #[must_use]
    pub fn failures(&self, limit: f64) -> Vec<String> {
        self.srgb.failures(limit)
    }

    /// One line for comments in files.
    #[must_use]
    pub fn summary(&self) -> String {
        summary(&self.srgb)
    }
}

impl fmt::Display for Certified {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&in_words(&self.srgb, "sRGB"))?;
        if let Some(wide) = &self.rec2020 {
            let (mean, max) = (wide.overall.mean, wide.max_found);
            writeln!(f, "  the same for Rec.2020 colours: mean {mean:.3}, max {max:.3}")?;
        }
        writeln!(f, "{}", self.tint)
    }
}

impl fmt::Display for Tint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { mid_grey, largest, stops } = self;
        write!(f, "the film's own tint of greys: C* {mid_grey:.1} at 18 %, at most {largest:.1} at {stops:+} stops")
    }
}

/// A certificate in one line for comments in files.
#[must_use]
pub fn summary(certificate: &Certificate) -> String {
    let Certificate { law, overall, max_found, .. } = certificate;
    let [low, high] = law.stops;
    let to_six = if high > 6.0 {
        let MeanAndMax { mean, max } = to_six_stops(certificate);
        format!("; to +6 stops: mean {mean:.3}, max {max:.3}")
    } else {
        String::new()
    };
    format!(
        "CIEDE2000 from the exact film, {low:+} to {high:+} stops: mean {:.3}, p99 {:.3}, max {max_found:.3}{to_six}",
        overall.mean, overall.p99
    )
}

/// A certificate in a few lines; `space` names the primaries of its colours.
#[must_use]
pub fn in_words(certificate: &Certificate, space: &str) -> String {
    let Certificate { law, overall, headline_mean, max_found, max_found_at: at, .. } = certificate;
    let mut text = format!(
        "certificate: CIEDE2000 from the exact film, {} {space} colours, {:+} to {:+} stops, any saturation\n  \
         mean {:.3} (worst band {headline_mean:.3}), p95 {:.3}, p99 {:.3}, max {max_found:.3} at scene RGB {:.4}, {:.4}, {:.4}\n",
        law.count, law.stops[0], law.stops[1], overall.mean, overall.p95, overall.p99, at[0], at[1], at[2]
    );
    for band in &certificate.bands {
        let ([low, high], d) = (band.stops, &band.deviation);
        text += &format!("  {low:>+3} to {high:>+3} stops: mean {:.3}, p99 {:.3}, max {:.3}\n", d.mean, d.p99, d.max);
    }
    if law.stops[1] > 6.0 {
        let MeanAndMax { mean, max } = to_six_stops(certificate);
        text += &format!("  all to +6 stops: mean {mean:.3}, max {max:.3}\n");
    }
    let axis = &certificate.neutral_axis;
    let folds = &certificate.folds;
    text += &format!(
        "  greys: max {:.3}, largest fall of luminance {:.1e}; folds: {} of {} places\n",
        axis.max, axis.fall.luminance, folds.folds, folds.places
    );
    for set in &certificate.colour_sets {
        text += &format!(
            "  {}, -4 to +4 stops: mean {:.3}, max {:.3} ({}, {:+} stops)\n",
            set.name, set.mean, set.max, set.worst_name, set.worst_stops
        );
    }
    let steps: Vec<String> = certificate
        .hue_steps
        .iter()
        .map(|s| format!("{:.2} for {:.2} at {:+}", s.candidate, s.reference, s.stops))
        .collect();
    text + &format!("  largest step per half degree of hue, table for film: {}\n", steps.join(", "))
}

/// Mean and maximum of the bands up to +6 stops: the law of the prototypes.
#[must_use]
pub fn to_six_stops(certificate: &Certificate) -> MeanAndMax {
    let bands = || certificate.bands.iter().filter(|band| band.stops[1] <= 6.0).map(|band| &band.deviation);
    let count: usize = bands().map(|d| d.count).sum();
    let sum: f64 = bands().map(|d| d.mean * d.count as f64).sum();
    MeanAndMax { mean: sum / count.max(1) as f64, max: bands().map(|d| d.max).fold(0.0, f64::max) }
}
