use onelight_film::{DyeModel, Matching, PrintCurves, Tail, WideGamut};
use onelight_printing::{
    Aim, Calibration, Filters, HeatGlass, Infrared, NEUTRAL_DENSITY, Printer, PrinterLight, Projector, White,
};
use onelight_spatial::{Antihalation, FilmFormat};
use onelight_spectra::{HDR_WHITE_CD_M2, Reconstruction, SceneWhite, TransferCurve};
use serde::{Deserialize, Serialize};

use super::version::FormatVersion;
use super::word_lists::{
    self, parse_antihalation, parse_calibration, parse_film_format, parse_inter_image, parse_print, parse_scene_white,
};
use crate::error::Error;
use crate::process::{
    Approach, DEFAULT_CAMERA, DEFAULT_PRINT, EffectChoice, Effects, FilmProcess, FirstControls, InterImageChoice, SCAN,
};
use crate::word::{self, WorkingSpace};

/// Every key of `look.toml` with its value: what a file says and a command line changes before it is one kind of [`Process`].
///
/// Here a key may stand beside others that make it mean nothing, such as the filters of a printer beside a reversal film;
/// [`ProcessKeys::process`] refuses that. In Rust, [`FilmProcess`](crate::FilmProcess) and its like are the shorter way.
///
/// ```
/// use onelight::{Aim, ProcessKeys};
/// let mut keys = ProcessKeys::from_toml("look.toml", "version = 2\ncamera = \"fuji-velvia-50\"\n")?;
/// keys.aim = Aim::Sheet;
/// assert_eq!(keys.process()?.name(), "fuji-velvia-50");
/// keys.points = [1.0, 0.0, 0.0];
/// assert!(keys.process().unwrap_err().to_string().contains("points changes nothing"));
/// # Ok::<(), onelight::Error>(())
/// ```
///
/// [`Process`]: crate::Process
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ProcessKeys {
    /// The version that the description was written in; it is written in the newest.
    pub version: FormatVersion,
    /// The simulation, the talk's first approach, or a tone mapping to compare with.
    #[serde(with = "word::text")]
    pub approach: Approach,
    /// Id of the film in the camera: a negative or a reversal film; `"none"` where codes of a scanned negative are printed. Tone
    /// mappings read it and leave it out.
    pub camera: String,
    /// The folder of the camera film's data sheet, unless it is built in.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera_sheet: Option<String>,
    /// SHA-256 of that sheet, as [`OwnSheet::sha256`](crate::OwnSheet::sha256).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera_sha256: Option<String>,
    /// Id of the film that a negative is printed on; `"scan"` for a negative that is scanned and inverted
    /// ([`FilmProcess::scanned`](crate::FilmProcess::scanned)), `None` (`"none"` in text) for reversal film.
    #[serde(with = "word_lists::print")]
    pub print: Option<String>,
    /// The folder of the print film's data sheet, unless it is built in.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub print_sheet: Option<String>,
    /// SHA-256 of that sheet, as [`OwnSheet::sha256`](crate::OwnSheet::sha256).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub print_sha256: Option<String>,
    /// What an 18 % grey card becomes.
    #[serde(with = "word::text")]
    pub aim: Aim,
    /// Equivalent neutral density of a grey card in neutral aim, 0.05 to 3.
    pub neutral_density: f64,
    /// Stops that the camera film is exposed over its normal exposure, -10 to 10.
    pub overexposure: f64,
    /// How densities become amounts of dye.
    #[serde(with = "word::text")]
    pub dyes: DyeModel,
    /// How exposures meet the characteristic curves.
    #[serde(with = "word::text")]
    pub matching: Matching,
    /// How strongly the camera film's layers inhibit each other's development: `"film"` for its own.
    #[serde(rename = "interimage", with = "word_lists::inter_image")]
    pub inter_image: InterImageChoice,
    /// How a spectrum is made for an RGB value.
    #[serde(with = "word::text")]
    pub reconstruction: Reconstruction,
    /// What light outside the sRGB primaries does.
    #[serde(with = "word::text")]
    pub gamut: WideGamut,
    /// What the characteristic curves of the print film's sheet are.
    #[serde(with = "word::text")]
    pub print_curves: PrintCurves,
    /// Three separated beams in the printer, or a white one.
    #[serde(with = "word::text")]
    pub light: PrinterLight,
    /// The gelatin filters in the printer.
    #[serde(with = "word_lists::filters")]
    pub filters: Filters,
    /// Neutral density in the printer's red, green and blue beam, 0 to 4.
    pub beam_density: [f64; 3],
    /// How the printer's lights are found: `"exact"`, or the talk's iterations (`"0"` to `"30"`).
    #[serde(with = "word_lists::calibration")]
    pub calibration: Calibration,
    /// Printer points on red, green and blue light, -50 to 50.
    pub points: [f64; 3],
    /// Whether infrared takes part in printing.
    #[serde(with = "word::text")]
    pub infrared: Infrared,
    /// The heat glass of the printer.
    #[serde(with = "word::text")]
    pub glass: HeatGlass,
    /// How the print's red layer goes on beyond its sheet.
    #[serde(with = "word::text")]
    pub red_tail: Tail,
    /// The light that the film is seen by.
    #[serde(with = "word::text")]
    pub projector: Projector,
    /// What a viewer takes for white.
    #[serde(with = "word::text")]
    pub white: White,
    /// Stops by which the scene is made brighter, -20 to 20.
    pub ev: f64,
    /// The light that is to become neutral: `"none"`, or kelvin and a tint as `"3200"` or `"5600,10"`.
    #[serde(with = "word_lists::scene_white")]
    pub scene_white: Option<SceneWhite>,
    /// How large the picture is on the film, for sharpness, halation and grain; `None` (`"none"` in text) leaves them out.
    #[serde(with = "word_lists::film_format")]
    pub film_format: Option<FilmFormat>,
    /// Whether grain is run.
    #[serde(with = "word::text")]
    pub grain: EffectChoice,
    /// Whether scatter and adjacency are run.
    #[serde(with = "word::text")]
    pub sharpness: EffectChoice,
    /// Whether halation is run.
    #[serde(with = "word::text")]
    pub halation: EffectChoice,
    /// Density of the antihalation layer, 0 to 3, or `"none"` for a film without one.
    #[serde(with = "word_lists::antihalation")]
    pub antihalation: Antihalation,
    /// Another seed, another pattern of grain.
    pub seed: u32,
    /// Primaries of the scene-linear RGB that comes in.
    #[serde(with = "word::text")]
    pub input_space: WorkingSpace,
    /// Primaries of the display RGB that goes out.
    #[serde(with = "word::text")]
    pub output_space: WorkingSpace,
    /// Transfer curve of the display RGB that goes out.
    #[serde(with = "word::text")]
    pub output_coding: TransferCurve,
    /// Luminance of the display's (1, 1, 1) in cd/m^2, for PQ and HLG.
    pub white_luminance: f64,
    /// What a hand changes in the first approach.
    pub first: FirstControls,
}

impl Default for ProcessKeys {
    fn default() -> Self {
        let Effects { film_format, grain, sharpness, halation, antihalation, seed } = Effects::default();
        Self {
            version: FormatVersion::default(),
            approach: Approach::default(),
            camera: DEFAULT_CAMERA.to_owned(),
            camera_sheet: None,
            camera_sha256: None,
            print: Some(DEFAULT_PRINT.to_owned()),
            print_sheet: None,
            print_sha256: None,
            aim: Aim::default(),
            neutral_density: NEUTRAL_DENSITY,
            overexposure: 0.0,
            dyes: DyeModel::default(),
            matching: Matching::default(),
            inter_image: InterImageChoice::default(),
            reconstruction: Reconstruction::default(),
            gamut: WideGamut::default(),
            print_curves: PrintCurves::default(),
            light: PrinterLight::default(),
            filters: Filters::default(),
            beam_density: Printer::default().beam_density.to_array(),
            calibration: Calibration::default(),
            points: [0.0; 3],
            infrared: Infrared::default(),
            glass: HeatGlass::default(),
            red_tail: Tail::default(),
            projector: Projector::default(),
            white: White::default(),
            ev: 0.0,
            scene_white: None,
            film_format,
            grain,
            sharpness,
            halation,
            antihalation,
            seed,
            input_space: WorkingSpace::default(),
            output_space: WorkingSpace::default(),
            output_coding: TransferCurve::default(),
            white_luminance: HDR_WHITE_CD_M2,
            first: FirstControls::default(),
        }
    }
}

/// The folder and the digest of a data sheet of one's own, as two keys have them.
///
/// ```
/// use onelight::ProcessKeys;
/// let keys = ProcessKeys { camera_sheet: Some("mine".into()), camera_sha256: Some("00".into()), ..ProcessKeys::default() };
/// assert_eq!(keys.camera_sheet().map(|sheet| sheet.path), Some("mine"));
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SheetKeys<'a> {
    /// The folder, as seen from the folder of the `look.toml`.
    pub path: &'a str,
    /// The digest written beside it.
    pub sha256: &'a str,
}

impl ProcessKeys {
    /// The camera film's own sheet, if both of its keys are there.
    #[must_use]
    pub fn camera_sheet(&self) -> Option<SheetKeys<'_>> {
        sheet(self.camera_sheet.as_deref(), self.camera_sha256.as_deref())
    }

    /// The print film's own sheet, if both of its keys are there.
    #[must_use]
    pub fn print_sheet(&self) -> Option<SheetKeys<'_>> {
        sheet(self.print_sheet.as_deref(), self.print_sha256.as_deref())
    }

    /// Film by its sheet alone, as the talk has it: the settings of [`FilmProcess::as_in_the_talk`].
    pub fn set_talk(&mut self) {
        let FilmProcess { inter_image, white, gamut, .. } = FilmProcess::default().as_in_the_talk();
        (self.inter_image, self.gamut) = (inter_image, gamut);
        // A scan has no film on the screen, and no white but the display's.
        if self.print.as_deref() != Some(SCAN) {
            self.white = white;
        }
    }

    /// What `interimage` is for a word: `film`, `none`, `negative`, `reversal`, or two numbers as `0.6,0.06`.
    ///
    /// # Errors
    /// If the word is none of these, or a number is out of its range.
    pub fn parse_inter_image(word: &str) -> Result<InterImageChoice, Error> {
        parse_inter_image(word)
    }

    /// What `print` is for a word: the id of a film, `scan`, or `None` for `none`.
    ///
    /// # Errors
    /// If the word is `none` or `scan` in capitals.
    pub fn parse_print(word: &str) -> Result<Option<String>, Error> {
        parse_print(word)
    }

    /// What `scene_white` is for a word: `none`, or kelvin and a tint as `3200` or `5600,10`.
    ///
    /// # Errors
    /// If it is neither `none` nor one or two numbers in their ranges.
    pub fn parse_scene_white(word: &str) -> Result<Option<SceneWhite>, Error> {
        parse_scene_white(word)
    }

    /// What `film_format` is for a word: a name or a width such as `24.9mm`, `None` for `none`.
    ///
    /// # Errors
    /// If the word is none of these, or the width is out of range.
    pub fn parse_film_format(word: &str) -> Result<Option<FilmFormat>, Error> {
        parse_film_format(word)
    }

    /// What `antihalation` is for a word: a density, or `none`.
    ///
    /// # Errors
    /// If the word is neither.
    pub fn parse_antihalation(word: &str) -> Result<Antihalation, Error> {
        parse_antihalation(word)
    }

    /// What `calibration` is for a word: `exact`, or a number of iterations.
    ///
    /// # Errors
    /// If the word is neither `exact` nor a number of iterations.
    pub fn parse_calibration(word: &str) -> Result<Calibration, Error> {
        parse_calibration(word)
    }
}

fn sheet<'a>(path: Option<&'a str>, sha256: Option<&'a str>) -> Option<SheetKeys<'a>> {
    path.zip(sha256).map(|(path, sha256)| SheetKeys { path, sha256 })
}
