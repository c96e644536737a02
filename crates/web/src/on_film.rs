//! Sharpness, halation and grain on the page: what the camera film does to a picture rather than to a colour.

use half::f16;
use half::slice::{HalfBitsSliceExt as _, HalfFloatSliceExt as _};
use onelight::spatial::Frame;
use onelight::{FilmEffects, FilmSteps, Process};

use crate::error::Error;
use crate::film_look::{FilmLook, SAMPLES};

/// A rectangle of a picture, and where it lies in the frame that fills the film format.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FramePart {
    /// Pixels across and down.
    pub size: [usize; 2],
    /// Its first pixel, counted from the frame's, to the right and down.
    pub at: [i32; 2],
    /// Pixels across the whole frame. Of a picture made smaller, smaller pixels count: each is a larger piece of film.
    pub frame_width: usize,
    /// Width of a pixel over its height, 1/8 to 8.
    pub pixel_aspect: f64,
}

/// What a film does to a rectangle of a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct OnFilm {
    /// Display codes, red, green, blue and alpha; `None` where no effect is run, and colours alone are developed.
    pub codes: Option<Vec<u8>>,
    /// Which effects are run and which are not, and why; a sentence each.
    pub reasons: Vec<String>,
}

/// The effects of a look's camera film; `None` without a film format.
///
/// # Errors
/// If an effect was asked for whose figures the film's sheet does not have.
pub(crate) fn effects_of(look: &FilmLook) -> Result<Option<FilmEffects>, Error> {
    match look.process() {
        Process::Film(film) => Ok(FilmEffects::new(film)?),
        Process::First(_) | Process::Print(_) | Process::Tone(_) => Err(Error::without_film()),
    }
}

/// Develops light in half floats (red, green, blue and alpha) with the effects of the look's film format; `ev` is the exposure in stops.
///
/// What is run `auto` is decided by this rectangle alone, and halation knows no light from outside of it.
///
/// ```
/// use half::f16;
/// use onelight_web::{FilmLook, FramePart, Keys, develop_on_film};
/// let look = FilmLook::new(&Keys::from_json(r#"{ "film_format": "super16", "grain": "on" }"#)?)?;
/// let grey = [0.18, 0.18, 0.18, 1.0].map(|v| f16::from_f32(v).to_bits()).repeat(32 * 24);
/// let part = FramePart { size: [32, 24], at: [0, 0], frame_width: 2048, pixel_aspect: 1.0 };
/// let found = develop_on_film(&look, &grey, &part, 0.0)?;
/// let codes = found.codes.ok_or("grain is on")?;
/// assert!(codes.chunks(4).any(|code| code[1].abs_diff(123) > 3));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the samples are not those of the rectangle, the pixels are too small for the film format, or an effect was asked for whose figures
/// the film's sheet does not have.
pub fn develop_on_film(look: &FilmLook, light: &[u16], part: &FramePart, ev: f64) -> Result<OnFilm, Error> {
    let expected = part.size[0] * part.size[1] * SAMPLES;
    if light.len() != expected || expected == 0 {
        return Err(Error::samples(light.len(), expected.max(SAMPLES)));
    }
    let Some(effects) = effects_of(look)? else { return Ok(OnFilm { codes: None, reasons: Vec::new() }) };
    let steps = FilmSteps::direct(look.exact()?.film()?, look.direct()?)?;
    let frame = Frame::new(part.size, effects.pitch(part.frame_width, part.pixel_aspect)?)?.at(part.at);
    let mut samples = vec![0.0_f32; light.len()];
    light.reinterpret_cast::<f16>().convert_to_f32_slice(&mut samples);
    let gain = ev.exp2() as f32;
    let mut rgb: Vec<[f32; 3]> = samples.chunks_exact(SAMPLES).map(|v| [v[0], v[1], v[2]].map(|v| v * gain)).collect();
    let mut first = effects.look_at(steps, frame)?;
    if first.needs_picture() {
        first.add(&rgb)?;
    }
    let mut run = first.finish()?;
    let reasons = run.reasons().to_vec();
    if !run.runs_any() {
        return Ok(OnFilm { codes: None, reasons });
    }
    run.add(&rgb)?;
    run.develop(&mut rgb)?;
    let code = |v: f32| (v.clamp(0.0, 1.0) * 255.0).round() as u8;
    let codes = rgb.iter().flat_map(|[r, g, b]| [code(*r), code(*g), code(*b), 255]).collect();
    Ok(OnFilm { codes: Some(codes), reasons })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Keys;

    fn grey(pixels: usize) -> Vec<u16> {
        [0.18, 0.18, 0.18, 1.0].map(|v| f16::from_f32(v).to_bits()).repeat(pixels)
    }

    fn look(keys: &str) -> FilmLook {
        FilmLook::new(&Keys::from_json(keys).unwrap()).unwrap()
    }

    #[test]
    fn a_part_has_the_grain_of_the_whole() {
        let look = look(r#"{ "film_format": "super16", "grain": "on", "sharpness": "off" }"#);
        let whole = FramePart { size: [24, 16], at: [0, 0], frame_width: 1024, pixel_aspect: 1.0 };
        let all = develop_on_film(&look, &grey(24 * 16), &whole, 0.0).unwrap().codes.unwrap();
        let part = FramePart { size: [8, 6], at: [5, 4], ..whole };
        let some = develop_on_film(&look, &grey(8 * 6), &part, 0.0).unwrap().codes.unwrap();
        for (y, row) in some.chunks(8 * SAMPLES).enumerate() {
            let start = ((y + 4) * 24 + 5) * SAMPLES;
            assert_eq!(row, &all[start..start + 8 * SAMPLES], "row {y}");
        }
    }

    #[test]
    fn what_is_not_run_says_why() {
        let part = FramePart { size: [4, 4], at: [0, 0], frame_width: 4, pixel_aspect: 1.0 };
        let found = develop_on_film(&look("{}"), &grey(16), &part, 0.0).unwrap();
        assert_eq!(found, OnFilm { codes: None, reasons: Vec::new() });
        // Four pixels across a frame: no grain to be seen.
        let found = develop_on_film(&look(r#"{ "film_format": "65mm" }"#), &grey(16), &part, 0.0).unwrap();
        assert!(found.codes.is_none() && found.reasons.iter().any(|reason| reason.starts_with("grain")), "{found:?}");
        assert!(develop_on_film(&look("{}"), &grey(15), &part, 0.0).is_err());
    }
}
