//! One picture on many stocks, in one PNG.

use std::path::Path;

use anyhow::Result;
use onelight::{FilmProcess, Image, Printing, Reference, Stock, StockKind};
use onelight_charts::{TILE_WIDTH, Tile};
use rayon::prelude::*;

use crate::progress::bar;
use crate::small_picture::SmallPicture;

/// The picture on each of the stocks, under the names of its films.
pub(super) fn tiles(picture: &Path, stocks: &[Stock]) -> Result<Vec<Tile>> {
    let looks: Vec<Reference> = stocks.par_iter().map(|stock| Ok(look(stock)?.compile()?)).collect::<Result<_>>()?;
    let scene = SmallPicture::read(picture, "--sheet takes a scene-linear picture", |width, height| {
        let small = width.min(TILE_WIDTH);
        [small, (height * small).div_ceil(width)]
    })?;
    let progress = bar("develop", looks.len() as u64);
    let develop = |film: &Reference| {
        let picture = Ok(scene.rgb.iter().map(|rgb| film.develop(*rgb).map(|v| v as f32)).collect());
        progress.inc(1);
        let (camera, print) = film.name().split_once('_').unwrap_or((film.name(), ""));
        let on = if print.is_empty() { String::new() } else { format!("on {print}") };
        Tile { captions: [camera.to_owned(), on], width: scene.width as u32, height: scene.height as u32, picture }
    };
    let tiles = looks.par_iter().map(develop).collect();
    progress.finish_and_clear();
    Ok(tiles)
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
}
