use nalgebra::{Matrix3, Vector3};
use onelight_film::{EXPOSURE_FLOOR, LAYER_NAMES, PerLayer, Stock, Tail};
use onelight_spectra::{Chromaticity, DisplayLinear, RgbSpace, TransferCurve};

use super::post::PostColour;
use super::tone_curve::ToneCurve;
use crate::about::About;
use crate::error::Error;
use crate::films::Films;
use crate::process::{FirstProcess, Process};
use crate::scene::{MID_GREY, SceneInput, multiply};

/// The talk's first approach: a matrix before, a tone curve for each channel, a matrix after (\[Gotanda2010\]).
///
/// Red, green and blue light count as 612, 549 and 464 nm. Dyes, spectra and the printer's lights are left out, and with them
/// what makes colours of film.
///
/// ```
/// use onelight::{FirstProcess, Look, Process};
/// let Look::First(first) = Process::from(FirstProcess::default()).look()? else { return Ok(()) };
/// assert!((first.develop_linear([0.18; 3])[1] - 10f64.powf(-0.7)).abs() < 1e-3);
/// assert!((first.pre_colour().row(0).sum() - 1.0).abs() < 1e-12);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct FirstApproach {
    scene: SceneInput,
    matrix: Matrix3<f64>,
    curves: PerLayer<ToneCurve>,
    post: PostColour,
    to_output: Matrix3<f64>,
    about: About,
}

/// What red, green and blue light are taken for, in nm.
const WAVELENGTHS_NM: [f64; 3] = [612.0, 549.0, 464.0];

impl FirstApproach {
    pub(crate) fn new(process: &FirstProcess, films: &Films) -> Result<Self, Error> {
        films.check_for(process.print.is_some(), None)?;
        process.check()?;
        let density = process.neutral_density;
        let layers = PerLayer::from(LAYER_NAMES);
        let film = films.camera.characteristic().zip_map(layers, |curve, layer| (curve, layer));
        let curves = match &films.print {
            Some(print) => film.zip_map(print.characteristic(), |film, print| (film, print)).try_map(
                |((curve, layer), printed), _| ToneCurve::printed(&films.camera, curve, print, layer, printed, density),
            )?,
            None => film.try_map(|(curve, layer), _| ToneCurve::reversal(&films.camera, layer, curve, density))?,
        };
        let output = process.spaces.output_space.space();
        Ok(Self {
            scene: SceneInput::new(&process.spaces)?,
            matrix: pre_colour(&films.camera),
            curves: curves.try_map(|curve, _| curve.edited(&process.controls.curve))?,
            post: PostColour::new(&process.controls)?,
            to_output: RgbSpace::SRGB.to_about(&output, Chromaticity::black_body_6500_k())?,
            about: About::new(&films.named_in(&Process::First(process.clone()))),
        })
    }

    /// Scene-linear RGB to display-linear RGB, not clipped. Hard inputs as in [`crate::Look::develop`]; what is negative in
    /// sRGB primaries counts as 0.
    #[must_use]
    pub fn develop_linear(&self, rgb: [f64; 3]) -> DisplayLinear {
        let exposure = self.matrix * Vector3::from(self.scene.clean(rgb)) / MID_GREY;
        let exposure = PerLayer::from(<[f64; 3]>::from(exposure));
        let coded = self.curves.as_ref().zip_map(exposure, |curve, e| curve.at(e.max(EXPOSURE_FLOOR).log10()));
        let linear = TransferCurve::Srgb.decode_rgb(self.post.apply(coded.to_array()));
        DisplayLinear(multiply(&self.to_output, *linear))
    }

    /// The pre-colour matrix: sensitivity of layer i at the wavelength of light k, each row summing to 1.
    #[must_use]
    pub fn pre_colour(&self) -> &Matrix3<f64> {
        &self.matrix
    }

    /// The tone curve of each channel, edits included.
    #[must_use]
    pub fn tone_curves(&self) -> PerLayer<&ToneCurve> {
        self.curves.as_ref()
    }

    /// The matrix on display-coded colour behind the tone curves.
    #[must_use]
    pub fn post_colour(&self) -> &PostColour {
        &self.post
    }

    pub(super) fn about(&self) -> &About {
        &self.about
    }
}

/// Beyond the published range the sensitivities go on log-linearly.
fn pre_colour(film: &Stock) -> Matrix3<f64> {
    let layers = film.sensitivity().to_array();
    let row = |i: usize| WAVELENGTHS_NM.map(|nm| 10f64.powf(layers[i].log10_at(nm, Tail::LogLinear)));
    Matrix3::from_fn(|i, k| row(i)[k] / row(i).iter().sum::<f64>())
}
