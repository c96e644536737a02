//! A look at work on the page's pixels.

use std::cell::OnceCell;

use half::f16;
use half::slice::{HalfBitsSliceExt as _, HalfFloatSliceExt as _};
use onelight::lut::DirectForm;
use onelight::{Channels, DirectSettings, Look, PixelMap as _, Pixels, PixelsMut, Process};

use crate::error::Error;
use crate::keys::Keys;

/// Samples of a pixel on the page: red, green, blue, alpha.
pub(crate) const SAMPLES: usize = 4;

/// A look in the two forms that the page needs: the direct one for pictures, the exact one to say where a colour comes from.
///
/// Each is made when it is first asked for.
///
/// ```
/// use half::f16;
/// use onelight_web::{FilmLook, Keys};
///
/// let look = FilmLook::new(&Keys::from_json("{}")?)?;
/// // One grey pixel, in half floats with alpha, one stop under: the film's grey at an exposure of +1.
/// let light = [0.09, 0.09, 0.09, 1.0].map(|v| f16::from_f32(v).to_bits());
/// let codes = look.develop(&light, 1.0)?;
/// assert_eq!(codes, [123, 123, 123, 255]);
/// # Ok::<(), onelight_web::Error>(())
/// ```
#[derive(Debug)]
pub struct FilmLook {
    process: Process,
    exact: OnceCell<Look>,
    direct: OnceCell<DirectForm>,
}

impl FilmLook {
    /// The look of these keys; nothing is computed yet.
    ///
    /// # Errors
    /// If the keys do not go together.
    pub fn new(keys: &Keys) -> Result<Self, Error> {
        Ok(Self { process: keys.process()?, exact: OnceCell::new(), direct: OnceCell::new() })
    }

    /// The same with its direct form, made before.
    #[must_use]
    pub fn with_direct(self, direct: DirectForm) -> Self {
        Self { direct: OnceCell::from(direct), ..self }
    }

    /// What it was made of.
    #[must_use]
    pub fn process(&self) -> &Process {
        &self.process
    }

    /// A short name made of the films.
    #[must_use]
    pub fn name(&self) -> String {
        self.process.name()
    }

    /// The film itself, in float64.
    ///
    /// # Errors
    /// If the film cannot be brought to its aim, or its parts contradict each other.
    pub fn exact(&self) -> Result<&Look, Error> {
        made(&self.exact, || Ok(self.process.look()?))
    }

    /// The form that develops pictures.
    ///
    /// # Errors
    /// Those of [`FilmLook::exact`], and a look without film.
    pub fn direct(&self) -> Result<&DirectForm, Error> {
        made(&self.direct, || Ok(self.exact()?.film()?.direct(&DirectSettings::default())?))
    }

    /// Display codes for light in half floats: see [`develop_codes`].
    ///
    /// # Errors
    /// Those of [`develop_codes`] and [`FilmLook::direct`].
    pub fn develop(&self, light: &[u16], ev: f64) -> Result<Vec<u8>, Error> {
        develop_codes(self.direct()?, light, ev)
    }
}

/// Display codes of 8 bits for light in half floats, both red, green, blue and alpha; `ev` is the exposure in stops.
///
/// Values are rounded to the nearest code, and alpha goes through.
///
/// # Errors
/// If the samples are not whole pixels.
pub fn develop_codes(direct: &DirectForm, light: &[u16], ev: f64) -> Result<Vec<u8>, Error> {
    let pixels = light.len() / SAMPLES;
    if !light.len().is_multiple_of(SAMPLES) {
        return Err(Error::samples(light.len(), pixels * SAMPLES));
    }
    let (mut rows, mut codes) = (vec![0.0_f32; light.len().min(BLOCK)], vec![0_u8; light.len()]);
    for (light, codes) in light.chunks(BLOCK).zip(codes.chunks_mut(BLOCK)) {
        let rows = &mut rows[..light.len()];
        light.reinterpret_cast::<f16>().convert_to_f32_slice(rows);
        expose(rows, ev);
        let size = [light.len() / SAMPLES, 1];
        let from = Pixels::new(rows, Channels::Rgba, size)?;
        direct.map(&from, &mut PixelsMut::new(codes, Channels::Rgba, size)?)?;
    }
    Ok(codes)
}

/// Samples that are developed at a time, so that they stay in the cache.
const BLOCK: usize = 1 << 14;

/// Light of more stops; alpha stays.
fn expose(rgba: &mut [f32], ev: f64) {
    let gain = ev.exp2() as f32;
    if gain != 1.0 {
        rgba.chunks_exact_mut(SAMPLES).for_each(|pixel| pixel[..3].iter_mut().for_each(|v| *v *= gain));
    }
}

/// What a cell holds, made now if it is empty.
fn made<T>(cell: &OnceCell<T>, make: impl FnOnce() -> Result<T, Error>) -> Result<&T, Error> {
    match cell.get() {
        Some(made) => Ok(made),
        None => {
            let new = make()?;
            Ok(cell.get_or_init(|| new))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn half(rgba: &[f32]) -> Vec<u16> {
        rgba.iter().map(|v| f16::from_f32(*v).to_bits()).collect()
    }

    #[test]
    fn pictures_get_the_codes_of_the_film() {
        let look = FilmLook::new(&Keys::from_json(r#"{ "camera": "fuji-velvia-50" }"#).unwrap().fitting().unwrap());
        let look = look.unwrap();
        let colours: Vec<f32> =
            (0..6000).map(|i| if i % 4 == 3 { 0.5 } else { 0.001 * ((i * 37 % 997) as f32) }).collect();
        let codes = look.develop(&half(&colours), 1.5).unwrap();
        for (colour, code) in half(&colours).chunks(4).zip(codes.chunks(4)) {
            let light: [f64; 3] = std::array::from_fn(|i| f64::from(f16::from_bits(colour[i])) * 1.5_f64.exp2());
            let exact = look.exact().unwrap().develop(light);
            for (exact, code) in exact.iter().zip(code) {
                let expected = exact.clamp(0.0, 1.0) * 255.0;
                assert!((expected - f64::from(*code)).abs() < 1.0, "{light:?}: {expected} {code}");
            }
            assert_eq!(code[3], 128);
        }
    }

    #[test]
    fn half_pixels_are_refused() {
        let look = FilmLook::new(&Keys::from_json("{}").unwrap()).unwrap();
        assert!(look.develop(&[0; 3], 0.0).unwrap_err().to_string().contains("found 3 samples"));
    }
}
