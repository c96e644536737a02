//! A negative on print film, on paper, and scanned.

use onelight::spectra::{DisplayLinear, MID_GREY};
use onelight::{FilmProcess, Printing};

use super::chart::{Scene, chroma};
use crate::error::Result;

/// The negatives that are seen in every way.
const NEGATIVES: [&str; 3] = ["kodak-5207", "kodak-portra-400", "fuji-pro-400h"];
/// What they are printed on.
const PRINTS: [&str; 2] = ["kodak-2383", "kodak-endura-premier"];

/// A way to see a negative.
pub(super) struct Way {
    pub(super) name: String,
    /// Slope of log10 luminance over log10 exposure at a grey card.
    pub(super) gamma: f64,
    /// Median chroma of the chart, and median turn of hue in degrees.
    pub(super) chroma: f64,
    pub(super) turn: f64,
    /// Largest C* of greys from -4 to +2 stops, and where: a scan's white lies not far above.
    pub(super) tint: (f64, f64),
    /// Stops over a grey card at which green reaches the display's white; `None` where it does not up to +8 stops.
    pub(super) white: Option<f64>,
}

/// Every negative in every way.
pub(super) fn all(scene: &Scene) -> Result<Vec<Way>> {
    let mut ways = Vec::new();
    for id in NEGATIVES {
        for print in PRINTS {
            let process = FilmProcess { print: Some(Printing::on(print)), ..FilmProcess::for_camera(id)? };
            let look = process.compile()?;
            ways.push(way(scene, look.name().replace('_', " on "), |rgb| look.develop_linear(rgb)));
        }
        let look = FilmProcess::scanned(id).compile()?;
        ways.push(way(scene, format!("{id}, scanned"), |rgb| look.develop_linear(rgb)));
    }
    Ok(ways)
}

fn way(scene: &Scene, name: String, develop: impl Fn([f64; 3]) -> DisplayLinear) -> Way {
    let grey = |stops: f64| develop([MID_GREY * stops.exp2(); 3]);
    // Greys are nearly neutral: green stands for luminance.
    let step = 1.0 / 3.0;
    let gamma = (grey(step)[1] / grey(-step)[1]).log10() / (2.0 * step * std::f64::consts::LOG10_2);
    let chart = scene.chart(|_, rgb| develop(rgb));
    let tint = (-16..=8).map(|i| f64::from(i) / 4.0).map(|stops| (chroma(scene.lab(grey(stops))), stops));
    let tint = tint.fold((0.0, 0.0), |most, grey| if grey.0 > most.0 { grey } else { most });
    let white = (0..=80).map(|i| f64::from(i) / 10.0).find(|stops| grey(*stops)[1] >= 0.995);
    Way { name, gamma, chroma: chart.median_chroma(), turn: chart.median_turn(), tint, white }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A scan's rule keeps the light of the scene: 0.6 is taken out again of films of about 0.6, where a print adds contrast.
    #[test]
    fn a_scan_is_flatter_than_any_print() {
        for ways in all(&Scene::new().unwrap()).unwrap().chunks(3) {
            let [film, paper, scan] = ways else { panic!("three ways") };
            assert!(scan.gamma < film.gamma && scan.gamma < paper.gamma, "{}: {}", scan.name, scan.gamma);
            assert!((0.6..1.3).contains(&scan.gamma), "{}: {}", scan.name, scan.gamma);
        }
    }
}
