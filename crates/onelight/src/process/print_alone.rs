use onelight_film::{DyeModel, PrintCurves};
use onelight_printing::{Aim, NEUTRAL_DENSITY, Projector, White};

use super::film::{check_exposure, check_lights};
use super::spaces::ColourSpaces;
use super::stock_ref::{DEFAULT_PRINT, StockRef};
use crate::error::{Error, ErrorKind};

/// A print film behind a negative that was scanned, or that was never shot: what colourists call a print film emulation.
///
/// What comes in are Cineon codes: printing densities of a negative, 0.002 above D-min for each of 1023 codes from 95 on. Printing densities
/// are those that the print sees, so that each channel exposes its own layer, and the printer is set for the grey patch of the digital LAD, code
/// 445, whose density is 0.70 above D-min.
///
/// ```
/// use onelight::{Look, PrintAlone, Process};
/// let Look::Print(print) = Process::from(PrintAlone::on("kodak-2383")).look()? else { return Ok(()) };
/// let grey = print.develop_codes([445.0 / 1023.0; 3]);
/// assert!(grey.iter().all(|v| (v - 10f64.powf(-0.7)).abs() < 1e-6));
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct PrintAlone {
    /// The print film or paper.
    pub film: StockRef,
    /// What the characteristic curves of its sheet are.
    pub curves: PrintCurves,
    /// How densities become amounts of dye.
    pub dyes: DyeModel,
    /// What code 445 becomes.
    pub aim: Aim,
    /// Equivalent neutral density of code 445 in neutral aim, 0.05 to 3.
    pub neutral_density: f64,
    /// Printer points by which red, green and blue light are moved once they are set, -50 to 50.
    pub points: [f64; 3],
    /// The light that the print is seen by.
    pub projector: Projector,
    /// What a viewer takes for white.
    pub white: White,
    /// The RGB that goes out. Codes have no primaries, exposure or white: the others stay as they are by default.
    pub spaces: ColourSpaces,
}

impl Default for PrintAlone {
    fn default() -> Self {
        Self::on(DEFAULT_PRINT)
    }
}

impl PrintAlone {
    /// The usual print on a built-in film.
    #[must_use]
    pub fn on(film: &str) -> Self {
        Self {
            film: film.into(),
            curves: PrintCurves::default(),
            dyes: DyeModel::default(),
            aim: Aim::default(),
            neutral_density: NEUTRAL_DENSITY,
            points: [0.0; 3],
            projector: Projector::default(),
            white: White::default(),
            spaces: ColourSpaces::default(),
        }
    }

    /// Whether the numbers are within their ranges, and every setting changes something.
    pub(crate) fn check(&self) -> Result<(), Error> {
        check_exposure(self.neutral_density, 0.0)?;
        check_lights(&[0.0; 3], &self.points)?;
        let refuse = |what: &str| {
            let sentence = format!(
                "camera is none and codes of a scan are no light: {what} changes nothing, expected it left out"
            );
            Err(ErrorKind::Contradiction(sentence).into())
        };
        let usual = ColourSpaces::default();
        self.spaces.check()?;
        match &self.spaces {
            spaces if spaces.ev != usual.ev => refuse("ev"),
            spaces if spaces.scene_white.is_some() => refuse("scene_white"),
            spaces if spaces.input_space != usual.input_space => refuse("input_space"),
            _ if self.aim == Aim::Sheet && self.neutral_density != NEUTRAL_DENSITY => Err(ErrorKind::Contradiction(
                "aim sheet takes its density from the sheet: neutral_density changes nothing, expected aim neutral"
                    .to_owned(),
            )
            .into()),
            _ => Ok(()),
        }
    }
}
