//! Colours of the user's own pictures: what a look has to be good for.

use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use onelight::spectra::nalgebra::{Matrix3, Vector3};
use onelight::spectra::{Chromaticity, RgbSpace};
use onelight::{Process, space_of};
use onelight_picture::{Limits, PictureReader, Source};

use crate::picture_file::open;

/// Colours taken from all pictures together, evenly spread over their pixels.
const COLOURS: usize = 1 << 14;

/// Scene-linear colours of pictures in the input space of a process; `None` without pictures.
pub(crate) fn read(paths: &[PathBuf], process: &Process) -> Result<Option<Vec<[f64; 3]>>> {
    if paths.is_empty() {
        return Ok(None);
    }
    let mut colours = Vec::new();
    for path in paths {
        let mut picture = open(path, &Limits::default())?;
        if picture.description().source != Source::Exr {
            bail!("{}: --scene takes scene-linear pictures, expected an EXR", path.display());
        }
        let own = picture.description().primaries.as_ref().map(space_of);
        let to_input = to_input_space(own.as_ref(), process);
        let to_input = to_input.with_context(|| path.display().to_string())?;
        colours.extend(some_of(&mut picture, to_input, COLOURS.div_ceil(paths.len()))?);
    }
    if colours.is_empty() {
        bail!("the pictures of --scene hold no finite colour, expected at least one");
    }
    Ok(Some(colours))
}

/// From a picture's own primaries to those a process takes; `None` where the file names none. Its white is taken for the
/// scene's white: primaries count, the white point does not.
pub(crate) fn to_input_space(own: Option<&RgbSpace>, process: &Process) -> Result<Option<Matrix3<f64>>> {
    let Some(own) = own else { return Ok(None) };
    let matrix = own.to_about(&process.spaces().input_space.space(), Chromaticity::black_body_6500_k());
    matrix.map(Some).context("its chromaticities make no colour space")
}

/// About `count` colours of a picture, as far apart as can be in the order of its rows.
fn some_of(picture: &mut PictureReader, to_input: Option<Matrix3<f64>>, count: usize) -> Result<Vec<[f64; 3]>> {
    let pixels = picture.description().width * picture.description().height;
    let every = pixels.div_ceil(count).max(1);
    let mut colours = Vec::new();
    while let Some(band) = picture.next_band()? {
        let before = band.top() * band.width();
        // The first of the band that is a multiple of `every` in the picture.
        let first = before.next_multiple_of(every) - before;
        let finite = band.rgb().iter().skip(first).step_by(every).filter(|rgb| rgb.iter().all(|v| v.is_finite()));
        colours.extend(finite.map(|rgb| {
            let rgb = rgb.map(f64::from);
            to_input.map_or(rgb, |matrix| (matrix * Vector3::from(rgb)).into())
        }));
    }
    Ok(colours)
}
