//! How far what the card makes lies from the film.

use onelight::Reference;
use onelight::lut::SceneSampler;
use onelight_gpu::wgpu::TextureFormat;
use onelight_gpu::{FilmPass, Form, Headless, LookSettings};
use rayon::prelude::*;

use super::card::Card;
use crate::error::Result;

/// Colours that are compared, as a picture.
const SIZE: [u32; 2] = [256, 256];
/// Their exposures, stops about mid grey.
const STOPS: (f64, f64) = (-10.0, 10.0);

/// CIEDE2000, in the mean and at most.
#[derive(Clone, Copy)]
pub(super) struct Difference {
    pub(super) mean: f64,
    pub(super) max: f64,
}

/// Between the film and a form on the card, before rounding to a format.
pub(super) fn difference(card: &Card, film: &Reference, form: Form<'_>, settings: &LookSettings) -> Result<Difference> {
    let colours: Vec<[f64; 3]> =
        SceneSampler::new(STOPS.0..=STOPS.1)?.take((SIZE[0] * SIZE[1]) as usize).map(|rgb| rgb.map(to_f32)).collect();
    let pass = FilmPass::with_settings(&card.gpu.device, &card.gpu.queue, form, TextureFormat::Rgba32Float, settings)?;
    let found = developed(&card.gpu, &pass, &colours)?;
    let between = film.difference()?;
    let differences: Vec<f64> = colours
        .par_iter()
        .zip(&found)
        .map(|(&rgb, &found)| between.between(film.develop_linear(rgb), film.coding().decode_rgb(found)))
        .collect();
    let mean = differences.iter().sum::<f64>() / differences.len() as f64;
    Ok(Difference { mean, max: differences.into_iter().fold(0.0, f64::max) })
}

fn to_f32(v: f64) -> f64 {
    f64::from(v as f32)
}

/// Colours through a pass that writes 32-bit floats.
fn developed(gpu: &Headless, pass: &FilmPass, colours: &[[f64; 3]]) -> Result<Vec<[f64; 3]>> {
    let bytes: Vec<u8> =
        colours.iter().flat_map(|&[r, g, b]| [r, g, b, 1.0]).flat_map(|v| (v as f32).to_ne_bytes()).collect();
    let bytes = gpu.develop(pass, &gpu.upload(SIZE, TextureFormat::Rgba32Float, &bytes)?)?;
    let float = |bytes: &[u8]| f64::from(bytes.try_into().map_or(f32::NAN, f32::from_ne_bytes));
    Ok(bytes.chunks_exact(16).map(|p| [float(&p[0..4]), float(&p[4..8]), float(&p[8..12])]).collect())
}
