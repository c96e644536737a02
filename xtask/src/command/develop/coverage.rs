//! What becomes of a picture's alpha.

use onelight_picture::{Band, Channels, Description, RowMut, StoredAlpha};
use rayon::prelude::*;

use super::input::Background;

/// Light without coverage counts from here on: a thousandth of white, below which is the noise of renderers.
const SEEN: f32 = 1e-3;

/// What is done with the coverage of a picture before it meets the film.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Coverage {
    /// Colours are developed as those of whole pixels, and keep their alpha.
    Kept,
    /// The alpha says nothing: the picture is opaque.
    LeftOut,
    /// The picture lies over light of this colour, and is opaque.
    Over([f32; 3], StoredAlpha),
}

/// What the alpha of a picture was seen to be.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct CoverageSeen {
    pixels: usize,
    /// Alpha above 0.
    covered: usize,
    /// Light where alpha is 0.
    uncovered_light: usize,
    /// Alpha that is NaN or infinite.
    hard: usize,
}

impl CoverageSeen {
    /// Adds what a band shows.
    pub(super) fn add(&mut self, band: &Band) {
        let Some(alpha) = band.alpha() else { return };
        let rows = band.rgb().par_chunks(band.width().max(1)).zip(alpha.par_chunks(band.width().max(1)));
        let seen = rows.map(|(rgb, alpha)| {
            let mut seen = Self { pixels: rgb.len(), ..Self::default() };
            for (rgb, alpha) in rgb.iter().zip(alpha) {
                seen.hard += usize::from(!alpha.is_finite());
                seen.covered += usize::from(*alpha > 0.0);
                seen.uncovered_light += usize::from(*alpha == 0.0 && rgb.iter().any(|v| *v > SEEN));
            }
            seen
        });
        *self = self.with(seen.reduce(Self::default, Self::with));
    }

    /// Whether every pixel is covered, at least in part.
    pub(super) fn covers_all(&self) -> bool {
        self.covered == self.pixels
    }

    /// What both saw.
    fn with(self, other: Self) -> Self {
        Self {
            pixels: self.pixels + other.pixels,
            covered: self.covered + other.covered,
            uncovered_light: self.uncovered_light + other.uncovered_light,
            hard: self.hard + other.hard,
        }
    }

    /// What to do with it; `notes` gets what the user should know.
    pub(super) fn decide(
        self,
        picture: &Description,
        background: Option<Background>,
        notes: &mut Vec<String>,
    ) -> Coverage {
        if self.hard > 0 {
            notes.push(format!("the alpha of {} pixels is NaN or infinite", self.hard));
        }
        match background {
            Some(Background::None) => Coverage::Kept,
            Some(Background::Light(light)) => Coverage::Over(light, picture.stored_alpha),
            None if self.covered == 0 && self.uncovered_light > 0 => {
                notes.push("the alpha is 0 everywhere, over colour: the picture counts as opaque".to_owned());
                Coverage::LeftOut
            }
            // Where colours are stored straight, those that nothing covers are leftovers.
            None if self.uncovered_light > 0 && picture.stored_alpha == StoredAlpha::Premultiplied => {
                notes.push(format!(
                    "{} of {} pixels are light without coverage (glow, flames, glass): the picture is developed over black \
                     and is opaque (--background chooses another, none keeps the alpha)",
                    self.uncovered_light, self.pixels
                ));
                Coverage::Over([0.0; 3], picture.stored_alpha)
            }
            None => Coverage::Kept,
        }
    }
}

impl Coverage {
    /// What a pixel holds after it.
    pub(super) fn channels(self, picture: &Description) -> Channels {
        if self == Self::Kept { picture.channels } else { Channels::Rgb }
    }

    /// Lays a row of linear light over what is behind it.
    pub(super) fn apply(self, row: &mut RowMut<'_>) {
        let (Self::Over(behind, stored), Some(alpha)) = (self, &row.alpha) else { return };
        for (rgb, alpha) in row.rgb.iter_mut().zip(alpha.iter()) {
            let covers = if alpha.is_finite() { alpha.clamp(0.0, 1.0) } else { 0.0 };
            // Readers leave light without coverage as it is stored.
            let own = match (covers > 0.0, stored) {
                (false, StoredAlpha::Premultiplied) => 1.0,
                _ if alpha.is_normal() => *alpha,
                _ => covers,
            };
            for (value, behind) in rgb.iter_mut().zip(behind) {
                *value = *value * own.max(0.0) + behind * (1.0 - covers);
            }
        }
    }
}
