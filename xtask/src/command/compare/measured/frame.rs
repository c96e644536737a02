//! The pictures that the looks are shown on.

use std::collections::HashMap;
use std::path::Path;

use anyhow::{Context, Result};
use onelight::spectra::nalgebra::Vector3;
use onelight::spectra::{Basis, Chromaticity, Reconstruction, RgbSpace, color_checker};

use crate::command::develop::exposure::Exposure;
use crate::small_picture::SmallPicture;

/// Who takes pictures, for messages.
const TAKER: &str = "compare takes scene-linear pictures";
/// Width of a tile in pixels; height of the scene's.
pub(super) const WIDTH: usize = onelight_charts::TILE_WIDTH;
const SCENE_HEIGHT: usize = 162;
/// A picture of the user's taller than this is made narrower instead.
const MAX_HEIGHT: usize = 320;
/// The fixture scene whose pixels are shown on film, and how much of its surroundings, or a user's picture's, are developed with them: a
/// tenth of the halation of film without an antihalation layer is from further away at Super 16.
const WHOLE_SCENE: (usize, usize) = (1024, 576);
const SURROUNDINGS: usize = 96;

/// Scene-linear light (sRGB primaries, white is 6500 K) to show looks on.
pub(super) struct Frame {
    /// What it is, for captions and file names.
    pub(super) name: String,
    pub(super) width: usize,
    pub(super) height: usize,
    /// Its different colours, scene-linear sRGB, each once.
    pub(super) colours: Vec<[f32; 3]>,
    /// Which of them each pixel has, row by row.
    pub(super) pixels: Vec<u32>,
    /// What it shows part of, where its pixels are those of a picture on film: `colours` is empty then.
    pub(super) on_film: Option<OnFilm>,
}

/// Pixels of a picture with their surroundings, about its brightest place.
pub(super) struct OnFilm {
    /// Scene-linear sRGB, row by row.
    pub(super) rgb: Vec<[f32; 3]>,
    pub(super) size: [usize; 2],
    /// Where they begin in the whole picture, and how wide that is.
    pub(super) offset: [i32; 2],
    pub(super) frame_width: usize,
}

impl OnFilm {
    /// Width and height of a tile within.
    fn tile(&self) -> [usize; 2] {
        [self.size[0].min(WIDTH), self.size[1].min(SCENE_HEIGHT)]
    }

    /// The pixels of the tile in the middle.
    pub(super) fn middle<T: Copy>(&self, pixels: &[T]) -> impl Iterator<Item = T> {
        let ([width, height], tile) = (self.size, self.tile());
        let [left, top] = [(width - tile[0]) / 2, (height - tile[1]) / 2];
        let rows = pixels.chunks_exact(width).skip(top).take(tile[1]);
        rows.flat_map(move |row| row[left..left + tile[0]].iter().copied())
    }
}

impl Frame {
    fn new(name: String, (width, height): (usize, usize), rgb: &[[f32; 3]]) -> Self {
        let (mut colours, mut known) = (Vec::new(), HashMap::new());
        let mut place = |rgb: &[f32; 3]| {
            *known.entry(rgb.map(f32::to_bits)).or_insert_with(|| {
                colours.push(*rgb);
                colours.len() as u32 - 1
            })
        };
        let pixels = rgb.iter().map(&mut place).collect();
        Self { name, width, height, colours, pixels, on_film: None }
    }

    /// The same picture on film: `whole` is its width and height, `part` gives the pixels from a place on.
    fn on_film(
        &self,
        [width, height]: [usize; 2],
        part: impl FnOnce([usize; 2], [usize; 2]) -> Result<Vec<[f32; 3]>>,
    ) -> Result<Self> {
        let light = |i: &usize| self.colours[self.pixels[*i] as usize].iter().sum::<f32>();
        let brightest = (0..self.pixels.len()).max_by(|a, b| light(a).total_cmp(&light(b))).unwrap_or_default();
        let size = [width.min(WIDTH + 2 * SURROUNDINGS), height.min(SCENE_HEIGHT + 2 * SURROUNDINGS)];
        let place = |at: usize, of: usize, whole: usize, part: usize| {
            ((2 * at + 1) * whole / (2 * of)).saturating_sub(part / 2).min(whole - part)
        };
        let offset = [
            place(brightest % self.width, self.width, width, size[0]),
            place(brightest / self.width, self.height, height, size[1]),
        ];
        let rgb = part(offset, size)?;
        let part = OnFilm { rgb, size, offset: offset.map(|v| v as i32), frame_width: width };
        let [width, height] = part.tile();
        let pixels = (0..(width * height) as u32).collect();
        Ok(Self { name: self.name.clone(), width, height, colours: Vec::new(), pixels, on_film: Some(part) })
    }

    /// One value for each pixel, from one for each colour.
    pub(super) fn spread<T: Copy>(&self, of_colours: &[T]) -> Vec<T> {
        self.pixels.iter().filter_map(|i| of_colours.get(*i as usize).copied()).collect()
    }
}

/// The fixture scene at the width of a tile.
pub(super) fn scene() -> Result<Frame> {
    let rgb = onelight_fixtures::scene_rgb((WIDTH, SCENE_HEIGHT))?;
    Ok(Frame::new("scene".to_owned(), (WIDTH, SCENE_HEIGHT), &rgb))
}

/// Part of the fixture scene, rendered larger.
pub(super) fn scene_on_film(scene: &Frame) -> Result<Frame> {
    let (width, height) = WHOLE_SCENE;
    scene.on_film([width, height], |[x, y], size| {
        let rgb = onelight_fixtures::scene_rgb(WHOLE_SCENE)?;
        let rows = rgb.chunks_exact(width).skip(y).take(size[1]);
        Ok(rows.flat_map(|row| row[x..x + size[0]].iter().copied()).collect())
    })
}

/// The ColorChecker under the white of the scene, as a display of its patches.
pub(super) fn chart() -> Result<Frame> {
    /// Side of a patch and the black between two, in pixels.
    const PATCH: (usize, usize) = (41, 6);
    let patches = chart_colours()?;
    let pitch = PATCH.0 + PATCH.1;
    let (width, height) = (6 * pitch + PATCH.1, 4 * pitch + PATCH.1);
    let at = |i: usize| {
        let (x, y) = (i % width, i / width);
        let inside = |v: usize| v % pitch >= PATCH.1;
        if inside(x) && inside(y) { patches[(y / pitch) * 6 + x / pitch].map(|v| v as f32) } else { [0.0; 3] }
    };
    let rgb: Vec<[f32; 3]> = (0..width * height).map(at).collect();
    Ok(Frame::new("colorchecker".to_owned(), (width, height), &rgb))
}

/// Scene values of the ColorChecker's patches.
pub(super) fn chart_colours() -> Result<Vec<[f64; 3]>> {
    let basis = Basis::new(Reconstruction::Smooth)?;
    let rgb = |patch: &onelight::spectra::Patch| basis.rgb_of(&basis.white().reflected_by(&patch.reflectance));
    // One patch, cyan, lies a little outside sRGB.
    Ok(color_checker().iter().map(|patch| rgb(patch).map(|v| v.max(0.0))).collect())
}

/// A picture of the user's, small and exposed, and part of it on film.
pub(super) fn user(path: &Path, exposure: Exposure) -> Result<[Frame; 2]> {
    let mut whole = [0; 2];
    let small = SmallPicture::read(path, TAKER, |width, height| {
        whole = [width, height];
        let shrink = (width as f64 / WIDTH as f64).max(height as f64 / MAX_HEIGHT as f64).max(1.0);
        [width, height].map(|pixels| ((pixels as f64 / shrink) as usize).max(1))
    })?;
    let rgb: Vec<[f64; 3]> = small.rgb.into_iter().map(|rgb| rgb.map(|v| v.max(0.0))).collect();
    let no_light = || format!("{}: the picture holds no light to expose for", path.display());
    let scale = match exposure {
        Exposure::Stops(stops) => stops.exp2(),
        Exposure::Auto => onelight::spectra::MID_GREY / log_average(&rgb)?.with_context(no_light)?,
    };
    let rgb: Vec<[f32; 3]> = rgb.into_iter().map(|rgb| rgb.map(|v| (scale * v) as f32)).collect();
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
    let small = Frame::new(stem.chars().map(plain).take(24).collect(), (small.width, small.height), &rgb);
    let on_film = small.on_film(whole, |place, size| {
        let part = SmallPicture::part(path, TAKER, place, size)?;
        Ok(part.rgb.into_iter().map(|rgb| rgb.map(|v| (scale * v.max(0.0)) as f32)).collect())
    })?;
    Ok([small, on_film])
}

/// Geometric mean of the luminance of the pixels that have any.
fn log_average(rgb: &[[f64; 3]]) -> Result<Option<f64>> {
    let weights = RgbSpace::SRGB.with_white(Chromaticity::black_body_6500_k()).to_xyz()?.row(1).transpose();
    let luminance = rgb.iter().map(|rgb| weights.dot(&Vector3::from(*rgb)));
    let logs: Vec<f64> = luminance.filter(|y| *y > 0.0 && y.is_finite()).map(f64::ln).collect();
    Ok((!logs.is_empty()).then(|| (logs.iter().sum::<f64>() / logs.len() as f64).exp()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_chart_shows_its_patches_in_order() {
        let (chart, patches) = (chart().unwrap(), chart_colours().unwrap());
        let rgb = chart.spread(&chart.colours);
        let at = |column: usize, row: usize| rgb[(row * 47 + 30) * chart.width + column * 47 + 30];
        assert_eq!(at(0, 0), patches[0].map(|v| v as f32));
        assert_eq!(at(5, 3), patches[23].map(|v| v as f32));
        assert_eq!(rgb[0], [0.0; 3]);
        assert_eq!((rgb.len(), chart.colours.len()), (chart.width * chart.height, 25));
    }
}
