//! The grey scale of a look, by stops and by lightness.

use onelight::Reference;
use onelight::spectra::MID_GREY;

use super::chart::{Scene, chroma};

/// Lowest and highest exposure searched for a lightness, in stops over a grey card.
const RANGE: (f64, f64) = (-8.0, 8.0);
const HALVINGS: u32 = 50;

/// CIELAB of a grey, so many stops over a grey card.
pub(super) fn grey(scene: &Scene, look: &Reference, stops: f64) -> [f64; 3] {
    scene.lab(look.develop_linear([MID_GREY * stops.exp2(); 3]))
}

/// Largest chroma of greys from -4 to +6 stops in quarter stops, and where.
pub(super) fn tint(scene: &Scene, look: &Reference) -> (f64, f64) {
    let greys = (-16..=24).map(|i| f64::from(i) / 4.0).map(|stops| (chroma(grey(scene, look, stops)), stops));
    greys.fold((0.0, 0.0), |most, grey| if grey.0 > most.0 { grey } else { most })
}

/// The stops at which a grey has this lightness; an end of the range where none does.
pub(super) fn stops_of(scene: &Scene, look: &Reference, lightness: f64) -> f64 {
    let (mut low, mut high) = RANGE;
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if grey(scene, look, middle)[0] < lightness {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high)
}

/// The stops at which the camera film's mean density lies so much below that at other stops.
pub(super) fn thinner(look: &Reference, stops: f64, by: f64) -> f64 {
    let density = |stops: f64| look.inter_image().developed(stops * std::f64::consts::LOG10_2);
    let wanted = density(stops) - by;
    let (mut low, mut high) = (RANGE.0, stops);
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if density(middle) < wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    f64::midpoint(low, high)
}

/// Slope of log10 luminance over log10 exposure at a grey card.
pub(super) fn gamma(look: &Reference) -> f64 {
    let luminance = |stops: f64| look.stages([MID_GREY * stops.exp2(); 3]).xyz[1].log10();
    let step = 1.0 / 3.0;
    (luminance(step) - luminance(-step)) / (2.0 * step * std::f64::consts::LOG10_2)
}
