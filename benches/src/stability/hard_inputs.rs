//! Hard inputs that a film and its forms decide: steep parts of curves, dense dyes, the nodes of tables.

use onelight::Reference;
use onelight::film::{AmountCurve, LogExposure, PerLayer};
use onelight::lut::{PlainLut, StructuredLut};
use rayon::prelude::*;

use super::cases::{Case, Order, closely, stops};

/// Steps of the search for the steepest part of a curve.
const CURVE_STEPS: u32 = 4096;
/// Halvings when a grey is looked for: from 200 stops to the last bit of a float32.
const HALVINGS: usize = 40;
/// Greys beyond which nothing changes, in stops about mid grey.
const FAR: f64 = 60.0;
/// Where the dense begins, and the fewest colours of the case: the densest, where a film does not reach it.
const DENSE: f64 = 4.0;
const DENSEST: usize = 64;
/// Every so many entries of a curve's table are visited.
const CURVE_NODES: usize = 8;

/// Greys about the steepest part of each layer's curve: the camera film's, and the print's behind it.
pub(super) fn steepest(film: &Reference) -> Case {
    let mut case = Case::new("steepest parts of the curves");
    let rows = row_sums(film);
    let camera = film.camera_curves().to_array();
    for layer in 0..3 {
        let grey = 10_f64.powf(steepest_of(camera[layer])) / rows[layer];
        case = case.with(Order::Greys, closely(grey));
        // The same exposure by one channel alone.
        let own = film.exposure_matrix().matrix()[(layer, layer)];
        let channel = closely(grey * rows[layer] / own).map(move |[v, ..]| {
            let mut rgb = [0.0; 3];
            rgb[layer] = v;
            rgb
        });
        case = case.with(Order::Line, channel);
    }
    for (layer, curve) in film.print_curves().into_iter().flat_map(|curves| curves.to_array().into_iter().enumerate()) {
        let steep = steepest_of(curve);
        let print = |grey: f64| {
            let amounts = camera_amounts(film, grey);
            film.print_exposure(amounts).map_or(0.0, |h| h.to_array()[layer].0)
        };
        // More light on the negative, less on the print.
        case = case.with(Order::Greys, closely(grey_where(|grey| print(grey) <= steep)));
    }
    case
}

/// Dye in the camera film that a grey gives.
fn camera_amounts(film: &Reference, grey: f64) -> PerLayer<onelight::film::DyeAmount> {
    let exposure = film.exposure_matrix().expose([grey; 3]).map(LogExposure::of);
    film.camera_curves().zip_map(exposure, AmountCurve::amount)
}

/// Exposure of each layer by a grey of 1.
fn row_sums(film: &Reference) -> [f64; 3] {
    film.exposure_matrix().expose([1.0; 3]).to_array()
}

/// The log exposure where a curve changes fastest.
fn steepest_of(curve: &AmountCurve) -> f64 {
    let (first, last) = curve.range().into_inner();
    let at = |i: u32| first.0 + f64::from(i) / f64::from(CURVE_STEPS) * (last.0 - first.0);
    let rise = |i: &u32| (curve.amount(LogExposure(at(i + 1))).0 - curve.amount(LogExposure(at(*i))).0).abs();
    let steep = (0..CURVE_STEPS).max_by(|a, b| rise(a).total_cmp(&rise(b))).unwrap_or(0);
    at(steep) + 0.5 / f64::from(CURVE_STEPS) * (last.0 - first.0)
}

/// The first grey where something holds that holds for all brighter ones.
fn grey_where(holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (-FAR, FAR);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if holds(stops(middle)) { high = middle } else { low = middle }
    }
    stops(high)
}

/// Colours whose light is below 10^-4 of the lamp's, or the darkest of those that were tried.
pub(super) fn dense(film: &Reference) -> Case {
    let levels: Vec<f32> = std::iter::once(0.0).chain((-14..=6).map(|s| stops(f64::from(s)) as f32)).collect();
    let n = levels.len();
    let mut tried: Vec<(f64, [f32; 3])> = (0..n.pow(3))
        .into_par_iter()
        .map(|i| {
            let rgb = [levels[i % n], levels[i / n % n], levels[i / n / n]];
            (-film.stages(rgb.map(f64::from)).xyz[1].log10(), rgb)
        })
        .collect();
    tried.sort_by(|a, b| b.0.total_cmp(&a.0));
    let count = tried.iter().filter(|(density, _)| *density > DENSE).count().max(DENSEST);
    Case::new("densities above 4").with(Order::Loose, tried.into_iter().take(count).map(|(_, rgb)| rgb))
}

/// Exactly at nodes of a plain table, and half-way.
pub(super) fn plain_nodes(lut: &PlainLut) -> Case {
    let halves = 2 * (lut.table().size() - 1);
    let at = |i: usize| lut.shaper().decode((i % (halves + 1)) as f64 / halves as f64) as f32;
    let greys = (0..=halves).map(|i| [at(i); 3]);
    // Planes of nodes, of half-ways, and of both.
    let mixed = (0..=halves).flat_map(|i| [[0, 14, 38], [0, 7, 19], [0, 20, 3]].map(|o| o.map(|o| at(i + o))));
    Case::new("nodes of the plain table").with(Order::Greys, greys).with(Order::Loose, mixed)
}

/// Greys exactly at nodes of the film's curves as the fast forms hold them, and half-way: each layer in turn.
pub(super) fn curve_nodes(film: &Reference, lut: &StructuredLut) -> Case {
    let curves = &lut.parts().develop.curves;
    let halves = 2 * (curves.size() - 1);
    let mut case = Case::new("nodes of the curves");
    for (layer, row) in row_sums(film).into_iter().enumerate() {
        let [from, to] = [curves.domain().min(), curves.domain().max()].map(|ends| f64::from(ends[layer]));
        let grey = |i: usize| ((from + i as f64 / halves as f64 * (to - from)).exp2() / row) as f32;
        let visited = (0..=halves).filter(|i| i / 2 % CURVE_NODES == 0);
        case = case.with(Order::Greys, visited.map(|i| [grey(i); 3]));
    }
    case
}

/// Greys at nodes of a structured table, and half-way: each axis in turn.
pub(super) fn table_nodes(lut: &StructuredLut) -> Case {
    let halves = 2 * (lut.parts().table.size() - 1);
    let mut case = Case::new("nodes of the structured table");
    for axis in 0..3 {
        let along = |grey: f64| f64::from(lut.coordinates([grey as f32; 3])[axis]);
        let rising = along(stops(FAR)) > along(stops(-FAR));
        let greys = (0..=halves).map(|i| {
            let place = i as f64 / halves as f64;
            grey_where(|grey| if rising { along(grey) >= place } else { along(grey) <= place }) as f32
        });
        let mut greys: Vec<f32> = greys.collect();
        greys.sort_by(f32::total_cmp);
        case = case.with(Order::Greys, greys.into_iter().map(|v| [v; 3]));
    }
    case
}
