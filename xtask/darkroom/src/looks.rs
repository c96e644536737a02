//! What the page need not compute: the looks of all camera films on their usual prints, and a scene.

use std::io::Cursor;

use anyhow::{Context, Result};
use half::f16;
use onelight::lut::DirectForm;
use onelight::{Stock, StockKind, pairs, stock, stock_ids};
use onelight_picture::{Chromaticities, Picture, Source};
use onelight_web::{FilmLook, Keys, look_name, pack};
use rayon::prelude::*;
use serde_json::json;

/// Pixels of the scene across and down.
const SCENE: (usize, usize) = (720, 405);

/// The direct form of every camera film as it is or scanned, and on all that it is printed on, packed.
///
/// # Errors
/// None with the films that are built in.
pub(crate) fn looks() -> Result<Vec<u8>> {
    let stocks = stock_ids().map(stock).collect::<Result<Vec<_>, _>>()?;
    let looks: Vec<(String, DirectForm)> = pairs(&stocks)
        .into_par_iter()
        .map(|(camera, print)| {
            // A negative that is not printed is scanned.
            let scan = (camera.kind() == StockKind::Negative).then_some("scan");
            look(camera.id(), print.map(Stock::id).or(scan))
        })
        .collect::<Result<_>>()?;
    let looks: Vec<(&str, &DirectForm)> = looks.iter().map(|(name, form)| (name.as_str(), form)).collect();
    Ok(pack(&looks))
}

/// The direct form of the usual look of two films, with its name.
fn look(camera: &str, print: Option<&str>) -> Result<(String, DirectForm)> {
    let keys = Keys::from_json(&json!({ "camera": camera, "print": print.unwrap_or("none") }).to_string())?;
    let name = look_name(&keys);
    let form = FilmLook::new(&keys)?.direct().with_context(|| name.clone())?.clone();
    Ok((name, form))
}

/// The fixture scene as a picture of a size to look at.
///
/// # Errors
/// None with the tables that are built in.
pub(crate) fn scene() -> Result<Vec<u8>> {
    // The page holds light in half floats: finer steps would only be more to load.
    let half = |rgb: [f32; 3]| rgb.map(|v| f16::from_f32(v).to_f32());
    let rgb = onelight_fixtures::scene_rgb(SCENE)?.into_iter().map(half).collect();
    let mut file = Cursor::new(Vec::new());
    let texts = [("Software", concat!("onelight ", env!("CARGO_PKG_VERSION")))];
    let primaries = Some(Chromaticities::BT709);
    Picture { primaries, ..Picture::opaque(SCENE.0, SCENE.1, rgb, Source::Exr) }.write_exr(&mut file, &texts)?;
    Ok(file.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_look_develops_as_the_film_that_it_is_of() {
        let (name, form) = look("kodak-5207", Some("kodak-2383")).unwrap();
        assert_eq!(name, "kodak-5207 kodak-2383");
        let keys = Keys::from_json("{}").unwrap();
        let look = FilmLook::new(&keys).unwrap().with_direct(form);
        // A grey card in half floats.
        assert_eq!(look.develop(&[0x31c3, 0x31c3, 0x31c3, 0x3c00], 0.0).unwrap(), [123, 123, 123, 255]);
    }
}
