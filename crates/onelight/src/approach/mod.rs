//! The ways from scene light to a display that are compared: both approaches of \[Gotanda2010\], and what games did before.

mod baseline;
mod first;
mod post;
mod tone_curve;

use onelight_lut::Lut3d;
use onelight_spectra::{DisplayDifference, TransferCurve};
use rayon::prelude::*;

pub use baseline::Baseline;
pub use first::FirstApproach;
pub use post::{FirstControls, PostColour};
pub use tone_curve::ToneCurve;

use crate::error::{Error, Kind};
use crate::process::Process;
use crate::reference::Reference;
use crate::word::Word;

/// How scene light becomes a picture. Differences are CIEDE2000 from the second approach on the ColorChecker from -2 to +2 stops,
/// the means of five films.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Approach {
    /// The simulation: spectrum, exposure, dye, print, projection.
    #[default]
    Second,
    /// The talk's first: sensitivities at three wavelengths, characteristic curves as tone curves, colour controls by hand. "Was
    /// NOT a simulation": 4.9 to 6.4.
    First,
    /// x / (1 + x) for each channel (\[Reinhard2002\], equation 3): highlights lose their colour. 6.4 to 8.5.
    Reinhard,
    /// The same of luminance: highlights keep their colour and clip.
    ReinhardLuminance,
    /// Nothing: what does not fit the display is cut off.
    Clip,
}

/// A [`Process`] made to work, whatever its approach: scene-linear RGB in, display RGB out.
///
/// ```
/// use onelight::{Approach, Process};
/// let grey = |approach| {
///     let look = Process { approach, ..Process::default() }.look()?;
///     Ok::<_, onelight::Error>(look.develop_linear([0.18; 3])[1])
/// };
/// assert!((grey(Approach::Reinhard)? - 0.18 / 1.18).abs() < 1e-12);
/// assert!((grey(Approach::First)? - 10f64.powf(-0.7)).abs() < 1e-3);
/// assert!((grey(Approach::Second)? - 10f64.powf(-0.7)).abs() < 1e-6);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone)]
#[expect(clippy::large_enum_variant, reason = "there is one look at a time")]
pub enum Look {
    /// The second approach.
    Film(Reference),
    /// The first approach.
    First(FirstApproach),
    /// No film at all.
    Baseline(Baseline),
}

impl From<Reference> for Look {
    fn from(film: Reference) -> Self {
        Self::Film(film)
    }
}

impl Look {
    pub(crate) fn new(process: &Process) -> Result<Self, Error> {
        match process.approach {
            Approach::Second => Ok(Self::Film(Reference::new(process)?)),
            Approach::First => Ok(Self::First(FirstApproach::new(process)?)),
            Approach::Reinhard | Approach::ReinhardLuminance | Approach::Clip => {
                Ok(Self::Baseline(Baseline::new(process)?))
            }
        }
    }

    /// Scene-linear RGB to display-coded RGB. Every input gives a finite result: NaN counts as 0, each channel is held to
    /// ±[`crate::SCENE_MAX`].
    #[must_use]
    pub fn develop(&self, rgb: [f64; 3]) -> [f64; 3] {
        self.develop_linear(rgb).map(|v| self.coding().encode(v))
    }

    /// Scene-linear RGB to display-linear RGB. Hard inputs as in [`Look::develop`].
    #[must_use]
    pub fn develop_linear(&self, rgb: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Film(film) => film.develop_linear(rgb),
            Self::First(first) => first.develop_linear(rgb),
            Self::Baseline(baseline) => baseline.develop_linear(rgb),
        }
    }

    /// The transfer curve of [`Look::develop`].
    #[must_use]
    pub fn coding(&self) -> TransferCurve {
        match self {
            Self::Film(film) => film.coding(),
            Self::First(first) => first.coding(),
            Self::Baseline(baseline) => baseline.coding(),
        }
    }

    /// The colour difference between two results, display-linear.
    ///
    /// # Errors
    /// None for the built-in spaces.
    pub fn difference(&self) -> Result<DisplayDifference, Error> {
        match self {
            Self::Film(film) => film.difference(),
            Self::First(first) => first.difference(),
            Self::Baseline(baseline) => baseline.difference(),
        }
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
            Self::First(_) => Err(no_film(Approach::First.word())),
            Self::Baseline(baseline) => Err(no_film(baseline.approach().word())),
        }
    }
}

/// The sentence for what needs the second approach.
pub(crate) fn no_film(approach: &str) -> Error {
    Kind::Contradiction(format!("approach {approach} has no spectra, dyes or film curves, expected approach second"))
        .into()
}
