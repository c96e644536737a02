//! The three sets of curves of a stock, as SVG.

use std::ops::Range;

use onelight_film::{Densitometry, ExposureAxis, LogExposure, Stock, Tail};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::error::Error;

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

/// One diagram of a stock's plot: curves over one axis, with its titles.
struct Panel {
    title: &'static str,
    x: &'static str,
    y: &'static str,
    curves: Vec<Curve>,
    /// A value of x to mark, and its name.
    mark: Option<(f64, &'static str)>,
}

/// The curves of a stock as the text of an SVG, 1500 x 500: log10 sensitivity over wavelength in nm, density over log10 exposure, and
/// the densities of the dyes over wavelength. Camera films have the exposure of an 18 % grey card marked.
///
/// ```
/// # use onelight_charts::stock_plot;
/// # use onelight_film::{SheetText, Stock};
/// # let files = onelight_stocks::find("kodak-5207").ok_or("no such stock")?;
/// # let stock = Stock::parse(&SheetText {
/// #     id: files.id,
/// #     stock_toml: files.stock_toml,
/// #     sensitivity_csv: files.sensitivity_csv,
/// #     characteristic_csv: files.characteristic_csv,
/// #     dye_density_csv: files.dye_density_csv,
/// # })?;
/// let svg = stock_plot(&stock)?;
/// assert!(svg.contains("red layer") && svg.contains("18 % grey"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the library that draws fails, which no data sheet that was read is known to make it.
pub fn stock_plot(stock: &Stock) -> Result<String, Error> {
    let mut svg = String::new();
    draw(&mut svg, stock).map_err(|error| Error(format!("{}: its curves cannot be drawn: {error}", stock.id())))?;
    Ok(svg)
}

fn draw(svg: &mut String, stock: &Stock) -> Result<(), Box<dyn std::error::Error>> {
    let root = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let root = root.titled(stock.name(), ("sans-serif", 22))?;
    for (area, panel) in root.split_evenly((1, 3)).iter().zip([sensitivity(stock), characteristic(stock), dyes(stock)])
    {
        panel.draw(area)?;
    }
    root.present()?;
    Ok(())
}

const LAYERS: [(RGBColor, &str); 3] = [(RED, "red layer"), (GREEN, "green layer"), (BLUE, "blue layer")];
const WAVELENGTH: &str = "wavelength (nm)";

fn sensitivity(stock: &Stock) -> Panel {
    let curves = stock.sensitivity().to_array().into_iter().zip(LAYERS).map(|(layer, (colour, name))| {
        let (first, last) = layer.range_nm().into_inner();
        (sampled(first..last, |nm| layer.log10_at(nm, Tail::LogLinear)), colour, name)
    });
    // Without the density it is stated at, a sensitivity has no unit.
    let y = match stock.criterion() {
        Some(_) => "log10 sensitivity (cm\u{b2}/erg)",
        None => "log10 sensitivity (criterion not stated)",
    };
    Panel { title: "spectral sensitivity", x: WAVELENGTH, y, curves: curves.collect(), mark: None }
}

fn characteristic(stock: &Stock) -> Panel {
    let curves = stock.characteristic().to_array().into_iter().zip(LAYERS).map(|(curve, (colour, name))| {
        let (first, last) = curve.range().into_inner();
        (sampled(first.0..last.0, |h| curve.density(LogExposure(h)).0), colour, name)
    });
    let x = match stock.axis() {
        ExposureAxis::LuxSeconds => "log10 exposure (lux s)",
        ExposureAxis::LuxSecondsUnverified => "log10 exposure (lux s, not confirmed)",
        ExposureAxis::Relative => "log10 exposure (relative)",
    };
    let y = match stock.densitometry() {
        Densitometry::StatusM => "density (status M)",
        Densitometry::StatusA => "density (status A)",
        Densitometry::Visual => "density (visual)",
    };
    let mark = stock.mid_grey().ok().map(|h| (h.0, "18 % grey"));
    Panel { title: "characteristic curves", x, y, curves: curves.collect(), mark }
}

fn dyes(stock: &Stock) -> Panel {
    let named = [(CYAN, "cyan"), (MAGENTA, "magenta"), (YELLOW, "yellow")];
    let dyes = stock.dyes().to_array().into_iter().zip(named).map(|(dye, (colour, name))| (dye, colour, name));
    let others = [(stock.d_min(), GREY, "D-min"), (stock.neutral(), BLACK, "neutral")];
    let others = others.into_iter().filter_map(|(curve, colour, name)| Some((curve?, colour, name)));
    let curves = dyes.chain(others).map(|(dye, colour, name)| {
        let (first, last) = dye.range_nm().into_inner();
        (sampled(first..last, |nm| dye.at(nm)), colour, name)
    });
    Panel { title: "spectral density of the dyes", x: WAVELENGTH, y: "density", curves: curves.collect(), mark: None }
}

fn sampled(range: Range<f64>, f: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    const POINTS: u32 = 300;
    let x = |i: u32| range.start + (range.end - range.start) * f64::from(i) / f64::from(POINTS);
    (0..=POINTS).map(|i| (x(i), f(x(i)))).collect()
}

impl Panel {
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Result<(), Box<dyn std::error::Error>>
    where
        B::ErrorType: 'static,
    {
        let area = area.titled(self.title, ("sans-serif", 16))?;
        let (names, area) = area.split_vertically(20);
        self.draw_names(&names)?;
        let points = || self.curves.iter().flat_map(|(points, _, _)| points);
        let bounds = |pick: fn(&(f64, f64)) -> f64| {
            points().map(pick).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)))
        };
        let ((x0, x1), (y0, y1)) = (bounds(|p| p.0), bounds(|p| p.1));
        let margin = 0.05 * (y1 - y0).max(1e-6);
        let mut chart = ChartBuilder::on(&area)
            .margin(12)
            .x_label_area_size(42)
            .y_label_area_size(52)
            .build_cartesian_2d(x0..x1, y0 - margin..y1 + margin)?;
        let mut mesh = chart.configure_mesh();
        mesh.light_line_style(WHITE).x_label_formatter(&|x| format!("{x}")).x_desc(self.x).y_desc(self.y).draw()?;
        if let Some((x, name)) = self.mark {
            let line = [(x, y0 - margin), (x, y1 + margin)];
            chart.draw_series(LineSeries::new(line, GREY.stroke_width(1)))?;
            // At the top, on the side where the curves are low.
            let (side, shift) = if self.rises() { (HPos::Right, -4) } else { (HPos::Left, 4) };
            let style = ("sans-serif", 13).into_font().color(&GREY).pos(Pos::new(side, VPos::Top));
            chart.draw_series([EmptyElement::at((x, y1 + margin)) + Text::new(name, (shift, 4), style)])?;
        }
        for (points, colour, _) in &self.curves {
            chart.draw_series(LineSeries::new(points.iter().copied(), colour.stroke_width(2)))?;
        }
        Ok(())
    }

    /// The names of the curves in their colours, in a row.
    fn draw_names<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Result<(), Box<dyn std::error::Error>>
    where
        B::ErrorType: 'static,
    {
        const SLOT: i32 = 88;
        let (width, _) = area.dim_in_pixel();
        let left = (width as i32 - SLOT * self.curves.len() as i32) / 2;
        for (i, (_, colour, name)) in (0..).zip(&self.curves) {
            let x = left + SLOT * i;
            area.draw(&PathElement::new([(x, 10), (x + 14, 10)], colour.stroke_width(2)))?;
            let style = ("sans-serif", 13).into_font().color(colour).pos(Pos::new(HPos::Left, VPos::Center));
            area.draw(&Text::new(*name, (x + 19, 10), style))?;
        }
        Ok(())
    }

    /// Whether the first curve rises.
    fn rises(&self) -> bool {
        let ends = self.curves.first().and_then(|(points, _, _)| Some((points.first()?, points.last()?)));
        ends.is_some_and(|(first, last)| last.1 > first.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use onelight_film::SheetText;

    #[test]
    fn every_plot_names_its_curves_and_axes_and_marks_the_grey_of_camera_films() {
        for files in onelight_stocks::ALL {
            let (id, stock) = (
                files.id,
                Stock::parse(&SheetText {
                    id: files.id,
                    stock_toml: files.stock_toml,
                    sensitivity_csv: files.sensitivity_csv,
                    characteristic_csv: files.characteristic_csv,
                    dye_density_csv: files.dye_density_csv,
                })
                .unwrap(),
            );
            let svg = stock_plot(&stock).unwrap();
            for text in ["red layer", "wavelength (nm)", "density (", "log10 exposure (", "log10 sensitivity ("] {
                assert!(svg.contains(text), "{id}: {text}");
            }
            assert_eq!(svg.contains("density (status "), stock.image() == onelight_film::Image::Dye, "{id}");
            assert_eq!(svg.contains("18 % grey"), stock.kind().is_camera_film(), "{id}");
            assert_eq!(svg.contains("(cm\u{b2}/erg)"), stock.criterion().is_some(), "{id}");
            assert!(!svg.contains("NaN") && svg.trim_end().ends_with("</svg>"), "{id}");
        }
    }
}
