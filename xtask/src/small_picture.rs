//! A picture of the user's, small enough for a contact sheet.

use std::path::Path;

use anyhow::{Context, Result, bail};
use onelight::spectra::nalgebra::{Matrix3, Vector3};
use onelight::{Process, space_of};
use onelight_picture::{Limits, PictureReader, Source};

use crate::picture_file::open;
use crate::scene_colours::to_input_space;

/// Scene-linear, sRGB primaries, row by row.
pub(crate) struct SmallPicture {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) rgb: Vec<[f64; 3]>,
}

impl SmallPicture {
    /// Means over the pixels that fall on each small one, as many as `shrink` makes of width and height; what is not finite is
    /// left out. `taker` is named where the picture is not scene-linear: `compare takes scene-linear pictures`.
    ///
    /// # Errors
    /// If the file is no EXR, or cannot be read.
    pub(crate) fn read(path: &Path, taker: &str, shrink: impl FnOnce(usize, usize) -> [usize; 2]) -> Result<Self> {
        let (mut picture, to_srgb) = opened(path, taker)?;
        let (from, to) = (picture.description().width, picture.description().height);
        let [width, height] = shrink(from, to);
        // Sums of the finite pixels that fall on each small one, and their number.
        let mut sums = vec![(Vector3::zeros(), 0.0); width * height];
        while let Some(band) = picture.next_band()? {
            for (i, rgb) in band.rgb().iter().enumerate().filter(|(_, rgb)| rgb.iter().all(|v| v.is_finite())) {
                let (x, y) = (i % from * width / from, (band.top() + i / from) * height / to);
                let (sum, count) = &mut sums[y * width + x];
                *sum += Vector3::from(rgb.map(f64::from));
                *count += 1.0;
            }
        }
        let mean = |(sum, count): (Vector3<f64>, f64)| <[f64; 3]>::from(to_srgb * sum / count.max(1.0));
        Ok(Self { width, height, rgb: sums.into_iter().map(mean).collect() })
    }

    /// The pixels of a part of the picture, `size` from `place` on, as they are; what is not finite counts as 0.
    ///
    /// # Errors
    /// As [`SmallPicture::read`].
    #[cfg(feature = "measure")]
    pub(crate) fn part(path: &Path, taker: &str, [left, top]: [usize; 2], size: [usize; 2]) -> Result<Self> {
        let (mut picture, to_srgb) = opened(path, taker)?;
        let width = picture.description().width;
        let mut rgb = Vec::with_capacity(size[0] * size[1]);
        while let Some(band) = picture.next_band()? {
            for (row, y) in band.rgb().chunks_exact(width).zip(band.top()..) {
                if (top..top + size[1]).contains(&y) {
                    let pixels = row[left..left + size[0]].iter().map(|rgb| Vector3::from(rgb.map(f64::from)));
                    rgb.extend(
                        pixels.map(|rgb| <[f64; 3]>::from(to_srgb * rgb).map(|v| if v.is_finite() { v } else { 0.0 })),
                    );
                }
            }
        }
        Ok(Self { width: size[0], height: size[1], rgb })
    }
}

/// An EXR, and the way from its primaries to those of sRGB.
fn opened(path: &Path, taker: &str) -> Result<(PictureReader<'static>, Matrix3<f64>)> {
    let picture = open(path, &Limits::default())?;
    if picture.description().source != Source::Exr {
        bail!("{}: {taker}, expected an EXR", path.display());
    }
    let own = picture.description().primaries.as_ref().map(space_of);
    let to_srgb = to_input_space(own.as_ref(), &Process::default());
    Ok((picture, to_srgb.with_context(|| path.display().to_string())?.unwrap_or_else(Matrix3::identity)))
}
