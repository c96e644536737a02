//! Offset and range of the plain form's shaper, fitted to a look or to a scene.

use onelight_lut::{DirectForm, Interpolation, PlainLut, SceneSampler, Shaper, bake_form};
use onelight_spectra::{DisplayDifference, ciede2000};
use rayon::prelude::*;

use crate::direct::{DirectSettings, Nodes};
use crate::error::Error;
use crate::look::Look;
use crate::scene::MID_GREY;

/// What a shaper is fitted to.
pub(super) enum Fitted<'a> {
    /// Colours of all exposures and saturations: the look in general.
    Look {
        /// Where the range ends, in stops about mid grey; `None` tries several.
        stops: Option<f64>,
    },
    /// The colours of somebody's pictures, in the look's input space.
    Scene(&'a [[f64; 3]]),
}

/// Side of the trial tables: small, but with the error pattern of a full one.
const TRIAL_SIZE: usize = 12;
const TRIAL_COLOURS: usize = 1 << 10;
/// Colours of a look to fit to, in stops about mid grey; the upper end is that of the widest range.
const STOPS: (f64, f64) = (-10.0, 10.0);
/// Ends of the range that are tried for a look: wider ones cost nodes, narrower ones clip colours that still change.
const RANGES: [f64; 3] = [6.0, 8.0, 10.0];
/// log2 of the smallest and largest offset.
const OFFSETS: (f64, f64) = (-11.0, -2.0);
const STEPS: usize = 6;

/// Primaries and secondaries of a brightness: what a range that ends too early gets most wrong.
fn corners(peak: f64) -> impl Iterator<Item = [f64; 3]> {
    (1..7usize).map(move |bits| std::array::from_fn(|c| if bits >> c & 1 == 1 { peak } else { 0.0 }))
}

/// The shaper whose table comes nearest to the look.
pub(super) fn fitted_to(look: &Look, target: &Fitted) -> Result<Shaper, Error> {
    let (colours, ranges): (Vec<[f64; 3]>, Vec<f64>) = match target {
        Fitted::Look { stops } => {
            let ranges = stops.map_or(RANGES.to_vec(), |stops| vec![stops]);
            let last = ranges.iter().copied().fold(STOPS.0, f64::max);
            let mut colours: Vec<[f64; 3]> = SceneSampler::new(STOPS.0..=last)?.take(TRIAL_COLOURS).collect();
            colours.extend(corners(MID_GREY * last.exp2()));
            (colours, ranges.iter().map(|stops| MID_GREY * stops.exp2()).collect())
        }
        Fitted::Scene(colours) => {
            let brightest = colours.iter().flatten().copied().fold(MID_GREY, f64::max);
            let every = colours.len().div_ceil(TRIAL_COLOURS);
            (colours.iter().step_by(every).copied().collect(), vec![brightest])
        }
    };
    let trial = Trial::new(look, &colours)?;
    let tried: Vec<Result<(f64, f64), Error>> =
        ranges.par_iter().map(|&max| golden(|exponent| trial.error(exponent, max))).collect();
    let mut best: Option<(f64, Shaper)> = None;
    for (max, tried) in ranges.into_iter().zip(tried) {
        let (error, exponent) = tried?;
        if best.as_ref().is_none_or(|(least, _)| error < *least) {
            best = Some((error, shaper(exponent, max)?));
        }
    }
    match best {
        Some((_, shaper)) => Ok(shaper),
        None => Ok(Shaper::gotanda()),
    }
}

fn shaper(exponent: f64, max: f64) -> Result<Shaper, Error> {
    Ok(Shaper::log2(exponent.exp2(), max)?)
}

/// Least value of `f` over [`OFFSETS`] and where it is, by golden section.
fn golden(f: impl Fn(f64) -> Result<f64, Error>) -> Result<(f64, f64), Error> {
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    let (mut low, mut high) = OFFSETS;
    let (mut a, mut b) = (high - ratio * (high - low), low + ratio * (high - low));
    let (mut error_a, mut error_b) = (f(a)?, f(b)?);
    for _ in 0..STEPS {
        if error_a <= error_b {
            (high, b, error_b) = (b, a, error_a);
            a = high - ratio * (high - low);
            error_a = f(a)?;
        } else {
            (low, a, error_a) = (a, b, error_b);
            b = low + ratio * (high - low);
            error_b = f(b)?;
        }
    }
    Ok(if error_a <= error_b { (error_a, a) } else { (error_b, b) })
}

/// Colours and what the look makes of them.
struct Trial<'a> {
    look: &'a Look,
    /// Stands for a film: what it misses is small beside what the tables do.
    baking: Option<DirectForm>,
    difference: DisplayDifference,
    /// Scene-linear, and what the look makes of it in CIELAB.
    pairs: Vec<([f32; 3], [f64; 3])>,
}

impl<'a> Trial<'a> {
    fn new(look: &'a Look, colours: &[[f64; 3]]) -> Result<Self, Error> {
        let baking = match look {
            // Forms code by powers alone: the exact look stands for itself.
            Look::Film(film) if film.coding().curve.is_hdr() => None,
            Look::Film(film) => Some(film.direct(&DirectSettings { nodes: Nodes::Grid { step_nm: 10 } })?),
            Look::Print(_) | Look::First(_) | Look::Tone(_) => None,
        };
        let difference = look.difference()?;
        let pairs = colours.par_iter().map(|&rgb| {
            let single = rgb.map(|v| v as f32);
            let linear = match &baking {
                Some(form) => look.coding().decode_rgb(form.apply(single).map(f64::from)),
                None => look.develop_linear(rgb),
            };
            (single, difference.lab(linear))
        });
        let pairs = pairs.collect();
        Ok(Self { look, baking, difference, pairs })
    }

    /// Mean difference of a small table, and a hundredth of the largest: clipped colours are few.
    fn error(&self, exponent: f64, max: f64) -> Result<f64, Error> {
        let shaper = shaper(exponent, max)?;
        let at = |t: [f64; 3]| t.map(|t| shaper.decode(t));
        let table = match &self.baking {
            Some(form) => bake_form(TRIAL_SIZE, at, form)?,
            None => self.look.bake(TRIAL_SIZE, at)?,
        };
        let lut = PlainLut::new(shaper, table, Interpolation::Tetrahedral);
        let coding = self.look.coding();
        let read = |rgb: [f32; 3]| self.difference.lab(coding.decode_rgb(lut.apply(rgb).map(f64::from)));
        let all: Vec<f64> = self.pairs.par_iter().map(|(rgb, exact)| ciede2000(*exact, read(*rgb))).collect();
        Ok(all.iter().sum::<f64>() / all.len() as f64 + all.iter().copied().fold(0.0, f64::max) / 100.0)
    }
}
