//! One picture on many stocks, in one PNG.

use std::io::Cursor;
use std::path::Path;

use anyhow::Result;
use image::{ImageFormat, RgbImage};
use onelight::{FilmProcess, Image, Printing, Reference, Stock, StockKind};
use rayon::prelude::*;

use crate::progress::bar;
use crate::sheet::{BACKGROUND, caption, paste};
use crate::small_picture::SmallPicture;

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
    let scene = SmallPicture::read(picture, "--sheet takes a scene-linear picture", |width, height| {
        let small = width.min(TILE);
        [small, (height * small).div_ceil(width)]
    })?;
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
