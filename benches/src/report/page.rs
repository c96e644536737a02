//! The report as one page that needs nothing else.

use std::fmt::Write as _;

use super::axis::Axis;
use super::contents::Contents;
use super::figure::{self, Which};
use super::plot::{Chart, SIZE};
use super::scope::Scope;
use super::text::{bytes, escaped, figure as written};
use super::{table, words};

const CHART_CSS: &str = include_str!("chart.css");
const PAGE_CSS: &str = include_str!("page.css");
const SORT_JS: &str = include_str!("sort.js");

/// Colours by name, for light and for dark surroundings. `c0` to `c5` are distinct to colour-blind eyes: after
/// \[OkabeIto2008\], with the lightness that each ground needs.
const COLOURS: [(&str, &str, &str); 11] = [
    ("--paper", "#ffffff", "#15171a"),
    ("--ink", "#1c1e21", "#e6e7e9"),
    ("--soft", "#5b6168", "#a3a9b1"),
    ("--rule", "#c9ced6", "#41464d"),
    ("--grid", "#e9ebef", "#2a2e33"),
    ("--c0", "#a3487f", "#d990bd"),
    ("--c1", "#0072b2", "#56b4e9"),
    ("--c2", "#cc5200", "#f28b4b"),
    ("--c3", "#007f5f", "#2cc99b"),
    ("--c4", "#1c1e21", "#e6e7e9"),
    ("--c5", "#997000", "#eac435"),
];

/// The whole page as HTML: advice, plots, tables, studies, other programs, and how it was made.
pub(super) fn html(contents: &Contents) -> String {
    let mut body = head(contents);
    for (look, _) in &contents.looks {
        let _ = writeln!(body, "<h2>{}</h2>", escaped(&look.title));
        body.push_str("<dl>\n");
        for advice in words::advice(look, contents.copy, &contents.elsewhere) {
            let _ = writeln!(body, "<dt>{}</dt><dd>{}</dd>", advice.whom, escaped(&advice.sentence));
        }
        body.push_str("</dl>\n");
        charts(
            &mut body,
            &[Which::Max, Which::Mean]
                .map(|which| figure::speed_error(look, contents.copy, &contents.elsewhere, which)),
        );
        list(&mut body, &words::reading(look, contents.copy));
        body.push_str(&table::forms(look, contents.copy));
        paragraph(
            &mut body,
            "soft",
            "Direct forms are named by their exponentials, printing + projection, or by the step of an even grid of \
             wavelengths. Bytes are those of all tables and curves, a table's entry with four channels as in a texture. Forms that \
             differ in storage alone share a time: a processor reads all as 32-bit floats. Worst band: the mean of the \
             worst four stops of exposure. Max: followed uphill from the worst colours; max to +6: of the colours drawn.",
        );
    }
    studies(&mut body, contents);
    other_programs(&mut body, contents);
    made(&mut body, contents);
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n\
         <meta name=\"color-scheme\" content=\"light dark\"/>\n\
         <title>onelight: speed against error</title>\n<style>\n{}\n{CHART_CSS}{PAGE_CSS}</style>\n</head>\n\
         <body>\n<main>\n{body}</main>\n<script>\n{SORT_JS}</script>\n</body>\n</html>\n",
        palettes()
    )
}

/// Light, dark where the reader's system is, light on paper.
fn palettes() -> String {
    let of = |pick: fn(&(&'static str, &'static str, &'static str)) -> &'static str| {
        let all: Vec<String> = COLOURS.iter().map(|c| format!("{}: {};", c.0, pick(c))).collect();
        format!(":root {{ {} }}", all.join(" "))
    };
    let (light, dark) = (of(|c| c.1), of(|c| c.2));
    format!("{light}\n@media screen and (prefers-color-scheme: dark) {{ {dark} }}")
}

fn head(contents: &Contents) -> String {
    let mut body = "<h1>onelight: speed against error</h1>\n".to_owned();
    if contents.scope == Scope::Quick {
        paragraph(
            &mut body,
            "notice",
            "A quick run: few forms, few colours, a small picture. It shows that all works; its figures are rough.",
        );
    }
    let [width, height] = contents.frame;
    paragraph(
        &mut body,
        "",
        &format!(
            "How near each compiled form of a film comes to the film itself (float64 at 1 nm), and how long it takes. \
             Differences are CIEDE2000 between display pictures, over {} scene colours from -10 to +10 stops of any \
             saturation. Times are the fastest of {} rounds over a scene-linear picture of {width}x{height} pixels, {}, \
             32-bit float in and out, on one thread; all forms take turns in each round.",
            contents.colours, contents.rounds, contents.content
        ),
    );
    body
}

fn studies(body: &mut String, contents: &Contents) {
    for (look, studies) in &contents.looks {
        let _ = write!(body, "<h2>What the parts cost: {}</h2>\n<h3>Wavelengths</h3>\n", escaped(&look.title));
        paragraph(body, "", &words::grids(&studies.grids));
        charts(body, &[figure::grids(&studies.grids), figure::curves(&studies.curves)]);
        body.push_str(&table::grids(&studies.grids));
        paragraph(body, "", &words::exposure(&studies.exposure));
        body.push_str(&table::exposure(&studies.exposure));
        body.push_str("<h3>Curves</h3>\n");
        paragraph(body, "", &words::curves(&studies.curves));
        body.push_str(&table::curves(&studies.curves));
        body.push_str("<h3>Frame buffers</h3>\n");
        paragraph(body, "", &words::buffers(&studies.buffers));
        body.push_str(&table::buffers(&studies.buffers));
    }
    let Some((look, _)) = contents.looks.first() else { return };
    let _ = writeln!(body, "<h2>How cost grows: {}</h2>", escaped(&look.title));
    let growth = &contents.growth;
    let time = "time for a pixel, one thread (ns)";
    charts(
        body,
        &[
            figure::growth(
                "Size of the picture",
                Axis::log("megapixels"),
                Axis::log("time, one thread (ms)"),
                &growth.picture,
            ),
            figure::growth("Size of the table", Axis::log("nodes along a side"), Axis::linear(time), &growth.table),
            figure::growth("Exponentials", Axis::log("exponentials for a pixel"), Axis::log(time), &growth.nodes),
            figure::growth("Threads", Axis::linear("threads"), Axis::linear("megapixels a second"), &growth.threads),
        ],
    );
    list(body, &words::growth(growth));
    body.push_str(&table::growth("Milliseconds for a picture, one thread", "megapixels", &growth.picture));
    body.push_str(&table::growth("Nanoseconds a pixel, one thread", "nodes along a side", &growth.table));
    body.push_str(&table::effects(&growth.effects));
    body.push_str(&table::picture_effects(&growth.picture_effects));
    body.push_str(&table::growth("Megapixels a second", "threads", &growth.threads));
    body.push_str(&table::decisions(&contents.decisions));
}

fn other_programs(body: &mut String, contents: &Contents) {
    if contents.elsewhere.peers.is_empty() {
        return;
    }
    body.push_str("<h2>Outside programs</h2>\n<div class=\"scroll\">");
    body.push_str(&figure::peers(&contents.elsewhere.peers));
    body.push_str("</div>\n");
    body.push_str(&table::peers(&contents.elsewhere.peers));
}

fn made(body: &mut String, contents: &Contents) {
    let machine = &contents.machine;
    body.push_str("<h2>How this was made</h2>\n<dl>\n");
    let threads = format!("{} threads", machine.threads);
    for (what, value) in [
        ("Command", machine.command.clone()),
        ("Program", format!("onelight {}", machine.version)),
        ("Date", machine.date.clone()),
        ("Processor", format!("{}, {threads}, vectors to {}, {}", machine.processor, machine.vectors, machine.system)),
        ("Time taken", contents.clock.clone()),
        (
            "Copy",
            format!("{} ns for a pixel of {}: what no form can be faster than", written(contents.copy.ns), bytes(12)),
        ),
    ] {
        let _ = writeln!(body, "<dt>{what}</dt><dd>{}</dd>", escaped(&value));
    }
    body.push_str("</dl>\n");
    paragraph(body, "soft", "All numbers are in report.json beside this page.");
}

fn paragraph(body: &mut String, class: &str, text: &str) {
    let class = if class.is_empty() { String::new() } else { format!(" class=\"{class}\"") };
    let _ = writeln!(body, "<p{class}>{}</p>", escaped(text));
}

fn list(body: &mut String, sentences: &[String]) {
    body.push_str("<ul>\n");
    for sentence in sentences {
        let _ = writeln!(body, "<li>{}</li>", escaped(sentence));
    }
    body.push_str("</ul>\n");
}

fn charts(body: &mut String, charts: &[Chart]) {
    body.push_str("<div class=\"charts\">\n");
    for chart in charts {
        let _ = writeln!(body, "<div class=\"scroll\">{}</div>", chart.svg());
    }
    body.push_str("</div>\n");
}

/// The first look's two charts as a picture of its own, on its own ground: for a README, which may be light or dark.
pub(super) fn picture(contents: &Contents) -> String {
    const GAP: f64 = 14.0;
    const FOOT: f64 = 24.0;
    let mut style = CHART_CSS.to_owned();
    for (name, light, _) in COLOURS {
        style = style.replace(&format!("var({name})"), light);
    }
    let (width, height) = (2.0 * SIZE.0 + 3.0 * GAP, SIZE.1 + 2.0 * GAP + FOOT);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\">\n\
         <style>\n{style}</style>\n\
         <rect width=\"{width}\" height=\"{height}\" rx=\"6\" fill=\"{}\"/>\n",
        COLOURS[0].1
    );
    let Some((look, _)) = contents.looks.first() else { return svg + "</svg>\n" };
    for (i, which) in (0..).zip([Which::Max, Which::Mean]) {
        let chart = figure::speed_error(look, contents.copy, &contents.elsewhere, which).without_hints();
        let left = GAP + f64::from(i) * (SIZE.0 + GAP);
        let _ = writeln!(svg, "<g transform=\"translate({left} {GAP})\">{}</g>", chart.contents());
    }
    let Contents { machine, .. } = contents;
    let _ = write!(
        svg,
        "<text class=\"tick\" x=\"{:.1}\" y=\"{:.1}\">{}</text>\n</svg>\n",
        GAP + 8.0,
        height - GAP,
        escaped(&format!("{}; {}, one thread, {}; cargo xtask report", look.title, machine.processor, machine.date))
    );
    svg
}
