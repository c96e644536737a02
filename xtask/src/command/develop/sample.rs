//! What a fast form and a wide gamut do to this picture, told from some of its pixels.

use anyhow::Result;
use onelight::{Look, Process, WideGamut};
use onelight_picture::Band;
use rayon::prelude::*;

use super::film::Film;
use crate::look::ChosenLook;

/// Pixels that are compared, evenly spread over the picture: a hundredth of a second through the exact film.
const PIXELS: u64 = 1000;

/// Some of a picture's pixels as the film gets them, and how many of all have light outside the sRGB primaries.
pub(super) struct Sample<'a> {
    film: &'a Film,
    width: usize,
    all: u64,
    /// The next pixel to keep, of [`PIXELS`].
    next: u64,
    kept: Vec<[f32; 3]>,
    /// Counted for films that compress such light.
    outside: u64,
}

/// A colour difference, CIEDE2000.
#[derive(Debug, Clone, Copy, Default)]
struct Difference {
    mean: f64,
    max: f64,
}

impl<'a> Sample<'a> {
    /// Of a picture of this size.
    pub(super) fn new(film: &'a Film, width: usize, height: usize) -> Self {
        Self { film, width, all: (width * height) as u64, next: 0, kept: Vec::new(), outside: 0 }
    }

    /// Looks at a band of scene light before the film gets it.
    pub(super) fn look_at(&mut self, band: &Band) {
        let first = (band.top() * self.width) as u64;
        let pixels = band.rgb();
        loop {
            // The middle of each of as many equal parts.
            let at = ((2 * self.next + 1) * self.all) / (2 * PIXELS.min(self.all.max(1)));
            let Some(rgb) = at.checked_sub(first).and_then(|i| pixels.get(usize::try_from(i).ok()?)) else { break };
            self.kept.push(*rgb);
            self.next += 1;
        }
        if let Some(film) = self.film.compressing() {
            let rows = pixels.par_chunks(self.width.max(1));
            let outside = |rgb: &&[f32; 3]| film.is_outside_srgb(rgb.map(f64::from));
            self.outside += rows.map(|row| row.iter().filter(outside).count() as u64).sum::<u64>();
        }
    }

    /// A sentence for each thing there is to say.
    pub(super) fn notes(&self, look: &ChosenLook) -> Result<Vec<String>> {
        let mut notes = Vec::new();
        if let Some(miss) = self.film.baked().map(|baked| self.miss(|rgb| baked.apply(rgb))).transpose()? {
            notes.push(format!(
                "the {} form is within {} of the exact film on {} pixels of this picture (--form reference is exact)",
                self.film.form_word(),
                miss,
                self.kept.len()
            ));
        }
        if self.outside > 0 {
            notes.push(self.wide_gamut(look)?);
        }
        Ok(notes)
    }

    /// How far a map to display-coded colours lies from the exact look.
    fn miss(&self, map: impl Fn([f32; 3]) -> [f32; 3] + Sync) -> Result<Difference> {
        let exact = self.film.exact();
        let difference = exact.difference()?;
        let linear = |coded: [f32; 3]| coded.map(|v| exact.coding().decode(f64::from(v)));
        Ok(Difference::of(&self.kept, |rgb| {
            difference.between(exact.develop_linear(rgb.map(f64::from)), linear(map(rgb)))
        }))
    }

    fn wide_gamut(&self, look: &ChosenLook) -> Result<String> {
        let share = format!(
            "{:.2} % of the pixels hold light outside the sRGB primaries, which --gamut compress keeps apart",
            100.0 * self.outside as f64 / self.all as f64
        );
        let outside: Vec<[f32; 3]> = {
            let film = self.film.compressing();
            let is_outside = |rgb: &[f32; 3]| film.is_some_and(|film| film.is_outside_srgb(rgb.map(f64::from)));
            self.kept.iter().copied().filter(is_outside).collect()
        };
        let Some(clipped) = clipped(look)? else { return Ok(share) };
        if outside.is_empty() {
            return Ok(share);
        }
        let (exact, difference) = (self.film.exact(), self.film.exact().difference()?);
        let moved = Difference::of(&outside, |rgb| {
            let rgb = rgb.map(f64::from);
            difference.between(exact.develop_linear(rgb), clipped.develop_linear(rgb))
        });
        Ok(format!("{share}: {moved} from --gamut clip on {} of {} pixels", outside.len(), self.kept.len()))
    }
}

/// The same look with light outside the sRGB primaries clipped.
fn clipped(look: &ChosenLook) -> Result<Option<Look>> {
    let Process::Film(film) = &look.process else { return Ok(None) };
    let mut film = film.clone();
    film.gamut = WideGamut::Clip;
    look.with(film.into()).look().map(Some)
}

impl Difference {
    fn of(colours: &[[f32; 3]], difference: impl Fn([f32; 3]) -> f64 + Sync) -> Self {
        // In order, so that the sum is the same on any number of threads.
        let all: Vec<f64> = colours.par_iter().map(|rgb| difference(*rgb)).collect();
        Self { mean: all.iter().sum::<f64>() / all.len().max(1) as f64, max: all.iter().copied().fold(0.0, f64::max) }
    }
}

impl std::fmt::Display for Difference {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:.3} CIEDE2000 in the mean and {:.3} at most", self.mean, self.max)
    }
}
