//! What the structured and the direct form do first: scene light to exposure, exposure to dye in the camera film.

use std::f64::consts::LOG2_10;

use nalgebra::Matrix3;
use onelight_film::{AmountCurve, PerLayer, WideGamut};
use onelight_lut::{Coupling, Develop, Domain, Expose, Lut1d, NegativeLight, Rows};
use onelight_spectra::RgbSpace;

use crate::error::Error;
use crate::process::ColourSpaces;
use crate::reference::Reference;

/// Points of a curve: its error is below 0.002 dE.
pub(super) const CURVE_POINTS: usize = 1024;
/// Points of a curve of developed density: its error is below 0.002 dE.
const COUPLING_POINTS: usize = 257;

impl ColourSpaces {
    /// The first matrix of a form ([`Expose::input`](onelight_lut::Expose)) for pictures of these spaces: what moves a form's exposure and
    /// scene white ([`DirectForm::with_expose`](onelight_lut::DirectForm::with_expose)) without its film.
    ///
    /// ```
    /// use onelight::{ColourSpaces, lut::Expose};
    /// let form = onelight::Process::for_camera("fuji-velvia-50")?.compile()?.direct(&Default::default())?;
    /// let expose = form.parts().expose;
    /// let brighter = ColourSpaces { ev: 1.0, ..ColourSpaces::default() };
    /// let moved = form.clone().with_expose(Expose { input: brighter.input_rows()?, ..expose })?;
    /// assert!((moved.apply([0.1; 3])[1] - form.apply([0.2; 3])[1]).abs() < 1e-5);
    /// # Ok::<(), onelight::Error>(())
    /// ```
    ///
    /// # Errors
    /// If exposure or white are out of range.
    pub fn input_rows(&self) -> Result<Rows, Error> {
        self.check()?;
        Ok(rows(&self.scene_to(&RgbSpace::SRGB)?))
    }
}

impl Reference {
    /// From scene light in the input's primaries to log2 exposure.
    pub(crate) fn expose(&self) -> Expose {
        let negative = match self.exposure_matrix().gamut() {
            WideGamut::Compress => NegativeLight::Compress,
            WideGamut::Clip => NegativeLight::Clip,
        };
        Expose { input: rows(self.to_srgb()), matrix: rows(self.exposure_matrix().matrix()), negative }
    }

    /// From log2 exposure to values of the camera film's layers, given over log10 exposure.
    pub(crate) fn develop_form(&self, value: impl Fn(usize, f64) -> f64) -> Result<Develop, Error> {
        Ok(Develop { coupling: self.coupling()?, curves: over_log2(self.camera_curves(), value)? })
    }

    /// The inter-image effect, unless there is none.
    fn coupling(&self) -> Result<Option<Coupling>, Error> {
        let effect = self.inter_image();
        if effect.strength().is_none() {
            return Ok(None);
        }
        let (first, last) = effect.offsets().into_inner();
        let grey = effect.grey().to_array();
        let log2 = |offset: f64| grey.map(|grey| ((grey.0 + offset) * LOG2_10) as f32);
        let entry = |i: usize| {
            let t = i as f64 / (COUPLING_POINTS - 1) as f64;
            [effect.developed(first + t * (last - first)) as f32; 3]
        };
        let curves = Lut1d::new(Domain::new(log2(first), log2(last))?, (0..COUPLING_POINTS).map(entry).collect())?;
        let matrix = effect.strength().matrix().map(|row| row.map(|v| (v * LOG2_10) as f32));
        Ok(Some(Coupling { curves, matrix }))
    }
}

/// Values over log2 of the exposure, each layer over its own curve's range.
pub(crate) fn over_log2(camera: PerLayer<&AmountCurve>, value: impl Fn(usize, f64) -> f64) -> Result<Lut1d, Error> {
    let ranges = camera.map(|curve| (curve.range().start().0, curve.range().end().0)).to_array();
    let log2 = |log10: f64| (log10 * LOG2_10) as f32;
    let domain = Domain::new(ranges.map(|r| log2(r.0)), ranges.map(|r| log2(r.1)))?;
    let point = |i: usize| {
        let t = i as f64 / (CURVE_POINTS - 1) as f64;
        std::array::from_fn(|layer| value(layer, ranges[layer].0 + t * (ranges[layer].1 - ranges[layer].0)) as f32)
    };
    Ok(Lut1d::new(domain, (0..CURVE_POINTS).map(point).collect())?)
}

/// A matrix as the forms have it.
pub(crate) fn rows(matrix: &Matrix3<f64>) -> Rows {
    std::array::from_fn(|i| std::array::from_fn(|k| matrix[(i, k)] as f32))
}
