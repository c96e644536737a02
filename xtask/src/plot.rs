//! The three sets of curves of a stock, as SVG.

use std::fmt::Display;
use std::io::Write as _;
use std::ops::Range;
use std::path::Path;

use anyhow::{Result, anyhow};
use onelight::Stock;
use onelight::film::{LogExposure, Tail};
use plotters::coord::Shift;
use plotters::prelude::*;

use crate::whole::write_whole;

const SIZE: (u32, u32) = (1500, 500);
const RED: RGBColor = RGBColor(196, 48, 40);
const GREEN: RGBColor = RGBColor(40, 140, 60);
const BLUE: RGBColor = RGBColor(40, 80, 200);
const CYAN: RGBColor = RGBColor(0, 150, 180);
const MAGENTA: RGBColor = RGBColor(190, 30, 140);
const YELLOW: RGBColor = RGBColor(200, 160, 0);
const GREY: RGBColor = RGBColor(110, 110, 110);

/// A curve: points, colour, name.
type Curve = (Vec<(f64, f64)>, RGBColor, &'static str);

/// Writes the plot.
pub(crate) fn write(path: &Path, stock: &Stock) -> Result<()> {
    let mut svg = String::new();
    draw(&mut svg, stock).map_err(|error| anyhow!("{}: the plot cannot be drawn: {error}", path.display()))?;
    write_whole(path, |file| Ok(file.write_all(svg.as_bytes())?))
}

fn draw(svg: &mut String, stock: &Stock) -> Result<(), Box<dyn std::error::Error>> {
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let root = root.titled(stock.name(), ("sans-serif", 22))?;
    let panels = root.split_evenly((1, 3));
    let colours = [(RED, "red layer"), (GREEN, "green layer"), (BLUE, "blue layer")];
    let sensitivity = stock.sensitivity().to_array().into_iter().zip(colours).map(|(layer, (colour, name))| {
        let (first, last) = layer.range_nm();
        (sampled(first..last, |nm| layer.log10_at(nm, Tail::LogLinear)), colour, name)
    });
    panel(&panels[0], "log10 sensitivity over nm", &sensitivity.collect::<Vec<_>>())?;
    let characteristic = stock.characteristic().to_array().into_iter().zip(colours).map(|(curve, (colour, name))| {
        let (first, last) = curve.range();
        (sampled(first.0..last.0, |h| curve.density(LogExposure(h)).0), colour, name)
    });
    panel(&panels[1], "density over log10 exposure", &characteristic.collect::<Vec<_>>())?;
    let named = [(CYAN, "cyan"), (MAGENTA, "magenta"), (YELLOW, "yellow")];
    let dyes = stock.dyes().to_array().into_iter().zip(named).map(|(dye, (colour, name))| (dye, colour, name));
    let others = [(stock.d_min(), GREY, "D-min"), (stock.neutral(), BLACK, "neutral")];
    let others = others.into_iter().filter_map(|(curve, colour, name)| Some((curve?, colour, name)));
    let dyes = dyes.chain(others).map(|(dye, colour, name)| {
        let (first, last) = dye.range_nm();
        (sampled(first..last, |nm| dye.at(nm)), colour, name)
    });
    panel(&panels[2], "spectral density over nm", &dyes.collect::<Vec<_>>())?;
    root.present()?;
    Ok(())
}

fn sampled(range: Range<f64>, f: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    const POINTS: u32 = 300;
    let x = |i: u32| range.start + (range.end - range.start) * f64::from(i) / f64::from(POINTS);
    (0..=POINTS).map(|i| (x(i), f(x(i)))).collect()
}

fn panel<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    title: impl Display,
    curves: &[Curve],
) -> Result<(), Box<dyn std::error::Error>>
where
    B::ErrorType: 'static,
{
    let points = || curves.iter().flat_map(|(points, _, _)| points);
    let bounds = |pick: fn(&(f64, f64)) -> f64| {
        points().map(pick).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
    };
    let ((x0, x1), (y0, y1)) = (bounds(|p| p.0), bounds(|p| p.1));
    let margin = 0.05 * (y1 - y0).max(1e-6);
    // Names stand above the curves.
    let names = margin * (2 + 2 * curves.len()) as f64;
    let mut chart = ChartBuilder::on(area)
        .caption(title.to_string(), ("sans-serif", 16))
        .margin(12)
        .x_label_area_size(28)
        .y_label_area_size(40)
        .build_cartesian_2d(x0..x1, y0 - margin..y1 + names)?;
    chart.configure_mesh().light_line_style(WHITE).x_label_formatter(&|x| format!("{x}")).draw()?;
    for (points, colour, name) in curves {
        let colour = *colour;
        chart
            .draw_series(LineSeries::new(points.iter().copied(), colour.stroke_width(2)))?
            .label(*name)
            .legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 16, y)], colour.stroke_width(2)));
    }
    let labels = &mut chart.configure_series_labels();
    labels.position(SeriesLabelPosition::UpperRight).background_style(WHITE).border_style(GREY).draw()?;
    Ok(())
}
