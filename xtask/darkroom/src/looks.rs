//! What the page need not compute: the looks of all camera films on their usual prints, and a scene.

use std::collections::BTreeMap;
use std::io::Cursor;

use anyhow::{Context, Result};
use half::f16;
use onelight_picture::{Picture, Source};
use onelight_web::{FilmLook, Keys, films};
use rayon::prelude::*;
use serde_json::{Value, json};

/// Pixels of the scene across and down.
const SCENE: (usize, usize) = (720, 405);

/// The direct form of each camera film on its usual print, by the film's id.
///
/// # Errors
/// None with the films that are built in.
pub(crate) fn looks() -> Result<Vec<u8>> {
    let films = films()?;
    let cameras: Vec<&str> = films.iter().filter(|film| film.is_camera).map(|film| film.id.as_str()).collect();
    let looks = cameras.par_iter().map(|id| look(id)).collect::<Result<BTreeMap<_, _>>>()?;
    Ok(serde_json::to_vec(&looks)?)
}

/// The direct form of a camera film on its usual print, with the film's id.
fn look(id: &str) -> Result<(String, Value)> {
    let keys = Keys::from_json(&json!({ "camera": id }).to_string())?.fitting()?;
    let file = FilmLook::new(&keys)?.direct_json().with_context(|| id.to_owned())?;
    Ok((id.to_owned(), String::from_utf8(file)?.into()))
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
    Picture::opaque(SCENE.0, SCENE.1, rgb, Source::Exr).write_exr(&mut file, &texts)?;
    Ok(file.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_look_develops_as_the_film_that_it_is_of() {
        let (id, file) = look("kodak-5207").unwrap();
        assert_eq!(id, "kodak-5207");
        let keys = Keys::from_json("{}").unwrap();
        let look = FilmLook::new(&keys).unwrap().with_direct(file.as_str().unwrap()).unwrap();
        // A grey card in half floats.
        assert_eq!(look.develop(&[0x31c3, 0x31c3, 0x31c3, 0x3c00], 0.0).unwrap(), [123, 123, 123, 255]);
    }
}
