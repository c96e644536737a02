use onelight_film::{DyeModel, InterImage, Matching, PerLayer, PrintCurves, Stock, Tail, WideGamut};
use onelight_printing::{
    Aim, Calibration, EquivalentNeutralDensity, Filters, HeatGlass, Infrared, NEUTRAL_DENSITY, Printer, PrinterLight,
    Projector, ScanRule, White, Wratten,
};
use onelight_spectra::Reconstruction;

use super::effects::Effects;
use super::spaces::ColourSpaces;
use super::stock_ref::{DEFAULT_CAMERA, DEFAULT_PRINT, StockRef, default_print};
use crate::error::{Error, ErrorKind};
use crate::word::Word as _;

/// The simulation of film, second approach of \[Gotanda2010\]: films, lights, and the RGB at both ends.
///
/// ```
/// use onelight::{Aim, FilmProcess, Printing};
/// let film = FilmProcess { aim: Aim::Sheet, ..FilmProcess::for_camera("kodak-portra-400")? };
/// assert!(film.compile()?.develop_linear([0.18; 3])[1] < 0.15);
///
/// // One point more of red light in the printer.
/// let print = Printing { points: [1.0, 0.0, 0.0], ..Default::default() };
/// let cyan = FilmProcess { print: Some(print), ..Default::default() }.compile()?;
/// assert!(cyan.develop([0.18; 3])[0] < cyan.develop([0.18; 3])[1]);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct FilmProcess {
    /// The film in the camera: a negative or a reversal film.
    pub camera: StockRef,
    /// How a negative is printed; `None` for reversal film, which is shown as it is, and where the negative is scanned.
    pub print: Option<Printing>,
    /// The rule by which a negative that is not printed is scanned and inverted.
    pub scan: Option<ScanRule>,
    /// What an 18 % grey card becomes.
    pub aim: Aim,
    /// Equivalent neutral density of a grey card in neutral aim, 0.05 to 3. 0.3 more is a stop darker.
    pub neutral_density: f64,
    /// Stops that the camera film is exposed over its normal exposure, -10 to 10. The printer is set for the grey card so
    /// exposed, as a lab does: grey stays, shadows and highlights move along the film's curves. Reversal film has no print to
    /// correct it: the picture is brighter.
    pub overexposure: f64,
    /// How densities become amounts of dye.
    pub dyes: DyeModel,
    /// How exposures meet the characteristic curves.
    pub matching: Matching,
    /// How strongly the camera film's layers inhibit each other's development.
    pub inter_image: InterImageChoice,
    /// How a spectrum is made for an RGB value.
    pub reconstruction: Reconstruction,
    /// What light outside the sRGB primaries does.
    pub gamut: WideGamut,
    /// The light that the film is seen by.
    pub projector: Projector,
    /// What a viewer takes for white. Grey is aimed at after it, and [`FilmProcess::neutral_density`] is relative to it.
    pub white: White,
    /// What the camera film does to a picture, not to a colour: no map of colours has any of it.
    pub effects: Effects,
    /// The RGB that comes in and goes out.
    pub spaces: ColourSpaces,
}

/// Where the strength of the inter-image effect is from.
///
/// ```
/// use onelight::{FilmProcess, InterImageChoice};
/// use onelight::film::InterImage;
/// let muted = FilmProcess { inter_image: InterImageChoice::Fixed(InterImage::NONE), ..FilmProcess::default() };
/// let (muted, usual) = (muted.compile()?, FilmProcess::default().compile()?);
/// let spread = |rgb: [f64; 3]| rgb[0] - rgb[2];
/// assert!(spread(muted.develop([0.5, 0.2, 0.1])) < spread(usual.develop([0.5, 0.2, 0.1])));
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum InterImageChoice {
    /// The camera film's own: what its data sheet's files say, else that of its kind ([`Stock::inter_image`]).
    #[default]
    Film,
    /// This one, whatever the film.
    Fixed(InterImage),
}

impl InterImageChoice {
    /// The strength for a film: none for one that is not made for a camera.
    #[must_use]
    pub fn of(self, camera: &Stock) -> InterImage {
        match self {
            Self::Film => camera.inter_image().map_or(InterImage::NONE, |(own, _)| own),
            Self::Fixed(fixed) => fixed,
        }
    }
}

/// How a negative is printed: the film behind it, and the printer. Reversal film has none of it.
///
/// ```
/// use onelight::{PrinterLight, Printing};
/// let white = Printing { light: PrinterLight::White, ..Printing::on("kodak-2393") };
/// assert_eq!(white.film.id(), "kodak-2393");
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Printing {
    /// The print film: a stock of kind print.
    pub film: StockRef,
    /// What the characteristic curves of its sheet are.
    pub curves: PrintCurves,
    /// Three separated beams in the printer, or a white one.
    pub light: PrinterLight,
    /// The gelatin filters in the printer.
    pub filters: Filters,
    /// Neutral density in the printer's red, green and blue beam, 0 to 4.
    pub beam_density: [f64; 3],
    /// How the printer's lights are found.
    pub calibration: Calibration,
    /// Printer points by which red, green and blue light are moved once they are found, -50 to 50
    /// ([`onelight_printing::POINT_LOG_EXPOSURE`] each): the lab's colour correction.
    pub points: [f64; 3],
    /// Whether infrared takes part in printing.
    pub infrared: Infrared,
    /// The heat glass of the printer.
    pub glass: HeatGlass,
    /// How the print's red layer goes on beyond its sheet.
    pub red_tail: Tail,
}

impl Default for Printing {
    fn default() -> Self {
        Self::on(DEFAULT_PRINT)
    }
}

impl Default for FilmProcess {
    fn default() -> Self {
        Self {
            camera: DEFAULT_CAMERA.into(),
            print: Some(Printing::default()),
            scan: None,
            aim: Aim::default(),
            neutral_density: NEUTRAL_DENSITY,
            overexposure: 0.0,
            dyes: DyeModel::default(),
            matching: Matching::default(),
            inter_image: InterImageChoice::default(),
            reconstruction: Reconstruction::default(),
            gamut: WideGamut::default(),
            projector: Projector::default(),
            white: White::default(),
            effects: Effects::default(),
            spaces: ColourSpaces::default(),
        }
    }
}

impl FilmProcess {
    /// The usual process for a built-in camera film: negatives on [`DEFAULT_PRINT`], reversal film as it is.
    ///
    /// # Errors
    /// If no stock has this id, or it is a print film.
    pub fn for_camera(camera: &str) -> Result<Self, Error> {
        Ok(Self { camera: camera.into(), print: default_print(camera)?.map(Printing::on), ..Self::default() })
    }

    /// A built-in negative that is scanned instead of printed: densities above its base, status M or visual, are taken for the logarithm
    /// of light by the Cineon system's rule ([`onelight_printing::Scan`]), and a grey card is balanced. What scanners and their programs
    /// add to it, such as curves of their own, is not published.
    ///
    /// ```
    /// use onelight::FilmProcess;
    /// let scan = FilmProcess::scanned("kodak-portra-400").compile()?;
    /// let [dark, grey, bright] = [0.09, 0.18, 0.36].map(|v| scan.develop_linear([v; 3])[1]);
    /// assert!((grey - 10f64.powf(-0.7)).abs() < 1e-9);
    /// // The scene's own contrast, which a print raises.
    /// assert!((bright / dark).log2() < 2.3);
    /// assert!(FilmProcess::scanned("fuji-velvia-50").compile().is_err());
    /// # Ok::<(), onelight::Error>(())
    /// ```
    #[must_use]
    pub fn scanned(camera: &str) -> Self {
        Self { camera: camera.into(), print: None, scan: Some(ScanRule::default()), ..Self::default() }
    }

    /// The same process as the talk has it, film by its sheet alone: layers that do not inhibit each other, the bare lamp for white,
    /// light outside the sRGB primaries clipped (\[Gotanda2010\]). The preset `talk` of the command line.
    ///
    /// ```
    /// use onelight::FilmProcess;
    /// let talk = FilmProcess::default().as_in_the_talk().compile()?;
    /// // Clear film is yellowish and not bright.
    /// let white = talk.develop_linear([1e6; 3]);
    /// assert!(white[0] < 0.95 && white[2] < 0.85);
    /// # Ok::<(), onelight::Error>(())
    /// ```
    #[must_use]
    pub fn as_in_the_talk(self) -> Self {
        let inter_image = InterImageChoice::Fixed(InterImage::NONE);
        // A scan has no film on the screen, and no white but the display's.
        let white = if self.scan.is_some() { self.white } else { White::Lamp };
        Self { inter_image, white, gamut: WideGamut::Clip, ..self }
    }

    /// Whether the numbers are within their ranges, and every setting changes something.
    pub(crate) fn check(&self) -> Result<(), Error> {
        check_exposure(self.neutral_density, self.overexposure)?;
        self.effects.check()?;
        if let Some(print) = &self.print {
            check_lights(&print.beam_density, &print.points)?;
        }
        if self.aim == Aim::Sheet && self.neutral_density != NEUTRAL_DENSITY {
            return Err(ErrorKind::Contradiction(
                "aim sheet takes its density from the sheet: neutral_density changes nothing, expected aim neutral"
                    .to_owned(),
            )
            .into());
        }
        if self.dyes == DyeModel::Literal && self.print.as_ref().is_some_and(|p| p.curves == PrintCurves::Principal) {
            return Err(ErrorKind::Contradiction(
                "dyes literal takes each density of a print for its dye's amount: print_curves principal changes nothing, \
                 expected dyes wedge or constants"
                    .to_owned(),
            )
            .into());
        }
        self.check_scan()?;
        self.print.as_ref().map_or(Ok(()), Printing::check)
    }

    /// Refuses what a scan has nothing for.
    fn check_scan(&self) -> Result<(), Error> {
        let sentence = match self.scan {
            None => return Ok(()),
            _ if self.print.is_some() => "a scan is no print: the process has both, expected one of them",
            _ if self.aim == Aim::Sheet => {
                "a scan has no sheet that states an aim, expected aim neutral instead of sheet"
            }
            _ if self.projector != Projector::default() => {
                "a scan is not projected: projector changes nothing, expected it left out"
            }
            _ if self.white != White::default() => {
                "a scan has no film on the screen: white changes nothing, expected it left out"
            }
            Some(ScanRule::Cineon) => return Ok(()),
        };
        Err(ErrorKind::Contradiction(sentence.to_owned()).into())
    }
}

impl Printing {
    /// The usual printing on a built-in film.
    #[must_use]
    pub fn on(film: &str) -> Self {
        Self {
            film: film.into(),
            curves: PrintCurves::default(),
            light: PrinterLight::default(),
            filters: Filters::default(),
            beam_density: Printer::default().beam_density.to_array(),
            calibration: Calibration::default(),
            points: [0.0; 3],
            infrared: Infrared::default(),
            glass: HeatGlass::default(),
            red_tail: Tail::default(),
        }
    }

    /// The printer's settings by themselves.
    #[must_use]
    pub fn printer(&self) -> Printer {
        Printer {
            light: self.light,
            filters: self.filters,
            beam_density: PerLayer::from(self.beam_density),
            infrared: self.infrared,
            glass: self.glass,
            red_tail: self.red_tail,
        }
    }

    fn check(&self) -> Result<(), Error> {
        let usual = Printer::default().beam_density.to_array();
        if self.calibration == Calibration::Exact && self.beam_density != usual {
            let sentence = "calibration exact finds the lights whatever density is in the beams: beam_density changes nothing, \
                            expected it left out, or calibration with a number of iterations";
            return Err(ErrorKind::Contradiction(sentence.to_owned()).into());
        }
        let separations = [Wratten::No70, Wratten::No99, Wratten::No98];
        if self.light != PrinterLight::Separations && !separations.iter().all(|filter| self.filters.contains(*filter)) {
            let sentence = format!(
                "light {} has no separation filters: taking them out changes nothing, expected filters with 70, 99 and 98 or light separations",
                self.light.word()
            );
            return Err(ErrorKind::Contradiction(sentence).into());
        }
        Ok(())
    }
}

/// Whether density of grey and overexposure are within their ranges.
pub(crate) fn check_exposure(neutral_density: f64, overexposure: f64) -> Result<(), Error> {
    EquivalentNeutralDensity::new(neutral_density)?;
    within("overexposure", overexposure, -10.0, 10.0)
}

/// Whether densities of beams and printer points are within their ranges.
pub(crate) fn check_lights(beam_density: &[f64; 3], points: &[f64; 3]) -> Result<(), Error> {
    beam_density.iter().try_for_each(|v| within("beam_density", *v, 0.0, 4.0))?;
    points.iter().try_for_each(|v| within("points", *v, -50.0, 50.0))
}

fn within(what: &str, found: f64, low: f64, high: f64) -> Result<(), Error> {
    if (low..=high).contains(&found) { Ok(()) } else { Err(Error::setting(what, found, low, high)) }
}
