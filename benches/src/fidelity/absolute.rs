//! Greys where a film's layers are exposed by their sensitivities as published, not balanced on grey.

use onelight::{Aim, FilmProcess, Image, InterImageChoice, Matching, Reference, stock, stock_ids};

use super::chart::{Scene, chroma};
use super::greys;
use super::negative::ALONE;
use crate::error::Result;

/// A film's greys under absolute matching.
pub(super) struct Unbalanced {
    pub(super) id: &'static str,
    /// Stops by which an 18 % grey card exposes the red, green and blue layer more than it does in the balanced film.
    pub(super) off: [f64; 3],
    /// CIELAB of that card, and the largest C* of greys from -4 to +6 stops with its place.
    pub(super) grey: [f64; 3],
    pub(super) tint: (f64, f64),
    /// C* of the card where layers do not inhibit each other.
    pub(super) alone: f64,
}

/// Every camera film in colour whose sheet has what absolute matching asks for.
pub(super) fn all(scene: &Scene) -> Result<Vec<Unbalanced>> {
    let mut found = Vec::new();
    for id in stock_ids() {
        let film = stock(id)?;
        if !film.kind().is_camera_film() || film.image() == Image::Silver {
            continue;
        }
        let usual = FilmProcess::for_camera(id)?;
        let absolute = |inter_image: InterImageChoice| {
            FilmProcess { matching: Matching::Absolute, inter_image, ..usual.clone() }.compile()
        };
        // Sheets without an absolute axis or a criterion of sensitivity are refused, each in a sentence.
        let Ok(look) = absolute(usual.inter_image) else { continue };
        let balanced = FilmProcess { aim: Aim::Neutral, ..usual.clone() }.compile()?;
        let card = |look: &Reference| look.stages([onelight::spectra::MID_GREY; 3]).exposure;
        let off =
            card(&look).zip_map(card(&balanced), |own, balanced| (own.0 - balanced.0) / std::f64::consts::LOG10_2);
        found.push(Unbalanced {
            id,
            off: off.to_array(),
            grey: greys::grey(scene, &look, 0.0),
            tint: greys::tint(scene, &look),
            alone: chroma(greys::grey(scene, &absolute(ALONE)?, 0.0)),
        });
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the films that are not refused two are for tungsten light, which the scene's 6500 K is far from.
    #[test]
    fn films_for_tungsten_see_blue_light_and_others_do_not() {
        let found = all(&Scene::new().unwrap()).unwrap();
        assert!(found.len() > 4);
        for Unbalanced { id, off: [red, _, blue], grey, alone, .. } in found {
            let tungsten = stock(id).unwrap().balance().contains("tungsten");
            assert!(if tungsten { blue - red > 2.0 } else { (blue - red).abs() < 1.3 }, "{id}: {:+.2}", blue - red);
            // Layers apart are driven further apart.
            assert!(alone < grey[1].hypot(grey[2]), "{id}");
        }
    }
}
