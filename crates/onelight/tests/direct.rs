//! The direct form against the film.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails loudly")]

use onelight::lut::{DirectForm, SceneSampler, deviation};
use onelight::{DirectSettings, Nodes, Process, Reference};

/// Mean and largest difference on colours of all exposures.
fn measured(film: &Reference, direct: &DirectForm) -> (f64, f64) {
    let colours: Vec<[f64; 3]> = SceneSampler::with_seed(-10.0..=10.0, 31).unwrap().take(4000).collect();
    let difference = film.difference().unwrap();
    let fast = |rgb: [f64; 3]| direct.apply(rgb.map(|v| v as f32)).map(|v| film.coding().decode(f64::from(v)));
    let found = deviation(&colours, |rgb| film.develop_linear(rgb), fast, |a, b| difference.between(*a, *b)).unwrap();
    (found.mean, found.max)
}

fn grid(step_nm: usize) -> DirectSettings {
    DirectSettings { nodes: Nodes::Grid { step_nm } }
}

#[test]
fn grids_near_the_film_as_they_get_finer() {
    for camera in ["kodak-5207", "fuji-velvia-50"] {
        let film = Process::for_camera(camera).unwrap().compile().unwrap();
        // At 1 nm only curve tables and float32 are left.
        for (step_nm, limit) in [(1, 0.005), (5, 0.02), (10, 0.3), (20, 2.0)] {
            let direct = film.direct(&grid(step_nm)).unwrap();
            assert_eq!(direct.parts().projection.terms().len(), 400 / step_nm + 1);
            let (mean, max) = measured(&film, &direct);
            assert!(mean < 0.3 * limit && max < limit, "{camera} by {step_nm} nm: {mean} {max}");
        }
    }
}

#[test]
fn steps_that_do_not_fit_are_refused() {
    let film = Process::default().compile().unwrap();
    for step in [0, 3, 7, 401, usize::MAX] {
        let error = film.direct(&grid(step)).unwrap_err().to_string();
        assert!(error.contains(&format!("found {}", step as f64)) && error.contains("such as 1, 2, 5, 10"), "{error}");
    }
}
