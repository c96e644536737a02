//! Stage values against an independent computation of the model in float64 at 1 nm (fixtures/reference/stages.json).

use onelight::{Aim, DyeModel, FilmProcess};
use serde_json::Value;

use crate::{compiled, process};

/// Largest difference of display colours, CIEDE2000.
const DISPLAY_TOLERANCE: f64 = 0.05;
/// Largest difference of log exposures and dye amounts.
const STAGE_TOLERANCE: f64 = 1e-3;

fn rows(value: &Value) -> Vec<[f64; 3]> {
    serde_json::from_value(value.clone()).unwrap()
}

fn close(what: &str, ours: [f64; 3], theirs: [f64; 3], tolerance: f64) {
    for i in 0..3 {
        assert!((ours[i] - theirs[i]).abs() <= tolerance, "{what}[{i}]: {ours:?} against {theirs:?}");
    }
}

fn compare(name: &str, process: &FilmProcess, expected: &Value, inputs: &[[f64; 3]]) {
    let film = compiled(process);
    for (i, row) in rows(&expected["exposure_matrix_K"]).into_iter().enumerate() {
        let ours: Vec<f64> = film.exposure_matrix().matrix().row(i).iter().copied().collect();
        for k in 0..3 {
            assert!((ours[k] / row[k] - 1.0).abs() < 2e-4, "{name}: K[{i}][{k}] = {} against {}", ours[k], row[k]);
        }
    }
    let difference = film.difference().unwrap();
    let mut largest = 0f64;
    for (i, &rgb) in inputs.iter().enumerate() {
        let stages = film.stages(rgb);
        let check = |key: &str, ours: [f64; 3]| {
            close(&format!("{name}: {key} of {rgb:?}"), ours, rows(&expected[key])[i], STAGE_TOLERANCE);
        };
        check("camera_log10_exposure", stages.exposure.map(|h| h.0).to_array());
        check("camera_dye_amounts", stages.amounts.map(|a| a.0).to_array());
        if let Some(print) = stages.print {
            check("print_log10_exposure", print.exposure.map(|h| h.0).to_array());
            check("print_dye_amounts", print.amounts.map(|a| a.0).to_array());
        }
        let theirs = rows(&expected["rgb_linear"])[i];
        let miss = difference.between(stages.linear, theirs);
        assert!(miss <= DISPLAY_TOLERANCE, "{name}: {rgb:?} gives {:?} against {theirs:?}: dE {miss}", stages.linear);
        largest = largest.max(miss);
    }
    println!("{name}: largest dE {largest:.2e}");
}

#[test]
fn four_processes_agree_stage_by_stage() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/reference/stages.json");
    let Ok(text) = std::fs::read_to_string(path) else {
        // The file stays in the repository; a packaged crate is tested without it.
        println!("skipped: {path} is not here");
        return;
    };
    let all: Value = serde_json::from_str(&text).unwrap();
    let inputs = rows(&all["input_rgb"]);
    let negative = FilmProcess::default();
    let velvia = process("fuji-velvia-50");
    compare("K-negative", &negative, &all["K-negative/wedge/neutral"], &inputs);
    compare("F-reversal", &velvia, &all["F-reversal/wedge/neutral"], &inputs);
    let sheet = FilmProcess { aim: Aim::Sheet, ..negative.clone() };
    compare("K-negative, sheet", &sheet, &all["K-negative/wedge/sheet"], &inputs);
    let literal = FilmProcess { dyes: DyeModel::Literal, ..negative };
    compare("K-negative, literal", &literal, &all["K-negative/literal/neutral"], &inputs);
}
