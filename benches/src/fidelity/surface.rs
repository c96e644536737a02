//! What light reflected by a paper's surface would do to a print.

use onelight::spectra::{DisplayLinear, color_checker};
use onelight::{FilmProcess, Printing};

use super::chart::Scene;
use crate::error::Result;

/// A negative or a slide and its paper.
const PRINTS: [(&str, &str); 4] = [
    ("kodak-portra-400", "kodak-endura-premier"),
    ("fuji-pro-400h", "fuji-crystal-archive-dpii"),
    ("fuji-velvia-50", "kodak-radiance-iii"),
    ("kodak-tri-x-400", "kodak-polymax-fine-art"),
];

/// Light from the surface as a part of what white paper reflects: the range that is tried.
pub(super) const SURFACE: [f64; 2] = [0.005, 0.01];

/// A print, and what each amount of [`SURFACE`] makes of it.
pub(super) struct Reflecting {
    pub(super) name: String,
    /// L* of the print's densest black: without, and with each amount.
    pub(super) black: [f64; 3],
    /// CIEDE2000 on the ColorChecker for each amount: mean and largest, with its patch.
    pub(super) moved: [(f64, f64, String); 2],
}

/// Every print.
pub(super) fn all(scene: &Scene) -> Result<Vec<Reflecting>> {
    let print = |(camera, paper): (&str, &str)| {
        let look = FilmProcess { print: Some(Printing::on(paper)), ..FilmProcess::for_camera(camera)? }.compile()?;
        let difference = look.difference()?;
        let patches: Vec<(&str, DisplayLinear)> = color_checker()
            .iter()
            .map(|patch| (patch.name.as_str(), look.develop_linear(scene.patch(patch))))
            .collect();
        let moved = SURFACE.map(|part| {
            let all = patches.iter().map(|(name, rgb)| (difference.between(*rgb, with_surface(*rgb, part)), *name));
            let all: Vec<(f64, &str)> = all.collect();
            let mean = all.iter().map(|(moved, _)| moved).sum::<f64>() / all.len() as f64;
            let (most, name) = all.into_iter().fold((0.0, ""), |most, one| if one.0 > most.0 { one } else { most });
            (mean, most, name.to_owned())
        });
        let black = look.develop_linear([0.0; 3]);
        let lightness = |part| difference.lab(with_surface(black, part))[0];
        Ok(Reflecting {
            name: look.name().replace('_', " on "),
            black: [0.0, SURFACE[0], SURFACE[1]].map(lightness),
            moved,
        })
    };
    PRINTS.into_iter().map(print).collect()
}

/// The surface's light is as white as the paper, which a viewer still takes for white.
fn with_surface(rgb: DisplayLinear, part: f64) -> DisplayLinear {
    DisplayLinear(rgb.map(|v| (v + part) / (1.0 + part)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_paper_stays_white_and_black_gets_lighter() {
        assert_eq!(with_surface(DisplayLinear([1.0; 3]), 0.01), DisplayLinear([1.0; 3]));
        for print in all(&Scene::new().unwrap()).unwrap() {
            assert!(print.black.windows(2).all(|pair| pair[0] < pair[1]), "{}", print.name);
            let [half, one] = print.moved;
            assert!(half.0 > 0.1 && half.0 < one.0 && one.0 < one.1, "{}", print.name);
        }
    }
}
