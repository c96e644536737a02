//! How far a picture could be off, for what the data sheets and the inter-image effect are uncertain by.

use onelight_film::{Figures, InterImage, Stock};
use onelight_spectra::DisplayDifference;
use rayon::iter::{IntoParallelRefIterator as _, ParallelIterator as _};

use crate::error::Error;
use crate::films::Films;
use crate::process::{FilmProcess, InterImageChoice};
use crate::reference::Reference;

/// By how much the strength of the inter-image effect is uncertain, near and far: what scan bands, spectra and dyes moved it by where
/// it was fitted to negatives.
const INTER_IMAGE: (f64, f64) = (0.12, 0.1);

/// The colour differences that uncertain figures make in a look, colour by colour.
///
/// The look is compiled again with one thing moved at a time: each of the three sets of figures of each layer of both films
/// ([`Stock::reread`]), `near` by 0.12 and `far` by 0.1; 20 looks for a negative and its print whose sheets state all
/// uncertainties. The CIEDE2000 that each makes are combined as the square root of the sum of their squares: errors are
/// taken to be independent, small, and as large one way as the other. Nothing is drawn at random.
///
/// ```
/// use onelight::{FilmProcess, Uncertainty};
/// let look = Uncertainty::new(&FilmProcess::default())?;
/// // Grey is aimed at; colours are not.
/// assert!(look.difference([0.18; 3]) < 0.01);
/// assert!(look.difference([0.05, 0.1, 0.4]) > 0.1);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Uncertainty {
    look: Reference,
    sheets: Vec<Reference>,
    inter_image: Vec<Reference>,
    difference: DisplayDifference,
}

impl Uncertainty {
    /// The look of built-in films, and what it could be.
    ///
    /// # Errors
    /// As [`FilmProcess::compile`].
    pub fn new(process: &FilmProcess) -> Result<Self, Error> {
        Self::with(process, &Films::of_film(process)?)
    }

    /// The same with these films instead of those that the process names.
    ///
    /// # Errors
    /// As [`FilmProcess::compile_with`].
    pub fn with(process: &FilmProcess, films: &Films) -> Result<Self, Error> {
        let look = process.compile_with(films)?;
        let mut reread = Vec::new();
        for (figures, layer) in Figures::ALL.into_iter().flat_map(|figures| (0..3).map(move |layer| (figures, layer))) {
            if let Some(camera) = films.camera.reread(figures, layer)? {
                reread.push(Films { camera, print: films.print.clone() });
            }
            if let Some(print) = films.print.as_ref().map(|print| print.reread(figures, layer)).transpose()?.flatten() {
                reread.push(Films { camera: films.camera.clone(), print: Some(print) });
            }
        }
        let sheets = reread.par_iter().map(|films| process.compile_with(films)).collect::<Result<_, _>>()?;
        let inter_image = strengths(process, &films.camera)?;
        let inter_image = inter_image.into_iter().map(|strength| {
            FilmProcess { inter_image: InterImageChoice::Fixed(strength), ..process.clone() }.compile_with(films)
        });
        let inter_image = inter_image.collect::<Result<_, _>>()?;
        Ok(Self { difference: look.difference()?, look, sheets, inter_image })
    }

    /// How many looks beside the look itself are compared.
    #[must_use]
    pub fn count(&self) -> usize {
        self.sheets.len() + self.inter_image.len()
    }

    /// CIEDE2000 by which a scene-linear colour could be off; hard inputs as in [`Reference::develop`].
    #[must_use]
    pub fn difference(&self, rgb: [f64; 3]) -> f64 {
        let [sheets, inter_image] = self.parts(rgb);
        sheets.hypot(inter_image)
    }

    /// The same apart: for what the sheets leave open, and for the strength of the inter-image effect.
    #[must_use]
    pub fn parts(&self, rgb: [f64; 3]) -> [f64; 2] {
        let usual = self.look.develop_linear(rgb);
        let apart = |look: &Reference| self.difference.between(usual, look.develop_linear(rgb)).powi(2);
        [&self.sheets, &self.inter_image].map(|looks| looks.iter().map(apart).sum::<f64>().sqrt())
    }
}

/// The strengths that are tried instead of the look's: none where it has been switched off.
fn strengths(process: &FilmProcess, camera: &Stock) -> Result<Vec<InterImage>, Error> {
    let used = process.inter_image.of(camera);
    if used == InterImage::NONE {
        return Ok(Vec::new());
    }
    let (near, far) = INTER_IMAGE;
    let moved = [(used.near() + near, used.far()), (used.near(), used.far() + far)];
    let within = |v: f64| v.min(InterImage::MAX);
    let strengths = moved.map(|(near, far)| InterImage::new(within(near), within(far)));
    Ok(strengths.into_iter().collect::<Result<_, _>>()?)
}
