//! What a fast form and a wide gamut do to this picture, told from some of its pixels.

use anyhow::Result;
use onelight::{Reference, WideGamut};
use onelight_picture::Band;
use rayon::prelude::*;

use super::film::Film;

/// Pixels that are compared, evenly spread over the picture: a hundredth of a second through the exact film.
const PIXELS: u64 = 1000;

/// Some of a picture's pixels as the film gets them, and how many of all have light outside the sRGB primaries.
pub(super) struct Sample<'a> {
    film: &'a Film,
    /// Pixels of the picture, once a band was seen.
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
    /// Of a picture that this film will develop.
    pub(super) fn new(film: &'a Film) -> Self {
        Self { film, all: 0, next: 0, kept: Vec::new(), outside: 0 }
    }

    /// Looks at a band of scene light, of a picture of this size, before the film gets it.
    pub(super) fn look_at(&mut self, [width, height]: [usize; 2], band: &Band) {
        self.all = (width * height) as u64;
        let first = (band.top() * width) as u64;
        let pixels = band.rgb();
        loop {
            // The middle of each of as many equal parts.
            let at = ((2 * self.next + 1) * self.all) / (2 * PIXELS.min(self.all.max(1)));
            let Some(rgb) = at.checked_sub(first).and_then(|i| pixels.get(usize::try_from(i).ok()?)) else { break };
            self.kept.push(*rgb);
            self.next += 1;
        }
        if let Some(film) = self.film.compressing() {
            let rows = pixels.par_chunks(width.max(1));
            let outside = |rgb: &&[f32; 3]| film.is_outside_srgb(rgb.map(f64::from));
            self.outside += rows.map(|row| row.iter().filter(outside).count() as u64).sum::<u64>();
        }
    }

    /// A sentence for each thing there is to say.
    pub(super) fn notes(&self) -> Result<Vec<String>> {
        let mut notes = Vec::new();
        if let Some(miss) = self.film.baked().map(|baked| self.miss(|rgb| baked.apply(rgb))).transpose()? {
            notes.push(format!(
                "the {} form is within {} of the exact film on {} pixels of this picture (--form reference is exact)",
                self.film.form_word(),
                miss,
                self.kept.len()
            ));
        }
        if let Some(film) = self.film.compressing().filter(|_| self.outside > 0) {
            notes.push(self.wide_gamut(film)?);
        }
        Ok(notes)
    }

    /// How far a map to display-coded colours lies from the exact look.
    fn miss(&self, map: impl Fn([f32; 3]) -> [f32; 3] + Sync) -> Result<Difference> {
        let exact = self.film.exact();
        let difference = exact.difference()?;
        let linear = |coded: [f32; 3]| exact.coding().decode_rgb(coded.map(f64::from));
        Ok(Difference::of(&self.kept, |rgb| {
            difference.between(exact.develop_linear(rgb.map(f64::from)), linear(map(rgb)))
        }))
    }

    /// What share of the picture lies outside, and how far clipping would move those pixels that were kept.
    fn wide_gamut(&self, film: &Reference) -> Result<String> {
        let share = format!(
            "{:.2} % of the pixels hold light outside the sRGB primaries, which --gamut compress keeps apart",
            100.0 * self.outside as f64 / self.all as f64
        );
        let outside: Vec<[f32; 3]> =
            self.kept.iter().copied().filter(|rgb| film.is_outside_srgb(rgb.map(f64::from))).collect();
        if outside.is_empty() {
            return Ok(share);
        }
        // Clipping changes exposures, and nothing before or after them.
        let clip = film.exposure_matrix().clone().with_gamut(WideGamut::Clip);
        let difference = film.difference()?;
        let moved = Difference::of(&outside, |rgb| {
            let stages = film.stages(rgb.map(f64::from));
            difference.between(stages.linear, film.develop_exposure(clip.expose(stages.scene)))
        });
        Ok(format!("{share}: {moved} from --gamut clip on {} of {} pixels", outside.len(), self.kept.len()))
    }
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
