//! The inter-image effect: its laws on random exposures, and an independent computation (fixtures/reference).

use onelight_film::{InterImage, InterImageEffect, LogExposure, PerLayer, SheetText, Stock};
use proptest::prelude::*;
use serde_json::Value;

use crate::cases;

fn stock(id: &str) -> Stock {
    let files = onelight_stocks::find(id).unwrap();
    Stock::parse(&SheetText {
        id: files.id,
        stock_toml: files.stock_toml,
        sensitivity_csv: files.sensitivity_csv,
        characteristic_csv: files.characteristic_csv,
        dye_density_csv: files.dye_density_csv,
    })
    .unwrap()
}

fn layers(h: [f64; 3]) -> PerLayer<LogExposure> {
    PerLayer::from(h).map(LogExposure)
}

fn numbers(h: PerLayer<LogExposure>) -> [f64; 3] {
    h.map(|h| h.0).to_array()
}

/// Every camera film that is built in.
fn camera_films() -> Vec<Stock> {
    let all: Vec<Stock> = onelight_stocks::ALL.iter().map(|files| stock(files.id)).collect();
    all.into_iter().filter(|stock| stock.kind().is_camera_film()).collect()
}

fn effect(film: &Stock, strength: InterImage) -> InterImageEffect {
    InterImageEffect::new(film, strength, PerLayer::all(film.mid_grey().unwrap()))
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn the_laws_hold_for_every_film_and_strength(
        near in 0.0..=InterImage::MAX,
        far in 0.0..=InterImage::MAX,
        offsets in prop::array::uniform3(-6.0..6.0),
        layer in 0..3_usize,
        step in 1e-4..1.0,
    ) {
        let strength = InterImage::new(near, far).unwrap();
        for film in camera_films() {
            let effect = effect(&film, strength);
            let grey = numbers(effect.grey());
            let at = |offsets: [f64; 3]| numbers(effect.effective(layers(std::array::from_fn(|i| grey[i] + offsets[i]))));
            let before = at(offsets);
            // The shift is bounded, and the three shifts take from each other what they give.
            let matrix = strength.matrix();
            for i in 0..3 {
                let bound = effect.most_developed() * matrix[i][i];
                prop_assert!((before[i] - grey[i] - offsets[i]).abs() <= bound + 1e-12, "{}", film.id());
            }
            let sum: f64 = (0..3).map(|i| before[i] - grey[i] - offsets[i]).sum();
            prop_assert!(sum.abs() < 1e-12);
            // A layer gains at least what its own exposure gains, and loses by its neighbours'.
            let mut moved = offsets;
            moved[layer] += step;
            let after = at(moved);
            for i in 0..3 {
                let gained = after[i] - before[i];
                if i == layer {
                    prop_assert!(gained >= step - 1e-12, "{}: {gained} for {step}", film.id());
                } else {
                    prop_assert!(gained <= 1e-12, "{}: {gained}", film.id());
                }
            }
            // Greys stay, to the last bit.
            let wedge = layers(std::array::from_fn(|i| grey[i] + offsets[0]));
            let stays = numbers(effect.effective(wedge));
            for (a, b) in stays.into_iter().zip(numbers(wedge)) {
                prop_assert!((a - b).abs() <= 4e-15 * (1.0 + b.abs()), "{}: {a} for {b}", film.id());
            }
        }
    }
}

#[test]
fn the_map_has_no_folds() {
    let film = stock("kodak-5207");
    let effect = effect(&film, InterImage::NEGATIVE);
    let step = 1e-5;
    let places: Vec<f64> = (-12..=12).map(|i| 0.25 * f64::from(i)).collect();
    let mut least = f64::INFINITY;
    for &r in &places {
        for &g in &places {
            for &b in &places {
                let at = |h: [f64; 3]| numbers(effect.effective(layers(h)));
                let column = |k: usize| {
                    let [mut up, mut down] = [[r, g, b]; 2];
                    (up[k], down[k]) = (up[k] + step, down[k] - step);
                    let (up, down) = (at(up), at(down));
                    [0, 1, 2].map(|i| (up[i] - down[i]) / (2.0 * step))
                };
                let [x, y, z] = [column(0), column(1), column(2)];
                let cross = [y[1] * z[2] - y[2] * z[1], y[2] * z[0] - y[0] * z[2], y[0] * z[1] - y[1] * z[0]];
                least = least.min(x[0] * cross[0] + x[1] * cross[1] + x[2] * cross[2]);
            }
        }
    }
    assert!(least > 1.0 - 1e-6, "smallest determinant {least}");
}

#[test]
fn hard_exposures_have_finite_results() {
    for film in camera_films() {
        let effect = effect(&film, InterImage::new(InterImage::MAX, InterImage::MAX).unwrap());
        for hard in [-12.0, 40.0, f64::MIN_POSITIVE, 1e300, -1e300] {
            let shifted = numbers(effect.effective(layers([hard, 0.0, -1.0])));
            assert!(shifted.iter().all(|h| h.is_finite()), "{}: {shifted:?}", film.id());
        }
        assert_eq!(effect.developed(f64::NAN), 0.0);
    }
}

#[test]
fn strengths_are_checked_and_named() {
    for word in ["none", "negative", "reversal", "0.5,0.1"] {
        assert_eq!(InterImage::parse(word).unwrap().to_string(), word);
    }
    for (word, expected) in [
        ("much", "found \"much\", expected none, negative, reversal, or two numbers such as 0.6,0.06"),
        ("1,2,3", "expected none, negative"),
        ("-1,0", "inter-image effect, near: found -1, expected 0 to 3"),
        ("0,NaN", "far: found NaN"),
    ] {
        let found = InterImage::parse(word).unwrap_err().to_string();
        assert!(found.contains(expected), "{found}");
    }
}

fn rows(value: &Value) -> Vec<[f64; 3]> {
    serde_json::from_value(value.clone()).unwrap()
}

#[test]
fn an_independent_computation_agrees() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/reference/interimage_stages.json");
    let Ok(text) = std::fs::read_to_string(path) else {
        // The file stays in the repository; a packaged crate is tested without it.
        println!("skipped: {path} is not here");
        return;
    };
    let all: Value = serde_json::from_str(&text).unwrap();
    let number = |value: &Value| value.as_f64().unwrap();
    let strength = InterImage::new(number(&all["near"]), number(&all["far"])).unwrap();
    for (key, id) in [("5207-2383", "kodak-5207"), ("portra400-2383", "kodak-portra-400")] {
        let (film, expected) = (stock(id), &all[key]);
        let effect = effect(&film, strength);
        let reference: [f64; 3] = serde_json::from_value(expected["reference_log10_exposure"].clone()).unwrap();
        for (ours, theirs) in numbers(effect.grey()).into_iter().zip(reference) {
            assert!((ours - theirs).abs() < 1e-12, "{id}: grey at {ours} against {theirs}");
        }
        assert!((effect.most_developed() - number(&expected["q_max"])).abs() < 1e-6, "{id}");
        let offsets: Vec<f64> = serde_json::from_value(expected["q_t"].clone()).unwrap();
        let developed: Vec<f64> = serde_json::from_value(expected["q"].clone()).unwrap();
        for (t, q) in offsets.into_iter().zip(developed) {
            assert!((effect.developed(t) - q).abs() < 1e-6, "{id}: q({t}) is {} against {q}", effect.developed(t));
        }
        let (exposures, effective) = (rows(&expected["log10_exposure"]), rows(&expected["effective_log10_exposure"]));
        for (h, theirs) in exposures.into_iter().zip(effective) {
            let ours = numbers(effect.effective(layers(h)));
            for (a, b) in ours.into_iter().zip(theirs) {
                assert!((a - b).abs() < 1e-6, "{id}: {h:?} becomes {ours:?} against {theirs:?}");
            }
        }
    }
}
