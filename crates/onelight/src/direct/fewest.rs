//! The fewest exponentials that keep a promise.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use onelight_lut::{Certificate, DirectForm, Maps, Samples, SamplingLaw, Search, certify};
use onelight_spectra::DisplayLinear;

use super::fit::{fit, misses};
use super::settings::{Nodes, check_limit};
use super::stages::Stages;
use super::sum::Sum;
use super::training::{Sample, Training};
use crate::error::{Error, ErrorKind};
use crate::reference::Reference;

/// The sums of one stage by their number of terms, with the largest miss of each; made when they are asked for.
struct Fitted<'a> {
    full: &'a Sum,
    samples: &'a [Sample],
    found: BTreeMap<usize, (Sum, f64)>,
}

impl Fitted<'_> {
    fn with(&mut self, count: usize) -> &(Sum, f64) {
        self.found.entry(count).or_insert_with(|| {
            let sum = fit(self.full, self.samples, count);
            let most = misses(&sum, self.samples).into_iter().fold(0.0, f64::max);
            (sum, most)
        })
    }
}

pub(super) fn under(film: &Reference, stages: &Stages, limit: f64) -> Result<Stages, Error> {
    check_limit(limit)?;
    let training = Training::new(film)?;
    let measure = Measure::new(film)?;
    let mut projection = Fitted { full: &stages.projection, samples: &training.projection, found: BTreeMap::new() };
    let both = stages.duplication.as_ref().zip(training.duplication.as_deref());
    let mut duplication = both.map(|(full, samples)| Fitted { full, samples, found: BTreeMap::new() });
    let mut nearest = f64::INFINITY;
    let counts = 2..=Nodes::MAX_COUNT;
    let most = if duplication.is_some() { 2 * Nodes::MAX_COUNT } else { Nodes::MAX_COUNT };
    for all in 2..=most {
        let firsts = if duplication.is_some() { counts.clone() } else { 0..=0 };
        for first in firsts.filter(|first| all > *first && counts.contains(&(all - first))) {
            let (sum, miss) = match &mut duplication {
                Some(fitted) => {
                    let (sum, miss) = fitted.with(first);
                    (Some(sum.clone()), *miss)
                }
                None => (None, 0.0),
            };
            // Misses of colours that were fitted to: the certificate only finds more.
            if miss > limit {
                continue;
            }
            let (last, miss) = projection.with(all - first);
            if *miss > limit {
                continue;
            }
            let stages = Stages { duplication: sum, projection: last.clone() };
            let direct = film.direct_of(&stages)?;
            let quick = measure.certify(&direct, Search::SamplesOnly)?;
            nearest = nearest.min(quick.max_found);
            if quick.max_found <= limit && measure.certify(&direct, Search::Ascent)?.passed(limit) {
                return Ok(stages);
            }
        }
    }
    let expected = format!("a limit that {most} fitted exponentials keep (the nearest had a maximum of {nearest:.4})");
    Err(ErrorKind::Setting { what: "largest difference of a direct form".to_owned(), found: limit, expected }.into())
}

/// A film with what a certificate needs.
struct Measure<'a> {
    film: &'a Reference,
    samples: Samples,
    luminance: Vector3<f64>,
}

impl<'a> Measure<'a> {
    fn new(film: &'a Reference) -> Result<Self, Error> {
        // Colours of the law are in sRGB primaries.
        let exact = |rgb| *film.develop_linear(film.input_of_srgb(rgb));
        let samples = Samples::new(&SamplingLaw::default(), &[], exact, |_| {})?;
        Ok(Self { film, samples, luminance: film.spaces().luminance()? })
    }

    fn certify(&self, direct: &DirectForm, search: Search) -> Result<Certificate, Error> {
        let difference = self.film.difference()?;
        let input = |rgb: [f64; 3]| self.film.input_of_srgb(rgb);
        let maps = Maps {
            reference: |rgb| *self.film.develop_linear(input(rgb)),
            candidate: |rgb: [f64; 3]| {
                *self.film.coding().decode_rgb(direct.apply(input(rgb).map(|v| v as f32)).map(f64::from))
            },
            difference: |a: &[f64; 3], b: &[f64; 3]| difference.between(DisplayLinear(*a), DisplayLinear(*b)),
            luminance: |v: &[f64; 3]| self.luminance.dot(&Vector3::from(*v)),
        };
        Ok(certify(&self.samples, &maps, search, |_| {})?)
    }
}
