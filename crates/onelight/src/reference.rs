use nalgebra::Matrix3;
use onelight_film::{
    AmountCurve, Density, DyeAmount, ExposureMatrix, Image, InterImageEffect, LogExposure, PerLayer, PrintCurves,
    Stock, WideGamut,
};
use onelight_printing::{
    EquivalentNeutralDensity, PrinterLights, Projection, ScanRule, White, print_mid_grey, print_target, reversal_target,
};
use onelight_spectra::quantity::Power;
use onelight_spectra::{Basis, DisplayCoding, DisplayDifference, DisplayLinear, SpectralDistribution, SpectralShape};

use crate::about::About;
use crate::error::{Error, ErrorKind};
use crate::films::Films;
use crate::positive::{Positive, PrintStep, ScanStep, viewed_by};
use crate::process::{Approach, ColourSpaces, FilmProcess, InterImageChoice, Process};
use crate::scene::SceneInput;
use crate::word::Word as _;

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
    inter_image: InterImageEffect,
    camera: PerLayer<AmountCurve>,
    positive: Positive,
    projection: Projection,
    about: About,
}

/// Every value on the way of one colour: where it comes from.
///
/// ```
/// let film = onelight::Process::default().compile()?;
/// let stages = film.stages([2.0, 0.5, 0.1]);
/// assert!(stages.amounts.red.0 > stages.amounts.blue.0);
/// // What is dense on the negative is clear on the print.
/// let print = stages.print.as_ref().map(|print| print.amounts);
/// assert!(print.is_some_and(|print| print.red.0 < print.blue.0));
/// assert_eq!(stages.coded, film.develop([2.0, 0.5, 0.1]));
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Stages {
    /// Scene-linear, sRGB primaries; below 0 where the light lies outside them, unless [`WideGamut::Clip`] makes it 0.
    pub scene: [f64; 3],
    /// Exposure of the camera film.
    pub exposure: PerLayer<LogExposure>,
    /// The exposure at which each layer's own curve is read: the inter-image effect has moved it.
    pub effective: PerLayer<LogExposure>,
    /// Dye in the camera film.
    pub amounts: PerLayer<DyeAmount>,
    /// The print, if there is one.
    pub print: Option<PrintStage>,
    /// Densities that a scan reads, base included, if the negative is scanned.
    pub scan: Option<PerLayer<Density>>,
    /// The light from the screen; Y of the bare lamp is 1. Of a scan, the light through the negative on a light table: what is shown
    /// follows from the densities.
    pub spectrum: SpectralDistribution<Power>,
    /// Tristimulus values of that light (CIE 1931); Y of the bare lamp is 1.
    pub xyz: [f64; 3],
    /// Display-linear RGB, the white being (1, 1, 1); may be negative or above 1.
    pub linear: DisplayLinear,
    /// Display-coded RGB: what [`Reference::develop`] gives.
    pub coded: [f64; 3],
}

/// What printing makes of one colour.
///
/// ```
/// let film = onelight::Process::default().compile()?;
/// let print = film.stages([0.18; 3]).print.ok_or("a negative is printed")?;
/// // A grey card is printed at the aim.
/// assert!((print.exposure.red.0 - film.print_target().ok_or("a print has a target")?.red.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrintStage {
    /// Exposure of the print film behind the negative.
    pub exposure: PerLayer<LogExposure>,
    /// Dye in the print film.
    pub amounts: PerLayer<DyeAmount>,
}

impl Reference {
    fn new(process: &FilmProcess, films: &Films) -> Result<Self, Error> {
        films.check_for(process.print.is_some(), process.scan)?;
        process.check()?;
        check_silver(process, films)?;
        let film = &films.camera;
        let printing = films.print.as_ref().zip(process.print.as_ref());
        let density = EquivalentNeutralDensity::new(process.neutral_density)?;
        let output = process.spaces.output_space.space();
        let basis = Basis::new(process.reconstruction)?;
        let own_grey = PerLayer::all(film.mid_grey()?);
        // What takes longest, side by side.
        let curves = process.print.as_ref().map_or(PrintCurves::default(), |printing| printing.curves);
        let of_print = |print: &Stock| -> Result<_, Error> {
            Ok(match curves {
                PrintCurves::Neutral => process.dyes.amounts(print, print_mid_grey(print)?)?,
                PrintCurves::Principal => PrintCurves::principal_amounts(print)?,
            })
        };
        let (camera, print) =
            rayon::join(|| process.dyes.amounts(film, own_grey), || films.print.as_ref().map(of_print).transpose());
        let (camera, print) = (camera?, print?);
        let shown = films.print.as_ref().unwrap_or(film);
        let projection =
            Projection::new(shown.dyes_on(SpectralShape::VISIBLE)?, viewed_by(process.projector, shown)?, &output)?;
        let projection = match process.white {
            White::Film if process.scan.is_none() => {
                let shown = print.as_ref().unwrap_or(&camera).as_ref();
                projection.adapted_to(shown.map(|curve| *curve.amount_range().start()))
            }
            White::Film | White::Lamp => projection,
        };
        let normal = match printing {
            Some(_) => own_grey,
            None if process.scan.is_some() => own_grey,
            None => reversal_target(process.aim, density, film, own_grey, camera.as_ref(), &projection)?,
        };
        let over = process.overexposure * std::f64::consts::LOG10_2;
        let mid_grey = normal.map(|h| LogExposure(h.0 + over));
        let grey = || camera.as_ref().zip_map(mid_grey, AmountCurve::amount);
        let positive = match (printing.zip(print), process.scan) {
            (Some(((print, printing), curves)), _) => {
                let target = print_target(process.aim, density, print, curves.as_ref(), &projection)?;
                Positive::Print(PrintStep::new(printing, film, print, grey(), target, curves)?)
            }
            (None, Some(ScanRule::Cineon)) => Positive::Scan(ScanStep::new(film, grey(), density, &output)?),
            (None, None) => Positive::Itself,
        };
        Ok(Self {
            scene: SceneInput::new(&process.spaces)?,
            exposure: ExposureMatrix::new(film, &basis, process.matching, normal)?
                .overexposed(process.overexposure)
                .with_gamut(process.gamut),
            mid_grey,
            // Of normal exposure: more of it moves colours along the same densities.
            inter_image: InterImageEffect::new(film, process.inter_image.of(film), normal),
            camera,
            positive,
            projection,
            about: About::new(&films.named_in(&Process::Film(process.clone()))),
        })
    }

    /// Scene-linear RGB to display-coded RGB, not clipped.
    ///
    /// Every input gives a finite result: NaN counts as 0, each channel is held to ±[`crate::SCENE_MAX`]; what is negative in
    /// sRGB primaries lowers exposures or counts as 0, as [`WideGamut`] says.
    #[must_use]
    pub fn develop(&self, rgb: [f64; 3]) -> [f64; 3] {
        self.coding().encode_rgb(self.develop_linear(rgb))
    }

    /// Scene-linear RGB to display-linear RGB, not clipped. Hard inputs as in [`Reference::develop`].
    #[must_use]
    pub fn develop_linear(&self, rgb: [f64; 3]) -> DisplayLinear {
        self.develop_exposure(self.exposure.expose(self.light(rgb)))
    }

    /// Exposure of the three layers (not its logarithm; matching vector included) to display-linear RGB: for light whose
    /// spectrum is known.
    #[must_use]
    pub fn develop_exposure(&self, exposure: PerLayer<f64>) -> DisplayLinear {
        self.develop_amounts(self.camera_amounts(exposure.map(LogExposure::of)))
    }

    /// Dye in the camera film to display-linear RGB: what is left to do once the camera film is developed.
    #[must_use]
    pub fn develop_amounts(&self, amounts: PerLayer<DyeAmount>) -> DisplayLinear {
        match &self.positive {
            Positive::Itself => self.projection.rgb(amounts),
            Positive::Print(print) => self.projection.rgb(print.amounts(print.duplication.expose(amounts))),
            Positive::Scan(scan) => scan.rgb(amounts),
        }
    }

    /// Dye in the camera film to light that [`Reference::rgb_from_light`] makes RGB of: tristimulus values above 0, Y of the bare lamp being
    /// 1, or the channels of a scan.
    pub(crate) fn light_of_amounts(&self, amounts: PerLayer<DyeAmount>) -> [f64; 3] {
        match &self.positive {
            Positive::Itself => self.projection.xyz(amounts),
            Positive::Print(print) => self.projection.xyz(print.amounts(print.duplication.expose(amounts))),
            Positive::Scan(scan) => *scan.scan.positive(amounts),
        }
    }

    /// Exposure of the print behind a camera film that holds these amounts of dye; `None` without a print.
    #[must_use]
    pub fn print_exposure(&self, amounts: PerLayer<DyeAmount>) -> Option<PerLayer<LogExposure>> {
        self.print().map(|print| print.duplication.expose(amounts))
    }

    /// Whether a scene-linear colour has light outside the sRGB primaries, beyond what rounding makes of one on their edge: what
    /// [`WideGamut`] is about.
    ///
    /// ```
    /// let film = onelight::Process::default().compile()?;
    /// assert!(film.is_outside_srgb([-0.1, 0.5, 0.5]) && !film.is_outside_srgb([0.0, 0.5, 0.5]));
    /// # Ok::<(), onelight::Error>(())
    /// ```
    #[must_use]
    pub fn is_outside_srgb(&self, rgb: [f64; 3]) -> bool {
        let light = self.light(rgb);
        let most = light.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        light.iter().any(|v| *v < -1e-6 * most)
    }

    /// Every value on the way of a scene-linear colour.
    #[must_use]
    pub fn stages(&self, rgb: [f64; 3]) -> Stages {
        let scene = match self.exposure.gamut() {
            WideGamut::Compress => self.scene.light(rgb),
            WideGamut::Clip => self.scene.clean(rgb),
        };
        let exposure = self.exposure.expose(scene).map(LogExposure::of);
        let effective = self.inter_image.effective(exposure);
        let amounts = self.camera_amounts(exposure);
        let print = self.print().map(|print| {
            let exposure = print.duplication.expose(amounts);
            PrintStage { exposure, amounts: print.amounts(exposure) }
        });
        let shown = print.map_or(amounts, |print| print.amounts);
        let xyz = self.projection.xyz(shown);
        let (scan, linear) = match &self.positive {
            Positive::Scan(scan) => (Some(scan.scan.densities(amounts)), scan.rgb(amounts)),
            Positive::Itself | Positive::Print(_) => (None, self.projection.rgb_of(xyz)),
        };
        Stages {
            scene,
            exposure,
            effective,
            amounts,
            print,
            scan,
            spectrum: self.projection.spectrum(shown),
            xyz,
            linear,
            coded: self.coding().encode_rgb(linear),
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

    /// How the camera film's layers inhibit each other's development.
    #[must_use]
    pub fn inter_image(&self) -> &InterImageEffect {
        &self.inter_image
    }

    /// Amount of dye over effective exposure ([`Stages::effective`]): the camera film's layers.
    #[must_use]
    pub fn camera_curves(&self) -> PerLayer<&AmountCurve> {
        self.camera.as_ref()
    }

    /// Amount of dye over exposure: the print's layers.
    #[must_use]
    pub fn print_curves(&self) -> Option<PerLayer<&AmountCurve>> {
        self.print().map(|print| print.curves.as_ref())
    }

    /// The lights of the printer: calibrated, and moved by the points.
    #[must_use]
    pub fn printer_lights(&self) -> Option<PrinterLights> {
        self.print().map(|print| print.lights)
    }

    /// The exposure that a grey card must give the print.
    #[must_use]
    pub fn print_target(&self) -> Option<PerLayer<LogExposure>> {
        self.print().map(|print| print.target)
    }

    /// The colour difference between two results.
    ///
    /// # Errors
    /// None for the built-in spaces.
    pub fn difference(&self) -> Result<DisplayDifference, Error> {
        self.about.difference()
    }

    /// The coding of [`Reference::develop`].
    #[must_use]
    pub fn coding(&self) -> DisplayCoding {
        self.about.coding()
    }

    /// The RGB that comes in and goes out.
    #[must_use]
    pub fn spaces(&self) -> &ColourSpaces {
        &self.about.spaces
    }

    /// A short name made of the films: `kodak-5207_kodak-2383`, `fuji-velvia-50`.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.about.name
    }

    /// The same film with linear light for its output: what forms code whose files know no PQ or HLG.
    pub(crate) fn in_linear_light(&self) -> Self {
        Self { about: self.about.in_linear_light(), ..self.clone() }
    }

    pub(crate) fn about(&self) -> &About {
        &self.about
    }

    pub(crate) fn projection(&self) -> &Projection {
        &self.projection
    }

    pub(crate) fn positive(&self) -> &Positive {
        &self.positive
    }

    fn print(&self) -> Option<&PrintStep> {
        match &self.positive {
            Positive::Print(print) => Some(print),
            Positive::Itself | Positive::Scan(_) => None,
        }
    }

    /// Curves over the light that the camera film lets through: the print's, or those of a scan.
    pub(crate) fn curves_behind(&self) -> Option<PerLayer<&AmountCurve>> {
        match &self.positive {
            Positive::Itself => None,
            Positive::Print(print) => Some(print.curves.as_ref()),
            Positive::Scan(scan) => Some(scan.curves.as_ref()),
        }
    }

    /// The same, by which a table's nodes are spread.
    pub(crate) fn axis_curves(&self) -> Option<PerLayer<&AmountCurve>> {
        match &self.positive {
            Positive::Scan(scan) => Some(scan.codes.as_ref()),
            Positive::Itself | Positive::Print(_) => self.curves_behind(),
        }
    }

    /// Where those curves are read, for dye in the camera film.
    pub(crate) fn exposure_behind(&self, amounts: PerLayer<DyeAmount>) -> Option<PerLayer<LogExposure>> {
        match &self.positive {
            Positive::Itself => None,
            Positive::Print(print) => Some(print.duplication.expose(amounts)),
            Positive::Scan(scan) => Some(scan.light(amounts)),
        }
    }

    /// Scene light as the exposure matrix takes it: sRGB primaries, hard values cleaned.
    pub(crate) fn light(&self, rgb: [f64; 3]) -> [f64; 3] {
        self.scene.light(rgb)
    }

    pub(crate) fn to_srgb(&self) -> &Matrix3<f64> {
        self.scene.to_srgb()
    }

    /// The input's primaries of a colour in sRGB's.
    pub(crate) fn input_of_srgb(&self, rgb: [f64; 3]) -> [f64; 3] {
        self.scene.input_of_srgb(rgb)
    }

    /// Display-linear RGB of what [`Reference::light_of_amounts`] gives.
    pub(crate) fn rgb_from_light(&self) -> &Matrix3<f64> {
        match &self.positive {
            Positive::Itself | Positive::Print(_) => self.projection.rgb_from_xyz(),
            Positive::Scan(scan) => &scan.to_output,
        }
    }

    pub(crate) fn camera_amounts(&self, exposure: PerLayer<LogExposure>) -> PerLayer<DyeAmount> {
        self.camera.as_ref().zip_map(self.inter_image.effective(exposure), AmountCurve::amount)
    }
}

impl FilmProcess {
    /// The exact simulation with the built-in films that the process names: float64 at 1 nm.
    ///
    /// # Errors
    /// If a stock is unknown or a sheet of one's own, the parts contradict each other, a sheet lacks what is asked of it, or the
    /// aim cannot be reached.
    pub fn compile(&self) -> Result<Reference, Error> {
        Reference::new(self, &Films::of_film(self)?)
    }

    /// The exact simulation with these films instead of those that the process names.
    ///
    /// # Errors
    /// As [`FilmProcess::compile`], but for names of stocks; if only one of process and films has a print.
    pub fn compile_with(&self, films: &Films) -> Result<Reference, Error> {
        Reference::new(self, films)
    }
}

impl Process {
    /// The exact simulation with the built-in films that the process names: float64 at 1 nm.
    ///
    /// # Errors
    /// If a stock is unknown or a sheet of one's own, the parts contradict each other, a sheet lacks what is asked of it, the
    /// aim cannot be reached, or the process is no simulation of film ([`Process::look`] takes any).
    pub fn compile(&self) -> Result<Reference, Error> {
        self.film()?.compile()
    }

    /// The exact simulation with these films instead of those that the process names: data sheets of one's own, read by
    /// [`Stock::parse`].
    ///
    /// # Errors
    /// As [`Process::compile`], but for names of stocks; if only one of process and films has a print.
    pub fn compile_with(&self, films: &Films) -> Result<Reference, Error> {
        self.film()?.compile_with(films)
    }

    /// The description of the film, for what only it has.
    ///
    /// # Errors
    /// If the process is no simulation of film.
    pub fn film(&self) -> Result<&FilmProcess, Error> {
        match self {
            Self::Film(film) => Ok(film),
            Self::Print(_) => Err(no_camera()),
            Self::First(_) | Self::Tone(_) => Err(no_film(self.approach())),
        }
    }
}

/// Refuses what only dyes have of films in silver.
fn check_silver(process: &FilmProcess, films: &Films) -> Result<(), Error> {
    let refuse = |sentence: String| Err(ErrorKind::Contradiction(sentence).into());
    let fixed = matches!(process.inter_image, InterImageChoice::Fixed(fixed) if !fixed.is_none());
    if fixed && films.camera.image() == Image::Silver {
        return refuse(format!(
            "{} has one layer, which inhibits no other: interimage changes nothing, expected film or none",
            films.camera.id()
        ));
    }
    let print = films.print.as_ref().filter(|print| print.image() == Image::Silver);
    match (print, &process.print) {
        (Some(print), Some(printing)) if printing.curves == PrintCurves::Principal => {
            refuse(format!("{} has one layer: print_curves principal changes nothing, expected neutral", print.id()))
        }
        _ => Ok(()),
    }
}

/// The sentence for what needs a film in the camera.
pub(crate) fn no_camera() -> Error {
    ErrorKind::Contradiction("camera is none: there is no camera film, expected a film in the camera".to_owned()).into()
}

/// The sentence for what needs the second approach.
pub(crate) fn no_film(approach: Approach) -> Error {
    ErrorKind::Contradiction(format!(
        "approach {} has no spectra, dyes or film curves, expected approach second",
        approach.word()
    ))
    .into()
}
