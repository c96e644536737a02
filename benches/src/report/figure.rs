//! The charts of the report.

use onelight::Process;

use super::axis::Axis;
use super::forms::Kind;
use super::measure::{Look, Row};
use super::peers::{Elsewhere, Peer};
use super::plot::{self, Chart, Filling, Guide, Line, Marker, Point, Series};
use super::stopwatch::Timing;
use super::studies::{CurveRow, GridRow, Measured};
use super::text::{escaped, figure};

/// Which difference a chart shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Which {
    Mean,
    Max,
}

/// About the smallest difference that an eye sees between two colours side by side.
const VISIBLE: f64 = 1.0;

impl Kind {
    pub(super) fn look(self, line: Line) -> plot::Look {
        let (colour, marker) = match self {
            Self::Talk => (0, Marker::Triangle),
            Self::Plain => (1, Marker::Circle),
            Self::Structured => (2, Marker::Square),
            Self::Direct => (3, Marker::Diamond),
            Self::Reference => (4, Marker::Cross),
            Self::Gpu => (5, Marker::Down),
            Self::Outside => (1, Marker::Plus),
        };
        plot::Look { colour, marker, line }
    }
}

impl Which {
    fn of(self, row: &Row) -> f64 {
        match self {
            Self::Mean => row.error.mean,
            Self::Max => row.error.max,
        }
    }

    fn title(self) -> &'static str {
        match self {
            Self::Mean => "Mean difference against time",
            Self::Max => "Largest difference against time",
        }
    }

    fn axis(self) -> &'static str {
        match self {
            Self::Mean => "mean difference from the film (CIEDE2000)",
            Self::Max => "largest difference from the film (CIEDE2000)",
        }
    }
}

/// The rows that no other row beats in both time and difference, fastest first. The reference is not among them. Of those that
/// are alike but for a few parts in a hundred of the difference, the one of fewest bytes.
pub(super) fn front(rows: &[Row], which: Which) -> Vec<&Row> {
    /// Differences by so small a factor are alike.
    const ALIKE: f64 = 1.03;
    let class = |row: &Row| (which.of(row).ln() / ALIKE.ln()).round();
    let mut rows: Vec<&Row> = rows.iter().filter(|row| row.kind != Kind::Reference).collect();
    rows.sort_by(|a, b| {
        let by_time = a.time.ns.total_cmp(&b.time.ns);
        by_time.then(class(a).total_cmp(&class(b))).then(a.bytes.cmp(&b.bytes))
    });
    let mut least = f64::INFINITY;
    rows.retain(|row| {
        let better = which.of(row) * ALIKE < least;
        least = least.min(which.of(row));
        better
    });
    rows
}

/// Time against difference: every form, those of the front by name.
pub(super) fn speed_error(look: &Look, copy: Timing, elsewhere: &Elsewhere, which: Which) -> Chart {
    let best: Vec<String> = front(&look.rows, which).into_iter().map(Row::name).collect();
    let mut series: Vec<Series> = Vec::new();
    for kind in Kind::ALL {
        let mut points: Vec<Point> = look
            .rows
            .iter()
            .filter(|row| row.kind == kind)
            .map(|row| {
                let name = row.name();
                let known = matches!(kind, Kind::Reference | Kind::Talk);
                let label = (known || best.contains(&name)).then(|| match kind {
                    Kind::Reference => "the film itself".to_owned(),
                    _ => name.clone(),
                });
                let hint = format!("{name}: {} ns, {} dE", figure(row.time.ns), figure(which.of(row)));
                let coarse = matches!(row.storage, Some("unorm8" | "unorm10"));
                let filling = if coarse { Filling::Hollow } else { Filling::Full };
                Point { at: (row.time.ns, which.of(row)), label, hint, filling }
            })
            .collect();
        match kind {
            Kind::Gpu => points.extend(elsewhere.of_look(&look.name).map(|row| {
                let error = if which == Which::Mean { row.mean } else { row.max };
                let (time, shown) = (figure(row.ns_per_pixel), figure(error));
                let hint = format!("{} on {}: {time} ns, {shown} dE", row.detail(), row.card);
                Point { label: Some(row.detail()), hint, ..Point::plain((row.ns_per_pixel, error)) }
            })),
            // The peers are measured on the default look.
            Kind::Outside if look.name == Process::default().name() => {
                let table = look.rows.iter().find(|row| row.kind == Kind::Plain && row.size == Some(33));
                points.extend(elsewhere.peers.iter().filter(|peer| peer.applies_our_table()).filter_map(|peer| {
                    let at = (peer.theirs_ns_per_pixel, which.of(table?));
                    let hint = format!("{}: {} ns", peer.peer, figure(at.0));
                    Some(Point { label: Some(peer.peer.clone()), hint, ..Point::plain(at) })
                }));
            }
            _ => {}
        }
        if !points.is_empty() {
            series.push(Series { name: kind.name().to_owned(), look: kind.look(Line::None), points });
        }
    }
    Chart {
        title: which.title().to_owned(),
        x: Axis::log("time for a pixel (ns), processor: one thread"),
        y: Axis::log(which.axis()),
        series,
        guides: vec![
            Guide::Vertical(copy.ns, "copy".to_owned()),
            Guide::Horizontal(VISIBLE, "1: just visible side by side".to_owned()),
        ],
        note: "hollow: 8 or 10 bit".to_owned(),
    }
}

/// Difference against the number of exponentials.
pub(super) fn grids(rows: &[GridRow]) -> Chart {
    let kinds = [
        ("fitted, mean", 3, Marker::Circle),
        ("fitted, max", 3, Marker::Diamond),
        ("even grid, mean", 1, Marker::Circle),
        ("even grid, max", 1, Marker::Square),
    ];
    let series = kinds.map(|(name, colour, marker)| {
        let (even, mean) = (name.starts_with("even"), name.ends_with("mean"));
        let mut points: Vec<Point> = rows
            .iter()
            .filter(|row| row.name.ends_with("nm") == even)
            .map(|row| {
                let value = if mean { row.both.mean } else { row.both.max };
                let at = (row.nodes.iter().sum::<usize>() as f64, value);
                let label = (!mean).then(|| row.name.clone());
                let filling = if mean { Filling::Hollow } else { Filling::Full };
                Point { label, hint: format!("{}: {}", row.name, figure(value)), filling, ..Point::plain(at) }
            })
            .collect();
        points.sort_by(|a, b| a.at.0.total_cmp(&b.at.0));
        Series { name: name.to_owned(), look: plot::Look { colour, marker, line: Line::Joined }, points }
    });
    Chart {
        title: "Wavelengths of the direct form".to_owned(),
        x: Axis::log("exponentials for a pixel, printing and projection"),
        y: Axis::log("difference from the film (CIEDE2000)"),
        series: series.into(),
        guides: Vec::new(),
        note: String::new(),
    }
}

/// Difference against points of the curves' tables.
pub(super) fn curves(rows: &[CurveRow]) -> Chart {
    let series = [("mean", 1, Marker::Circle), ("max", 2, Marker::Square)].map(|(name, colour, marker)| {
        let value = |row: &CurveRow| if name == "mean" { row.miss.mean } else { row.miss.max };
        let points = rows.iter().map(|row| Point::plain((row.points as f64, value(row)))).collect();
        Series { name: name.to_owned(), look: plot::Look { colour, marker, line: Line::Joined }, points }
    });
    Chart {
        title: "Curves as tables".to_owned(),
        x: Axis::log("points of each curve"),
        y: Axis::log("difference from the film (CIEDE2000)"),
        series: series.into(),
        guides: Vec::new(),
        note: String::new(),
    }
}

/// Cost over something that grows.
pub(super) fn growth(title: &str, x: Axis, y: Axis, measured: &[Measured]) -> Chart {
    let series = measured.iter().map(|m| Series {
        name: m.name.clone(),
        look: m.kind.look(Line::Joined),
        points: m.points.iter().map(|&at| Point::plain(at)).collect(),
    });
    Chart { title: title.to_owned(), x, y, series: series.collect(), guides: Vec::new(), note: String::new() }
}

/// Our time and theirs for each job, as two dots on a line. Drawn by hand: its vertical axis is words.
pub(super) fn peers(rows: &[Peer]) -> String {
    let rows: Vec<&Peer> = rows.iter().filter(|row| row.is_usual()).collect();
    const ROW: f64 = 34.0;
    const WIDTH: f64 = 760.0;
    let height = 62.0 + ROW * rows.len() as f64;
    let times = rows.iter().flat_map(|row| [row.ours_ns_per_pixel, row.theirs_ns_per_pixel]);
    let x = Axis::log("").placed((20.0, WIDTH - 20.0), times);
    let mut svg = format!(
        "<svg class=\"chart\" viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" aria-label=\"Our time and theirs\">\
         <circle class=\"full c2\" cx=\"26\" cy=\"12\" r=\"4.5\"/><text class=\"legend\" x=\"36\" y=\"16\">onelight</text>\
         <circle class=\"hollow c1\" cx=\"126\" cy=\"12\" r=\"4.5\"/>\
         <text class=\"legend\" x=\"136\" y=\"16\">the other program</text>"
    );
    for (value, name) in x.ticks() {
        let (at, bottom) = (x.at(*value), height - 34.0);
        svg += &format!(
            "<line class=\"grid\" x1=\"{at:.1}\" y1=\"24\" x2=\"{at:.1}\" y2=\"{bottom}\"/>\
             <text class=\"tick\" text-anchor=\"middle\" x=\"{at:.1}\" y=\"{}\">{name}</text>",
            bottom + 14.0
        );
    }
    for (i, row) in (0..).zip(&rows) {
        let y = 48.0 + ROW * f64::from(i);
        let (ours, theirs) = (x.at(row.ours_ns_per_pixel), x.at(row.theirs_ns_per_pixel));
        svg += &format!(
            "<text class=\"label\" x=\"20\" y=\"{:.1}\">{}</text>\
             <line class=\"leader\" x1=\"{ours:.1}\" y1=\"{y:.1}\" x2=\"{theirs:.1}\" y2=\"{y:.1}\"/>\
             <circle class=\"full c2\" cx=\"{ours:.1}\" cy=\"{y:.1}\" r=\"4.5\"/>\
             <circle class=\"hollow c1\" cx=\"{theirs:.1}\" cy=\"{y:.1}\" r=\"4.5\"/>",
            y - 9.0,
            escaped(&row.title())
        );
    }
    svg + &format!(
        "<text class=\"axis\" text-anchor=\"middle\" x=\"{}\" y=\"{}\">time for a pixel (ns)</text></svg>",
        WIDTH / 2.0,
        height - 4.0
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::difference::Difference;

    fn row(kind: Kind, detail: &str, ns: f64, max: f64) -> Row {
        let time = Timing { ns, median_ns: ns };
        let error = Difference { mean: max / 10.0, max, ..Difference::default() };
        Row::bare(kind, detail, time, error)
    }

    #[test]
    fn the_front_holds_what_nothing_beats() {
        let rows = [
            row(Kind::Plain, "a", 10.0, 1.0),
            row(Kind::Plain, "b", 10.0, 0.5),
            row(Kind::Structured, "c", 20.0, 0.6),
            row(Kind::Structured, "d", 30.0, 0.1),
            row(Kind::Reference, "", 900.0, 0.0),
        ];
        let names = |rows: &[Row]| -> Vec<String> {
            front(rows, Which::Max).into_iter().map(|row| row.detail.clone()).collect()
        };
        assert_eq!(names(&rows), ["b", "d"]);
        let [small, large] = [("half", 100), ("float", 200)].map(|(name, bytes)| {
            let max = if name == "half" { 0.3001 } else { 0.3 };
            Row { bytes: Some(bytes), ..row(Kind::Plain, name, 10.0, max) }
        });
        assert_eq!(names(&[large, small]), ["half"], "a difference that means nothing buys no bytes");
    }
}
