//! Prints of scanned negatives: Cineon codes behind a print film.

use onelight::baked::{Recipe, ShaperChoice};
use onelight::certify::{CertifySettings, in_words};
use onelight::film::{DyeAmount, PerLayer};
use onelight::lut::{SamplingLaw, Search};
use onelight::printing::{POINT_LOG_EXPOSURE, print_mid_grey};
use onelight::spectra::SpectralShape;
use onelight::{Aim, FilmProcess, Look, PrintAlone, Printing, Process, stock};

use crate::chart;

fn printed(process: PrintAlone) -> onelight::PrintedScan {
    match Process::from(process).look().unwrap() {
        Look::Print(print) => print,
        other => panic!("{}", other.name()),
    }
}

fn codes(code: f64) -> [f64; 3] {
    [code / 1023.0; 3]
}

/// The digital LAD is printed at the aim of the sheet, read on the print by the densities that its own curves give.
#[test]
fn the_lad_is_printed_at_either_aim() {
    for id in ["kodak-2383", "kodak-2393", "fuji-3513di", "kodak-endura-premier"] {
        let neutral = printed(PrintAlone::on(id)).develop_codes(codes(445.0));
        assert!(neutral.iter().all(|v| (v - 10f64.powf(-0.7)).abs() < 1e-6), "{id}: {neutral:?}");
    }
    // Sheet aim is darker; brightening the light by the distance of both aims makes it the same picture as neutral aim, one layer each.
    let sheet = printed(PrintAlone { aim: Aim::Sheet, ..PrintAlone::default() });
    let dark = sheet.develop_codes(codes(445.0));
    assert!(dark[1] < 0.12, "{dark:?}");
    assert!(print_mid_grey(&stock("kodak-2383").unwrap()).is_ok());
}

/// 0.002 a code and 0.025 a point: 12.5 codes less are one printer point more, in each layer by itself.
#[test]
fn codes_are_printing_densities() {
    let usual = printed(PrintAlone::default());
    for layer in 0..3 {
        let mut points = [0.0; 3];
        points[layer] = 4.0;
        let lit = printed(PrintAlone { points, ..PrintAlone::default() });
        for code in [150.0, 300.0, 445.0, 600.0, 685.0] {
            let mut thinner = codes(code);
            thinner[layer] -= 4.0 * POINT_LOG_EXPOSURE / 0.002 / 1023.0;
            let (by_light, by_density) = (lit.develop_codes(codes(code)), usual.develop_codes(thinner));
            for c in 0..3 {
                assert!((by_light[c] - by_density[c]).abs() < 1e-12, "{layer} {code}: {by_light:?} {by_density:?}");
            }
        }
    }
}

#[test]
fn prints_get_brighter_with_density_and_take_any_number() {
    let print = printed(PrintAlone::default());
    let luminance = |code: f64| print.develop_codes(codes(code))[1];
    for code in 0..1023 {
        assert!(luminance(f64::from(code + 1)) >= luminance(f64::from(code)) - 1e-12, "{code}");
    }
    assert_eq!(print.develop_codes([f64::NAN, -5.0, f64::NEG_INFINITY]), print.develop_codes([0.0; 3]));
    assert_eq!(print.develop_codes([2.0, 1e30, f64::INFINITY]), print.develop_codes([1.0; 3]));
    // Clear film is what the viewer is adapted to.
    assert!(print.develop_codes([1.0; 3]).iter().all(|v| *v > 0.9));
}

#[test]
fn a_cube_over_codes_is_certified() {
    let look = Process::from(PrintAlone::default()).look().unwrap();
    let baked = look.baked(&Recipe { size: 33, ..Recipe::taking(ShaperChoice::Cineon) }).unwrap();
    let law = SamplingLaw { count: 1 << 10, ..SamplingLaw::default() };
    let found = look.certify(&baked, &CertifySettings { law, search: Search::SamplesOnly }).unwrap();
    assert!(found.srgb.overall.mean < 0.1 && found.srgb.max_found < 1.5, "{}", in_words(&found.srgb, ""));
    assert!(baked.describe().contains("Cineon codes 0 to 1023"));
    let text = Process::from(PrintAlone::on("kodak-2393")).to_toml();
    assert_eq!(Process::from_toml("look.toml", &text).unwrap(), PrintAlone::on("kodak-2393").into());
}

/// Academy Printing Density, from the table of its responsivities: density by each channel of a negative that holds amounts of dye.
fn academy_density(negative: &str) -> Option<impl Fn(PerLayer<DyeAmount>) -> [f64; 3]> {
    let path = format!("{}/../../fixtures/reference/academy_printing_density.csv", env!("CARGO_MANIFEST_DIR"));
    let Ok(text) = std::fs::read_to_string(&path) else {
        println!("skipped: {path} is not here");
        return None;
    };
    let numbers = |line: &str| line.split(',').map(|v| v.parse().unwrap()).collect::<Vec<f64>>();
    let rows: Vec<Vec<f64>> = text.lines().filter(|line| line.starts_with(char::is_numeric)).map(numbers).collect();
    let [first, .., last] = &rows[..] else { panic!("no table") };
    let dyes =
        stock(negative).unwrap().dyes_on(SpectralShape::new(first[0] as u16, last[0] as u16, 2).unwrap()).unwrap();
    Some(move |amounts| {
        let film = dyes.density(amounts).transmittance();
        std::array::from_fn(|channel| {
            let through: f64 = rows.iter().zip(film.values()).map(|(row, t)| row[channel + 1] * t).sum();
            -(through / rows.iter().map(|row| row[channel + 1]).sum::<f64>()).log10()
        })
    })
}

/// Codes of the densities that the print itself sees make the picture of the two films; what codes of the standardised densities make
/// instead is stated in docs/talk.md.
#[test]
fn academy_printing_densities_are_near_those_of_the_prints() {
    let colours = chart(-2..=2);
    for (print, mean, most) in
        [("kodak-2383", [0.6, 0.9], 1.6), ("kodak-2393", [0.7, 1.1], 2.0), ("fuji-3513di", [0.5, 0.8], 3.6)]
    {
        let alone = printed(PrintAlone::on(print));
        for negative in ["kodak-5207", "kodak-5248", "fuji-eterna-500"] {
            let Some(academy) = academy_density(negative) else { return };
            let process =
                FilmProcess { camera: negative.into(), print: Some(Printing::on(print)), ..FilmProcess::default() };
            let film = process.compile().unwrap();
            let difference = film.difference().unwrap();
            let grey = film.stages([0.18; 3]);
            let own = |amounts| film.print_exposure(amounts).unwrap().map(|h| -h.0).to_array();
            let (own_grey, academy_grey) = (own(grey.amounts), academy(grey.amounts));
            let above_grey = |density: [f64; 3], of_grey: [f64; 3]| -> [f64; 3] {
                std::array::from_fn(|c| (445.0 + (density[c] - of_grey[c]) / 0.002) / 1023.0)
            };
            let mut differences = Vec::new();
            for rgb in &colours {
                let stages = film.stages(*rgb);
                let exact = alone.develop_codes(above_grey(own(stages.amounts), own_grey));
                assert!(difference.between(exact, stages.linear) < 1e-3, "{negative} on {print}: {rgb:?}");
                let scanned = alone.develop_codes(above_grey(academy(stages.amounts), academy_grey));
                differences.push(difference.between(exact, scanned));
            }
            let found = differences.iter().sum::<f64>() / differences.len() as f64;
            let largest = differences.iter().copied().fold(0.0, f64::max);
            assert!((mean[0]..mean[1]).contains(&found) && largest < most, "{negative} on {print}: {found} {largest}");
        }
    }
}
