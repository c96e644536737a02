//! Colours that the sums of a direct form are fitted to, and how far a miss of each can be seen.

use nalgebra::{Matrix3, Vector3};
use onelight_film::{AmountCurve, DyeAmount, LogExposure, PerLayer, WideGamut};
use onelight_lut::{DirectForm, SceneSampler};
use onelight_spectra::{Chromaticity, DisplayDifference, DisplayLinear, ciede2000};
use rayon::prelude::*;

use super::sum::Sum;
use crate::error::Error;
use crate::reference::Reference;
use crate::scene::multiply;
use crate::structured::towards_the_edge;
use crate::word::WorkingSpace;

/// One value that a sum should take.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    pub(super) at: Vector3<f64>,
    pub(super) target: Vector3<f64>,
    /// A miss times this has the length of the colour difference that it makes.
    pub(super) seen: Matrix3<f64>,
}

/// The samples of both stages.
pub(super) struct Training {
    /// Print exposure over dye in the negative.
    pub(super) duplication: Option<Vec<Sample>>,
    /// Linear RGB over dye in the film on the screen.
    pub(super) projection: Vec<Sample>,
}

/// Exposures of the colours, in stops about mid grey: until every layer of every film is clear or full.
const STOPS: (f64, f64) = (-10.0, 14.0);
/// Colours that each stage is fitted to.
const COUNT: usize = 1024;
/// Colours that a fit is judged by.
const JUDGES: usize = 4096;
/// One more for so many of these is drawn from Rec.2020: light outside the sRGB primaries leaves layers so little exposure that
/// their dyes come in amounts of which no light inside makes any.
const WIDE_SHARE: usize = 4;
const SEED: u64 = 0x666d_6469_7231_3031;
/// Difference that a miss of a whole print exposure counts for where the print hardly responds: keeps sums from falling to 0.
const LEAST_SEEN: f64 = 3.0;
/// How far outside the display's range a channel halves what is seen of it.
const OUTSIDE: f64 = 0.003;

impl Training {
    pub(super) fn new(film: &Reference) -> Result<Self, Error> {
        Self::of(film, COUNT)
    }

    /// More colours, none of which is fitted to: what a fit misses of them says how far it lies from the film.
    pub(super) fn judges(film: &Reference) -> Result<Self, Error> {
        Self::drawn(film, JUDGES, SEED + 2)
    }

    pub(super) fn of(film: &Reference, count: usize) -> Result<Self, Error> {
        Self::drawn(film, count, SEED)
    }

    fn drawn(film: &Reference, count: usize, seed: u64) -> Result<Self, Error> {
        let mut drawn = edged(seed, count)?;
        if film.exposure_matrix().gamut() == WideGamut::Compress {
            let white = Chromaticity::black_body_6500_k();
            let to_srgb = WorkingSpace::Rec2020.space().to_about(&WorkingSpace::Srgb.space(), white)?;
            drawn.extend(edged(seed + 1, count / WIDE_SHARE)?.into_iter().map(|rgb| multiply(&to_srgb, rgb)));
        }
        let difference = film.difference()?;
        let projection = Sum::shown(film);
        let duplication = Sum::behind(film).zip(film.curves_behind());
        let samples: Vec<(Option<Sample>, Sample)> = drawn
            .into_par_iter()
            .map(|rgb| {
                let exposure = film.exposure_matrix().expose(rgb).map(LogExposure::of);
                let camera = vector(film.camera_amounts(exposure));
                let Some((sum, curves)) = &duplication else {
                    let target = projection.at(&camera);
                    return (None, Sample { at: camera, target, seen: seen(&difference, target) });
                };
                let exposure = sum.at(&camera);
                let (amounts, response) = respond(curves, exposure);
                let target = projection.at(&amounts);
                let seen = seen(&difference, target);
                let relative = Matrix3::from_diagonal(&exposure.map(|e| 1.0 / e));
                let first = Sample {
                    at: camera,
                    target: exposure,
                    seen: at_least(seen * projection.slope_at(&amounts) * response) * relative,
                };
                (Some(first), Sample { at: amounts, target, seen })
            })
            .collect();
        let (first, last): (Vec<Option<Sample>>, Vec<Sample>) = samples.into_iter().unzip();
        Ok(Self { duplication: first.into_iter().collect(), projection: last })
    }
}

/// Colours within primaries, some of them on their edge.
fn edged(seed: u64, count: usize) -> Result<Vec<[f64; 3]>, Error> {
    let drawn = SceneSampler::with_seed(STOPS.0..=STOPS.1, seed)?.take(count).enumerate();
    Ok(drawn.map(|(i, rgb)| towards_the_edge(2 * i, rgb)).collect())
}

/// Colours with what the film makes of them: to try forms on that were not fitted.
pub(super) struct Probes<'a> {
    film: &'a Reference,
    difference: DisplayDifference,
    /// In the film's input space.
    colours: Vec<([f32; 3], DisplayLinear)>,
}

const PROBES: usize = 256;

impl<'a> Probes<'a> {
    pub(super) fn new(film: &'a Reference) -> Result<Self, Error> {
        let drawn: Vec<[f64; 3]> = SceneSampler::with_seed(STOPS.0..=STOPS.1, !SEED)?.take(PROBES).collect();
        let colours = drawn.into_par_iter().enumerate().map(|(i, rgb)| {
            let input = film.input_of_srgb(towards_the_edge(i, rgb)).map(|v| v as f32);
            (input, film.develop_linear(input.map(f64::from)))
        });
        Ok(Self { film, difference: film.difference()?, colours: colours.collect() })
    }

    pub(super) fn largest_miss(&self, direct: &DirectForm) -> f64 {
        let misses = self.colours.par_iter().map(|&(rgb, exact)| {
            self.difference.between(exact, self.film.coding().decode_rgb(direct.apply(rgb).map(f64::from)))
        });
        misses.reduce(|| 0.0, f64::max)
    }
}

fn vector(amounts: PerLayer<DyeAmount>) -> Vector3<f64> {
    Vector3::from(amounts.map(|a| a.0).to_array())
}

/// Dye of a print, and what each layer adds for a relative rise of its exposure.
fn respond(curves: &PerLayer<&AmountCurve>, exposure: Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    const STEP: f64 = 1e-3;
    let h = PerLayer::from(<[f64; 3]>::from(exposure)).map(LogExposure::of);
    let at = |offset: f64| vector(curves.zip_map(h, |curve, h| curve.amount(LogExposure(h.0 + offset))));
    let slope = (at(STEP) - at(-STEP)) / (2.0 * STEP * std::f64::consts::LN_10);
    (at(0.0), Matrix3::from_diagonal(&slope))
}

/// The same lengths, or a little more, with no direction left out: the root of `m^T m + LEAST_SEEN^2`.
fn at_least(m: Matrix3<f64>) -> Matrix3<f64> {
    let square = m.transpose() * m + Matrix3::identity() * LEAST_SEEN.powi(2);
    square.cholesky().map_or(m, |root| root.l().transpose())
}

/// The matrix that turns small misses of a linear RGB into vectors as long as the difference that is seen.
fn seen(difference: &DisplayDifference, rgb: Vector3<f64>) -> Matrix3<f64> {
    const STEP: f64 = 1e-5;
    let inside = rgb.map(|v| v.clamp(STEP, 1.0 - STEP));
    let lab = |rgb: Vector3<f64>| Vector3::from(difference.lab(DisplayLinear(rgb.into())));
    let slope = |k: usize| {
        let mut step = Vector3::zeros();
        step[k] = STEP;
        (lab(inside + step) - lab(inside - step)) / (2.0 * STEP) / (1.0 + (rgb[k] - inside[k]).abs() / OUTSIDE)
    };
    let slopes = Matrix3::from_columns(&[slope(0), slope(1), slope(2)]);
    // Where rounding leaves no positive form, CIELAB's own distance serves: weights of a fit need not be exact.
    let root = local(lab(inside)).cholesky().map_or_else(Matrix3::identity, |root| root.l().transpose());
    root * slopes
}

/// CIEDE2000 near one colour as a quadratic form.
fn local(lab: Vector3<f64>) -> Matrix3<f64> {
    const STEP: f64 = 1e-3;
    let square = |step: Vector3<f64>| (ciede2000(lab.into(), (lab + step * STEP).into()) / STEP).powi(2);
    let unit = |k: usize| Vector3::ith_axis(k).into_inner();
    let form = |i: usize, k: usize| 0.25 * (square(unit(i) + unit(k)) - square(unit(i) - unit(k)));
    Matrix3::from_fn(form)
}
