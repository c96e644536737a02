//! What a table is worth: its certificate against the exact film, in words and as JSON.

use std::fmt::Write as _;

use anyhow::Result;
use onelight::lut::{Certificate, ColourSet, Maps, Samples, SamplingLaw, Search, certify};
use onelight::spectra::nalgebra::{Matrix3, Vector3};
use onelight::spectra::{Basis, Chromaticity, DisplayDifference, Reconstruction, color_checker};
use onelight::{Look, Process, WorkingSpace};

/// A film with all that measuring against it needs.
pub(crate) struct Measure<'a> {
    film: &'a Look,
    process: &'a Process,
    difference: DisplayDifference,
    luminance: Vector3<f64>,
}

impl<'a> Measure<'a> {
    pub(crate) fn new(film: &'a Look, process: &'a Process) -> Result<Self> {
        let to_xyz = process.output_space.space().to_xyz()?;
        let luminance = to_xyz.row(1).transpose();
        Ok(Self { film, process, difference: film.difference()?, luminance })
    }

    /// Colours by a law, in the primaries of `space`, with the film's results.
    pub(crate) fn samples(&self, law: &SamplingLaw, space: WorkingSpace) -> Result<Samples> {
        let to_input = self.to_input(space)?;
        let film = |rgb| self.film.develop_linear(multiply(&to_input, rgb));
        Ok(Samples::new(law, &[checker(space)?], film, |_| {})?)
    }

    /// Measures a table that takes sRGB-law samples (see [`Measure::certify_in`]).
    pub(crate) fn certify(
        &self,
        samples: &Samples,
        table: impl Fn([f32; 3]) -> [f32; 3] + Sync,
        search: Search,
    ) -> Result<Certificate> {
        self.certify_in(WorkingSpace::Srgb, samples, table, search)
    }

    /// Measures a table (look's input space to display-coded) on samples in the primaries of `space`.
    pub(crate) fn certify_in(
        &self,
        space: WorkingSpace,
        samples: &Samples,
        table: impl Fn([f32; 3]) -> [f32; 3] + Sync,
        search: Search,
    ) -> Result<Certificate> {
        let to_input = self.to_input(space)?;
        let coding = self.film.coding();
        let maps = Maps {
            reference: |rgb| self.film.develop_linear(multiply(&to_input, rgb)),
            candidate: |rgb: [f64; 3]| {
                let input = multiply(&to_input, rgb).map(|v| v as f32);
                table(input).map(|v| coding.decode(f64::from(v)))
            },
            difference: |a: &[f64; 3], b: &[f64; 3]| self.difference.between(*a, *b),
            luminance: |v: &[f64; 3]| self.luminance.dot(&Vector3::from(*v)),
        };
        Ok(certify(samples, &maps, search, |_| {})?)
    }

    /// The film's own tint: chroma C* of 18 % grey, and the largest of all greys with its exposure in stops about it.
    pub(crate) fn tint(&self) -> (f64, f64, f64) {
        let chroma = |stops: f64| {
            let [_, a, b] = self.difference.lab(self.film.develop_linear([0.18 * stops.exp2(); 3]));
            a.hypot(b)
        };
        let greys = (-80..=80).map(|i| f64::from(i) / 8.0).map(|stops| (chroma(stops), stops));
        let (largest, stops) = greys.fold((0.0, 0.0), |most, grey| if grey.0 > most.0 { grey } else { most });
        (chroma(0.0), largest, stops)
    }

    fn to_input(&self, space: WorkingSpace) -> Result<Matrix3<f64>> {
        let white = Chromaticity::black_body_6500_k();
        Ok(space.space().to_about(&self.process.input_space.space(), white)?)
    }
}

fn multiply(matrix: &Matrix3<f64>, rgb: [f64; 3]) -> [f64; 3] {
    (matrix * Vector3::from(rgb)).data.0[0]
}

/// The ColorChecker under the white of the scene, in the primaries of `space`.
fn checker(space: WorkingSpace) -> Result<ColourSet> {
    let basis = Basis::new(Reconstruction::Smooth)?;
    let white = Chromaticity::black_body_6500_k();
    let from_srgb = WorkingSpace::Srgb.space().to_about(&space.space(), white)?;
    let patches = color_checker().iter().map(|patch| {
        let rgb = basis.rgb_of(&basis.white().reflected_by(&patch.reflectance));
        // One patch, cyan, lies a little outside sRGB.
        (patch.name.as_str(), multiply(&from_srgb, rgb.data.0[0]).map(|v| v.max(0.0)))
    });
    Ok(ColourSet::new("ColorChecker", patches)?)
}

/// The certificate in a few lines.
pub(crate) fn in_words(certificate: &Certificate, space: &str) -> String {
    let mut text = String::new();
    let Certificate { law, overall, headline_mean, max_found, max_found_at: at, .. } = certificate;
    // Writing to a string cannot fail.
    let _ = writeln!(
        text,
        "certificate: CIEDE2000 from the exact film, {} {space} colours, {:+} to {:+} stops, any saturation\n  \
         mean {:.3} (worst band {headline_mean:.3}), p95 {:.3}, p99 {:.3}, max {max_found:.3} at scene RGB {:.4}, {:.4}, {:.4}",
        law.count, law.stops[0], law.stops[1], overall.mean, overall.p95, overall.p99, at[0], at[1], at[2]
    );
    for band in &certificate.bands {
        let d = &band.deviation;
        let _ = writeln!(
            text,
            "  {:>+3} to {:>+3} stops: mean {:.3}, p99 {:.3}, max {:.3}",
            band.stops[0], band.stops[1], d.mean, d.p99, d.max
        );
    }
    let (mean, max) = to_six_stops(certificate);
    let _ = writeln!(text, "  all to +6 stops: mean {mean:.3}, max {max:.3}");
    let axis = &certificate.neutral_axis;
    let folds = &certificate.folds;
    let _ = writeln!(
        text,
        "  greys: max {:.3}, largest fall of luminance {:.1e}; folds: {} of {} places",
        axis.max, axis.fall.luminance, folds.folds, folds.places
    );
    for set in &certificate.colour_sets {
        let _ = writeln!(
            text,
            "  {}, -4 to +4 stops: mean {:.3}, max {:.3} ({}, {:+} stops)",
            set.name, set.mean, set.max, set.worst_name, set.worst_stops
        );
    }
    let steps: Vec<String> = certificate
        .hue_steps
        .iter()
        .map(|s| format!("{:.2} for {:.2} at {:+}", s.candidate, s.reference, s.stops))
        .collect();
    let _ = writeln!(text, "  largest step per half degree of hue, table for film: {}", steps.join(", "));
    text
}

/// Mean and maximum of the bands up to +6 stops: the law of the prototypes.
pub(crate) fn to_six_stops(certificate: &Certificate) -> (f64, f64) {
    let bands = || certificate.bands.iter().filter(|band| band.stops[1] <= 6.0).map(|band| &band.deviation);
    let count: usize = bands().map(|d| d.count).sum();
    let sum: f64 = bands().map(|d| d.mean * d.count as f64).sum();
    (sum / count.max(1) as f64, bands().map(|d| d.max).fold(0.0, f64::max))
}
