//! What a fast form and a wide gamut do to this picture, told from some of its pixels.

use anyhow::Result;
use onelight::certify::MeanAndMax;
use onelight::{GamutEffect, Reference};
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
    fn miss(&self, map: impl Fn([f32; 3]) -> [f32; 3] + Sync) -> Result<MeanAndMax> {
        let exact = self.film.exact();
        let difference = exact.difference()?;
        let linear = |coded: [f32; 3]| exact.coding().decode_rgb(coded.map(f64::from));
        let between = |rgb: &[f32; 3]| difference.between(exact.develop_linear(rgb.map(f64::from)), linear(map(*rgb)));
        // In order, so that the sum is the same on any number of threads.
        let all: Vec<f64> = self.kept.par_iter().map(between).collect();
        Ok(MeanAndMax::of(&all))
    }

    /// What share of the picture lies outside, and how far clipping would move those pixels that were kept.
    fn wide_gamut(&self, film: &Reference) -> Result<String> {
        let share = format!(
            "{:.2} % of the pixels hold light outside the sRGB primaries, which --gamut compress keeps apart",
            100.0 * self.outside as f64 / self.all as f64
        );
        let kept: Vec<[f64; 3]> = self.kept.iter().map(|rgb| rgb.map(f64::from)).collect();
        let GamutEffect { outside, colours, moved, .. } = film.gamut_effect(&kept)?;
        if outside == 0 {
            return Ok(share);
        }
        Ok(format!("{share}: {moved} from --gamut clip on {outside} of {colours} pixels"))
    }
}
