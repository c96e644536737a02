//! The fixture scene as a film and as an RGB camera see it.

use anyhow::{Context, Result};
use onelight::Reference;
use onelight::film::{PerLayer, Tail};
use onelight::spectra::nalgebra::Vector3;
use onelight::spectra::{Chromaticity, Kelvin, Observer, RgbSpace, SpectralShape, black_body, color_checker};
use onelight::stock;

use crate::scene::{self, Image, Inputs, Nodes};

/// The camera film whose true exposures go with the scene.
pub(crate) const TRUE_FILM: &str = "kodak-5207";

/// The scene: RGB (sRGB primaries, 6500 K white) and the exposures its spectra give [`TRUE_FILM`], as
/// [`Reference::develop_exposure`] takes them.
pub(crate) struct Truth {
    pub(crate) rgb: Vec<[f32; 3]>,
    pub(crate) exposure: Vec<[f32; 3]>,
}

impl Truth {
    /// Renders the scene; `film` is a process with [`TRUE_FILM`] in the camera.
    pub(crate) fn render(size: (usize, usize), film: &Reference) -> Result<Self> {
        let sensors = [rgb_sensors()?, film_sensors(film)?].concat();
        let image = render(size, &sensors)?;
        let triple = |offset: usize| {
            let pixels = image.responses.chunks_exact(sensors.len());
            pixels.map(|p| [p[offset], p[offset + 1], p[offset + 2]]).collect::<Vec<[f32; 3]>>()
        };
        Ok(Self { rgb: triple(0), exposure: triple(3) })
    }
}

/// The scene as RGB alone (sRGB primaries, 6500 K white).
pub(crate) fn rgb(size: (usize, usize)) -> Result<Vec<[f32; 3]>> {
    let image = render(size, &rgb_sensors()?)?;
    Ok(image.responses.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect())
}

fn render(size: (usize, usize), sensors: &[Nodes]) -> Result<Image> {
    let patches: Vec<Nodes> = color_checker().iter().map(|patch| at_nodes(|nm| patch.reflectance.at(nm))).collect();
    let patches: [Nodes; 24] = patches.try_into().ok().context("the ColorChecker has 24 patches")?;
    Ok(scene::render(size, &Inputs { color_checker: &patches }, sensors))
}

/// The exposures as the reference takes them.
pub(crate) fn layers(exposure: [f32; 3]) -> PerLayer<f64> {
    PerLayer::from(exposure.map(f64::from))
}

fn rgb_sensors() -> Result<Vec<Nodes>> {
    let observer = Observer::cie_1931();
    let white = observer.xyz(&black_body(Kelvin::WHITE, SpectralShape::VISIBLE)).y;
    let from_xyz = RgbSpace::SRGB.with_white(Chromaticity::black_body_6500_k()).from_xyz()? / white;
    let [x, y, z] = observer.matching_functions();
    let rgb: Vec<Vector3<f64>> = (0..SpectralShape::VISIBLE.len())
        .map(|i| from_xyz * Vector3::new(x.values()[i], y.values()[i], z.values()[i]))
        .collect();
    Ok((0..3).map(|k| scene::sensor(|i| rgb[i][k])).collect())
}

fn film_sensors(film: &Reference) -> Result<Vec<Nodes>> {
    let stock = stock(TRUE_FILM)?;
    let matching = film.exposure_matrix().matching_vector().to_array();
    let layers = stock.sensitivity().to_array().into_iter().zip(matching);
    layers
        .map(|(sensitivity, c)| {
            let on_grid = sensitivity.on(SpectralShape::VISIBLE, Tail::LogLinear)?;
            Ok(scene::sensor(|i| c * on_grid.values()[i]))
        })
        .collect()
}

/// Values of a curve at the scene's nodes.
fn at_nodes(curve: impl Fn(f64) -> Option<f64>) -> Nodes {
    scene::sample(|nm| curve(f64::from(nm)).unwrap_or(0.0) as f32)
}
