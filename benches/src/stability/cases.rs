//! Hard inputs, each with a name.

use onelight::WorkingSpace;
use onelight::spectra::{Chromaticity, Observer};

use crate::error::Result;

/// How the colours of a strand follow each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Order {
    /// The colours are no neighbours.
    Loose,
    /// Each is the neighbour of the next.
    Line,
    /// As [`Order::Line`], and they are greys that get no darker.
    Greys,
    /// As [`Order::Line`], and the last is the neighbour of the first.
    Circle,
}

/// Scene colours that belong together, in the primaries of the process.
#[derive(Debug, Clone)]
pub(super) struct Strand {
    pub(super) order: Order,
    pub(super) colours: Vec<[f32; 3]>,
}

/// Hard inputs of one kind, by name.
#[derive(Debug, Clone)]
pub(super) struct Case {
    pub(super) name: &'static str,
    pub(super) strands: Vec<Strand>,
}

impl Case {
    pub(super) fn new(name: &'static str) -> Self {
        Self { name, strands: Vec::new() }
    }

    pub(super) fn with(mut self, order: Order, colours: impl IntoIterator<Item = [f32; 3]>) -> Self {
        self.strands.push(Strand { order, colours: colours.into_iter().collect() });
        self
    }

    pub(super) fn len(&self) -> usize {
        self.strands.iter().map(|strand| strand.colours.len()).sum()
    }
}

/// Scene value of mid grey.
pub(super) const GREY: f64 = onelight::spectra::MID_GREY;

/// Greys so many stops about mid grey.
pub(super) fn stops(about: f64) -> f64 {
    GREY * about.exp2()
}

/// The six saturated hues: primaries and secondaries.
const HUES: [[f64; 3]; 6] =
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0], [1.0, 0.0, 1.0]];
/// Light and dark skin under the white of the scene, about as bright as grey.
const SKIN: [[f64; 3]; 2] = [[2.1, 1.4, 1.1], [1.5, 0.8, 0.6]];

/// Where something was worst or wrong before, with the look.
const FOUND: [[f32; 3]; 16] = [
    // Rounding of sRGB to sRGB, 1e-17, drowned what is not huge: dE 97 on any film.
    [-f32::MAX, -f32::MAX, 0.18],
    [f32::INFINITY, 0.18, f32::NEG_INFINITY],
    // Falls of luminance: 5207 on 2383, Portra 400 on 2393, Gold 200 on 5386.
    [53.670925, 53.670925, 53.670925],
    [17.435673, 17.435673, 17.435673],
    [78.03605, 78.03605, 78.03605],
    // Float32 against float64, and vectors against float32: 5207 on 2383 in either aim, 5203 on 2383, Portra 400 on 3523XD, 5219
    // on 3523XD.
    [0.0, 2.592, 11.52],
    [0.0, 0.0, 49.73084],
    [0.0, 0.0, 77.49702],
    [0.0, 0.0, 43.89756],
    [0.0, 0.0, 12.693947],
    [0.0, 0.80444676, 0.80444676],
    // The direct form against the film: 5213 on 5386, 5207 on 2383.
    [0.192, 0.0, 11.52],
    [0.0, 0.3429497, 0.0],
    // The structured form: Portra 400 on 3523XD, 5207 on 2383.
    [0.0, 2.88, 0.072],
    [0.096, 0.0, 2.88],
    // The plain form short of its end: 5207 on 2383.
    [0.0, 0.0, 58.731754],
];

/// Those that no film decides.
pub(super) fn general(space: WorkingSpace) -> Result<Vec<Case>> {
    let (nan, inf) = (f32::NAN, f32::INFINITY);
    Ok(vec![
        Case::new("zeros").with(Order::Loose, triples(&[0.0, -0.0, 0.18, 1.0])),
        subnormals(),
        decades(),
        Case::new("negatives").with(Order::Loose, triples(&[-f32::MAX, -1e30, -1.0, -1e-3, -1e-40, 0.0, 0.18])),
        Case::new("NaN and infinities").with(Order::Loose, triples(&[nan, -nan, inf, -inf, f32::MAX, 0.18])),
        spectral_locus(space)?,
        one_channel(),
        hue_circles(),
        ramps(),
        // Last: where a case finds the same again, its name says more.
        Case::new("found before").with(Order::Loose, FOUND),
    ])
}

/// Every colour whose channels are three of these values.
fn triples(values: &[f32]) -> impl Iterator<Item = [f32; 3]> {
    let n = values.len();
    (0..n.pow(3)).map(move |i| [values[i % n], values[i / n % n], values[i / n / n]])
}

fn single(rgb: [f64; 3]) -> [f32; 3] {
    rgb.map(|v| v as f32)
}

fn scaled(rgb: [f64; 3], by: f64) -> [f32; 3] {
    single(rgb.map(|v| v * by))
}

/// Below the smallest normal number, alone and beside mid grey.
fn subnormals() -> Case {
    let least = f32::MIN_POSITIVE.to_bits();
    let rising = [0, 1, 2, 1000, least / 2, least - 1, least, least + 1].map(f32::from_bits);
    let beside = rising.into_iter().chain([-f32::from_bits(1), 0.18]).collect::<Vec<_>>();
    Case::new("subnormals").with(Order::Greys, rising.map(|v| [v; 3])).with(Order::Loose, triples(&beside))
}

/// 1e-12 to 1e30: greys by tenths, and hues and mixtures of far apart decades.
fn decades() -> Case {
    let greys = (-120..=300).map(|i| single([10_f64.powf(f64::from(i) / 10.0); 3]));
    let hues = HUES.into_iter().flat_map(|hue| (-12..=30).map(move |i| scaled(hue, 10_f64.powi(i))));
    let apart: Vec<f32> = (-2..=5).map(|i| 10_f32.powi(6 * i)).collect();
    Case::new("1e-12 to 1e30").with(Order::Greys, greys).with(Order::Loose, hues).with(Order::Loose, triples(&apart))
}

/// Light of one wavelength by 10 nm from -10 to +14 stops: the largest channel lies so far above mid grey.
fn spectral_locus(space: WorkingSpace) -> Result<Case> {
    let from_xyz = space.space().with_white(Chromaticity::black_body_6500_k()).from_xyz()?;
    let [x, y, z] = Observer::cie_1931().matching_functions();
    let mut colours = Vec::new();
    for nm in (400..=700).step_by(10) {
        let at = |curve: &onelight::spectra::SpectralDistribution<_>| curve.at(f64::from(nm)).unwrap_or(0.0);
        let rgb = from_xyz * onelight::spectra::nalgebra::Vector3::new(at(x), at(y), at(z));
        let rgb = <[f64; 3]>::from(rgb / rgb.max());
        colours.extend((-10..=14).map(|s| scaled(rgb, stops(f64::from(s)))));
    }
    Ok(Case::new("spectral locus").with(Order::Loose, colours))
}

/// Scenes of one or two channels, by tenths of a stop from -16 to +20.
fn one_channel() -> Case {
    let ramp = |hue| (-160..=200).map(move |i| scaled(hue, stops(f64::from(i) / 10.0)));
    HUES.into_iter().fold(Case::new("one-channel scenes"), |case, hue| case.with(Order::Line, ramp(hue)))
}

/// Half degrees of hue, saturated and half so.
fn hue_circles() -> Case {
    let mut case = Case::new("hue circles");
    for saturation in [1.0, 0.5] {
        for level in [-6, -3, 0, 2, 4, 6, 10] {
            let peak = stops(f64::from(level));
            let colour = move |half_degrees: i32| {
                single([5.0, 3.0, 1.0].map(|offset| {
                    let sector = (offset + f64::from(half_degrees) / 120.0) % 6.0;
                    peak * (1.0 - saturation * sector.min(4.0 - sector).clamp(0.0, 1.0))
                }))
            };
            case = case.with(Order::Circle, (0..720).map(colour));
        }
    }
    case
}

/// Hundredths of a stop from -16 to +16.
fn ramps() -> Case {
    let ramp = |hue| (-1600..=1600).map(move |i| scaled(hue, stops(f64::from(i) / 100.0)));
    let case = Case::new("ramps by 1/100 stop").with(Order::Greys, ramp([1.0; 3]));
    HUES.into_iter().chain(SKIN).fold(case, |case, hue| case.with(Order::Line, ramp(hue)))
}

/// Greys by thousandths of a stop about one, half a stop either way.
pub(super) fn closely(grey: f64) -> impl Iterator<Item = [f32; 3]> {
    (-500..=500).map(move |i| single([grey * (f64::from(i) / 1000.0).exp2(); 3]))
}
