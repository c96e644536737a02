//! What becomes of a picture's alpha.

use onelight_picture::{Band, Channels, Description, RowMut, StoredAlpha};
use rayon::prelude::*;

use crate::picture_notes::{LightNote, LightSetting};

/// Light without coverage counts from here on: a thousandth of white, below which is the noise of renderers.
const SEEN: f32 = 1e-3;

/// What lies behind a picture with alpha.
///
/// ```
/// use onelight::Background;
/// assert_ne!(Background::None, Background::Light([0.0; 3]));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Background {
    /// Nothing: what comes out has the same alpha.
    None,
    /// Light of this colour, in the picture's own space.
    Light([f32; 3]),
}

/// What is done with the coverage of a picture before it meets the film.
///
/// ```
/// use onelight::{Coverage, picture::{Channels, Description, Source}};
/// let picture = Description::new(3, 2, Channels::Rgba, Source::Exr);
/// assert_eq!(Coverage::Kept.channels(&picture), Channels::Rgba);
/// assert_eq!(Coverage::Over([0.0; 3]).channels(&picture), Channels::Rgb);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Coverage {
    /// Colours are developed as those of whole pixels, and keep their alpha.
    Kept,
    /// The alpha says nothing: the picture is opaque.
    LeftOut,
    /// The picture lies over light of this colour, and is opaque.
    Over([f32; 3]),
}

/// What the alpha of a picture was seen to be, all of it before anything is developed.
///
/// ```
/// use std::io::Cursor;
/// use onelight::picture::{Limits, Picture, Source, open};
/// use onelight::{Coverage, CoverageSeen};
/// # let glow = Picture { alpha: Some(vec![1.0, 1.0, 0.0]), ..Picture::opaque(3, 1, vec![[0.2; 3]; 3], Source::Exr) };
/// # let mut file = Cursor::new(Vec::new());
/// # glow.write_exr(&mut file, &[])?;
/// // Light where nothing is covered, as of a flame.
/// let mut picture = open(file, "glow.exr", Limits::default())?;
/// let mut seen = CoverageSeen::default();
/// while let Some(band) = picture.next_band()? {
///     seen.add(band);
/// }
/// let (coverage, notes) = seen.decide(picture.description(), None);
/// assert_eq!(coverage, Coverage::Over([0.0; 3]));
/// assert!(notes[0].text.starts_with("1 of 3 pixels are light without coverage"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, Default)]
pub struct CoverageSeen {
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
    pub fn add(&mut self, band: &Band) {
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
    #[must_use]
    pub fn covers_all(&self) -> bool {
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

    /// What to do with it, by the background that was named, and what the user should know.
    #[must_use]
    pub fn decide(self, picture: &Description, background: Option<Background>) -> (Coverage, Vec<LightNote>) {
        let mut notes = Vec::new();
        let mut note = |text: String, decided_by| notes.push(LightNote { text, decided_by });
        if self.hard > 0 {
            note(format!("the alpha of {} pixels is NaN or infinite", self.hard), None);
        }
        let coverage = match background {
            Some(Background::None) => Coverage::Kept,
            Some(Background::Light(light)) => Coverage::Over(light),
            None if self.covered == 0 && self.uncovered_light > 0 => {
                note("the alpha is 0 everywhere, over colour: the picture counts as opaque".to_owned(), None);
                Coverage::LeftOut
            }
            // Where colours are stored straight, those that nothing covers are leftovers.
            None if self.uncovered_light > 0 && picture.stored_alpha == StoredAlpha::Premultiplied => {
                let sentence = format!(
                    "{} of {} pixels are light without coverage (glow, flames, glass): the picture is developed over black \
                     and is opaque",
                    self.uncovered_light, self.pixels
                );
                note(sentence, Some(LightSetting::Background));
                Coverage::Over([0.0; 3])
            }
            None => Coverage::Kept,
        };
        (coverage, notes)
    }
}

impl Coverage {
    /// What a pixel holds after it.
    #[must_use]
    pub fn channels(self, picture: &Description) -> Channels {
        if self == Self::Kept { picture.channels } else { Channels::Rgb }
    }

    /// Lays a row of linear light over what is behind it.
    pub(crate) fn apply(self, row: &mut RowMut<'_>, stored: StoredAlpha) {
        let (Self::Over(behind), Some(alpha)) = (self, &row.alpha) else { return };
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
