//! The tint of greys for either white in either aim.

use anyhow::Result;
use onelight::certify::{Certifier, Tint};
use onelight::{Aim, Process, White, Word as _};
use serde_json::{Value, json};

use crate::look::ChosenLook;

/// The same films for a white and an aim, and their tint of greys.
pub(super) struct Tinted {
    white: White,
    aim: Aim,
    tint: Tint,
}

/// The tints of a film for both whites and both aims, as far as its other settings go with them; none of a look without film.
pub(super) fn of(look: &ChosenLook) -> Result<Vec<Tinted>> {
    let Process::Film(film) = &look.process else { return Ok(Vec::new()) };
    let mut tints = Vec::new();
    for white in [White::Film, White::Lamp] {
        for aim in [Aim::Neutral, Aim::Sheet] {
            // A printer that does not reach the sheet's aim, or a density of one's own for grey, leaves fewer of them.
            let other = look.with(onelight::FilmProcess { white, aim, ..film.clone() }.into());
            if let Ok(other) = other.look() {
                tints.push(Tinted { white, aim, tint: Certifier::new(&other)?.tint() });
            }
        }
    }
    Ok(tints)
}

/// One line for people, empty where there are none.
pub(super) fn text(tints: &[Tinted]) -> String {
    let words: Vec<String> = tints
        .iter()
        .map(|Tinted { white, aim, tint }| {
            format!("{} white, {} aim {:.1} and {:.1}", white.word(), aim.word(), tint.mid_grey, tint.largest)
        })
        .collect();
    if words.is_empty() { String::new() } else { format!("  C* at 18 % and at most: {}\n", words.join("; ")) }
}

pub(super) fn json(tints: &[Tinted]) -> Value {
    let each = tints.iter().map(|Tinted { white, aim, tint }| {
        let Tint { mid_grey, largest, stops } = tint;
        json!({ "white": white.word(), "aim": aim.word(), "mid_grey": mid_grey, "largest": largest, "stops": stops })
    });
    each.collect()
}
