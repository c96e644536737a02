//! Shots of a sheet developed, and measured against each other.

use std::collections::HashMap;
use std::sync::Arc;

use anyhow::{Context, Result};
use onelight::baked::{Form, Recipe};
use onelight::spatial::Frame as FilmFrame;
use onelight::spectra::{DisplayDifference, DisplayLinear, RgbSpace};
use onelight::{FilmEffects, FilmSteps, Films, Look, ProcessKeys, TransferCurve};
use onelight_charts::mean_p95_max;
use rayon::prelude::*;

use super::frame::{Frame, OnFilm};
use super::plan::Shot;

/// A frame's colours developed, display-linear sRGB; or why they are not.
pub(super) type Developed = Result<Arc<Vec<[f32; 3]>>, String>;

/// Looks and pictures made so far.
#[derive(Default)]
pub(super) struct Darkroom {
    /// The stocks of the look that names data sheets of the user's.
    films: Option<Arc<Films>>,
    looks: HashMap<String, Result<Arc<Look>, String>>,
    pictures: HashMap<(String, i32), Developed>,
}

impl Darkroom {
    pub(super) fn new(films: Option<Arc<Films>>) -> Self {
        Self { films, ..Self::default() }
    }

    /// Pictures of another frame are of no use.
    pub(super) fn change_frame(&mut self) {
        self.pictures.clear();
    }

    /// A look, compiled once.
    pub(super) fn look(&mut self, keys: &ProcessKeys) -> Result<Arc<Look>, String> {
        let key = keys.to_toml();
        self.looks
            .entry(key)
            .or_insert_with(|| {
                let own = keys.camera_sheet().or(keys.print_sheet()).and(self.films.as_ref());
                let look = match own {
                    Some(films) => keys.process_with(films).and_then(|process| process.look_with(films)),
                    None => keys.process().and_then(|process| process.look()),
                };
                look.map(Arc::new).map_err(|error| error.to_string())
            })
            .clone()
    }

    /// A shot of a frame, developed once.
    pub(super) fn develop(&mut self, frame: &Frame, shot: &Shot) -> Developed {
        let key = (shot.keys.to_toml(), shot.ev);
        if let Some(developed) = self.pictures.get(&key) {
            return developed.clone();
        }
        let developed = self.look(&shot.keys).and_then(|look| match &frame.on_film {
            Some(part) => on_film(&shot.keys, &look, part).map(Arc::new).map_err(|error| error.to_string()),
            None => Ok(Arc::new(picture(&look, frame, shot.ev))),
        });
        self.pictures.insert(key, developed.clone());
        developed
    }
}

/// The exact look of every colour.
fn picture(look: &Look, frame: &Frame, ev: i32) -> Vec<[f32; 3]> {
    let scale = f64::from(ev).exp2();
    let develop = |rgb: &[f32; 3]| look.develop_linear(rgb.map(|v| f64::from(v) * scale)).map(|v| v as f32);
    frame.colours.par_iter().map(develop).collect()
}

/// A part of a picture as its place on the film makes it, by the direct form.
fn on_film(keys: &ProcessKeys, look: &Look, part: &OnFilm) -> Result<Vec<[f32; 3]>> {
    let process = keys.process()?;
    let effects = FilmEffects::new(process.film()?)?.context("a look without a film format has no effects to show")?;
    let baked = look.baked(&Recipe::of(Form::Direct))?;
    let frame = FilmFrame::new(part.size, effects.pitch(part.frame_width, 1.0)?)?.at(part.offset);
    let (shown, _) = effects.develop(FilmSteps::of(look, Some(&baked))?, frame, &part.rgb)?;
    let linear = |rgb: [f32; 3]| rgb.map(|v| TransferCurve::Srgb.decode(f64::from(v)) as f32);
    Ok(part.middle(&shown).map(linear).collect())
}

/// Display-linear sRGB to display-coded.
pub(super) fn coded(linear: &[[f32; 3]]) -> Vec<[f32; 3]> {
    linear.iter().map(|rgb| rgb.map(|v| TransferCurve::Srgb.encode(f64::from(v)) as f32)).collect()
}

/// The difference of each colour of two pictures, CIEDE2000.
pub(super) fn differences(a: &[[f32; 3]], b: &[[f32; 3]]) -> Result<Vec<f32>> {
    let difference = DisplayDifference::new(&RgbSpace::SRGB)?;
    let shown = |rgb: &[f32; 3]| DisplayLinear(rgb.map(f64::from));
    let between = |(a, b)| difference.between(shown(a), shown(b)) as f32;
    Ok(a.par_iter().zip(b).map(between).collect())
}

/// What one look lies from another on the ColorChecker from -2 to +2 stops: the figures of docs/talk.md.
pub(super) fn on_chart(plain: &Look, turned: &Look, chart: &[[f64; 3]]) -> Result<[f64; 3]> {
    let difference = DisplayDifference::new(&RgbSpace::SRGB)?;
    let colours = (-2..=2).flat_map(|ev| chart.iter().map(move |rgb| rgb.map(|v| v * f64::from(ev).exp2())));
    let between = |rgb: [f64; 3]| difference.between(plain.develop_linear(rgb), turned.develop_linear(rgb)) as f32;
    Ok(mean_p95_max(&colours.map(between).collect::<Vec<f32>>()))
}
