//! The direct form against the film.

use onelight::lut::{DirectForm, SceneSampler, Shaper, bake, deviation};
use onelight::spectra::nalgebra::Vector3;
use onelight::{Aim, DirectSettings, FilmProcess, Nodes, Printing, Reference, WorkingSpace};

use crate::{compiled, film, films, films_once, process};

/// Mean and largest difference on colours of all exposures.
fn measured(film: &Reference, direct: &DirectForm) -> (f64, f64) {
    let colours: Vec<[f64; 3]> = SceneSampler::with_seed(-10.0..=10.0, 31).unwrap().take(4000).collect();
    let difference = film.difference().unwrap();
    let fast = |rgb: [f64; 3]| film.coding().decode_rgb(direct.apply(rgb.map(|v| v as f32)).map(f64::from));
    let found = deviation(&colours, |rgb| film.develop_linear(rgb), fast, |a, b| difference.between(*a, *b)).unwrap();
    (found.mean, found.max)
}

fn settings(nodes: Nodes) -> DirectSettings {
    DirectSettings { nodes }
}

fn grid(step_nm: usize) -> DirectSettings {
    settings(Nodes::Grid { step_nm })
}

#[test]
fn grids_near_the_film_as_they_get_finer() {
    for camera in ["kodak-5207", "fuji-velvia-50"] {
        let film = film(camera);
        // At 1 nm only curve tables and float32 are left.
        for (step_nm, limit) in [(1, 0.005), (5, 0.02), (10, 0.3), (20, 2.0)] {
            let direct = film.direct(&grid(step_nm)).unwrap();
            assert!(direct.parts().projection.terms().len() <= 400 / step_nm + 1);
            let (mean, max) = measured(&film, &direct);
            assert!(mean < 0.3 * limit && max < limit, "{camera} by {step_nm} nm: {mean} {max}");
        }
    }
}

#[test]
fn steps_that_do_not_fit_are_refused() {
    let film = film("kodak-5207");
    for step in [0, 3, 7, 401, usize::MAX] {
        let error = film.direct(&grid(step)).unwrap_err().to_string();
        assert!(error.contains(&format!("found {}", step as f64)) && error.contains("such as 1, 2, 5, 10"), "{error}");
    }
}

#[test]
fn a_few_exponentials_are_the_film() {
    for camera in ["kodak-5207", "kodak-ektachrome-100", "kodak-kodachrome-64", "fuji-velvia-50", "fuji-provia-100f"] {
        for aim in [Aim::Neutral, Aim::Sheet] {
            let process = FilmProcess { aim, ..process(camera) };
            let (mean, max) = measured(&compiled(&process), &films::direct(&process));
            assert!(mean < 0.02 && max < 0.1, "{camera} {aim:?}: {mean} {max}");
        }
    }
}

#[test]
fn more_exponentials_come_nearer() {
    let film = film("kodak-5207");
    let max = |projection, duplication| {
        let direct = film.direct(&settings(Nodes::Counts { projection, duplication })).unwrap();
        let print = direct.parts().print.as_ref().unwrap();
        assert_eq!((direct.parts().projection.terms().len(), print.exposure.terms().len()), (projection, duplication));
        measured(&film, &direct).1
    };
    assert!(max(5, 3) < 1.0 && max(8, 4) < 0.5 * max(5, 3) && max(12, 6) < 0.5 * max(8, 4));
}

#[test]
fn greys_get_no_darker_with_more_light_on_any_film() {
    for (camera, print) in films_once() {
        let print = print.map(Printing::on);
        let film = compiled(&FilmProcess { camera: camera.into(), print, ..Default::default() });
        // Dyes of reversal film are steeper in the printer's light than those of a negative.
        let duplication = if film.name().contains("radiance") || film.name().contains("ilfochrome") { 8 } else { 5 };
        let direct = film.direct(&settings(Nodes::Counts { projection: 10, duplication })).unwrap();
        let to_y = WorkingSpace::Srgb.space().to_xyz().unwrap().row(1).into_owned();
        let luminance = |i: i32| {
            let coded = direct.apply([0.18 * 2f32.powf(i as f32 / 10.0); 3]);
            (to_y * Vector3::from(*film.coding().decode_rgb(coded.map(f64::from)))).x
        };
        let wedge: Vec<f64> = (-150..=150).map(luminance).collect();
        // Some roundings of float32, as in a certificate.
        let falls = wedge.windows(2).position(|pair| pair[1] < pair[0] - 1e-5);
        assert_eq!(falls, None, "{camera}");
        assert!(measured(&film, &direct).1 < 0.4, "{camera}: {:?}", measured(&film, &direct));
    }
}

#[test]
fn a_limit_is_kept_with_few_exponentials() {
    for (camera, terms) in [("kodak-5207", 10), ("fuji-velvia-50", 7)] {
        let film = film(camera);
        let direct = film.direct(&settings(Nodes::UnderMaxDe(0.5))).unwrap();
        let found = direct.parts().projection.terms().len()
            + direct.parts().print.as_ref().map_or(0, |print| print.exposure.terms().len());
        assert!(found <= terms, "{camera}: {found}");
        assert!(measured(&film, &direct).1 <= 0.5, "{camera}");
    }
}

#[test]
fn tables_are_baked_near_the_film() {
    for camera in ["kodak-5207", "kodak-5203", "fuji-velvia-50"] {
        let film = film(camera);
        let shaper = Shaper::log2(0.01, 184.0).unwrap();
        let at = |t: [f64; 3]| t.map(|t| shaper.decode(t));
        let (fast, exact) = (film.bake(9, at).unwrap(), bake(9, &shaper, |rgb| film.develop(rgb), |_| {}).unwrap());
        let difference = film.difference().unwrap();
        let linear = |entry: [f32; 3]| film.coding().decode_rgb(entry.map(f64::from));
        for (fast, exact) in fast.entries().zip(exact.entries()) {
            let miss = difference.between(linear(exact), linear(fast));
            // The probes that choose the grid are not all colours.
            assert!(miss < 0.06, "{camera}: {exact:?} {fast:?} {miss}");
        }
    }
    let film = film("kodak-5207");
    assert!(film.bake(1, |t| t).is_err());
    // Light that no shaper yields has a result too.
    let hard = film.bake(2, |t| t.map(|t| if t == 0.0 { f64::NAN } else { f64::INFINITY })).unwrap();
    let exact = film.develop([f64::INFINITY; 3]);
    assert!(hard.entry([1; 3]).unwrap().into_iter().zip(exact).all(|(a, b)| (f64::from(a) - b).abs() < 1e-3));
}

#[test]
fn threads_do_not_matter() {
    let film = film("kodak-5207");
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| film.direct(&settings(Nodes::Counts { projection: 6, duplication: 3 })).unwrap())
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn settings_are_checked() {
    let film = film("kodak-5207");
    let message = |nodes| film.direct(&settings(nodes)).unwrap_err().to_string();
    for found in [0, 1, 17, usize::MAX] {
        let projection = message(Nodes::Counts { projection: found, duplication: 4 });
        assert!(projection.contains("projection: found") && projection.contains("from 2 to 16"), "{projection}");
        assert!(message(Nodes::Counts { projection: 4, duplication: found }).contains("duplication: found"));
    }
    for found in [0.0, -1.0, f64::NAN] {
        assert!(message(Nodes::UnderMaxDe(found)).contains("above 0"), "{found}");
    }
    // A reversal film has no duplication to fit.
    let velvia = crate::film("fuji-velvia-50");
    assert!(velvia.direct(&settings(Nodes::Counts { projection: 4, duplication: 0 })).is_ok());
}

#[test]
fn any_light_has_a_finite_result() {
    let hard = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1.0, -0.0, 0.0, 1e-40, 1e-12, 0.18, 1e30, f32::MAX];
    for camera in ["kodak-5207", "fuji-velvia-50"] {
        let (film, direct) = (film(camera), films::direct(&process(camera)));
        let difference = film.difference().unwrap();
        for r in hard {
            for g in hard {
                for b in hard {
                    let fast = direct.apply([r, g, b]);
                    assert!(fast.iter().all(|v| v.is_finite()), "{r} {g} {b}: {fast:?}");
                    let exact = film.develop_linear([r, g, b].map(f64::from));
                    let miss = difference.between(exact, film.coding().decode_rgb(fast.map(f64::from)));
                    assert!(miss < 0.2, "{camera} {r} {g} {b}: dE {miss}");
                }
            }
        }
    }
}
