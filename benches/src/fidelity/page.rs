//! What is measured, as the text of docs/measured.md and as a page with plots.

use std::fmt::Write as _;

use onelight::spectra::color_checker;
use onelight::{DyeModel, FilmProcess, InterImageChoice, PrintCurves, Reference, Uncertainty, White, Word as _};

use super::causes::{self, Cause};
use super::chart::{COLOURS, Chart, Scene};
use super::negative::{ALONE, Negative};
use super::plot::{self, Curve};
use super::reversal::{self, Exchanged};
use super::{absolute, greys, surface, ways, words};
use crate::error::Result;
use crate::sheet_fidelity;

/// Stops over normal exposure of the measured frames of Portra 400, their slopes R - G and B - G, and what the law gave on the
/// frames' own target.
pub(super) const SLOPES: [(f64, [f64; 2], [f64; 2]); 4] = [
    (-1.0, [1.09, 1.28], [1.09, 1.20]),
    (0.0, [1.17, 1.31], [1.20, 1.27]),
    (1.0, [1.27, 1.40], [1.27, 1.33]),
    (2.0, [1.30, 1.43], [1.29, 1.34]),
];

/// Median chroma that is expected of a film and its white, and where the figure is from.
pub(super) const CHROMA: [(&str, White, f64); 5] = [
    ("kodak-5207", White::Lamp, 1.00),
    ("kodak-5207", White::Film, 1.12),
    ("kodak-ektachrome-100", White::Film, 1.26),
    ("fuji-velvia-50", White::Film, 1.14),
    ("fuji-provia-100f", White::Film, 1.08),
];

/// b* of an emulation of 2383 that is widely used in grading, less that at L* 50, at L* 10 to 90 in tens.
const EMULATION_B: [f64; 9] = [-3.0, -3.2, -3.1, -2.2, 0.0, 2.5, 4.5, 5.5, 5.6];

/// Lightness of the emulation two stops below where it has [`ALIGNED_L`], for a camera film of gamma 0.6.
const EMULATION_L: f64 = 12.0;
const ALIGNED_L: f64 = 54.0;
/// Those two stops as density of that camera film.
const EMULATION_DENSITY: f64 = 0.6 * 2.0 * std::f64::consts::LOG10_2;

/// Everything that is measured, written twice.
pub struct Page {
    /// docs/measured.md.
    pub markdown: String,
    /// The same with plots, as one page of HTML that needs nothing else.
    pub html: String,
}

/// A part of the page: its text in Markdown, its plots in SVG.
struct Part {
    text: String,
    plots: String,
}

/// Measures everything; some seconds.
///
/// # Errors
/// If a look cannot be compiled.
pub fn measure() -> Result<Page> {
    let scene = Scene::new()?;
    let parts = [
        slopes()?,
        separations()?,
        densities()?,
        chroma(&scene)?,
        reversal_films(&scene)?,
        grey_scale(&scene)?,
        absolute_greys(&scene)?,
        surfaces(&scene)?,
        ways_to_see(&scene)?,
        uncertain(&scene)?,
        print_curves(&scene)?,
        turns()?,
    ];
    let mut markdown = words::INTRODUCTION.to_owned();
    let mut body = String::new();
    for part in &parts {
        let _ = write!(markdown, "\n{}", part.text);
        let _ = write!(body, "<pre>{}</pre>\n<p>{}</p>\n", escaped(&part.text), part.plots);
    }
    let html = words::PAGE.replace("{body}", &body);
    Ok(Page { markdown, html })
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}

fn slopes() -> Result<Part> {
    let film = Negative::new("kodak-portra-400", InterImageChoice::Film)?;
    let alone = Negative::new("kodak-portra-400", ALONE)?;
    let mut text = words::SLOPES.to_owned();
    let names = ["R-G measured", "R-G here", "B-G measured", "B-G here"];
    let mut curves =
        names.map(|name| Curve { name: name.to_owned(), is_measured: name.ends_with("measured"), points: Vec::new() });
    let mut moved = 0f64;
    for (stops, measured, law) in SLOPES {
        let (found, alone) = (film.chroma_slopes(stops), alone.chroma_slopes(stops));
        let found = [found.red_green, found.blue_green];
        let alone = [alone.red_green, alone.blue_green];
        for (i, name) in ["R-G", "B-G"].into_iter().enumerate() {
            let _ = writeln!(
                text,
                "| {stops:+.0} | {name} | {:.2} | {:.2} | {:+.2} | {:.2} | {:.2} |",
                measured[i],
                found[i],
                found[i] - measured[i],
                law[i],
                alone[i]
            );
            moved = moved.max((found[i] - law[i]).abs());
            curves[2 * i].points.push((stops, measured[i]));
            curves[2 * i + 1].points.push((stops, found[i]));
        }
    }
    let dark = [-3.0, -4.0, -5.0].map(|stops| film.chroma_slopes(stops).red_green);
    let _ = writeln!(
        text,
        "\nThe chart in place of the frames' own target moves a slope by at most {moved:.2}: that target holds darker colours, on the toe,\n\
         which the chart reaches later. Its R-G at -3, -4 and -5 stops: {:.2}, {:.2}, {:.2}.",
        dark[0], dark[1], dark[2]
    );
    Ok(Part { text, plots: plot::curves("Chroma slopes of Portra 400 over stops", &curves) })
}

fn separations() -> Result<Part> {
    let mut text = words::SEPARATIONS.to_owned();
    for (id, expected, sheet) in
        [("kodak-5207", [17, 29, 17], [-10, -17, -11]), ("kodak-portra-400", [26, 14, 27], [-6, -27, -7])]
    {
        let percent = |[r, g, b]: [f64; 3]| format!("{:+.0}/{:+.0}/{:+.0} %", 100.0 * r, 100.0 * g, 100.0 * b);
        let given = |[r, g, b]: [i32; 3]| format!("{r:+}/{g:+}/{b:+} %");
        let found = Negative::new(id, InterImageChoice::Film)?.separation_over_neutral();
        let alone = Negative::new(id, ALONE)?.separation_over_neutral();
        let _ = writeln!(
            text,
            "| {id} | {} | {} | {} | {} |",
            percent(found),
            given(expected),
            percent(alone),
            given(sheet)
        );
    }
    text.push_str(words::PATENTS);
    Ok(Part { text, plots: String::new() })
}

fn densities() -> Result<Part> {
    let mut text = words::DENSITIES.to_owned();
    let lad = [0.653, 0.687, 0.725];
    let found = sheet_fidelity::lad_of_5203()?;
    let off: Vec<String> = found.iter().zip(lad).map(|(found, lad)| format!("{:+.2}", found - lad)).collect();
    let _ = writeln!(
        text,
        "| 5203, status M above D-min of a grey card | 0.653/0.687/0.725 | {:.2}/{:.2}/{:.2} | {} | digital LAD \\[KodakH387\\] |",
        found[0],
        found[1],
        found[2],
        off.join("/")
    );
    for id in ["kodak-5203", "kodak-5207", "kodak-5213", "kodak-5219", "kodak-5248"] {
        let sheet = FilmProcess { aim: onelight::Aim::Sheet, ..FilmProcess::for_camera(id)? }.compile()?;
        let gamma = greys::gamma(&sheet);
        let off = if gamma < 1.5 { gamma - 1.5 } else { (gamma - 1.8).max(0.0) };
        let _ = writeln!(
            text,
            "| {id} on 2383, gamma at a grey card, sheet aim | 1.5 to 1.8 | {gamma:.2} | {off:+.2} | \\[FAOL\\], \\[DigitalFactBook\\] |"
        );
    }
    text.push_str(words::PROVIA);
    Ok(Part { text, plots: String::new() })
}

fn chart_of(scene: &Scene, look: &Reference) -> Chart {
    scene.chart(|_, rgb| look.develop_linear(rgb))
}

fn chroma(scene: &Scene) -> Result<Part> {
    let (mut text, mut plots) = (words::CHROMA.to_owned(), String::new());
    for (id, white, expected) in CHROMA {
        let look = FilmProcess { white, ..FilmProcess::for_camera(id)? }.compile()?;
        let chart = chart_of(scene, &look);
        let (turn, patch) = chart.largest_turn();
        let _ = writeln!(
            text,
            "| {id} | {} | {expected:.2} | {:.2} | {:+.2} | {:+.0} | {:.0} | {turn:+.0} ({patch}) |",
            white.word(),
            chart.median_chroma(),
            chart.median_chroma() - expected,
            chart.turn("light skin"),
            chart.median_turn()
        );
        plots.push_str(&plot::colours(&format!("{id}, white {}", white.word()), &chart.colours));
    }
    text.push_str(words::SKIN);
    Ok(Part { text, plots })
}

fn reversal_films(scene: &Scene) -> Result<Part> {
    let mut text = words::REVERSAL.to_owned();
    for Exchanged { id, own, lent, alone } in reversal::all(scene)? {
        let lent_chroma =
            lent.map(|lent| if id == reversal::LENDER { "-".to_owned() } else { format!("{:.2}", lent.chroma) });
        let _ = writeln!(
            text,
            "| {id} | {:.2} | {} | {:.2} | {:.2} | {} |",
            own.chroma,
            lent_chroma.join(" | "),
            alone.chroma,
            own.gamma,
            if id == reversal::LENDER { "-".to_owned() } else { format!("{:.2}", lent[1].gamma) }
        );
    }
    text.push_str(words::WHOSE_STRENGTH);
    Ok(Part { text, plots: String::new() })
}

fn grey_scale(scene: &Scene) -> Result<Part> {
    let look = FilmProcess::default().compile()?;
    let lightness: Vec<f64> = (1..=9).map(|i| 10.0 * f64::from(i)).collect();
    let of = |l: f64| greys::grey(scene, &look, greys::stops_of(scene, &look, l))[2];
    let middle = of(50.0);
    let mut text = words::GREYS.to_owned();
    let mut curves = ["emulation", "here"].map(|name| Curve {
        name: name.to_owned(),
        is_measured: name == "emulation",
        points: Vec::new(),
    });
    for (l, emulation) in lightness.into_iter().zip(EMULATION_B) {
        let found = of(l) - middle;
        let _ = writeln!(text, "| {l:.0} | {emulation:+.1} | {found:+.1} | {:+.1} |", found - emulation);
        curves[0].points.push((l, emulation));
        curves[1].points.push((l, found));
    }
    let (most, stops) = greys::tint(scene, &look);
    let _ = writeln!(
        text,
        "\nLargest chroma of a grey from -4 to +6 stops, 5207 on 2383 in neutral aim: {most:.1} at {stops:+.2} stops."
    );
    Ok(Part { text, plots: plot::curves("b* of greys over L*, 5207 on 2383", &curves) })
}

fn absolute_greys(scene: &Scene) -> Result<Part> {
    let mut text = words::ABSOLUTE.to_owned();
    for absolute::Unbalanced { id, off, grey, tint, alone } in absolute::all(scene)? {
        let [red, green, blue] = off;
        let _ = writeln!(
            text,
            "| {id} | {red:+.2}/{green:+.2}/{blue:+.2} | {:.1} | {:.1} | {alone:.1} | {:.1} at {:+.2} |",
            grey[0],
            grey[1].hypot(grey[2]),
            tint.0,
            tint.1
        );
    }
    text.push_str(words::WHY_ABSOLUTE);
    Ok(Part { text, plots: String::new() })
}

fn surfaces(scene: &Scene) -> Result<Part> {
    let mut text = words::SURFACE.to_owned();
    for surface::Reflecting { name, black, moved: [half, one] } in surface::all(scene)? {
        let _ = writeln!(
            text,
            "| {name} | {:.1} | {:.1} | {:.2}, {:.1} ({}) | {:.1} | {:.2}, {:.1} ({}) |",
            black[0], black[1], half.0, half.1, half.2, black[2], one.0, one.1, one.2
        );
    }
    text.push_str(words::NO_SURFACE);
    Ok(Part { text, plots: String::new() })
}

fn ways_to_see(scene: &Scene) -> Result<Part> {
    let mut text = words::WAYS.to_owned();
    for ways::Way { name, gamma, chroma, turn, tint, white } in ways::all(scene)? {
        let white = white.map_or_else(|| "-".to_owned(), |stops| format!("{stops:+.1}"));
        let _ = writeln!(
            text,
            "| {name} | {gamma:.2} | {chroma:.2} | {turn:.0} | {:.1} at {:+.2} | {white} |",
            tint.0, tint.1
        );
    }
    text.push_str(words::WHICH_WAY);
    Ok(Part { text, plots: String::new() })
}

fn uncertain(scene: &Scene) -> Result<Part> {
    let mut text = words::UNCERTAINTY.to_owned();
    for id in ["kodak-5207", "kodak-portra-400", "kodak-ektachrome-100", "fuji-velvia-50"] {
        let uncertainty = Uncertainty::new(&FilmProcess::for_camera(id)?)?;
        let patches: Vec<(&str, [f64; 2])> = color_checker()
            .iter()
            .take(COLOURS)
            .map(|patch| (patch.name.as_str(), uncertainty.parts(scene.patch(patch))))
            .collect();
        let mean =
            |of: &dyn Fn([f64; 2]) -> f64| patches.iter().map(|(_, parts)| of(*parts)).sum::<f64>() / COLOURS as f64;
        let both = |[sheets, inter_image]: [f64; 2]| f64::hypot(sheets, inter_image);
        let most = patches.iter().max_by(|a, b| both(a.1).total_cmp(&both(b.1)));
        let (name, most) = most.map_or(("", 0.0), |(name, parts)| (name, both(*parts)));
        let _ = writeln!(
            text,
            "| {id} | {:.1} | {most:.1} | {name} | {:.1} | {:.1} |",
            mean(&both),
            mean(&|parts| parts[0]),
            mean(&|parts| parts[1])
        );
    }
    text.push_str(words::UNCERTAIN_REVERSAL);
    Ok(Part { text, plots: String::new() })
}

fn print_curves(scene: &Scene) -> Result<Part> {
    let mut text = words::PRINT_CURVES.to_owned();
    let mut plots = String::new();
    let readings: [(&str, PrintCurves, DyeModel); 3] = [
        ("neutral", PrintCurves::Neutral, DyeModel::Wedge),
        ("principal", PrintCurves::Principal, DyeModel::Wedge),
        ("neutral, `--dyes literal`", PrintCurves::Neutral, DyeModel::Literal),
    ];
    for (name, curves, dyes) in readings {
        let mut process = FilmProcess { dyes, ..FilmProcess::default() };
        process.print.iter_mut().for_each(|printing| printing.curves = curves);
        let look = process.compile()?;
        let chart = chart_of(scene, &look);
        let (tint, at) = greys::tint(scene, &look);
        let aligned = greys::stops_of(scene, &look, ALIGNED_L);
        let stops_below = greys::grey(scene, &look, aligned - 2.0)[0];
        let below = greys::grey(scene, &look, greys::thinner(&look, aligned, EMULATION_DENSITY))[0];
        let _ = writeln!(
            text,
            "| {name} | {:.2} | {tint:.1} at {at:+.2} | {:.2} | {:+.0} | {:+.0} | {:+.0} | {stops_below:.1} | {below:.1} | {:+.1} |",
            greys::gamma(&look),
            chart.median_chroma(),
            chart.turn("blue sky"),
            chart.turn("cyan"),
            chart.turn("light skin"),
            below - EMULATION_L
        );
        plots.push_str(&plot::colours(&format!("5207 on 2383, {}", name.replace('`', "")), &chart.colours));
    }
    text.push_str(words::WHICH_READING);
    Ok(Part { text, plots })
}

fn turns() -> Result<Part> {
    let all = causes::all()?;
    let usual = all[0].turns;
    let mut text = words::TURNS.to_owned();
    for Cause { what, turns: [sky, cyan], median } in &all {
        let _ = writeln!(
            text,
            "| {what} | {sky:+.1} | {:+.1} | {cyan:+.1} | {:+.1} | {median:.1} |",
            sky - usual[0],
            cyan - usual[1]
        );
    }
    text.push_str(words::WHOSE);
    Ok(Part { text, plots: String::new() })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All of the page is measured again.
    #[test]
    fn docs_hold_what_is_measured() {
        let page = measure().unwrap();
        assert_eq!(page.markdown, include_str!("../../../docs/measured.md"), "run `cargo xtask fidelity`");
    }
}
