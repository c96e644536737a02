//! A film whose sheet was read a little otherwise: what its uncertainty does to pictures.

use onelight_spectra::TablePoints;

use super::{Image, Stock};
use crate::curve::CharacteristicCurve;
use crate::dye::DyeDensity;
use crate::error::Error;
use crate::layer::PerLayer;
use crate::sensitivity::SpectralSensitivity;

/// The sets of figures whose [`Uncertainty`](super::Uncertainty) a data sheet states.
///
/// ```
/// use onelight_film::Figures;
/// assert_eq!(Figures::ALL.len(), 3);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Figures {
    /// log10 of the spectral sensitivity.
    Sensitivity,
    /// Density of the characteristic curve.
    Characteristic,
    /// Spectral density of the dye.
    DyeDensity,
}

impl Figures {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Sensitivity, Self::Characteristic, Self::DyeDensity];
}

impl Stock {
    /// The same film with one set of figures of one layer (0, 1, 2: red, green, blue) read otherwise, by a straight line over wavelength
    /// or log exposure that is 0 in the middle of the published points and whose rms over them is the sheet's uncertainty:
    /// a constant is lost where looks are balanced for grey. `None` where the sheet states no uncertainty, or the picture is of silver.
    ///
    /// ```
    /// use onelight_film::{Figures, LogExposure, SheetText, Stock};
    /// # let f = onelight_stocks::find("kodak-5207").ok_or("no such stock")?;
    /// # let stock = Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
    /// #     characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?;
    /// let steeper = stock.reread(Figures::Characteristic, 0)?.ok_or("no uncertainty")?;
    /// let density = |stock: &Stock| stock.characteristic().red.density(LogExposure(2.0)).0;
    /// assert!(density(&steeper) > density(&stock));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// None for figures that have been read once; the signature is that of the curves.
    pub fn reread(&self, figures: Figures, layer: usize) -> Result<Option<Self>, Error> {
        let stated = self.uncertainty();
        let rms = match figures {
            Figures::Sensitivity => Some(stated.sensitivity),
            Figures::Characteristic => Some(stated.characteristic),
            Figures::DyeDensity => stated.dye_density,
        };
        let rms = rms.and_then(|layers| layers.get(layer).copied()).filter(|rms| *rms > 0.0);
        let Some(rms) = rms.filter(|_| self.image() == Image::Dye) else { return Ok(None) };
        let mut stock = self.clone();
        match figures {
            Figures::Sensitivity => {
                let curve = chosen(&mut stock.sensitivity, layer);
                *curve = SpectralSensitivity::new(moved(curve.wavelengths_nm(), curve.log10_values(), rms))?;
            }
            Figures::Characteristic => {
                let curve = chosen(&mut stock.characteristic, layer);
                let points = moved(curve.log_exposures(), curve.densities(), rms);
                *curve = CharacteristicCurve::new(points.x, &points.y, curve.direction())?;
            }
            Figures::DyeDensity => {
                let curve = chosen(&mut stock.dyes, layer);
                *curve = DyeDensity::dye(moved(curve.wavelengths_nm(), curve.densities(), rms), 0.0)?;
            }
        }
        Ok(Some(stock))
    }
}

fn chosen<T>(layers: &mut PerLayer<T>, layer: usize) -> &mut T {
    match layer {
        0 => &mut layers.red,
        1 => &mut layers.green,
        _ => &mut layers.blue,
    }
}

/// The points, a straight line of this rms added.
fn moved(x: &[f64], y: &[f64], rms: f64) -> TablePoints {
    let mean = x.iter().sum::<f64>() / x.len() as f64;
    let spread = (x.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / x.len() as f64).sqrt();
    let line = |x: f64| rms * (x - mean) / spread;
    TablePoints { x: x.to_vec(), y: x.iter().zip(y).map(|(&x, y)| y + line(x)).collect() }
}
