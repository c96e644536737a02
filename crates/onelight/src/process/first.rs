use onelight_printing::{EquivalentNeutralDensity, NEUTRAL_DENSITY};
use onelight_spectra::Kelvin;
use serde::{Deserialize, Serialize};

use super::spaces::ColourSpaces;
use super::stock_ref::{DEFAULT_CAMERA, DEFAULT_PRINT, StockRef, default_print};
use crate::error::Error;

/// The first approach of \[Gotanda2010\]: the description of it.
///
/// ```
/// use onelight::{FirstControls, FirstProcess, Process};
/// let controls = FirstControls { contrast: 1.2, ..Default::default() };
/// let look = Process::from(FirstProcess { controls, ..FirstProcess::for_camera("fuji-velvia-50")? }).look()?;
/// assert!(look.develop([0.5, 0.2, 0.1])[0] > 0.5);
/// # Ok::<(), onelight::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct FirstProcess {
    /// The film in the camera: a negative or a reversal film.
    pub camera: StockRef,
    /// The film that a negative is printed on; `None` for reversal film.
    pub print: Option<StockRef>,
    /// Equivalent neutral density of a grey card, 0.05 to 3. 0.3 more is a stop darker.
    pub neutral_density: f64,
    /// What a hand changes of matrix and tone curve.
    pub controls: FirstControls,
    /// The RGB that comes in and goes out.
    pub spaces: ColourSpaces,
}

impl Default for FirstProcess {
    fn default() -> Self {
        Self {
            camera: DEFAULT_CAMERA.into(),
            print: Some(DEFAULT_PRINT.into()),
            neutral_density: NEUTRAL_DENSITY,
            controls: FirstControls::default(),
            spaces: ColourSpaces::default(),
        }
    }
}

impl FirstProcess {
    /// The usual process for a built-in camera film: negatives on [`DEFAULT_PRINT`], reversal film as it is.
    ///
    /// # Errors
    /// If no stock has this id, or it is a print film.
    pub fn for_camera(camera: &str) -> Result<Self, Error> {
        Ok(Self { camera: camera.into(), print: default_print(camera)?.map(StockRef::from), ..Self::default() })
    }

    /// Whether the numbers are within their ranges; those of the controls are looked at where they are used.
    pub(crate) fn check(&self) -> Result<(), Error> {
        EquivalentNeutralDensity::new(self.neutral_density)?;
        Ok(())
    }
}

/// What a hand can change in the first approach: the table `[first]` of `look.toml`. The defaults change nothing.
///
/// ```
/// let usual = onelight::FirstControls::default();
/// assert_eq!((usual.contrast, usual.temperature, usual.curve.len()), (1.0, 6500.0, 0));
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FirstControls {
    /// Steepness about the code of mid grey, 0 to 4.
    pub contrast: f64,
    /// Added to the display-coded value, -1 to 1.
    pub brightness: f64,
    /// Colour of the light that white should look like, 2000 to 20000 K.
    pub temperature: f64,
    /// Distance from the grey of the same luma, 0 to 4.
    pub saturation: f64,
    /// Points that the tone curve is bent through, at most 16: stops about mid grey, and display-coded value.
    pub curve: Vec<[f64; 2]>,
}

impl Default for FirstControls {
    fn default() -> Self {
        let temperature = Kelvin::WHITE.value();
        Self { contrast: 1.0, brightness: 0.0, temperature, saturation: 1.0, curve: Vec::new() }
    }
}
