//! Charts as SVG text. Colours are classes: the page, or the picture's own style, decides them.

use std::fmt::Write as _;

use super::axis::{Axis, Placed};
use super::labels::{Rect, place, width};
use super::text::escaped;

/// Outlines of markers, so that colour is not all that tells series apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Marker {
    Circle,
    Square,
    Diamond,
    Triangle,
    /// A triangle on its point.
    Down,
    Cross,
    Plus,
}

/// How the points of a series look.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Look {
    /// Which class of the style sheet colours it, `c0` to `c5`.
    pub(super) colour: usize,
    pub(super) marker: Marker,
    pub(super) line: Line,
}

/// Whether the points of a series are joined.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Line {
    None,
    Joined,
}

/// A point of a series.
pub(super) struct Point {
    pub(super) at: (f64, f64),
    /// Text that is written beside the point.
    pub(super) label: Option<String>,
    /// Told when the pointer rests on it.
    pub(super) hint: String,
    pub(super) filling: Filling,
}

/// Whether a marker is filled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Filling {
    Full,
    Hollow,
}

impl Point {
    pub(super) fn plain(at: (f64, f64)) -> Self {
        Self { at, label: None, hint: String::new(), filling: Filling::Full }
    }
}

/// Points that share a name, a colour and a marker.
pub(super) struct Series {
    pub(super) name: String,
    pub(super) look: Look,
    pub(super) points: Vec<Point>,
}

/// A line across the chart.
pub(super) enum Guide {
    /// At a value of x.
    Vertical(f64, String),
    /// At a value of y.
    Horizontal(f64, String),
}

/// A chart: series of points over two axes.
pub(super) struct Chart {
    pub(super) title: String,
    pub(super) x: Axis,
    pub(super) y: Axis,
    pub(super) series: Vec<Series>,
    pub(super) guides: Vec<Guide>,
    /// What the legend adds about filled and hollow markers; empty where all are filled.
    pub(super) note: String,
}

/// Size of every chart, in pixels at its own scale.
pub(super) const SIZE: (f64, f64) = (560.0, 440.0);
const LEFT: f64 = 66.0;
const RIGHT: f64 = 12.0;
const TITLE: f64 = 24.0;
const BOTTOM: f64 = 46.0;
const LEGEND_ROW: f64 = 18.0;
const FONT: f64 = 12.0;
const RADIUS: f64 = 4.2;

impl Chart {
    /// The chart as one SVG element, for a page.
    pub(super) fn svg(&self) -> String {
        let (w, h) = SIZE;
        format!(
            "<svg class=\"chart\" viewBox=\"0 0 {w} {h}\" role=\"img\" aria-label=\"{}\">{}</svg>",
            escaped(&self.title),
            self.contents()
        )
    }

    /// The same without what only a pointer would tell.
    pub(super) fn without_hints(mut self) -> Self {
        self.series.iter_mut().flat_map(|series| &mut series.points).for_each(|point| point.hint.clear());
        self
    }

    /// What is inside, with (0, 0) at the upper left.
    pub(super) fn contents(&self) -> String {
        let (legend, rows) = self.legend();
        let top = TITLE + LEGEND_ROW * rows as f64 + 8.0;
        let area = Rect { left: LEFT, top, width: SIZE.0 - LEFT - RIGHT, height: SIZE.1 - top - BOTTOM };
        let all = || self.series.iter().flat_map(|series| &series.points);
        let guides = |pick: fn(&Guide) -> Option<f64>| self.guides.iter().filter_map(pick);
        let along = guides(|g| if let Guide::Vertical(x, _) = g { Some(*x) } else { None });
        let across = guides(|g| if let Guide::Horizontal(y, _) = g { Some(*y) } else { None });
        let x = self.x.placed((area.left, area.right()), all().map(|p| p.at.0).chain(along));
        let y = self.y.placed((area.bottom(), area.top), all().map(|p| p.at.1).chain(across));
        let mut svg = format!("<text class=\"title\" x=\"{LEFT}\" y=\"17\">{}</text>{legend}", escaped(&self.title));
        frame(&mut svg, &area, &x, &y, (&self.x, &self.y));
        let points: Vec<Rect> =
            all().map(|point| Rect::about((x.at(point.at.0), y.at(point.at.1)), 2.4 * RADIUS, 2.4 * RADIUS)).collect();
        let mut taken = self.guides(&mut svg, &area, &x, &y, &points);
        taken.extend(points);
        for series in &self.series {
            series.line(&mut svg, &x, &y, &mut taken);
        }
        for series in &self.series {
            for point in &series.points {
                let at = (x.at(point.at.0), y.at(point.at.1));
                marker(&mut svg, at, series.look, point.filling, &point.hint);
            }
        }
        // Last, so that labels lie above everything.
        for series in &self.series {
            for point in &series.points {
                let Some(label) = &point.label else { continue };
                let at = (x.at(point.at.0), y.at(point.at.1));
                let size = (width(label, FONT) + 2.0, FONT + 3.0);
                let Some((rect, far)) = place(at, size, &area, &taken) else { continue };
                if far {
                    let (x, y) = rect.nearest(at);
                    let _ = write!(
                        svg,
                        "<line class=\"leader\" x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{x:.1}\" y2=\"{y:.1}\"/>",
                        at.0, at.1
                    );
                }
                // Against the point, so that a face narrower than expected leaves no gap.
                let (anchor, left) = if rect.left >= at.0 {
                    ("start", rect.left + 1.0)
                } else if rect.right() <= at.0 {
                    ("end", rect.right() - 1.0)
                } else {
                    ("middle", rect.left + rect.width / 2.0)
                };
                let _ = write!(
                    svg,
                    "<text class=\"label\" text-anchor=\"{anchor}\" x=\"{left:.1}\" y=\"{:.1}\">{}</text>",
                    rect.bottom() - 4.0,
                    escaped(label)
                );
                taken.push(rect);
            }
        }
        svg
    }

    /// The names of the series in rows, and how many rows.
    fn legend(&self) -> (String, usize) {
        let mut svg = String::new();
        let (mut left, mut row) = (LEFT, 0);
        let note = (!self.note.is_empty()).then_some((None, &self.note));
        let series = self.series.iter().map(|s| {
            let filling = s.points.first().map_or(Filling::Full, |point| point.filling);
            (Some((s.look, filling)), &s.name)
        });
        for (look, name) in series.chain(note) {
            let mark = if look.is_some() { 14.0 } else { 8.0 };
            let needed = mark + width(name, FONT) + 14.0;
            if left + needed > SIZE.0 - RIGHT + 14.0 && left > LEFT {
                (left, row) = (LEFT, row + 1);
            }
            let y = TITLE + LEGEND_ROW * (f64::from(row) + 0.5);
            if let Some((look, filling)) = look {
                marker(&mut svg, (left + 5.0, y), look, filling, "");
            }
            let (x, y) = (left + mark, y + 4.0);
            let _ = write!(svg, "<text class=\"legend\" x=\"{x:.1}\" y=\"{y:.1}\">{}</text>", escaped(name));
            left += needed;
        }
        (svg, row as usize + 1)
    }

    /// Draws the guides, their names off the points; the places that they take.
    fn guides(&self, svg: &mut String, area: &Rect, x: &Placed, y: &Placed, points: &[Rect]) -> Vec<Rect> {
        let mut taken = Vec::new();
        for guide in &self.guides {
            let (from, to, name) = match guide {
                Guide::Vertical(value, name) => ((x.at(*value), area.top), (x.at(*value), area.bottom()), name),
                Guide::Horizontal(value, name) => ((area.left, y.at(*value)), (area.right(), y.at(*value)), name),
            };
            let size = (width(name, FONT), FONT + 4.0);
            let beside = |left: f64, top: f64| Rect { left, top, width: size.0, height: size.1 };
            let places = match guide {
                Guide::Vertical(..) => [
                    beside(from.0 + 4.0, area.top + 1.0),
                    beside(from.0 + 4.0, area.bottom() - size.1 - 1.0),
                    beside(from.0 - 4.0 - size.0, area.top + 1.0),
                ],
                Guide::Horizontal(..) => [
                    beside(area.right() - 4.0 - size.0, from.1 - size.1),
                    beside(area.left + 4.0, from.1 - size.1),
                    beside(area.right() - 4.0 - size.0, from.1 + 1.0),
                ],
            };
            let free = |place: &&Rect| !points.iter().chain(&taken).any(|point| point.meets(place));
            let place = *places.iter().find(free).unwrap_or(&places[0]);
            let _ = write!(
                svg,
                "<line class=\"guide\" x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\"/>\
                 <text class=\"tick\" x=\"{:.1}\" y=\"{:.1}\">{}</text>",
                from.0,
                from.1,
                to.0,
                to.1,
                place.left,
                place.bottom() - 4.0,
                escaped(name)
            );
            taken.push(place);
            // The line itself: words across it are hard to read.
            let (width, height) = (to.0 - from.0, to.1 - from.1);
            taken.push(Rect { left: from.0 - 1.0, top: from.1 - 1.0, width: width + 2.0, height: height + 2.0 });
        }
        taken
    }
}

impl Series {
    /// Joins the points, and takes the place under the line, so that no label lies on it.
    fn line(&self, svg: &mut String, x: &Placed, y: &Placed, taken: &mut Vec<Rect>) {
        /// Parts of the line between two points.
        const PARTS: u32 = 24;
        if self.look.line == Line::None {
            return;
        }
        let places: Vec<(f64, f64)> = self.points.iter().map(|p| (x.at(p.at.0), y.at(p.at.1))).collect();
        let points: Vec<String> = places.iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
        let _ = write!(svg, "<polyline class=\"line c{}\" points=\"{}\"/>", self.look.colour, points.join(" "));
        for (from, to) in places.iter().zip(places.iter().skip(1)) {
            taken.extend((0..=PARTS).map(|i| {
                let t = f64::from(i) / f64::from(PARTS);
                Rect::about((from.0 + t * (to.0 - from.0), from.1 + t * (to.1 - from.1)), 3.0, 3.0)
            }));
        }
    }
}

/// The axes with their ticks and names.
fn frame(svg: &mut String, area: &Rect, x: &Placed, y: &Placed, (x_axis, y_axis): (&Axis, &Axis)) {
    for (value, name) in x.ticks() {
        let x = x.at(*value);
        let _ = write!(
            svg,
            "<line class=\"grid\" x1=\"{x:.1}\" y1=\"{:.1}\" x2=\"{x:.1}\" y2=\"{:.1}\"/>\
             <text class=\"tick\" text-anchor=\"middle\" x=\"{x:.1}\" y=\"{:.1}\">{name}</text>",
            area.top,
            area.bottom(),
            area.bottom() + 16.0
        );
    }
    for (value, name) in y.ticks() {
        let y = y.at(*value);
        let _ = write!(
            svg,
            "<line class=\"grid\" x1=\"{:.1}\" y1=\"{y:.1}\" x2=\"{:.1}\" y2=\"{y:.1}\"/>\
             <text class=\"tick\" text-anchor=\"end\" x=\"{:.1}\" y=\"{:.1}\">{name}</text>",
            area.left,
            area.right(),
            area.left - 6.0,
            y + 4.0
        );
    }
    let (middle, half) = (area.left + area.width / 2.0, area.top + area.height / 2.0);
    let _ = write!(
        svg,
        "<rect class=\"frame\" x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\"/>\
         <text class=\"axis\" text-anchor=\"middle\" x=\"{middle:.1}\" y=\"{:.1}\">{}</text>\
         <text class=\"axis\" text-anchor=\"middle\" transform=\"translate(13 {half:.1}) rotate(-90)\">{}</text>",
        area.left,
        area.top,
        area.width,
        area.height,
        SIZE.1 - 10.0,
        escaped(&x_axis.name),
        escaped(&y_axis.name)
    );
}

fn marker(svg: &mut String, (x, y): (f64, f64), look: Look, filling: Filling, hint: &str) {
    let class = match (look.marker, filling) {
        (Marker::Cross | Marker::Plus, _) => format!("stroke c{}", look.colour),
        (_, Filling::Full) => format!("full c{}", look.colour),
        (_, Filling::Hollow) => format!("hollow c{}", look.colour),
    };
    let r = RADIUS;
    let shape = match look.marker {
        Marker::Circle => format!("<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r}\""),
        Marker::Square => path(&class, (x, y), &[(-r, -r), (r, -r), (r, r), (-r, r)]),
        Marker::Diamond => {
            let r = 1.3 * r;
            path(&class, (x, y), &[(0.0, -r), (r, 0.0), (0.0, r), (-r, 0.0)])
        }
        Marker::Triangle => path(&class, (x, y), &[(0.0, -1.25 * r), (1.2 * r, r), (-1.2 * r, r)]),
        Marker::Down => path(&class, (x, y), &[(0.0, 1.25 * r), (1.2 * r, -r), (-1.2 * r, -r)]),
        Marker::Plus => {
            let r = 1.3 * r;
            let [a, b, c, d] = [x - r, y - r, x + r, y + r];
            format!("<path class=\"{class}\" d=\"M{a:.1} {y:.1}L{c:.1} {y:.1}M{x:.1} {b:.1}L{x:.1} {d:.1}\"")
        }
        Marker::Cross => {
            let [a, b, c, d] = [x - r, y - r, x + r, y + r];
            format!("<path class=\"{class}\" d=\"M{a:.1} {b:.1}L{c:.1} {d:.1}M{a:.1} {d:.1}L{c:.1} {b:.1}\"")
        }
    };
    svg.push_str(&shape);
    if hint.is_empty() {
        svg.push_str("/>");
    } else {
        let element = if look.marker == Marker::Circle { "circle" } else { "path" };
        let _ = write!(svg, "><title>{}</title></{element}>", escaped(hint));
    }
}

fn path(class: &str, (x, y): (f64, f64), corners: &[(f64, f64)]) -> String {
    let points: Vec<String> = corners.iter().map(|(dx, dy)| format!("{:.1} {:.1}", x + dx, y + dy)).collect();
    format!("<path class=\"{class}\" d=\"M{}Z\"", points.join("L"))
}
