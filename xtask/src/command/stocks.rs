mod contact_sheet;

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use clap::Args;
use onelight::film::{ExposureAxis, Origin, PerLayer};
use onelight::{Image, Stock, StockKind, looks_with, stock, stock_ids, stock_named};
use serde_json::{Value, json};

use crate::atomic_file::write_atomically;
#[cfg(not(feature = "measure"))]
use crate::rebuild::{measured as fidelity, measured as certify};
use crate::{Report, folders};

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// One stock, by its id or a part of its name: its facts, and a plot of its curves
    #[arg(value_name = "NAME", conflicts_with = "check")]
    id: Option<String>,
    /// Read every stock and compile a process with it; the first fault is an error
    #[arg(long)]
    check: bool,
    /// Say of every camera film what is reproduced, and how nearly (docs/stocks.md says what the columns are)
    #[arg(long, alias = "likeness", conflicts_with_all = ["id", "check"])]
    fidelity: bool,
    /// Only stocks of this kind
    #[arg(long, value_name = "KIND", value_parser = KINDS, conflicts_with_all = ["id", "check", "fidelity"])]
    kind: Option<String>,
    /// Only stocks by this maker
    #[arg(long, value_name = "NAME", conflicts_with_all = ["id", "check", "fidelity"])]
    maker: Option<String>,
    /// This scene-linear EXR on every chosen stock, side by side with their names in one PNG: camera films on their usual print, all
    /// that is printed on behind a usual film
    #[arg(long, value_name = "EXR", conflicts_with_all = ["id", "check", "fidelity"])]
    sheet: Option<PathBuf>,
    /// Say of every sensible pair of the chosen stocks how far its structured table lies from the exact film: some minutes for all
    #[arg(long, conflicts_with_all = ["id", "check", "fidelity", "sheet"])]
    certify: bool,
    /// Folder for the plot of one stock, or for the sheet [default: target/onelight/stocks]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}

/// Pictures in a row of a contact sheet.
const COLUMNS: usize = 4;
/// Colours drawn for the certificate of a pair.
#[cfg(feature = "measure")]
const COLOURS: usize = 1 << 12;
/// What `--kind` takes: the kinds of stock, and what their pictures are made of.
const KINDS: [&str; 8] =
    ["negative", "reversal", "instant", "print", "paper", "reversal-print", "colour", "black-and-white"];

pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    let (text, json) = match &arguments.id {
        Some(id) => one(id, arguments.out.as_deref())?,
        None if arguments.check => check()?,
        None if arguments.fidelity => return fidelity(arguments),
        None if arguments.sheet.is_some() => shown(arguments)?,
        None if arguments.certify => return certify(arguments),
        None => all(&chosen(arguments)?),
    };
    Ok(Report { text, json, as_json: arguments.json })
}

#[cfg(feature = "measure")]
fn fidelity(arguments: &Arguments) -> Result<Report> {
    use onelight_benches::sheet_fidelity;

    let (found, curves) = (sheet_fidelity::all()?, sheet_fidelity::all_curves()?);
    let text = format!("{}\n{}", sheet_fidelity::table(&found), sheet_fidelity::table_of_curves(&curves));
    Ok(Report { text, json: json!({ "camera_films": found, "other_stocks": curves }), as_json: arguments.json })
}

#[cfg(feature = "measure")]
fn certify(arguments: &Arguments) -> Result<Report> {
    let looks = looks_with(&chosen(arguments)?)?;
    let (text, json) = onelight_benches::certified_pairs::certificates(&looks, COLOURS, &crate::progress::bars())?;
    Ok(Report { text, json, as_json: arguments.json })
}

/// The stocks of a kind, or of a maker, in the order of the list.
fn chosen(arguments: &Arguments) -> Result<Vec<Stock>> {
    let all: Vec<Stock> = stock_ids().map(stock).collect::<Result<_, _>>()?;
    let words =
        |stock: &Stock| [kind(stock), if stock.image() == Image::Silver { "black-and-white" } else { "colour" }];
    let of_kind = |stock: &Stock| arguments.kind.as_deref().is_none_or(|kind| words(stock).contains(&kind));
    let of_maker = |stock: &Stock| arguments.maker.as_deref().is_none_or(|m| stock.maker().eq_ignore_ascii_case(m));
    let makers: BTreeSet<String> = all.iter().map(|stock| stock.maker().to_lowercase()).collect();
    let found: Vec<Stock> = all.into_iter().filter(|stock| of_kind(stock) && of_maker(stock)).collect();
    if found.is_empty() {
        let makers: Vec<String> = makers.into_iter().collect();
        bail!(
            "no stock of kind {} by {}, expected a maker of {}",
            arguments.kind.as_deref().unwrap_or("any"),
            arguments.maker.as_deref().unwrap_or("any maker"),
            makers.join(", ")
        );
    }
    Ok(found)
}

fn all(stocks: &[Stock]) -> (String, Value) {
    let mut text = String::new();
    let groups = StockKind::ALL.into_iter().flat_map(|kind| [(kind, Image::Dye), (kind, Image::Silver)]);
    for (kind, image) in groups {
        let mut stocks = stocks.iter().filter(|stock| (stock.kind(), stock.image()) == (kind, image)).peekable();
        if stocks.peek().is_none() {
            continue;
        }
        let silver = if image == Image::Silver { ", black and white" } else { "" };
        let _ = writeln!(
            text,
            "{:31} {:4} {:>4}  {:13} {:>13} {:9} {:16} {:7} {:21} derived",
            format!("{}{silver}", kind.word()),
            "year",
            "EI",
            "sensitive nm",
            "log exposure",
            "axis",
            "aim",
            "+-D",
            "inter-image"
        );
        for stock in stocks {
            text.push_str(&row(stock));
        }
        text.push('\n');
    }
    text.push_str(
        "*    derived: the sheet states no aim\n\
         @    a variant: `ID@VARIANT`\n\
         +-D  how far two digitisations of the sheet differ in density, rms\n\
         inter-image: log10 exposure for a unit of density between layers that touch, and red and blue; measured on this film,\n\
         \x20    transferred from measured films of its kind, or assumed\n\
         ~    assumed, as there is only one: three times the median of the others\n\
         `cargo xtask stocks ID` plots one.\n",
    );
    (text, Value::from(stocks.iter().map(as_json).collect::<Vec<_>>()))
}

fn row(stock: &Stock) -> String {
    let (first, last) = sensitive_nm(stock);
    let (low, high) = exposures(stock);
    let speed = stock.exposure_index().map_or_else(|| "-".to_owned(), |ei| format!("{ei}"));
    let variants: Vec<String> = stock.variants().map(|variant| format!("@{variant}")).collect();
    let mut row = format!(
        "  {:29} {:4} {speed:>4}  {:13} {:>13} {:9} {:16} {:7} {:21} {}\n",
        stock.id(),
        stock.year(),
        format!("{first:.0}-{last:.0}"),
        format!("{}..{}", signed(low, 2), signed(high, 2)),
        axis(stock),
        aim(stock),
        format!("{:.3}{}", mean(stock.uncertainty().characteristic), if is_assumed(stock) { "~" } else { "" }),
        inter_image(stock),
        derived(stock),
    );
    if !variants.is_empty() {
        let _ = writeln!(row, "    {}", variants.join(" "));
    }
    row
}

/// The chosen stocks as a contact sheet.
fn shown(arguments: &Arguments) -> Result<(String, Value)> {
    let (Some(picture), stocks) = (&arguments.sheet, chosen(arguments)?) else { bail!("--sheet needs a picture") };
    let tiles = contact_sheet::tiles(picture, &stocks)?;
    let folder = arguments.out.as_deref().map_or_else(|| folders::output("stocks"), folders::make)?;
    let name = arguments.kind.as_deref().or(arguments.maker.as_deref()).unwrap_or("all").to_lowercase();
    let file = folder.join(format!("{name}.png"));
    let png = onelight_charts::contact_sheet(&name, COLUMNS, &tiles)?;
    write_atomically(&file, |mut out| Ok(std::io::Write::write_all(&mut out, &png)?))?;
    let looks: Vec<String> = tiles.iter().map(|tile| tile.captions.join(" ").trim_end().to_owned()).collect();
    let text = format!("{}\n{}\n", looks.join("\n"), folders::shown(&file));
    Ok((text, json!({ "looks": looks, "file": folders::shown(&file) })))
}

fn one(id: &str, out: Option<&Path>) -> Result<(String, Value)> {
    let stock = stock_named(id, |_| true)?;
    let id = stock.id();
    let folder = out.map_or_else(|| folders::output("stocks"), folders::make)?;
    let file = folder.join(format!("{id}.svg"));
    let svg = onelight_charts::stock_plot(&stock)?;
    write_atomically(&file, |mut out| Ok(std::io::Write::write_all(&mut out, svg.as_bytes())?))?;
    let uncertainty = stock.uncertainty();
    let mut text = format!("{}\n", stock.name());
    let mut line = |what: &str, value: String| {
        let _ = writeln!(text, "  {what:22} {value}");
    };
    line("kind, process", format!("{}, {}, {}", kind(&stock), stock.process(), stock.balance()));
    line("exposure index", stock.exposure_index().map_or_else(|| "none".to_owned(), |ei| ei.to_string()));
    line("sheet", format!("{} ({})", stock.sheet(), stock.year()));
    line("formats", names(&stock).map_or_else(|| "not known".to_owned(), |names| names.join(", ")));
    line("inter-image, near/far", inter_image(&stock));
    line("derived", derived(&stock));
    let variants: Vec<&str> = stock.variants().collect();
    if !variants.is_empty() {
        line("variants", variants.join(", "));
    }
    line("characteristic curve", format!("{:?}, axis {}", stock.densitometry(), axis(&stock)));
    line("D-min", densities(stock.characteristic().map(|curve| curve.d_min().0)));
    line("D-max", densities(stock.characteristic().map(|curve| curve.d_max().0)));
    line("steepest slope", densities(stock.characteristic().map(steepest)));
    if let Ok(mid_grey) = stock.mid_grey() {
        line("18 % grey at", format!("log10 H {}", signed(mid_grey.0, 3)));
        line("  with densities", densities(stock.characteristic().map(|curve| curve.density(mid_grey).0)));
    }
    if stock.aim().is_some() {
        line("aim", aim(&stock));
    }
    line("uncertainty from", uncertainty.origin.clone());
    line("  log10 sensitivity", densities(PerLayer::from(uncertainty.sensitivity)));
    line("  density of curves", densities(PerLayer::from(uncertainty.characteristic)));
    line(
        "  density of dyes",
        uncertainty.dye_density.map_or_else(|| "dyes are derived".to_owned(), |d| densities(PerLayer::from(d))),
    );
    line("plot", folders::shown(&file));
    let mut json = as_json(&stock);
    json["plot"] = folders::shown(&file).into();
    Ok((text, json))
}

/// Reads all stocks and compiles every sensible process.
fn check() -> Result<(String, Value)> {
    let stocks: Vec<Stock> = stock_ids().map(stock).collect::<Result<_, _>>()?;
    let looks = looks_with(&stocks)?;
    let faults: Vec<String> =
        looks.iter().filter_map(|look| look.compile().err()).map(|error| error.to_string()).collect();
    let (stocks, count) = (stocks.len(), looks.len());
    if let Some(first) = faults.first() {
        bail!("{} of {count} processes do not compile; the first: {first}", faults.len());
    }
    Ok((format!("{stocks} stocks read, {count} processes compiled\n"), json!({ "stocks": stocks, "processes": count })))
}

/// The sizes that a stock is sold in, where they are known.
fn names(stock: &Stock) -> Option<Vec<&'static str>> {
    let names: Vec<_> = stock.formats().iter().map(|size| size.name()).collect();
    (!names.is_empty()).then_some(names)
}

fn as_json(stock: &Stock) -> Value {
    let (first, last) = sensitive_nm(stock);
    let (low, high) = exposures(stock);
    json!({
        "id": stock.id(),
        "name": stock.name(),
        "maker": stock.maker(),
        "kind": kind(stock),
        "exposure_index": stock.exposure_index(),
        "image": if stock.image() == Image::Silver { "silver" } else { "dye" },
        "variants": stock.variants().collect::<Vec<_>>(),
        "process": stock.process(),
        "balance": stock.balance(),
        "sheet": stock.sheet(),
        "year": stock.year(),
        "formats": names(stock),
        "sensitivity_nm": [first, last],
        "log10_exposure": [low, high],
        "axis": axis(stock),
        "d_min": stock.characteristic().map(|curve| curve.d_min().0).to_array(),
        "d_max": stock.characteristic().map(|curve| curve.d_max().0).to_array(),
        "aim_status_a": stock.aim().map(|aim| aim.status_a.map(|d| d.0).to_array()),
        "inter_image": stock.inter_image().map(|(strength, origin)| json!({
            "near": strength.near(), "far": strength.far(), "origin": origin.word(),
        })),
        "derived": stock.derived(),
        "uncertainty": {
            "origin": stock.uncertainty().origin,
            "sensitivity_log10": stock.uncertainty().sensitivity,
            "characteristic_density": stock.uncertainty().characteristic,
            "dye_density": stock.uncertainty().dye_density,
        },
    })
}

fn kind(stock: &Stock) -> &'static str {
    stock.kind().word()
}

fn axis(stock: &Stock) -> &'static str {
    match stock.axis() {
        ExposureAxis::LuxSeconds => "lux s",
        ExposureAxis::LuxSecondsUnverified => "lux s?",
        ExposureAxis::Relative => "relative",
    }
}

fn aim(stock: &Stock) -> String {
    match stock.aim() {
        Some(onelight::film::AimDensities { status_a, origin }) => {
            let [r, g, b] = status_a.map(|d| d.0).to_array();
            format!("{r:.2}/{g:.2}/{b:.2}{}", if origin == Origin::Derived { "*" } else { "" })
        }
        None => "-".to_owned(),
    }
}

/// How strongly its layers inhibit each other, and where that is from.
fn inter_image(stock: &Stock) -> String {
    stock.inter_image().map_or("-".to_owned(), |(strength, origin)| {
        format!("{:.2}/{:.2} {}", strength.near(), strength.far(), origin.word())
    })
}

fn derived(stock: &Stock) -> String {
    let derived = stock.derived();
    if derived.is_empty() { "nothing, all published".to_owned() } else { derived.join(", ") }
}

fn densities(values: PerLayer<f64>) -> String {
    let [r, g, b] = values.to_array();
    format!("{r:.3} / {g:.3} / {b:.3}")
}

/// Whether nobody measured how far the figures can be trusted.
fn is_assumed(stock: &Stock) -> bool {
    stock.uncertainty().origin == "assumed"
}

/// With its sign; what rounds to nothing is `+0`.
fn signed(value: f64, decimals: i32) -> String {
    let scale = 10f64.powi(decimals);
    // Adding 0 makes +0 of -0.
    let rounded = (value * scale).round() / scale + 0.0;
    format!("{rounded:+.0$}", decimals.unsigned_abs() as usize)
}

fn mean(values: [f64; 3]) -> f64 {
    values.iter().sum::<f64>() / 3.0
}

fn steepest(curve: &onelight::film::CharacteristicCurve) -> f64 {
    let nodes = curve.log_exposures();
    nodes.iter().map(|&h| curve.slope(onelight::film::LogExposure(h)).abs()).fold(0.0, f64::max)
}

fn sensitive_nm(stock: &Stock) -> (f64, f64) {
    widest(stock.sensitivity().map(|layer| layer.range_nm().into_inner()))
}

fn exposures(stock: &Stock) -> (f64, f64) {
    widest(stock.characteristic().map(|curve| (curve.range().start().0, curve.range().end().0)))
}

fn widest(ranges: PerLayer<(f64, f64)>) -> (f64, f64) {
    let fold = |a: (f64, f64), b: (f64, f64)| (a.0.min(b.0), a.1.max(b.1));
    ranges.to_array().into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), fold)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_has_no_minus() {
        for (value, expected) in
            [(-0.001, "+0.00"), (-0.0, "+0.00"), (0.004, "+0.00"), (-0.006, "-0.01"), (3.2, "+3.20")]
        {
            assert_eq!(signed(value, 2), expected);
        }
    }

    #[test]
    fn assumed_figures_are_marked_and_measured_ones_are_not() {
        let stocks: Vec<Stock> = stock_ids().map(|id| stock(id).unwrap()).collect();
        let (text, _) = all(&stocks);
        assert!(!text.contains("-0.00"), "{text}");
        let row = |id: &str| text.lines().find(|line| line.trim_start().starts_with(id)).unwrap().to_owned();
        for stock in stock_ids().map(|id| stock(id).unwrap()) {
            // Where nobody compared two digitisations, the same figure stands for several stocks.
            assert_eq!(
                row(stock.id()).contains('~'),
                stock.uncertainty().origin != "two digitisations",
                "{}",
                stock.id()
            );
        }
        assert!(row("fuji-eterna-500").contains("0.015~") && row("fuji-3513di").contains('*'));
        assert!(text.lines().any(|line| line.starts_with("~ ")) && text.lines().any(|line| line.starts_with("* ")));
    }
}
