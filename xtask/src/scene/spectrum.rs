//! Light and reflectance as values at 41 nodes, 380..780 nm.

use std::sync::OnceLock;

use onelight::spectra::{self, Kelvin, Observer, SpectralShape};

/// Number of wavelengths a spectrum is known at: 380 nm to 780 nm, step 10 nm, linear between.
pub(crate) const NODES: usize = 41;

/// Distance between nodes.
const STEP_NM: f64 = 10.0;

/// A spectrum: its values at the nodes.
pub(crate) type Nodes = [f32; NODES];

/// The spectrum of a formula in the wavelength, nm.
pub(crate) fn sample(formula: impl Fn(f32) -> f32) -> Nodes {
    std::array::from_fn(|node| formula((SpectralShape::VISIBLE.first_nm() + STEP_NM * node as f64) as f32))
}

/// Product of two spectra.
pub(super) fn product(a: &Nodes, b: &Nodes) -> Nodes {
    std::array::from_fn(|node| a[node] * b[node])
}

/// `a (1 - t) + b t`.
pub(super) fn mix(a: &Nodes, b: &Nodes, t: f32) -> Nodes {
    std::array::from_fn(|node| a[node] + (b[node] - a[node]) * t)
}

/// Adds `weight * term` to `sum`.
pub(super) fn add(sum: &mut Nodes, term: &Nodes, weight: f32) {
    for (s, t) in sum.iter_mut().zip(term) {
        *s += weight * t;
    }
}

/// Luminance, relative to the 6500 K black body that is 1 at 560 nm: the white of the picture.
pub(super) fn luminance(light: &Nodes) -> f32 {
    static WEIGHTS: OnceLock<Nodes> = OnceLock::new();
    let weights = WEIGHTS.get_or_init(|| {
        let observer = Observer::cie_1931();
        let white = observer.xyz(&spectra::black_body(Kelvin::WHITE, SpectralShape::VISIBLE)).y;
        sensor(|i| observer.matching_functions()[1].values()[i] / white)
    });
    weights.iter().zip(light).map(|(w, l)| w * l).sum()
}

/// Weights on the nodes that give the integral of `response` (at the points of 380..780 nm by 1 nm) times light that is
/// linear between nodes.
pub(crate) fn sensor(response: impl Fn(usize) -> f64) -> Nodes {
    let mut weights = [0.0f64; NODES];
    let grid = SpectralShape::VISIBLE;
    for (i, (nm, width)) in grid.wavelengths_nm().zip(grid.trapezoid_weights_nm()).enumerate() {
        let position = (nm - grid.first_nm()) / STEP_NM;
        let node = (position as usize).min(NODES - 2);
        let t = position - node as f64;
        weights[node] += (1.0 - t) * width * response(i);
        weights[node + 1] += t * width * response(i);
    }
    weights.map(|w| w as f32)
}

/// The same colour of light at luminance 1.
pub(super) fn unit(light: &Nodes) -> Nodes {
    let scale = 1.0 / luminance(light);
    light.map(|v| v * scale)
}

/// Black body, at luminance 1.
pub(super) fn black_body(kelvin: f64) -> Nodes {
    // All temperatures of the scene are in range; white stands in for one that is not.
    let temperature = Kelvin::new(kelvin).unwrap_or(Kelvin::WHITE);
    let green = spectra::planck_radiance(temperature, 560.0);
    unit(&sample(|nm| (spectra::planck_radiance(temperature, f64::from(nm)) / green) as f32))
}

/// A line or LED of a centre and standard deviation, nm, at luminance 1.
pub(super) fn line(centre_nm: f32, deviation_nm: f32) -> Nodes {
    unit(&sample(|nm| bell(nm, centre_nm, deviation_nm)))
}

/// Gaussian of height 1.
pub(super) fn bell(nm: f32, centre_nm: f32, deviation_nm: f32) -> f32 {
    (-0.5 * ((nm - centre_nm) / deviation_nm).powi(2)).exp()
}

/// Sigmoid from 0 to 1, `width_nm` being the reciprocal of four times its steepest slope.
pub(super) fn rise(nm: f32, centre_nm: f32, width_nm: f32) -> f32 {
    1.0 / (1.0 + ((centre_nm - nm) / width_nm).exp())
}
