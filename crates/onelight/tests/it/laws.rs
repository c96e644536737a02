//! Laws that hold for every process.

use onelight::film::{AmountCurve, DyeAmount, LogExposure, PerLayer};
use onelight::printing::{
    Duplication, EquivalentNeutralDensity, NEUTRAL_DENSITY, Printer, Projection, print_mid_grey, print_target,
};
use onelight::spectra::{RgbSpace, SpectralShape};
use onelight::{
    Aim, ColourSpaces, DyeModel, FilmProcess, HeatGlass, Infrared, Matching, Printing, Process, Projector, Reference,
    Tail, White, WideGamut, WorkingSpace, stock,
};

use crate::{compiled, film, films_once, process};

/// Every camera film and every print film at least once: `cargo xtask stocks --check` compiles all pairs.
fn sensible() -> Vec<FilmProcess> {
    films_once()
        .into_iter()
        .map(|(camera, print)| FilmProcess {
            camera: camera.into(),
            print: print.map(Printing::on),
            ..Default::default()
        })
        .collect()
}

#[test]
fn grey_is_grey_in_neutral_aim() {
    for process in sensible() {
        for dyes in [DyeModel::Wedge, DyeModel::Literal] {
            // Every pair can be calibrated, in the talk's literal reading too.
            let film = compiled(&FilmProcess { dyes, ..process.clone() });
            for v in *film.develop_linear([0.18; 3]) {
                assert!((v - 10f64.powf(-NEUTRAL_DENSITY)).abs() < 1e-6, "{} {dyes:?}: {v}", film.name());
            }
        }
    }
}

#[test]
fn grey_has_the_published_densities_in_sheet_aim() {
    for process in sensible().into_iter().filter(|p| p.print.is_some()) {
        let film = compiled(&FilmProcess { aim: Aim::Sheet, ..process.clone() });
        let print = stock(process.print.unwrap().film.id()).unwrap();
        let amounts = film.stages([0.18; 3]).print.unwrap().amounts;
        let grey = print.dyes_on(SpectralShape::VISIBLE).unwrap().density(amounts).transmittance();
        let aim = print.aim().unwrap().status_a;
        for (read, aim) in print.densitometry().density(&grey).to_array().into_iter().zip(aim.to_array()) {
            assert!((read.0 - aim.0).abs() < 2e-3, "{}: {read:?} for {aim:?}", film.name());
        }
    }
}

#[test]
fn layers_that_inhibit_each_other_leave_greys_where_they_are() {
    for process in sensible() {
        let lamp = compiled(&FilmProcess { white: White::Lamp, gamut: WideGamut::Clip, ..process.clone() });
        let alone = compiled(&process.clone().as_in_the_talk());
        for i in -100..=100 {
            let grey = [0.18 * 2f64.powf(f64::from(i) / 10.0); 3];
            let pair = lamp.develop_linear(grey).into_iter().zip(*alone.develop_linear(grey));
            pair.for_each(|(a, b)| assert!((a - b).abs() < 1e-12, "{} {grey:?}: {a} and {b}", lamp.name()));
        }
    }
}

#[test]
fn clear_film_is_white() {
    for process in sensible() {
        let film = compiled(&process);
        let brightest = film.develop_linear([1e30; 3]);
        // A negative's densest white lets a little light through to the print: 0.013 of white on 2383, most on papers.
        let near = match &process.print {
            None => 1e-12,
            Some(_) if process == FilmProcess::default() => 0.013,
            Some(_) => 0.5,
        };
        let most = brightest.iter().fold(0.0, |most: f64, v| most.max((v - 1.0).abs()));
        println!("{}: {most:.4}", film.name());
        assert!(most < near, "{}: {brightest:?}", film.name());
    }
}

#[test]
fn luminance_never_falls_with_exposure() {
    let y = RgbSpace::SRGB.to_xyz().unwrap();
    for process in sensible() {
        for aim in [Aim::Neutral, Aim::Sheet] {
            let film = compiled(&FilmProcess { aim, ..process.clone() });
            let wedge = (-150..=150).map(|i| 0.18 * 2f64.powf(f64::from(i) / 10.0));
            let luminance: Vec<f64> = wedge
                .map(|v| (y * onelight::spectra::nalgebra::Vector3::from(*film.develop_linear([v; 3]))).y)
                .collect();
            // A hair of rounding where the curves are flat.
            let falls = luminance.windows(2).position(|p| p[1] < p[0] - 1e-12);
            assert_eq!(falls, None, "{} {aim:?}", film.name());
        }
    }
}

/// Largest step in dE around the hue circle, in half degrees, of saturated colours this many stops over mid grey.
fn largest_hue_step(film: &Reference, stops: i32) -> f64 {
    let difference = film.difference().unwrap();
    let peak = 0.18 * 2f64.powi(stops);
    // HSV of the input space with saturation 1.
    let colour = |half_degrees: i32| {
        [5.0, 3.0, 1.0].map(|offset| {
            let sector = (offset + f64::from(half_degrees) / 120.0) % 6.0;
            peak * (1.0 - sector.min(4.0 - sector).clamp(0.0, 1.0))
        })
    };
    let circle: Vec<_> = (0..=720).map(|i| film.develop_linear(colour(i))).collect();
    circle.windows(2).map(|pair| difference.between(pair[0], pair[1])).fold(0.0, f64::max)
}

#[test]
fn a_wide_gamut_steps_hardly_more_than_srgb_around_the_hue_circle() {
    let spaces = ColourSpaces { input_space: WorkingSpace::Rec2020, ..Default::default() };
    let usual = FilmProcess::default();
    let lamp = FilmProcess { white: White::Lamp, ..usual.clone() };
    // Published with the model for 5207 on 2383, two digits: by its sheet alone, and with the inter-image effect.
    let published = [
        (usual.clone().as_in_the_talk(), Some([0.66, 2.5, 5.8, 10.6])),
        (lamp, Some([1.08, 3.4, 5.3, 8.5])),
        (usual, None),
    ];
    for (process, published) in published {
        let (srgb, wide) = (compiled(&process), compiled(&FilmProcess { spaces, ..process.clone() }));
        for (i, stops) in [0, 2, 4, 6].into_iter().enumerate() {
            let own = largest_hue_step(&srgb, stops);
            if let Some(published) = published {
                assert!((own / published[i] - 1.0).abs() < 0.02, "{stops:+} stops: {own} against {}", published[i]);
            }
            let wide = largest_hue_step(&wide, stops) / own;
            println!(
                "{:?} {:?} {stops:+} stops: {own:.2} in sRGB, {wide:.2} times in Rec.2020",
                process.white, process.gamut
            );
            assert!(wide <= 1.5, "{stops:+} stops: {wide} times in Rec.2020, {own} in sRGB");
        }
    }
}

#[test]
fn any_input_gives_a_finite_result() {
    let hard = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, -0.0, 0.0, 1e-320, 1e-12, 0.18, 1e30, f64::MAX];
    for input_space in [WorkingSpace::Srgb, WorkingSpace::AcesCg] {
        for camera in ["kodak-5207", "fuji-velvia-50"] {
            let spaces = ColourSpaces { input_space, ..Default::default() };
            let film = compiled(&FilmProcess { spaces, ..process(camera) });
            for r in hard {
                for g in hard {
                    for b in hard {
                        let out = film.develop([r, g, b]);
                        assert!(out.iter().all(|v| v.is_finite() && v.abs() < 2.0), "{r} {g} {b}: {out:?}");
                    }
                }
            }
            assert_eq!(film.develop([f64::NAN, -1.0, 0.5]), film.develop([0.0, -1.0, 0.5]));
        }
    }
}

struct Bench {
    duplication: Duplication,
    grey: PerLayer<DyeAmount>,
    target: PerLayer<LogExposure>,
}

/// 5207 on 2383 in neutral aim, in a printer.
fn bench(printer: Printer) -> Bench {
    let (negative, print) = (stock("kodak-5207").unwrap(), stock("kodak-2383").unwrap());
    let mid_grey = PerLayer::all(negative.mid_grey().unwrap());
    let camera = DyeModel::Wedge.amounts(&negative, mid_grey).unwrap();
    let printed = DyeModel::Wedge.amounts(&print, print_mid_grey(&print).unwrap()).unwrap();
    let dyes = print.dyes_on(SpectralShape::VISIBLE).unwrap();
    let projection = Projection::new(dyes, Projector::Display, &RgbSpace::SRGB).unwrap();
    Bench {
        duplication: Duplication::new(&negative, &print, printer).unwrap(),
        grey: camera.as_ref().zip_map(mid_grey, AmountCurve::amount),
        target: print_target(Aim::Neutral, EquivalentNeutralDensity::default(), &print, printed.as_ref(), &projection)
            .unwrap(),
    }
}

#[test]
fn iteration_converges_to_the_solution() {
    let Bench { duplication, grey, target } = bench(Printer::default());
    // Published with the model: largest log10 error of the print exposure after 0, 1, 2, 3 iterations.
    for (iterations, expected) in [0.3, 5e-3, 7e-5, 3e-6].into_iter().enumerate() {
        let lights = duplication.calibrate_by_iteration(grey, target, iterations).unwrap();
        let exposure = duplication.lit(lights).expose(grey).zip_map(target, |a, b| (a.0 - b.0).abs());
        let largest = exposure.to_array().into_iter().fold(0.0, f64::max);
        assert!((0.5..2.0).contains(&(largest / expected)), "{iterations}: {largest} against {expected}");
    }
    let exact = duplication.calibrate(grey, target).unwrap().0.to_array();
    let iterated = duplication.calibrate_by_iteration(grey, target, 30).unwrap().0.to_array();
    for (a, b) in exact.into_iter().zip(iterated) {
        assert!((a / b - 1.0).abs() < 1e-12);
    }
}

#[test]
fn infrared_matters_only_with_a_held_tail() {
    let printer = |infrared, glass, red_tail| Printer { infrared, glass, red_tail, ..Printer::default() };
    let solved = |p: Printer| {
        let Bench { duplication, grey, target } = bench(p);
        duplication.calibrate(grey, target)
    };
    let lights = |p: Printer| solved(p).unwrap().0.to_array();
    let on = lights(printer(Infrared::On, HeatGlass::No2043, Tail::LogLinear));
    let off = lights(printer(Infrared::Off, HeatGlass::No2043, Tail::LogLinear));
    assert!(on.iter().zip(off).all(|(a, b)| (a / b - 1.0).abs() < 1e-6), "{on:?} {off:?}");
    let error = solved(printer(Infrared::On, HeatGlass::None, Tail::Held)).unwrap_err();
    assert!(error.is_unreachable_aim() && error.to_string().contains("-5"), "{error}");
    assert!(solved(printer(Infrared::Off, HeatGlass::None, Tail::Held)).is_ok());
}

#[test]
fn absolute_matching_needs_absolute_figures() {
    let absolute = |camera: &str| FilmProcess { matching: Matching::Absolute, ..process(camera) };
    assert!(absolute("kodak-5207").compile().unwrap_err().to_string().contains("relative"));
    assert!(absolute("kodak-5248").compile().unwrap_err().to_string().contains("criterion"));
    // Sheets agree with themselves to some tenths: near the balanced film, but not on it.
    let (film, balanced) = (compiled(&absolute("kodak-portra-160")), film("kodak-portra-160"));
    let (a, b) = (film.stages([0.18; 3]).exposure, balanced.stages([0.18; 3]).exposure);
    let off = a.zip_map(b, |a, b| a.0 - b.0).to_array();
    assert!(off.iter().all(|d| d.abs() < 0.4) && off.iter().any(|d| d.abs() > 0.01), "{off:?}");
}

#[test]
fn contradictions_are_named() {
    let message = |camera: &str, print: Option<&str>| {
        let process = FilmProcess { camera: camera.into(), print: print.map(Printing::on), ..Default::default() };
        let error = process.compile().unwrap_err();
        assert!(error.is_contradiction() || error.is_unknown_stock());
        error.to_string()
    };
    assert!(message("kodak-2383", None).contains("is a print film"));
    assert!(message("kodak-5207", None).contains("is a negative"));
    assert!(message("fuji-velvia-50", Some("kodak-2383")).contains("no print film"));
    assert!(message("kodak-5207", Some("kodak-5219")).contains("is a camera film"));
    assert!(message("velvia50", None).contains("fuji-velvia-50"));
    // The same words where the print film is left out.
    for error in [
        Process::for_camera("kodak-2383").unwrap_err(),
        Process::from_toml("look.toml", "version = 1\ncamera = \"kodak-2383\"").unwrap_err(),
    ] {
        assert!(error.is_contradiction() && error.to_string() == message("kodak-2383", None), "{error}");
    }
}
