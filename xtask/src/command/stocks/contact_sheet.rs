//! One picture on many stocks, in one PNG.

use std::io::Cursor;
use std::path::Path;

use anyhow::{Context, Result, bail};
use image::{ImageFormat, RgbImage};
use onelight::spectra::nalgebra::{Matrix3, Vector3};
use onelight::{FilmProcess, Image, Printing, Process, Reference, Stock, StockKind};
use onelight_picture::{Limits, Source};
use rayon::prelude::*;

use crate::picture_file::open;
use crate::progress::bar;
use crate::scene_colours::to_input_space;
use crate::sheet::{BACKGROUND, caption, paste};

/// Width of a tile in pixels.
const TILE: usize = 288;
/// Tiles in a row.
const COLUMNS: u32 = 4;
/// Space around the tiles, the height of a line of captions, and the dots of its letters, in pixels.
const GAP: u32 = 10;
const LINE: u32 = 20;
const DOT: (u32, u32) = (1, 2);

/// The pictures of a sheet, all of one size.
pub(super) struct Tiles {
    width: u32,
    height: u32,
    /// The name of each look, and its display-coded sRGB.
    pub(super) pictures: Vec<(String, Vec<[f32; 3]>)>,
}

/// The picture on each of the stocks.
pub(super) fn tiles(picture: &Path, stocks: &[Stock]) -> Result<Tiles> {
    let looks: Vec<Reference> = stocks.par_iter().map(|stock| Ok(look(stock)?.compile()?)).collect::<Result<_>>()?;
    let scene = Scene::read(picture)?;
    let progress = bar("develop", looks.len() as u64);
    let develop = |film: &Reference| {
        let picture = scene.rgb.iter().map(|rgb| film.develop(*rgb).map(|v| v as f32)).collect();
        progress.inc(1);
        (film.name().to_owned(), picture)
    };
    let pictures = looks.par_iter().map(develop).collect();
    progress.finish_and_clear();
    Ok(Tiles { width: scene.width as u32, height: scene.height as u32, pictures })
}

/// A camera film as it is usually seen; what is printed on, behind a film that is usual for it.
fn look(stock: &Stock) -> Result<FilmProcess> {
    let camera = match (stock.kind(), stock.image()) {
        (kind, _) if kind.is_camera_film() => return Ok(FilmProcess::for_camera(stock.id())?),
        (StockKind::ReversalPrint, _) => "fuji-velvia-50",
        (_, Image::Silver) => "kodak-tri-x-400",
        (StockKind::Paper, Image::Dye) => "kodak-portra-400",
        (_, Image::Dye) => onelight::DEFAULT_CAMERA,
    };
    let print = Some(Printing::on(stock.id()));
    Ok(FilmProcess { camera: camera.into(), print, ..FilmProcess::default() })
}

/// A picture as small as a tile, scene-linear in sRGB primaries.
struct Scene {
    width: usize,
    height: usize,
    rgb: Vec<[f64; 3]>,
}

impl Scene {
    /// Means over the pixels that fall into each pixel of the tile; what is not finite is left out.
    fn read(path: &Path) -> Result<Self> {
        let mut picture = open(path, &Limits::default())?;
        let (from, to) = (picture.description().width, picture.description().height);
        if picture.description().source != Source::Exr {
            bail!("{}: --sheet takes a scene-linear picture, expected an EXR", path.display());
        }
        let primaries = picture.description().primaries;
        let to_srgb = to_input_space(primaries.as_ref(), &Process::default());
        let to_srgb = to_srgb.with_context(|| path.display().to_string())?.unwrap_or_else(Matrix3::identity);
        let width = from.min(TILE);
        let height = (to * width).div_ceil(from);
        let mut sums = vec![([0.0; 3], 0.0); width * height];
        while let Some(band) = picture.next_band()? {
            for (i, rgb) in band.rgb().iter().enumerate().filter(|(_, rgb)| rgb.iter().all(|v| v.is_finite())) {
                let (x, y) = (i % from, band.top() + i / from);
                let (sum, count): &mut ([f64; 3], f64) = &mut sums[(y * height / to) * width + x * width / from];
                sum.iter_mut().zip(rgb).for_each(|(sum, v)| *sum += f64::from(*v));
                *count += 1.0;
            }
        }
        let mean = |(sum, count): ([f64; 3], f64)| (to_srgb * Vector3::from(sum) / count.max(1.0)).into();
        Ok(Self { width, height, rgb: sums.into_iter().map(mean).collect() })
    }
}

/// The tiles in rows, each under its name.
pub(super) fn png(tiles: &Tiles) -> Result<Vec<u8>> {
    let rows = (tiles.pictures.len() as u32).div_ceil(COLUMNS);
    let columns = COLUMNS.min(tiles.pictures.len() as u32).max(1);
    let pitch = (TILE as u32 + GAP, tiles.height + 2 * LINE + GAP);
    let mut sheet = RgbImage::from_pixel(columns * pitch.0 + GAP, rows * pitch.1 + GAP, BACKGROUND);
    for (i, (name, picture)) in (0..).zip(&tiles.pictures) {
        let (left, top) = (GAP + i % COLUMNS * pitch.0, GAP + i / COLUMNS * pitch.1);
        let (camera, print) = name.split_once('_').unwrap_or((name, ""));
        caption(&mut sheet, (left, top), DOT, camera);
        caption(
            &mut sheet,
            (left, top + LINE),
            DOT,
            &if print.is_empty() { String::new() } else { format!("on {print}") },
        );
        paste(&mut sheet, (left, top + 2 * LINE), tiles.width, picture.iter().copied());
    }
    let mut bytes = Cursor::new(Vec::new());
    sheet.write_to(&mut bytes, ImageFormat::Png)?;
    Ok(bytes.into_inner())
}

#[cfg(test)]
mod tests {
    use onelight::{stock, stock_ids};

    use super::*;

    #[test]
    fn every_stock_has_a_look_to_be_shown_in() {
        for id in stock_ids() {
            let look = look(&stock(id).unwrap()).unwrap();
            let film = look.camera.id() == id || look.print.as_ref().is_some_and(|print| print.film.id() == id);
            assert!(film && look.compile().is_ok(), "{id}: {look:?}");
        }
    }

    #[test]
    fn a_sheet_holds_its_tiles_in_rows() {
        let pictures = (0..5).map(|i| (format!("film-{i}"), vec![[1.0; 3]; 12])).collect();
        let bytes = png(&Tiles { width: 4, height: 3, pictures }).unwrap();
        let sheet = image::load_from_memory(&bytes).unwrap().to_rgb8();
        assert_eq!(sheet.dimensions(), (4 * 298 + 10, 2 * 53 + 10));
        assert_eq!((sheet.get_pixel(10, 50).0, sheet.get_pixel(10, 103).0), ([255; 3], [255; 3]));
        assert_eq!(sheet.get_pixel(308, 103).0, BACKGROUND.0);
    }
}
