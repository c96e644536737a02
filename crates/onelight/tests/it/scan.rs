//! Negatives that are scanned and inverted.

use onelight::lut::{Channels, PixelMap as _};
use onelight::{
    Aim, Effects, FilmProcess, Films, Process, ProcessKeys, StockKind, StructuredSettings, WorkingSpace, stock,
    stock_ids,
};

use crate::films::direct;
use crate::{chart, compiled, differ};

fn negatives() -> impl Iterator<Item = FilmProcess> {
    let negative = |id: &&str| stock(id).unwrap().kind() == StockKind::Negative;
    stock_ids().filter(negative).map(FilmProcess::scanned)
}

/// The look that keys describe, or why there is none.
fn keys(text: &str) -> Result<Process, String> {
    Process::from_toml("look.toml", &format!("version = 2\n{text}")).map_err(|error| error.to_string())
}

#[test]
fn every_negative_is_neutral_at_the_card_and_never_darker_with_more_light() {
    for process in negatives() {
        let scan = compiled(&process);
        assert!(scan.develop_linear([0.18; 3]).iter().all(|v| (v - 10f64.powf(-0.7)).abs() < 1e-9), "{}", scan.name());
        let greys: Vec<_> = (-80..=80).map(|i| scan.develop_linear([0.18 * (f64::from(i) / 8.0).exp2(); 3])).collect();
        // A densitometer's channels overlap, and reading noise of a sheet's curves is levelled layer by layer.
        let falls = |pair: &[onelight::DisplayLinear]| (0..3).any(|c| pair[1][c] < pair[0][c] - 1e-9);
        assert!(!greys.windows(2).any(falls), "{}", scan.name());
    }
}

/// CIEDE2000 that the direct form promises.
const DIRECT: f64 = 0.13;
/// CIEDE2000 of a table of 32 nodes: as those of negatives on print film.
const STRUCTURED: f64 = 1.0;

#[test]
fn forms_hold_a_scan_by_the_steps_of_a_print() {
    let colours = chart(-6..=4);
    for id in ["kodak-5207", "kodak-portra-400", "fuji-natura-1600", "kodak-tri-x-400"] {
        let process = FilmProcess::scanned(id);
        let (scan, form) = (compiled(&process), direct(&process));
        let coding = scan.coding();
        let single = |rgb: [f64; 3]| rgb.map(|v| v as f32);
        let (mean, most) = differ(
            &colours,
            |rgb| scan.develop_linear(rgb),
            |rgb| coding.decode_rgb(form.apply(single(rgb)).map(f64::from)),
        );
        assert!(most < DIRECT, "{id}: {mean} {most}");
        let table = scan.structured(&StructuredSettings::default()).unwrap();
        let (mean, most) = differ(
            &colours,
            |rgb| scan.develop_linear(rgb),
            |rgb| coding.decode_rgb(table.apply(single(rgb)).map(f64::from)),
        );
        assert!(most < STRUCTURED, "{id}: {mean} {most}");
        // In pictures as colour by colour.
        let mut row = [[0.02, 0.18, 3.0], [0.0, 9.0, 0.4]];
        let alone = row.map(|rgb| form.apply(rgb));
        let mut pixels = onelight::PixelsMut::new(row.as_flattened_mut(), Channels::Rgb, [2, 1]).unwrap();
        form.map_in_place(&mut pixels);
        assert!(row.iter().flatten().zip(alone.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-4), "{id}");
    }
}

#[test]
fn steps_say_what_a_scan_reads_and_has_no_print() {
    let scan = compiled(&FilmProcess::scanned("kodak-portra-400"));
    let stages = scan.stages([0.18; 3]);
    let densities = stages.scan.unwrap();
    // The red-filter density of a grey card on a correctly exposed negative, 0.80 to 1.00 on other Kodak sheets of C-41 film.
    assert!((0.6..1.0).contains(&densities.red.0), "{densities:?}");
    assert!(stages.print.is_none() && scan.print_curves().is_none() && scan.printer_lights().is_none());
    assert_eq!(stages.linear, scan.develop_linear([0.18; 3]));
}

/// The channels are sRGB's: in another space the picture has the same colours.
#[test]
fn the_output_space_does_not_change_the_colours() {
    let usual = FilmProcess::scanned("kodak-portra-400");
    let mut wide = usual.clone();
    wide.spaces.output_space = WorkingSpace::Rec2020;
    let (usual, wide) = (compiled(&usual), compiled(&wide));
    let (usual, wide) = (usual.develop_linear([0.5, 0.2, 0.1]), wide.develop_linear([0.5, 0.2, 0.1]));
    assert!(wide[0] < usual[0] && wide[2] > usual[2], "less saturated in wider primaries: {wide:?} {usual:?}");
    let compiled = compiled(&FilmProcess::scanned("kodak-portra-400"));
    let grey = compiled.develop_linear([0.18; 3]);
    assert!((grey[0] - grey[2]).abs() < 1e-9);
}

#[test]
fn a_scan_is_written_and_read() {
    let process = Process::from(FilmProcess::scanned("kodak-portra-400"));
    assert_eq!(process.name(), "kodak-portra-400_scan");
    let text = process.to_toml();
    assert!(text.contains("print = \"scan\""), "{text}");
    assert_eq!(Process::from_toml("look.toml", &text).unwrap(), process);
    assert_eq!(keys("camera = \"kodak-portra-400\"\nprint = \"scan\"").unwrap(), process);
    // By its sheet alone, as version 1 and the preset have it: a scan has no lamp to adapt to.
    let old = Process::from_toml("look.toml", "version = 1\ncamera = \"kodak-5207\"\nprint = \"scan\"\n").unwrap();
    assert_eq!(old, FilmProcess::scanned("kodak-5207").as_in_the_talk().into());
    // Films beside it are those of the description.
    let films = Films { camera: stock("kodak-5219").unwrap(), print: None };
    assert_eq!(process.compile_with(&films).unwrap().name(), "kodak-5219_scan");
}

#[test]
fn what_a_scan_has_nothing_for_is_refused_by_name() {
    let scan = "print = \"scan\"\n";
    for (line, expected) in [
        ("camera = \"fuji-velvia-50\"", "fuji-velvia-50 is a reversal film and is shown as it is, expected print none"),
        ("camera = \"fuji-instax\"", "fuji-instax is an instant film and is shown as it is, expected print none"),
        ("camera = \"kodak-2383\"", "kodak-2383"),
        ("camera = \"none\"", "camera none: codes of a scan are printed, expected a print film"),
        ("aim = \"sheet\"", "a scan has no sheet that states an aim, expected aim neutral"),
        ("points = [1, 0, 0]", "print is scan and nothing is printed or projected: points changes nothing"),
        ("light = \"white\"", "light changes nothing"),
        ("print_curves = \"principal\"", "print_curves changes nothing"),
        ("projector = \"theatre\"", "projector changes nothing"),
        ("white = \"lamp\"", "white changes nothing"),
        ("print_sheet = \"mine\"", "print is scan: print_sheet and print_sha256 change nothing"),
        ("approach = \"first\"", "print is scan, which approach first does not have"),
    ] {
        let found = keys(&format!("{scan}{line}")).unwrap_err();
        assert!(found.contains(expected), "{line}: {found}");
    }
    assert!(keys("print = \"Scan\"").unwrap_err().contains("did you mean \"scan\"?"));
    let negative = keys("print = \"none\"").unwrap_err();
    assert!(negative.contains("such as kodak-2383, or a scan"), "{negative}");
    let both = FilmProcess { print: Some(onelight::Printing::default()), ..FilmProcess::scanned("kodak-5207") };
    assert!(both.compile().unwrap_err().to_string().contains("a scan is no print"));
    let sheet = FilmProcess { aim: Aim::Sheet, ..FilmProcess::scanned("kodak-5207") };
    assert!(sheet.compile().unwrap_err().to_string().contains("expected aim neutral"));
    // What is done to the negative means the same as before a print.
    for line in
        ["overexposure = 1", "neutral_density = 0.6", "interimage = \"none\"", "film_format = \"super35\"", "ev = 1"]
    {
        assert!(keys(&format!("{scan}{line}")).is_ok(), "{line}");
    }
    assert_eq!(ProcessKeys::parse_print("scan").unwrap().as_deref(), Some("scan"));
    let effects = Effects { film_format: Some("super35".parse().unwrap()), ..Effects::default() };
    assert!(
        onelight::FilmEffects::new(&FilmProcess { effects, ..FilmProcess::scanned("kodak-5207") }).unwrap().is_some()
    );
}
