use nalgebra::Matrix3;
use onelight_film::{AmountCurve, DyeAmount, ExposureMatrix, LogExposure, PerLayer, Stock};
use onelight_printing::{
    Duplication, EquivalentNeutralDensity, LitDuplication, PrinterLights, Projection, print_mid_grey, print_target,
    reversal_target,
};
use onelight_spectra::quantity::Power;
use onelight_spectra::{Basis, DisplayDifference, RgbSpace, SpectralDistribution, SpectralShape, TransferCurve};

use crate::error::Error;
use crate::process::{Films, Process};
use crate::scene::SceneInput;

/// A [`Process`] compiled: every step in float64 at 1 nm. The measure of all faster forms.
///
/// ```
/// let film = onelight::Process::default().compile()?;
/// let grey = film.develop_linear([0.18; 3]);
/// assert!(grey.iter().all(|v| (v - 10f64.powf(-0.7)).abs() < 1e-6));
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Reference {
    scene: SceneInput,
    exposure: ExposureMatrix,
    mid_grey: PerLayer<LogExposure>,
    camera: PerLayer<AmountCurve>,
    print: Option<PrintStep>,
    projection: Projection,
    coding: TransferCurve,
    output: RgbSpace,
}

/// What printing adds.
#[derive(Debug, Clone)]
struct PrintStep {
    duplication: LitDuplication,
    lights: PrinterLights,
    target: PerLayer<LogExposure>,
    curves: PerLayer<AmountCurve>,
}

/// Every value on the way of one colour: where it comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct Stages {
    /// Scene-linear, sRGB primaries, not negative.
    pub scene: [f64; 3],
    /// Exposure of the camera film.
    pub exposure: PerLayer<LogExposure>,
    /// Dye in the camera film.
    pub amounts: PerLayer<DyeAmount>,
    /// Exposure and dye of the print, if there is one.
    pub print: Option<(PerLayer<LogExposure>, PerLayer<DyeAmount>)>,
    /// The light from the screen; Y of the bare lamp is 1.
    pub spectrum: SpectralDistribution<Power>,
    /// Its tristimulus values.
    pub xyz: [f64; 3],
    /// Display-linear RGB; may be negative or above 1.
    pub linear: [f64; 3],
    /// Display-coded RGB.
    pub coded: [f64; 3],
}

impl Reference {
    pub(crate) fn new(process: &Process) -> Result<Self, Error> {
        let Films { camera: film, print } = Films::of(process)?;
        let density = EquivalentNeutralDensity::new(process.neutral_density)?;
        let output = process.output_space.space();
        let basis = Basis::new(process.reconstruction)?;
        let own_grey = PerLayer::all(film.mid_grey()?);
        // What takes longest, side by side.
        let of_print = |print: &Stock| -> Result<_, Error> { Ok(process.dyes.amounts(print, print_mid_grey(print)?)?) };
        let (camera, paper) =
            rayon::join(|| process.dyes.amounts(&film, own_grey), || print.as_ref().map(of_print).transpose());
        let (camera, paper) = (camera?, paper?);
        let shown = print.as_ref().unwrap_or(&film);
        let projection = Projection::new(shown.dyes_on(SpectralShape::VISIBLE)?, process.projector, &output)?;
        let normal = match print {
            Some(_) => own_grey,
            None => reversal_target(process.aim, density, &film, own_grey, camera.as_ref(), &projection)?,
        };
        let over = process.overexposure * std::f64::consts::LOG10_2;
        let mid_grey = normal.map(|h| LogExposure(h.0 + over));
        let print = match print.as_ref().zip(paper) {
            Some((print, paper)) => {
                Some(PrintStep::new(process, &film, (print, paper), &camera, mid_grey, &projection)?)
            }
            None => None,
        };
        Ok(Self {
            scene: SceneInput::new(process)?,
            exposure: ExposureMatrix::new(&film, &basis, process.matching, normal)?.overexposed(process.overexposure),
            mid_grey,
            camera,
            print,
            projection,
            coding: process.output_coding,
            output,
        })
    }

    /// Scene-linear RGB to display-coded RGB, not clipped.
    ///
    /// Every input gives a finite result: NaN counts as 0, each channel is held to ±[`crate::SCENE_MAX`], and what is negative in
    /// sRGB primaries counts as 0.
    #[must_use]
    pub fn develop(&self, rgb: [f64; 3]) -> [f64; 3] {
        self.develop_linear(rgb).map(|v| self.coding.encode(v))
    }

    /// Scene-linear RGB to display-linear RGB, not clipped. Hard inputs as in [`Reference::develop`].
    #[must_use]
    pub fn develop_linear(&self, rgb: [f64; 3]) -> [f64; 3] {
        self.develop_exposure(self.exposure.expose(self.scene.clean(rgb)))
    }

    /// Exposure of the three layers (not its logarithm; matching vector included) to display-linear RGB: for light whose
    /// spectrum is known.
    #[must_use]
    pub fn develop_exposure(&self, exposure: PerLayer<f64>) -> [f64; 3] {
        self.develop_amounts(self.camera_amounts(exposure.map(LogExposure::of)))
    }

    /// Dye in the camera film to display-linear RGB: what is left to do once the camera film is developed.
    #[must_use]
    pub fn develop_amounts(&self, amounts: PerLayer<DyeAmount>) -> [f64; 3] {
        self.projection.rgb(self.shown(amounts))
    }

    /// The same to tristimulus values; Y of the bare lamp is 1, all three are above 0.
    pub(crate) fn xyz_of_amounts(&self, amounts: PerLayer<DyeAmount>) -> [f64; 3] {
        self.projection.xyz(self.shown(amounts))
    }

    /// Dye in the film on the screen, for dye in the camera film.
    fn shown(&self, amounts: PerLayer<DyeAmount>) -> PerLayer<DyeAmount> {
        match &self.print {
            Some(print) => print.amounts(print.duplication.expose(amounts)),
            None => amounts,
        }
    }

    /// Exposure of the print behind a camera film that holds these amounts of dye; `None` without a print.
    #[must_use]
    pub fn print_exposure(&self, amounts: PerLayer<DyeAmount>) -> Option<PerLayer<LogExposure>> {
        self.print.as_ref().map(|print| print.duplication.expose(amounts))
    }

    /// Every value on the way.
    #[must_use]
    pub fn stages(&self, rgb: [f64; 3]) -> Stages {
        let scene = self.scene.clean(rgb);
        let exposure = self.exposure.expose(scene).map(LogExposure::of);
        let amounts = self.camera_amounts(exposure);
        let print = self.print.as_ref().map(|print| {
            let exposure = print.duplication.expose(amounts);
            (exposure, print.amounts(exposure))
        });
        let shown = print.map_or(amounts, |(_, amounts)| amounts);
        let xyz = self.projection.xyz(shown);
        let linear = self.projection.rgb_of(xyz);
        Stages {
            scene,
            exposure,
            amounts,
            print,
            spectrum: self.projection.spectrum(shown),
            xyz,
            linear,
            coded: linear.map(|v| self.coding.encode(v)),
        }
    }

    /// The 3x3 from scene RGB (sRGB primaries) to exposure, and its matching vector.
    #[must_use]
    pub fn exposure_matrix(&self) -> &ExposureMatrix {
        &self.exposure
    }

    /// Where an 18 % grey card lies on the camera film's curves.
    #[must_use]
    pub fn mid_grey(&self) -> PerLayer<LogExposure> {
        self.mid_grey
    }

    /// Amount of dye over exposure: the camera film's layers.
    #[must_use]
    pub fn camera_curves(&self) -> PerLayer<&AmountCurve> {
        self.camera.as_ref()
    }

    /// Amount of dye over exposure: the print's layers.
    #[must_use]
    pub fn print_curves(&self) -> Option<PerLayer<&AmountCurve>> {
        self.print.as_ref().map(|print| print.curves.as_ref())
    }

    /// The lights of the printer: calibrated, and moved by the points.
    #[must_use]
    pub fn printer_lights(&self) -> Option<PrinterLights> {
        self.print.as_ref().map(|print| print.lights)
    }

    /// The exposure that a grey card must give the print.
    #[must_use]
    pub fn print_target(&self) -> Option<PerLayer<LogExposure>> {
        self.print.as_ref().map(|print| print.target)
    }

    /// The colour difference between two results, display-linear.
    ///
    /// # Errors
    /// None for the built-in spaces.
    pub fn difference(&self) -> Result<DisplayDifference, Error> {
        Ok(DisplayDifference::new(&self.output)?)
    }

    /// The transfer curve of [`Reference::develop`].
    #[must_use]
    pub fn coding(&self) -> TransferCurve {
        self.coding
    }

    pub(crate) fn output(&self) -> &RgbSpace {
        &self.output
    }

    pub(crate) fn projection(&self) -> &Projection {
        &self.projection
    }

    pub(crate) fn duplication(&self) -> Option<&LitDuplication> {
        self.print.as_ref().map(|print| &print.duplication)
    }

    pub(crate) fn to_srgb(&self) -> &Matrix3<f64> {
        self.scene.to_srgb()
    }

    pub(crate) fn rgb_from_xyz(&self) -> &Matrix3<f64> {
        self.projection.rgb_from_xyz()
    }

    pub(crate) fn camera_amounts(&self, exposure: PerLayer<LogExposure>) -> PerLayer<DyeAmount> {
        self.camera.as_ref().zip_map(exposure, AmountCurve::amount)
    }
}

impl PrintStep {
    fn new(
        process: &Process,
        negative: &Stock,
        (print, curves): (&Stock, PerLayer<AmountCurve>),
        camera: &PerLayer<AmountCurve>,
        mid_grey: PerLayer<LogExposure>,
        projection: &Projection,
    ) -> Result<Self, Error> {
        let density = EquivalentNeutralDensity::new(process.neutral_density)?;
        let target = print_target(process.aim, density, print, curves.as_ref(), projection)?;
        let grey = camera.as_ref().zip_map(mid_grey, AmountCurve::amount);
        let duplication = Duplication::new(negative, print, process.printer())?;
        let lights = duplication.calibrate_by(process.calibration, grey, target)?;
        let lights = lights.offset(PerLayer::from(process.points));
        Ok(Self { duplication: duplication.lit(lights), lights, target, curves })
    }

    fn amounts(&self, exposure: PerLayer<LogExposure>) -> PerLayer<DyeAmount> {
        self.curves.as_ref().zip_map(exposure, AmountCurve::amount)
    }
}
