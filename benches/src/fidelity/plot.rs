//! Plots of the page: colours in the plane of a* and b*, values over stops.

use std::fmt::Write as _;

use super::chart::ChartColour;

/// Side of a plot in pixels at its own scale, and its margin.
const SIDE: f64 = 420.0;
const MARGIN: f64 = 36.0;
/// Largest chroma that is drawn.
const MOST: f64 = 100.0;

/// Each colour of the chart as an arrow from the scene's to the film's, in its own colour.
pub(super) fn colours(title: &str, colours: &[ChartColour]) -> String {
    let at = |v: f64| SIDE / 2.0 + v * (SIDE / 2.0 - MARGIN) / MOST;
    let mut svg = begin(title);
    for radius in [25.0, 50.0, 75.0, 100.0] {
        let _ = write!(
            svg,
            "<circle class=\"grid\" cx=\"{0}\" cy=\"{0}\" r=\"{1:.1}\"/>",
            SIDE / 2.0,
            at(radius) - at(0.0)
        );
    }
    for colour in colours {
        let [_, a, b] = colour.scene;
        let [_, film_a, film_b] = colour.film;
        let (x, y, to_x, to_y) = (at(a), at(-b), at(film_a), at(-film_b));
        let _ = write!(
            svg,
            "<line x1=\"{x:.1}\" y1=\"{y:.1}\" x2=\"{to_x:.1}\" y2=\"{to_y:.1}\"/>\
             <circle class=\"scene\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\"/>\
             <circle class=\"film\" cx=\"{to_x:.1}\" cy=\"{to_y:.1}\" r=\"4\"><title>{}: chroma {:.2}, {:+.0} degrees</title></circle>",
            colour.name,
            colour.chroma(),
            colour.turn()
        );
    }
    svg + "</svg>\n"
}

/// A curve with its name.
pub(super) struct Curve {
    pub(super) name: String,
    /// Filled points are measured ones.
    pub(super) is_measured: bool,
    pub(super) points: Vec<(f64, f64)>,
}

/// Curves over one axis, with the range of their values written at the edges.
pub(super) fn curves(title: &str, curves: &[Curve]) -> String {
    let all = || curves.iter().flat_map(|curve| &curve.points);
    let range = |of: fn(&(f64, f64)) -> f64| {
        let (low, high) = all().map(of).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        (low, if high > low { high } else { low + 1.0 })
    };
    let (x, y) = (range(|p| p.0), range(|p| p.1));
    let place = |v: f64, (low, high): (f64, f64)| MARGIN + (v - low) / (high - low) * (SIDE - 2.0 * MARGIN);
    let mut svg = begin(title);
    for (i, curve) in curves.iter().enumerate() {
        let points: Vec<(f64, f64)> = curve.points.iter().map(|&(a, b)| (place(a, x), SIDE - place(b, y))).collect();
        let path: Vec<String> = points.iter().map(|(a, b)| format!("{a:.1},{b:.1}")).collect();
        let hue = i * 360 / curves.len();
        let dash = if curve.is_measured { "" } else { " stroke-dasharray=\"5 3\"" };
        let _ = write!(
            svg,
            "<polyline points=\"{}\" style=\"stroke:hsl({hue} 70% 45%)\"{dash}/><text x=\"{MARGIN}\" y=\"{}\" \
             style=\"fill:hsl({hue} 70% 40%)\">{}</text>",
            path.join(" "),
            MARGIN + 16.0 + 15.0 * i as f64,
            curve.name
        );
    }
    let edge = SIDE - MARGIN;
    let _ = write!(
        svg,
        "<text x=\"2\" y=\"{edge}\">{:.1}</text><text x=\"2\" y=\"{MARGIN}\">{:.1}</text><text x=\"{MARGIN}\" y=\"{2}\">{3:.1}</text>\
         <text x=\"{edge}\" y=\"{2}\">{4:.1}</text>",
        y.0,
        y.1,
        SIDE - 8.0,
        x.0,
        x.1
    );
    svg + "</svg>\n"
}

fn begin(title: &str) -> String {
    format!(
        "<svg viewBox=\"0 0 {SIDE} {SIDE}\" role=\"img\" aria-label=\"{title}\"><text class=\"title\" x=\"{MARGIN}\" y=\"20\">{title}</text>"
    )
}
