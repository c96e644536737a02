//! Data sheets of one's own in the camera and behind the negative.

use onelight::certify::{Certifier, CertifySettings};
use onelight::lut::{SamplingLaw, Search};
use onelight::{
    FilmProcess, Films, FirstProcess, Printing, Process, ProcessKeys, Reference, SheetText, Stock, StockRef,
    ToneProcess, baked, stock,
};

use crate::film;

/// A built-in sheet under another name, what its files say changed.
fn renamed(from: &str, id: &str, change: impl Fn(&str) -> String) -> Stock {
    let files = onelight_stocks::find(from).unwrap();
    Stock::parse(&SheetText {
        id,
        stock_toml: &files.stock_toml.replace(&format!("id = \"{from}\""), &format!("id = \"{id}\"")),
        sensitivity_csv: files.sensitivity_csv,
        characteristic_csv: &change(files.characteristic_csv),
        dye_density_csv: files.dye_density_csv,
    })
    .unwrap()
}

fn unchanged(text: &str) -> String {
    text.to_owned()
}

/// Steeper curves: as if developed for longer.
fn pushed(text: &str) -> String {
    let longer = |line: &str| {
        let cells: Option<Vec<f64>> = line.split(',').map(|cell| cell.trim().parse().ok()).collect();
        match cells.as_deref() {
            Some([h, densities @ ..]) => {
                let denser: Vec<String> = densities.iter().map(|d| format!("{:.4}", 1.15 * d)).collect();
                format!("{h},{}", denser.join(","))
            }
            _ => line.to_owned(),
        }
    };
    text.lines().map(longer).collect::<Vec<String>>().join("\n")
}

fn films(camera: Stock) -> Films {
    Films { camera, print: Some(stock("kodak-2383").unwrap()) }
}

const COLOURS: [[f64; 3]; 5] = [[0.18; 3], [2.0, 0.5, 0.1], [0.01, 0.3, 0.02], [0.0, 0.0, 8.0], [40.0, 30.0, 20.0]];

fn same(a: &Reference, b: &Reference) -> bool {
    COLOURS.iter().all(|rgb| a.stages(*rgb) == b.stages(*rgb))
}

#[test]
fn a_copy_of_a_sheet_is_the_film_itself() {
    let copy = Process::default().compile_with(&films(renamed("kodak-5207", "my-5207", unchanged))).unwrap();
    assert!(same(&copy, &film("kodak-5207")));
    assert_eq!(copy.name(), "my-5207_kodak-2383");
    let print =
        Films { camera: stock("kodak-5207").unwrap(), print: Some(renamed("kodak-2383", "my-print", unchanged)) };
    let copy = Process::default().compile_with(&print).unwrap();
    assert!(same(&copy, &film("kodak-5207")));
    assert_eq!(copy.name(), "kodak-5207_my-print");
}

#[test]
fn a_changed_sheet_reaches_stages_forms_and_certificate() {
    let films = films(renamed("kodak-5213", "my-5213", pushed));
    let usual = film("kodak-5213");
    let mine = Process::for_camera("kodak-5213").unwrap().look_with(&films).unwrap();
    let own = mine.film().unwrap();
    let (a, b) = (usual.stages([0.18; 3]), own.stages([0.18; 3]));
    assert!(b.amounts.green.0 - a.amounts.green.0 > 0.01 && !same(&usual, own), "{:?} {:?}", a.amounts, b.amounts);
    // Grey is grey on it too: it was calibrated with its own curves.
    assert!(b.linear.iter().all(|v| (v - 10f64.powf(-0.7)).abs() < 1e-6), "{:?}", b.linear);
    let law = SamplingLaw { count: 1 << 10, ..SamplingLaw::default() };
    for (form, size, limit) in
        [(baked::Form::Plain, 33, 40.0), (baked::Form::Structured, 12, 1.0), (baked::Form::Direct, 0, 0.1)]
    {
        let recipe = baked::Recipe { size, ..baked::Recipe::of(form) };
        let made = mine.baked(&recipe).unwrap();
        let settings = CertifySettings { law: law.clone(), search: Search::SamplesOnly };
        let found = mine.certify(&made, &settings).unwrap();
        assert!(found.srgb.max_found < limit, "{form:?}: {found}");
        assert_eq!(made.name(), "my-5213_kodak-2383");
    }
    // Measured against the film that it is, not the one it was made from.
    let usual = Process::for_camera("kodak-5213").unwrap().look().unwrap();
    let certifier = Certifier::new(&mine).unwrap();
    let samples = certifier.samples(&law, onelight::WorkingSpace::Srgb).unwrap();
    let other = |rgb: [f32; 3]| usual.develop(rgb.map(f64::from)).map(|v| v as f32);
    assert!(certifier.certify(&samples, other, Search::SamplesOnly).unwrap().max_found > 2.0);
}

#[test]
fn films_that_do_not_fit_are_refused() {
    let message = |process: &Process, films: &Films| process.look_with(films).unwrap_err().to_string();
    let negative = || renamed("kodak-5207", "my-5207", unchanged);
    let (usual, alone) = (Process::default(), Films { camera: negative(), print: None });
    assert!(message(&usual, &alone).starts_with("my-5207 is a negative, expected a print film"));
    let print = Films { camera: renamed("kodak-2383", "my-print", unchanged), print: None };
    assert!(message(&usual, &print).starts_with("my-print is a print film"));
    let reversal = Films { camera: stock("fuji-velvia-50").unwrap(), print: None };
    assert!(message(&usual, &reversal).contains("expected its print to be None"));
    let unprinted = Process::from(FilmProcess { print: None, ..Default::default() });
    assert!(message(&unprinted, &films(negative())).contains("expected its print to be set"));
    assert!(unprinted.look_with(&reversal).is_ok());
    assert!(message(&ToneProcess::default().into(), &reversal).contains("knows no film"));
    assert!(message(&FirstProcess::default().into(), &reversal).contains("expected its print to be None"));
    assert!(Process::from(FirstProcess::default()).look_with(&films(negative())).is_ok());
}

#[test]
fn a_description_holds_where_the_sheet_is_and_what_it_was() {
    let digest = "0123456789abcdef".repeat(4);
    let own = |id: &str| {
        StockRef::Own(onelight::OwnSheet { id: id.to_owned(), path: format!("../{id}"), sha256: digest.clone() })
    };
    let print = Printing { film: own("my-print"), ..Default::default() };
    let process = Process::from(FilmProcess { camera: own("my-film"), print: Some(print), ..Default::default() });
    assert_eq!(process.name(), "my-film_my-print");
    let error = process.compile().unwrap_err();
    assert!(
        error.is_contradiction() && error.to_string().contains("my-film is a data sheet of one's own (../my-film)")
    );
    let text = process.to_toml();
    assert!(text.contains(&format!("camera_sheet = \"../my-film\"\ncamera_sha256 = \"{digest}\"\n")), "{text}");
    let keys = ProcessKeys::from_toml("look.toml", &text).unwrap();
    assert_eq!(keys.camera_sheet().map(|sheet| sheet.path), Some("../my-film"));
    assert_eq!(keys.print_sheet().map(|sheet| sheet.sha256), Some(digest.as_str()));
    let films = Films {
        camera: renamed("kodak-5207", "my-film", unchanged),
        print: Some(renamed("kodak-2383", "my-print", unchanged)),
    };
    assert_eq!(keys.process_with(&films).unwrap(), process);
    assert!(keys.process().unwrap_err().to_string().contains("expected its stock beside the process"));
    let message = |text: &str| {
        let keys = ProcessKeys::from_toml("look.toml", &format!("version = 1\n{text}"));
        keys.and_then(|keys| keys.process()).unwrap_err().to_string()
    };
    assert!(message("print = \"none\"\ncamera_sheet = \"a\"\n").contains("expected camera_sha256 beside it"));
    assert!(message("camera_sha256 = \"00\"\n").contains("expected camera_sheet beside it"));
    assert!(message("print = \"none\"\nprint_sheet = \"a\"\n").contains("print is none"));
    assert!(message("camera_sheet = \"a\"\ncamera_sha256 = \"00\"\n").contains("no print beside camera_sheet"));
    assert!(message("camera_shet = \"a\"\n").contains("did you mean \"camera_sheet\""));
}
