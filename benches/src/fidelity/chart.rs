//! The ColorChecker on a film: chroma and hue against the reflectances' own.

use onelight::printing::NEUTRAL_DENSITY;
use onelight::spectra::quantity::Power;
use onelight::spectra::{
    Basis, DisplayDifference, DisplayLinear, MID_GREY, Patch, Reconstruction, RgbSpace, SpectralDistribution,
    color_checker,
};

use crate::error::Result;

/// Patches that are colours; the other six are greys.
pub(super) const COLOURS: usize = 18;

/// One colour in CIELAB: the scene's own, and the film's.
#[derive(Debug, Clone)]
pub(super) struct ChartColour {
    /// The patch: `blue sky`.
    pub(super) name: String,
    /// L*, a*, b* of the scene, shown with the same mid grey.
    pub(super) scene: [f64; 3],
    /// L*, a*, b* of the film's picture.
    pub(super) film: [f64; 3],
}

impl ChartColour {
    /// Chroma of the film's colour over the scene's.
    pub(super) fn chroma(&self) -> f64 {
        chroma(self.film) / chroma(self.scene)
    }

    /// Hue of the film's colour less the scene's, in degrees, -180 to 180.
    pub(super) fn turn(&self) -> f64 {
        (hue(self.film) - hue(self.scene) + 540.0).rem_euclid(360.0) - 180.0
    }
}

pub(super) fn chroma([_, a, b]: [f64; 3]) -> f64 {
    a.hypot(b)
}

fn hue([_, a, b]: [f64; 3]) -> f64 {
    b.atan2(a).to_degrees()
}

/// The chart's patches as a film shows them.
pub(super) struct Chart {
    /// All 24, in the order of the chart.
    pub(super) colours: Vec<ChartColour>,
}

/// What is lit and looked at: the 6500 K white, scene RGB of spectra, and colours of displays.
pub(super) struct Scene {
    basis: Basis,
    difference: DisplayDifference,
}

impl Scene {
    pub(super) fn new() -> Result<Self> {
        Ok(Self { basis: Basis::new(Reconstruction::Smooth)?, difference: DisplayDifference::new(&RgbSpace::SRGB)? })
    }

    /// Scene-linear RGB of a light; what lies outside sRGB is at its edge.
    pub(super) fn rgb(&self, light: &SpectralDistribution<Power>) -> [f64; 3] {
        self.basis.rgb_of(light).map(|v| v.max(0.0))
    }

    pub(super) fn lab(&self, rgb: DisplayLinear) -> [f64; 3] {
        self.difference.lab(rgb)
    }

    /// A colour of the scene and what the film makes of it.
    pub(super) fn colour(&self, name: &str, scene_rgb: [f64; 3], film: DisplayLinear) -> ChartColour {
        // A grey card as bright as in the picture.
        let shown = DisplayLinear(scene_rgb.map(|v| v * 10f64.powf(-NEUTRAL_DENSITY) / MID_GREY));
        ChartColour { name: name.to_owned(), scene: self.lab(shown), film: self.lab(film) }
    }

    /// Scene-linear RGB of a patch under the white of the scene.
    pub(super) fn patch(&self, patch: &Patch) -> [f64; 3] {
        self.rgb(&self.basis.white().reflected_by(&patch.reflectance))
    }

    /// The whole chart; `develop` takes a patch and its scene-linear RGB to display-linear RGB.
    pub(super) fn chart(&self, develop: impl Fn(&Patch, [f64; 3]) -> DisplayLinear) -> Chart {
        let colours = color_checker().iter().map(|patch| {
            let rgb = self.patch(patch);
            self.colour(&patch.name, rgb, develop(patch, rgb))
        });
        Chart { colours: colours.collect() }
    }
}

impl Chart {
    pub(super) fn turn(&self, name: &str) -> f64 {
        self.colours.iter().find(|colour| colour.name == name).map_or(f64::NAN, ChartColour::turn)
    }

    /// Median over the 18 colours of chroma over the scene's.
    pub(super) fn median_chroma(&self) -> f64 {
        median(self.colours[..COLOURS].iter().map(ChartColour::chroma))
    }

    /// Median over the 18 colours of the size of the turn in degrees.
    pub(super) fn median_turn(&self) -> f64 {
        median(self.colours[..COLOURS].iter().map(|colour| colour.turn().abs()))
    }

    /// The colour that turns most.
    pub(super) fn largest_turn(&self) -> (f64, &str) {
        let turns = self.colours[..COLOURS].iter().map(|colour| (colour.turn(), colour.name.as_str()));
        turns.fold((0.0, ""), |most, turn| if turn.0.abs() > most.0.abs() { turn } else { most })
    }
}

fn median(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    if values.len() % 2 == 1 { values[middle] } else { f64::midpoint(values[middle - 1], values[middle]) }
}
