//! Where blue sky and cyan turn: each step of the chain exchanged for one that does not mix layers.

use onelight::film::{ExposureMatrix, LogExposure, PerLayer, Tail};
use onelight::spectra::quantity::{Power, Responsivity};
use onelight::spectra::{
    Illuminant, Kelvin, MID_GREY, Patch, SpectralDistribution, SpectralShape, black_body, illuminant,
};
use onelight::{DyeModel, FilmProcess, PrintCurves, PrinterLight, Printing, Reconstruction, White, stock};

use super::chart::Scene;
use super::negative::ALONE;
use super::printer::{Beams, NegativeDyes, Overlap, Parts, PrintDyes, Printed, USUAL};
use crate::error::Result;

/// A step exchanged, and what the chart does then.
#[derive(Debug, Clone)]
pub(super) struct Cause {
    /// What is exchanged for what.
    pub(super) what: &'static str,
    /// Turns of blue sky and of cyan, in degrees.
    pub(super) turns: [f64; 2],
    /// Median size of the turns of the chart's 18 colours.
    pub(super) median: f64,
}

/// What reaches the layers of the camera film from a patch.
#[derive(Debug, Clone, Copy)]
enum Seen {
    /// A spectrum made of its RGB: what a picture gives.
    Rgb,
    /// Its reflectance in this light, balanced for it.
    Reflectance(Light),
    /// A film that sees with the display's primaries.
    Primaries,
}

#[derive(Debug, Clone, Copy)]
enum Light {
    White,
    Daylight,
    Sun,
}

/// The default look and its variants.
pub(super) fn all() -> Result<Vec<Cause>> {
    let scene = Scene::new()?;
    let usual = FilmProcess::default();
    let with = |change: fn(&mut FilmProcess)| {
        let mut process = usual.clone();
        change(&mut process);
        process
    };
    let printed = |change: fn(&mut Printing)| {
        let mut process = usual.clone();
        process.print.iter_mut().for_each(change);
        process
    };
    let apart = Parts { negative: NegativeDyes::Apart, print: PrintDyes::Apart, ..USUAL };
    let rows: Vec<(&'static str, FilmProcess, Parts, Seen)> = vec![
        ("the default look", usual.clone(), USUAL, Seen::Rgb),
        (
            "spectra by least slope, with negative lobes",
            with(|p| p.reconstruction = Reconstruction::PseudoInverse),
            USUAL,
            Seen::Rgb,
        ),
        (
            "spectra of three boxes, balanced",
            with(|p| p.reconstruction = Reconstruction::BoxesBalanced),
            USUAL,
            Seen::Rgb,
        ),
        ("white: the bare lamp, not clear film", with(|p| p.white = White::Lamp), USUAL, Seen::Rgb),
        ("no inter-image effect", with(|p| p.inter_image = ALONE), USUAL, Seen::Rgb),
        ("the patch's own reflectance in 6500 K, not its RGB", usual.clone(), USUAL, Seen::Reflectance(Light::White)),
        ("the same in daylight D65, grey balanced", usual.clone(), USUAL, Seen::Reflectance(Light::Daylight)),
        ("the same in 5400 K, grey balanced", usual.clone(), USUAL, Seen::Reflectance(Light::Sun)),
        ("camera layers that see the display's primaries", usual.clone(), USUAL, Seen::Primaries),
        ("a printer of dichroic beams", usual.clone(), Parts { beams: Beams::Dichroic, ..USUAL }, Seen::Rgb),
        (
            "a printer of three lines at the print's peaks",
            usual.clone(),
            Parts { beams: Beams::Lines, ..USUAL },
            Seen::Rgb,
        ),
        ("white printing light", printed(|p| p.light = PrinterLight::White), USUAL_WHITE, Seen::Rgb),
        (
            "print layers that see their own beam alone",
            usual.clone(),
            Parts { overlap: Overlap::None, ..USUAL },
            Seen::Rgb,
        ),
        (
            "negative dyes that act on their own layer alone",
            usual.clone(),
            Parts { negative: NegativeDyes::Apart, ..USUAL },
            Seen::Rgb,
        ),
        (
            "print dyes that act on their own primary alone",
            usual.clone(),
            Parts { print: PrintDyes::Apart, ..USUAL },
            Seen::Rgb,
        ),
        ("print's curves principal", printed(|p| p.curves = PrintCurves::Principal), USUAL, Seen::Rgb),
        ("dyes literal", with(|p| p.dyes = DyeModel::Literal), USUAL, Seen::Rgb),
        ("negative's and print's dyes apart", usual.clone(), apart, Seen::Rgb),
        ("both, and layers that see the display's primaries", usual.clone(), apart, Seen::Primaries),
        ("all three, and no inter-image effect", with(|p| p.inter_image = ALONE), apart, Seen::Primaries),
    ];
    rows.into_iter().map(|(what, process, parts, seen)| cause(&scene, what, &process, parts, seen)).collect()
}

/// White light: no beam is another layer's.
const USUAL_WHITE: Parts = Parts { overlap: Overlap::None, ..USUAL };

fn cause(scene: &Scene, what: &'static str, process: &FilmProcess, parts: Parts, seen: Seen) -> Result<Cause> {
    let printed = Printed::new(process, parts)?;
    let camera = Camera::new(process, &printed, seen)?;
    let chart = scene.chart(|patch, rgb| printed.develop(camera.expose(patch, rgb)));
    Ok(Cause { what, turns: [chart.turn("blue sky"), chart.turn("cyan")], median: chart.median_turn() })
}

/// How the camera film is exposed.
enum Camera {
    Matrix(ExposureMatrix),
    Spectral {
        light: SpectralDistribution<Power>,
        layers: PerLayer<SpectralDistribution<Responsivity>>,
        grey: PerLayer<f64>,
    },
    Primaries(PerLayer<f64>),
}

impl Camera {
    fn new(process: &FilmProcess, printed: &Printed, seen: Seen) -> Result<Self> {
        let shape = SpectralShape::VISIBLE;
        let grey = printed.reference().mid_grey().map(LogExposure::exposure);
        let light = match seen {
            Seen::Rgb => return Ok(Self::Matrix(printed.reference().exposure_matrix().clone())),
            Seen::Primaries => return Ok(Self::Primaries(grey)),
            Seen::Reflectance(Light::White) => black_body(Kelvin::WHITE, shape),
            Seen::Reflectance(Light::Daylight) => illuminant(Illuminant::D65, shape),
            Seen::Reflectance(Light::Sun) => black_body(Kelvin::new(5400.0)?, shape),
        };
        let layers = stock(process.camera.id())?.sensitivity().try_map(|s, _| s.on(shape, Tail::LogLinear))?;
        // What a layer's response is multiplied by to be an exposure.
        let grey = layers.as_ref().zip_map(grey, |layer, grey| grey / (MID_GREY * light.response(layer)));
        Ok(Self::Spectral { light, layers, grey })
    }

    fn expose(&self, patch: &Patch, rgb: [f64; 3]) -> PerLayer<f64> {
        match self {
            Self::Matrix(matrix) => matrix.expose(rgb),
            Self::Primaries(grey) => grey.zip_map(PerLayer::from(rgb), |grey, v| grey * v / MID_GREY),
            Self::Spectral { light, layers, grey } => {
                let light = light.reflected_by(&patch.reflectance);
                layers.as_ref().zip_map(*grey, |layer, grey| light.response(layer) * grey)
            }
        }
    }
}
