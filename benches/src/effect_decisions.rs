//! Whether `auto` leaves out what can be seen, or runs what cannot: its decisions beside the effects themselves.

use onelight::baked::{Baked, Form, Recipe};
use onelight::spatial::{
    Antihalation, Effect, FilmFormat, FirstPass, Frame, Halation, HalationSettings, Sharpness, Verdict,
};
use onelight::spectra::DisplayLinear;
use onelight::{EffectChoice, Effects, FilmEffects, FilmProcess, FilmSteps, Look, stock};
use rayon::prelude::*;
use serde::Serialize;

use crate::error::{Error, Result};
use crate::picture::natural;
use crate::progress::{OnProgress, Steps};

const CAMERAS: [&str; 2] = ["kodak-5207", "kodak-5219"];
/// The format, and pixels across it, of which the pictures are a part.
const FRAMES: [(FilmFormat, usize); 4] =
    [(FilmFormat::Film65, 2048), (FilmFormat::Super35, 1024), (FilmFormat::Super35, 2048), (FilmFormat::Super35, 4096)];
/// Stops that the scenes are brighter.
const EXPOSURES: [f32; 3] = [0.0, 3.0, 6.0];
/// For sharpness: pixels to either side over which the scene is blurred, as by a lens.
const SOFT: [usize; 3] = [0, 2, 6];
/// For halation: density of the antihalation layer.
const LAYERS: [f64; 2] = [1.0, 0.6];
/// Below these an effect counts as not seen: 99 of 100 pixels, and all of them. They are the limits that `auto` states.
const LEAST: [f64; 2] = [0.35, 0.5];

/// Which pictures are looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cases {
    /// All films, formats, exposures and layers: 144 cases of sharpness, 96 of halation.
    All,
    /// A few, on small pictures.
    Few,
}

/// One effect on one picture.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DecisionCase {
    /// `kodak-5219, super35 2048, scene +3, soft 2`
    pub name: String,
    /// What `auto` says of it.
    pub said: String,
    /// Whether it is run.
    pub is_run: bool,
    /// What the effect changes in truth, CIEDE2000: the 99th percentile for sharpness, the largest for halation.
    pub truth: f64,
}

/// All cases of one effect.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DecisionSummary {
    /// `sharpness` or `halation`.
    pub effect: String,
    /// The difference below which it counts as not seen.
    pub limit: f64,
    /// Every case.
    pub cases: Vec<DecisionCase>,
}

impl DecisionSummary {
    /// Cases that are left out.
    pub fn left_out(&self) -> usize {
        self.cases.iter().filter(|case| !case.is_run).count()
    }

    /// Differences in truth of cases that are left out and could be seen.
    pub fn missed(&self) -> Vec<f64> {
        self.cases.iter().filter(|case| !case.is_run && case.truth >= self.limit).map(|case| case.truth).collect()
    }

    /// Differences in truth of cases that are run and cannot be seen.
    pub fn needless(&self) -> Vec<f64> {
        self.cases.iter().filter(|case| case.is_run && case.truth < self.limit).map(|case| case.truth).collect()
    }
}

/// A picture of scene light.
struct Scene {
    name: &'static str,
    size: [usize; 2],
    linear: Vec<[f32; 3]>,
}

impl Scene {
    /// So many stops brighter, each pixel the mean of those up to `soft` away along rows and columns.
    fn changed(&self, stops: f32, soft: usize) -> Vec<[f32; 3]> {
        let [width, height] = self.size;
        let mean = |at: &dyn Fn(usize) -> [f32; 3], i: usize, count: usize| {
            let near = i.saturating_sub(soft)..(i + soft + 1).min(count);
            let sum = near.clone().map(at).fold([0.0; 3], |sum, rgb| std::array::from_fn(|k| sum[k] + rgb[k]));
            sum.map(|v: f32| v / near.len() as f32)
        };
        let along = |i: usize| mean(&|x| self.linear[i / width * width + x], i % width, width);
        let rows: Vec<[f32; 3]> = (0..self.linear.len()).into_par_iter().map(along).collect();
        let across = |i: usize| mean(&|y| rows[y * width + i % width], i / width, height);
        (0..rows.len()).into_par_iter().map(|i| across(i).map(|v| v * stops.exp2())).collect()
    }
}

fn scenes(size: [usize; 2]) -> Result<[Scene; 2]> {
    let camera = natural(size).as_chunks::<4>().0.iter().map(|[r, g, b, _]| [*r, *g, *b]).collect();
    let scene = onelight_fixtures::scene_rgb((size[0], size[1]))?;
    Ok([Scene { name: "scene", size, linear: scene }, Scene { name: "camera", size, linear: camera }])
}

/// A film with its direct form.
struct Film {
    camera: &'static str,
    look: Look,
    baked: Baked,
}

impl Film {
    fn new(camera: &'static str) -> Result<Self> {
        let look = Look::Film(FilmProcess::for_camera(camera)?.compile()?);
        let baked = look.baked(&Recipe::of(Form::Direct))?;
        Ok(Self { camera, look, baked })
    }

    fn steps(&self) -> Result<FilmSteps<'_>> {
        Ok(FilmSteps::of(&self.look, Some(&self.baked))?)
    }

    /// Differences that an effect makes in truth, in rising order.
    fn truth(&self, effects: Effects, frame: Frame, linear: &[[f32; 3]]) -> Result<Vec<f64>> {
        let shown = |effects: Effects| -> Result<Vec<[f32; 3]>> {
            let process = FilmProcess { effects, ..FilmProcess::for_camera(self.camera)? };
            let effects = FilmEffects::new(&process)?.ok_or_else(|| Error::new("effects without a film format"))?;
            Ok(effects.develop(self.steps()?, frame, linear)?.0)
        };
        let off = EffectChoice::Off;
        let (with, without) = (
            shown(effects)?,
            shown(Effects { sharpness: off, halation: off, antihalation: Antihalation::default(), ..effects })?,
        );
        let (film, coding) = (self.look.film()?.difference()?, self.look.coding());
        let light = |rgb: &[f32; 3]| -> DisplayLinear { coding.decode_rgb(rgb.map(f64::from)) };
        let between = |(a, b): (&[f32; 3], &[f32; 3])| if a == b { 0.0 } else { film.between(light(a), light(b)) };
        let mut all: Vec<f64> = with.par_iter().zip(&without).map(between).collect();
        all.par_sort_unstable_by(f64::total_cmp);
        Ok(all)
    }

    /// What a look at the picture comes to.
    fn decided(
        &self,
        pass: FirstPass,
        frame: Frame,
        linear: &[[f32; 3]],
    ) -> Result<onelight::spatial::FirstPassResult> {
        let (mut pass, steps) = (pass, self.steps()?);
        let (planes, rows) = pass.add(frame.height())?;
        let linear = linear.par_chunks(frame.width());
        planes.par_rows_mut(rows).zip(linear).for_each(|(layers, linear)| steps.expose(linear, layers));
        pass.look(&steps, &steps)?;
        Ok(pass.finish(&steps, &steps)?)
    }
}

/// Sharpness and halation on every case; progress is told.
///
/// # Errors
/// If a film does not compile: built-in ones do.
pub fn decisions(cases: Cases, progress: OnProgress<'_>) -> Result<[DecisionSummary; 2]> {
    let (cameras, frames, exposures, size) = match cases {
        Cases::All => (&CAMERAS[..], &FRAMES[..], &EXPOSURES[..], [1024, 576]),
        Cases::Few => (&CAMERAS[1..], &FRAMES[1..3], &EXPOSURES[1..2], [256, 144]),
    };
    let scenes = scenes(size)?;
    let films: Vec<Film> = cameras.iter().map(|camera| Film::new(camera)).collect::<Result<_>>()?;
    let steps = Steps::new("what auto leaves out", (films.len() * frames.len()) as u64, progress);
    let (mut sharp, mut halos) = (Vec::new(), Vec::new());
    for film in &films {
        let sheet = Sharpness::of_stock(&stock(film.camera)?)?;
        for (format, width) in frames {
            let frame = Frame::new(size, format.pitch(*width, 1.0)?)?;
            let none = Effects {
                film_format: Some(*format),
                grain: EffectChoice::Off,
                sharpness: EffectChoice::Off,
                ..Effects::default()
            };
            for (scene, &stops) in scenes.iter().flat_map(|scene| exposures.iter().map(move |stops| (scene, stops))) {
                let name = format!("{}, {format} {width}, {} {stops:+}", film.camera, scene.name);
                for soft in SOFT {
                    let linear = scene.changed(stops, soft);
                    let seen =
                        film.decided(FirstPass::new(frame).looking_for_sharpness(&sheet), frame, &linear)?.sharpness;
                    let all = film.truth(Effects { sharpness: EffectChoice::On, ..none }, frame, &linear)?;
                    sharp.extend(seen.map(|seen| DecisionCase {
                        name: format!("{name}, soft {soft}"),
                        said: seen.to_string(),
                        is_run: seen.verdict() == Verdict::Visible,
                        truth: all[(all.len() - 1) * 99 / 100],
                    }));
                }
                let linear = scene.changed(stops, 0);
                for density in LAYERS {
                    let antihalation = Antihalation::Density(density);
                    let halation = Halation::new(HalationSettings { antihalation, ..HalationSettings::default() })?;
                    let pass = FirstPass::new(frame).looking_for_halation(&halation)?;
                    let seen = film.decided(pass, frame, &linear)?.halation;
                    let all =
                        film.truth(Effects { halation: EffectChoice::On, antihalation, ..none }, frame, &linear)?;
                    halos.extend(seen.map(|seen| DecisionCase {
                        name: format!("{name}, layer {density}"),
                        said: seen.to_string(),
                        is_run: seen.verdict() == Verdict::Visible,
                        truth: all[all.len() - 1],
                    }));
                }
            }
            steps.step();
        }
    }
    let summary = |effect: Effect, limit, cases| DecisionSummary { effect: effect.to_string(), limit, cases };
    Ok([summary(Effect::Sharpness, LEAST[0], sharp), summary(Effect::Halation, LEAST[1], halos)])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sample of the picture stands for it: what it leaves out may change a hundredth of the pixels by half as much again as what
    /// counts as seen, what it runs is at least half of that.
    fn near_the_truth(cases: Cases) -> [DecisionSummary; 2] {
        let found = decisions(cases, &|_| {}).unwrap();
        for summary in &found {
            for case in &summary.cases {
                let (low, high) = (0.5 * summary.limit, 1.5 * summary.limit);
                assert!(if case.is_run { case.truth > low } else { case.truth < high }, "{case:?}");
            }
        }
        found
    }

    #[test]
    fn decisions_are_near_the_truth() {
        let [sharpness, halation] = near_the_truth(Cases::Few);
        assert_eq!([sharpness.cases.len(), halation.cases.len()], [12, 8]);
        assert!((1..8).contains(&halation.left_out()), "{halation:?}");
    }

    #[test]
    #[ignore = "minutes, in a release build seconds: `cargo test --release -p onelight-benches -- --ignored decisions`"]
    fn all_decisions_are_near_the_truth() {
        for summary in near_the_truth(Cases::All) {
            let (missed, needless) = (summary.missed(), summary.needless());
            println!(
                "{}: {} cases, {} left out, missed {missed:?}, needless {needless:?}",
                summary.effect,
                summary.cases.len(),
                summary.left_out()
            );
            assert!(summary.cases.len() >= 60 && (1..summary.cases.len()).contains(&summary.left_out()));
        }
    }
}
