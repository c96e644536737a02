use nalgebra::{Matrix3, Vector3};
use onelight_film::{DyeAmount, Dyes, Image, LogExposure, PerLayer, Stock, Tail};
use onelight_spectra::SpectralDistribution;

use crate::error::{Error, ErrorKind, expect_pair};
use crate::printer::{Printer, PrinterLight, PrinterLights};
use crate::spectral_row::{SpectralRow, transmitted};

/// How the printer's lights are found.
///
/// ```
/// use onelight_printing::Calibration;
/// assert_eq!(Calibration::default(), Calibration::Exact);
/// let talk = Calibration::Iterations(1);
/// # let _ = talk;
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Calibration {
    /// By solving for them: exposure is linear in the lights.
    #[default]
    Exact,
    /// The talk's way, stopped after so many corrections ([`Duplication::calibrate_by_iteration`]). One is enough for the eye:
    /// docs/talk.md has the errors.
    Iterations(u8),
}

/// A negative in a printer over a print film: from amounts of dye to the exposure of the print's layers.
///
/// ```
/// use onelight_film::{DyeModel, PerLayer, SheetText, Stock};
/// use onelight_printing::{Calibration, Duplication, Printer, print_mid_grey};
/// # fn read(id: &str) -> Result<Stock, Box<dyn std::error::Error>> {
/// #     let f = onelight_stocks::find(id).ok_or("no such stock")?;
/// #     Ok(Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #         characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?)
/// # }
/// let (negative, print) = (read("kodak-5207")?, read("kodak-2383")?);
/// let mid_grey = PerLayer::all(negative.mid_grey()?);
/// let grey_card = DyeModel::Wedge.amounts(&negative, mid_grey)?.as_ref().zip_map(mid_grey, |curve, h| curve.amount(h));
///
/// // The lights that print a grey card as the sheet of the print film wants it.
/// let printer = Duplication::new(&negative, &print, Printer::default())?;
/// let target = print_mid_grey(&print)?;
/// let exact = printer.calibrate(grey_card, target)?;
/// let found = printer.lit(exact).expose(grey_card);
/// assert!((found.red.0 - target.red.0).abs() < 1e-12);
///
/// // The talk's one iteration comes near.
/// let near = printer.calibrate_by(Calibration::Iterations(1), grey_card, target)?;
/// assert!((near.0.red / exact.0.red - 1.0).abs() < 0.02);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Duplication {
    negative: String,
    print: String,
    dyes: Dyes,
    /// Beam k of print layer j, wavelength by wavelength: `weights[j][k]`, trapezoid and 1 nm included.
    weights: [[Vec<f64>; 3]; 3],
}

impl Duplication {
    /// `negative` on `print` in `printer`; also a reversal film on reversal paper. Black and white has one layer: it is lit by one
    /// white beam whatever `printer` says of light and red tail.
    ///
    /// # Errors
    /// If a film is of the wrong kind.
    pub fn new(negative: &Stock, print: &Stock, printer: Printer) -> Result<Self, Error> {
        expect_pair(negative, print)?;
        let printer = match print.image() {
            Image::Dye => printer,
            Image::Silver => Printer { light: PrinterLight::White, red_tail: Tail::LogLinear, ..printer },
        };
        let shape = printer.shape();
        let beams = printer.beams()?.to_array();
        let tails = PerLayer { red: printer.red_tail, green: Tail::LogLinear, blue: Tail::LogLinear };
        let layers =
            print.sensitivity().zip_map(tails, |s, tail| (s, tail)).try_map(|(s, tail), _| s.on(shape, tail))?;
        let nm: Vec<f64> = shape.trapezoid_weights_nm().collect();
        let weights = layers.to_array().map(|layer| {
            std::array::from_fn(|k| (0..nm.len()).map(|i| nm[i] * layer.values()[i] * beams[k].values()[i]).collect())
        });
        let weights = match printer.light {
            PrinterLight::Separations | PrinterLight::ColourHead => weights,
            PrinterLight::White => only_its_own(weights),
        };
        let (negative, print) = (negative, print.id().to_owned());
        Ok(Self { negative: negative.id().to_owned(), print, dyes: negative.dyes_on(shape)?, weights })
    }

    /// Exposure of print layer j (row) by beam k (column) at unit strength, through a negative that holds `amounts`.
    #[must_use]
    pub fn response(&self, amounts: PerLayer<DyeAmount>) -> Matrix3<f64> {
        let film = self.dyes.density(amounts).transmittance();
        let through = |w: &Vec<f64>| -> f64 { w.iter().zip(film.values()).map(|(w, t)| w * t).sum() };
        Matrix3::from_fn(|j, k| through(&self.weights[j][k]))
    }

    /// The lights that give a print of `amounts` (a grey card's) the exposures `target`, found as `how` says.
    ///
    /// # Errors
    /// If a light would have to be negative or no finite lights do it: the aim cannot be reached.
    pub fn calibrate_by(
        &self,
        how: Calibration,
        amounts: PerLayer<DyeAmount>,
        target: PerLayer<LogExposure>,
    ) -> Result<PrinterLights, Error> {
        match how {
            Calibration::Exact => self.calibrate(amounts, target),
            Calibration::Iterations(count) => self.calibrate_by_iteration(amounts, target, count.into()),
        }
    }

    /// The lights that give a print of `amounts` (a grey card's) the exposures `target`: an exact solution, exposure being
    /// linear in the lights.
    ///
    /// # Errors
    /// If a light would have to be negative or no finite lights do it: the aim cannot be reached.
    pub fn calibrate(
        &self,
        amounts: PerLayer<DyeAmount>,
        target: PerLayer<LogExposure>,
    ) -> Result<PrinterLights, Error> {
        let target = Vector3::from(target.map(LogExposure::exposure).to_array());
        let response = self.response(amounts);
        let directions = Matrix3::from_columns(&std::array::from_fn::<_, 3, _>(|k| response.column(k).normalize()));
        // Not 0 to the last bit where beams differ in strength alone.
        if directions.determinant().abs() < LEAST_VOLUME {
            return Err(self.dependent());
        }
        let lights = response.lu().solve(&target).filter(|g| g.iter().all(|v| v.is_finite()));
        let lights = lights.ok_or_else(|| self.dependent())?;
        self.checked(PerLayer::from([lights.x, lights.y, lights.z]))
    }

    /// The talk's way to the same lights (\[Gotanda2010\]): from equal lights, `iterations` times correct each beam by what its
    /// own layer misses.
    ///
    /// # Errors
    /// If a light ends negative: the aim cannot be reached in this way.
    pub fn calibrate_by_iteration(
        &self,
        amounts: PerLayer<DyeAmount>,
        target: PerLayer<LogExposure>,
        iterations: usize,
    ) -> Result<PrinterLights, Error> {
        let target = Vector3::from(target.map(LogExposure::exposure).to_array());
        let response = self.response(amounts);
        let own = response.diagonal();
        let mut lights = Vector3::repeat(target.component_div(&own).product().cbrt());
        for _ in 0..iterations {
            lights += (target - response * lights).component_div(&own);
        }
        self.checked(PerLayer::from([lights.x, lights.y, lights.z]))
    }

    /// The printer with its lights set.
    #[must_use]
    pub fn lit(&self, lights: PrinterLights) -> LitDuplication {
        let g = lights.0.to_array();
        let [c, m, y] = self.dyes.dyes().map(SpectralDistribution::values).to_array();
        let rows = (0..c.len()).map(|i| SpectralRow {
            dyes: [c[i], m[i], y[i]],
            base: self.dyes.d_min().map_or(0.0, |d| d.values()[i]),
            weights: std::array::from_fn(|j| (0..3).map(|k| g[k] * self.weights[j][k][i]).sum()),
        });
        LitDuplication { rows: rows.collect() }
    }

    fn checked(&self, lights: PerLayer<f64>) -> Result<PrinterLights, Error> {
        if lights.to_array().iter().all(|&g| g > 0.0) {
            return Ok(PrinterLights(lights));
        }
        Err(ErrorKind::NegativeLight { negative: self.negative.clone(), print: self.print.clone(), lights }.into())
    }

    fn dependent(&self) -> Error {
        ErrorKind::Dependent { negative: self.negative.clone(), print: self.print.clone() }.into()
    }
}

/// Where the directions of the three lights span less volume than this, two of them do the same.
const LEAST_VOLUME: f64 = 1e-9;

/// Each layer of the print gets light `k` of its own colour alone: a white beam balanced layer by layer.
fn only_its_own(mut weights: [[Vec<f64>; 3]; 3]) -> [[Vec<f64>; 3]; 3] {
    for (j, layer) in weights.iter_mut().enumerate() {
        for (_, other) in layer.iter_mut().enumerate().filter(|(k, _)| *k != j) {
            other.fill(0.0);
        }
    }
    weights
}

/// A [`Duplication`] with its lights set: what a picture goes through.
///
/// ```
/// use onelight_film::{DyeAmount, PerLayer, SheetText, Stock};
/// use onelight_printing::{Duplication, Printer, PrinterLights};
/// # fn read(id: &str) -> Result<Stock, Box<dyn std::error::Error>> {
/// #     let f = onelight_stocks::find(id).ok_or("no such stock")?;
/// #     Ok(Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #         characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?)
/// # }
/// let (negative, print) = (read("kodak-5207")?, read("kodak-2383")?);
/// let lit = Duplication::new(&negative, &print, Printer::default())?.lit(PrinterLights(PerLayer::all(100.0)));
/// // More cyan in the negative: less red light for the print.
/// let [thin, dense] = [0.2, 1.2].map(|cyan| lit.expose(PerLayer { red: DyeAmount(cyan), ..PerLayer::all(DyeAmount(0.5)) }));
/// assert!(dense.red < thin.red);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct LitDuplication {
    rows: Vec<SpectralRow>,
}

impl LitDuplication {
    /// Log exposure of the print's layers behind a negative that holds `amounts`.
    #[must_use]
    pub fn expose(&self, amounts: PerLayer<DyeAmount>) -> PerLayer<LogExposure> {
        PerLayer::from(transmitted(&self.rows, amounts.map(|a| a.0).to_array())).map(LogExposure::of)
    }

    /// Wavelength by wavelength, by 1 nm: the sums are the exposures of the print's red, green and blue layer.
    #[must_use]
    pub fn rows(&self) -> &[SpectralRow] {
        &self.rows
    }
}
