use nalgebra::{Matrix3, Vector3};
use onelight_spectra::{Basis, MID_GREY, SpectralShape, lux_to_w_per_m2};

use super::wide_gamut::WideGamut;
use crate::error::Error;
use crate::layer::PerLayer;
use crate::metering::MID_GREY_LUX_S;
use crate::quantity::{Density, LogExposure};
use crate::sensitivity::Tail;
use crate::stock::{ExposureAxis, Stock};

/// How exposures meet the axis of the characteristic curves: what fixes the matching vector.
///
/// ```
/// use onelight_film::{ExposureMatrix, Matching, PerLayer, SheetText, Stock};
/// use onelight_spectra::{Basis, Reconstruction};
/// # fn read(id: &str) -> Result<Stock, Box<dyn std::error::Error>> {
/// #     let f = onelight_stocks::find(id).ok_or("no such stock")?;
/// #     Ok(Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #         characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?)
/// # }
/// // The sheet of 5207 has a relative axis: it does not say what an exposure in lux s does.
/// let (stock, basis) = (read("kodak-5207")?, Basis::new(Reconstruction::Smooth)?);
/// let mid_grey = PerLayer::all(stock.mid_grey()?);
/// let error = ExposureMatrix::new(&stock, &basis, Matching::Absolute, mid_grey).unwrap_err();
/// assert!(error.is_not_published());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Matching {
    /// An 18 % grey under the 6500 K white lands on the mid grey of all three curves: the film is balanced for its light.
    #[default]
    Grey,
    /// The sheet's own units: the sensitivity makes the criterion density. Lights other than the sheet's leave a cast.
    Absolute,
}

/// Scene RGB (sRGB primaries, 6500 K white) to the exposure of each layer: E = K u. Spectrum, sensitivity and matching
/// vector in one 3x3 matrix, integrated at 1 nm. Light outside the primaries as [`WideGamut`] says.
///
/// ```
/// use onelight_film::{ExposureMatrix, LogExposure, Matching, PerLayer, SheetText, Stock};
/// use onelight_spectra::{Basis, MID_GREY, Reconstruction};
/// # fn read(id: &str) -> Result<Stock, Box<dyn std::error::Error>> {
/// #     let f = onelight_stocks::find(id).ok_or("no such stock")?;
/// #     Ok(Stock::parse(&SheetText { id: f.id, stock_toml: f.stock_toml, sensitivity_csv: f.sensitivity_csv,
/// #         characteristic_csv: f.characteristic_csv, dye_density_csv: f.dye_density_csv })?)
/// # }
/// let (stock, basis) = (read("kodak-5207")?, Basis::new(Reconstruction::Smooth)?);
/// let mid_grey = stock.mid_grey()?;
/// let matrix = ExposureMatrix::new(&stock, &basis, Matching::Grey, PerLayer::all(mid_grey))?;
/// // A grey card lands on the mid grey of all three curves.
/// let red = LogExposure::of(matrix.expose([MID_GREY; 3]).red);
/// assert!((red.0 - mid_grey.0).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct ExposureMatrix {
    matrix: Matrix3<f64>,
    matching: PerLayer<f64>,
    gamut: WideGamut,
}

impl ExposureMatrix {
    /// The matrix of a camera film; `mid_grey` is where [`Matching::Grey`] puts 18 % grey.
    ///
    /// # Errors
    /// If the sheet does not say what the matching needs.
    pub fn new(
        stock: &Stock,
        basis: &Basis,
        matching: Matching,
        mid_grey: PerLayer<LogExposure>,
    ) -> Result<Self, Error> {
        let sensors = sensors(stock, basis)?;
        let grey = PerLayer::from(<[f64; 3]>::from(sensors * Vector3::repeat(MID_GREY)));
        let vector = match matching {
            Matching::Grey => mid_grey.zip_map(grey, |h, response| h.exposure() / response),
            Matching::Absolute => absolute(stock, basis)?,
        };
        let matrix = Matrix3::from_diagonal(&Vector3::from(vector.to_array())) * sensors;
        Ok(Self { matrix, matching: vector, gamut: WideGamut::default() })
    }

    /// The same film exposed so many stops more.
    #[must_use]
    pub fn overexposed(self, stops: f64) -> Self {
        let factor = stops.exp2();
        Self { matrix: self.matrix * factor, matching: self.matching.map(|c| c * factor), ..self }
    }

    /// The same film, light outside the sRGB primaries taken so.
    #[must_use]
    pub fn with_gamut(self, gamut: WideGamut) -> Self {
        Self { gamut, ..self }
    }

    /// Exposure of each layer for a scene-linear RGB (sRGB primaries, 6500 K white), on the axis of the characteristic curves.
    #[must_use]
    pub fn expose(&self, scene_linear: [f64; 3]) -> PerLayer<f64> {
        PerLayer::from(self.gamut.expose(&self.matrix, scene_linear))
    }

    /// What light outside the sRGB primaries does.
    #[must_use]
    pub fn gamut(&self) -> WideGamut {
        self.gamut
    }

    /// The matrix, the matching vector in it; row i is layer i.
    #[must_use]
    pub fn matrix(&self) -> &Matrix3<f64> {
        &self.matrix
    }

    /// The matching vector: by what the response of each layer is multiplied to be an exposure on its axis.
    #[must_use]
    pub fn matching_vector(&self) -> PerLayer<f64> {
        self.matching
    }
}

/// Response of layer i to primary k of the basis (1.0 at 560 nm for white): integrated at 1 nm.
fn sensors(stock: &Stock, basis: &Basis) -> Result<Matrix3<f64>, Error> {
    let mut sensors = Matrix3::zeros();
    for (i, sensitivity) in stock.sensitivity().to_array().into_iter().enumerate() {
        let sensitivity = sensitivity.on(SpectralShape::VISIBLE, Tail::LogLinear)?;
        for k in 0..3 {
            let mut primary = [0.0; 3];
            primary[k] = 1.0;
            sensors[(i, k)] = basis.spectrum(primary).response(&sensitivity);
        }
    }
    Ok(sensors)
}

/// Mid grey gets the metered exposure of the stock's speed; from there the sheet's own units decide.
fn absolute(stock: &Stock, basis: &Basis) -> Result<PerLayer<f64>, Error> {
    let refuse = |problem: &str| Error::stock(stock.id(), format!("absolute matching needs {problem}"));
    let criterion =
        stock.criterion().ok_or_else(|| refuse("the sheet's sensitivity criterion, which it does not state"))?;
    let speed = stock.exposure_index().ok_or_else(|| refuse("an exposure index, which the sheet does not state"))?;
    if stock.axis() == ExposureAxis::Relative {
        return Err(refuse("characteristic curves over lux s, but the sheet's axis is relative"));
    }
    // mJ/m^2 of white light at scene value 1, spread over its spectrum.
    let white_mj = 1000.0 * lux_to_w_per_m2(MID_GREY_LUX_S / speed) / MID_GREY;
    let scale = white_mj / basis.white().integral();
    stock.characteristic().try_map(|curve, layer| {
        let density = Density(curve.d_min().0 + criterion.0);
        let h = curve.log_exposure(density);
        let h = h.ok_or_else(|| {
            refuse(&format!("density {:.2} on the {layer} curve, which does not reach it", density.0))
        })?;
        Ok(scale * h.exposure())
    })
}
