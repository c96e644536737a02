//! What is baked of looks.

use onelight::baked::{Form, Recipe, ShaperChoice, smallest_under};
use onelight::certify::{CertifySettings, to_six_stops};
use onelight::lut::{SamplingLaw, Search, Storage};
use onelight::{Entries, FirstProcess, Process, ToneProcess};

fn settings() -> CertifySettings {
    CertifySettings { law: SamplingLaw { count: 1 << 11, ..SamplingLaw::default() }, search: Search::SamplesOnly }
}

#[test]
fn every_form_is_the_look() {
    let look = Process::for_camera("fuji-velvia-50").unwrap().look().unwrap();
    let bevy = Recipe { shaper: ShaperChoice::Bevy, ..Recipe::cube(33) };
    let fitted = Recipe { entries: Entries::Fitted, storage: Storage::F16, ..Recipe::cube(17) };
    for (recipe, mean) in [
        // The inter-image effect bends a table between its nodes: 1.8 times the error of film by its sheet alone.
        (Recipe::cube(33), 0.18),
        (bevy, 0.4),
        (fitted, 0.54),
        (Recipe { size: 12, ..Recipe::of(Form::Structured) }, 0.1),
        (Recipe::of(Form::Direct), 0.02),
    ] {
        let baked = look.baked(&recipe).unwrap();
        assert_eq!(baked.form().kind(), recipe.form);
        let found = look.certify(&baked, &settings()).unwrap();
        assert!(to_six_stops(&found.srgb).mean < mean, "{recipe:?}: {found}");
        assert_eq!(found.rec2020.is_some(), recipe.form != Form::Plain);
        // One colour and many.
        let colours = [[0.18; 3], [f32::NAN, 1.0, f32::INFINITY], [-1.0, 0.2, 1e30], [3.0, 0.0, 0.5]];
        let mut mapped = colours;
        baked.map_in_place(&mut mapped);
        for (rgb, mapped) in colours.into_iter().zip(mapped) {
            let one = baked.apply(rgb);
            assert!(one.iter().all(|v| v.is_finite()), "{recipe:?} {rgb:?}: {one:?}");
            assert!((0..3).all(|c| (one[c] - mapped[c]).abs() < 1e-5), "{recipe:?} {rgb:?}: {one:?} {mapped:?}");
        }
    }
}

#[test]
fn looks_without_film_curves_have_the_plain_form_alone() {
    for process in [Process::from(FirstProcess::default()), Process::from(ToneProcess::default())] {
        let look = process.look().unwrap();
        assert!(look.baked(&Recipe::cube(9)).is_ok());
        for form in [Form::Structured, Form::Direct] {
            let error = look.baked(&Recipe::of(form)).unwrap_err();
            assert!(error.is_contradiction() && error.to_string().contains("expected approach second"), "{error}");
        }
    }
}

#[test]
fn sizes_are_checked() {
    let look = Process::default().look().unwrap();
    for size in [0, 1, 1 << 20, usize::MAX] {
        assert!(look.baked(&Recipe::cube(size)).is_err(), "{size}");
    }
}

#[test]
fn a_limit_that_no_table_keeps_is_said() {
    let look = Process::from(ToneProcess::default()).look().unwrap();
    assert!(smallest_under(&look, 1.0, |_, _| {}).unwrap_err().is_contradiction());
}

#[test]
fn a_report_says_what_a_person_needs() {
    let look = Process::from(ToneProcess::default()).look().unwrap();
    let baked = look.baked(&Recipe::cube(17)).unwrap();
    let found = look.certify(&baked, &settings()).unwrap();
    let text = found.to_string();
    for part in ["certificate: CIEDE2000", "all to +6 stops", "ColorChecker", "own tint of greys: C* 0.0 at 18 %"] {
        assert!(text.contains(part), "{text}");
    }
    let [look, input, output, measured] = baked.comments(Some(&found.summary())).try_into().unwrap();
    assert!(look.contains("reinhard, neutral aim, plain 17^3"), "{look}");
    assert!(input.starts_with("input: scene-linear light, srgb primaries"), "{input}");
    assert!(output.starts_with("output: display srgb primaries, srgb coding"), "{output}");
    assert!(measured.starts_with("CIEDE2000 from the exact film") && baked.comments(None)[3] == "not certified");
    assert!(!found.failures(0.0).is_empty());
}

#[test]
fn a_coded_table_is_measured_within_its_coding() {
    let look = Process::from(ToneProcess::default()).look().unwrap();
    let baked = look.baked(&Recipe { size: 33, ..Recipe::taking(ShaperChoice::Srgb) }).unwrap();
    let found = look.certify(&baked, &settings()).unwrap();
    // 1.0, the brightest grey of sRGB, is 2.47 stops over mid grey.
    assert_eq!(found.srgb.law.stops[1], 2.375);
    // The hue circles and the chart go on to +6 stops and count there as what the coding holds of them.
    assert!(found.srgb.max_found < 1.0 && found.srgb.hue_steps[3].max < 1.0, "{found}");
}
