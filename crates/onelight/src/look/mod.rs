//! Looks at work: both approaches of \[Gotanda2010\], and what games did before.

mod first;
mod post;
mod printed_scan;
mod tone_curve;
mod tone_mapped;

use onelight_lut::Lut3d;
use onelight_spectra::{DisplayCoding, DisplayDifference, DisplayLinear};
use rayon::prelude::*;

pub use first::FirstApproach;
pub use post::PostColour;
pub use printed_scan::PrintedScan;
pub use tone_curve::{Texels, ToneCurve};
pub use tone_mapped::ToneMapped;

use crate::about::About;
use crate::error::Error;
use crate::films::Films;
use crate::process::{Approach, ColourSpaces, Process};
use crate::process_keys::no_films;
use crate::reference::{Reference, no_camera, no_film};

/// A [`Process`] made to work, whatever its approach: scene-linear RGB in, display RGB out.
///
/// ```
/// use onelight::{FilmProcess, FirstProcess, Process, ToneProcess};
/// let grey = |process: Process| Ok::<_, onelight::Error>(process.look()?.develop_linear([0.18; 3])[1]);
/// assert!((grey(ToneProcess::default().into())? - 0.18 / 1.18).abs() < 1e-12);
/// assert!((grey(FirstProcess::default().into())? - 10f64.powf(-0.7)).abs() < 1e-3);
/// assert!((grey(FilmProcess::default().into())? - 10f64.powf(-0.7)).abs() < 1e-6);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone)]
#[expect(clippy::large_enum_variant, reason = "there is one look at a time")]
pub enum Look {
    /// The simulation of film: the second approach.
    Film(Reference),
    /// A print of a scanned negative; its light is that of Cineon codes ([`PrintedScan::develop_linear`]).
    Print(PrintedScan),
    /// The first approach: tone curves and matrices.
    First(FirstApproach),
    /// A tone mapping without film.
    Tone(ToneMapped),
}

impl From<Reference> for Look {
    fn from(film: Reference) -> Self {
        Self::Film(film)
    }
}

impl Look {
    /// Scene-linear RGB to display-coded RGB. Every input gives a finite result: NaN counts as 0, each channel is held to
    /// ±[`crate::SCENE_MAX`].
    #[must_use]
    pub fn develop(&self, rgb: [f64; 3]) -> [f64; 3] {
        self.coding().encode_rgb(self.develop_linear(rgb))
    }

    /// Scene-linear RGB to display-linear RGB. Hard inputs as in [`Look::develop`].
    #[must_use]
    pub fn develop_linear(&self, rgb: [f64; 3]) -> DisplayLinear {
        match self {
            Self::Film(film) => film.develop_linear(rgb),
            Self::Print(print) => print.develop_linear(rgb),
            Self::First(first) => first.develop_linear(rgb),
            Self::Tone(tone) => tone.develop_linear(rgb),
        }
    }

    /// The coding of [`Look::develop`].
    #[must_use]
    pub fn coding(&self) -> DisplayCoding {
        self.about().coding()
    }

    /// The RGB that comes in and goes out.
    #[must_use]
    pub fn spaces(&self) -> &ColourSpaces {
        &self.about().spaces
    }

    /// A short name made of the films: `kodak-5207_kodak-2383`, `reinhard`.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.about().name
    }

    pub(crate) fn about(&self) -> &About {
        match self {
            Self::Film(film) => film.about(),
            Self::Print(print) => print.about(),
            Self::First(first) => first.about(),
            Self::Tone(tone) => tone.about(),
        }
    }

    /// The colour difference between two results.
    ///
    /// # Errors
    /// None for the built-in spaces.
    pub fn difference(&self) -> Result<DisplayDifference, Error> {
        self.about().difference()
    }

    /// A table of display-coded entries for a plain form; `at` gives the scene-linear colour for coordinates from 0 to 1. A
    /// film's is [`Reference::bake`].
    ///
    /// # Errors
    /// If the size is out of bounds.
    pub fn bake(&self, size: usize, at: impl Fn([f64; 3]) -> [f64; 3] + Sync) -> Result<Lut3d, Error> {
        if let Self::Film(film) = self {
            return film.bake(size, at);
        }
        // Checks the size before anything is allocated.
        let nodes = Lut3d::identity(size)?.entries().len();
        let place = |i: usize| i as f64 / (size - 1) as f64;
        let entry = |i: usize| {
            self.develop(at([place(i % size), place(i / size % size), place(i / size / size)])).map(|v| v as f32)
        };
        Ok(Lut3d::new(size, (0..nodes).into_par_iter().map(entry).collect())?)
    }

    /// The exact film, for what only it has: stages, curves, the forms whose axes they are.
    ///
    /// # Errors
    /// If the look is of another approach.
    pub fn film(&self) -> Result<&Reference, Error> {
        match self {
            Self::Film(film) => Ok(film),
            Self::Print(_) => Err(no_camera()),
            Self::First(_) => Err(no_film(Approach::First)),
            Self::Tone(tone) => Err(no_film(tone.mapping().approach())),
        }
    }
}

impl Process {
    /// The process at work, whatever its kind.
    ///
    /// # Errors
    /// As [`Process::compile`], but for the kind.
    pub fn look(&self) -> Result<Look, Error> {
        match self {
            Self::Film(film) => film.compile().map(Look::Film),
            Self::Print(print) => PrintedScan::new(print).map(Look::Print),
            Self::First(first) => FirstApproach::new(first, &Films::of_first(first)?).map(Look::First),
            Self::Tone(tone) => ToneMapped::new(tone).map(Look::Tone),
        }
    }

    /// The process at work with these films instead of those that it names.
    ///
    /// # Errors
    /// As [`Process::compile_with`], but for the kind; a tone mapping takes no films.
    pub fn look_with(&self, films: &Films) -> Result<Look, Error> {
        match self {
            Self::Film(film) => film.compile_with(films).map(Look::Film),
            Self::Print(_) => Err(no_camera()),
            Self::First(first) => FirstApproach::new(first, films).map(Look::First),
            Self::Tone(tone) => Err(no_films(tone.mapping.approach())),
        }
    }
}
