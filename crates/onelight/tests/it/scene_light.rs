//! Exposure and the scene's white before the film, in every kind of look and every form.

use onelight::baked::{Form, Recipe, ShaperChoice};
use onelight::spectra::nalgebra::Vector3;
use onelight::spectra::{Chromaticity, RgbSpace, SceneWhite};
use onelight::{
    Approach, ColourSpaces, FilmProcess, FirstProcess, Process, ProcessKeys, ToneMapping, ToneProcess, WorkingSpace,
};

fn tungsten(ev: f64, input_space: WorkingSpace) -> ColourSpaces {
    let scene_white = Some(SceneWhite::new(3200.0, -12.0).unwrap());
    ColourSpaces { ev, scene_white, input_space, ..ColourSpaces::default() }
}

/// The same light brought to 6500 K by Bradford's matrix, in sRGB primaries.
fn by_hand(spaces: &ColourSpaces, rgb: [f64; 3]) -> [f64; 3] {
    let white = Chromaticity::black_body_6500_k();
    let to_xyz = spaces.input_space.space().with_white(white).to_xyz().unwrap();
    let adapted = spaces.scene_white.unwrap().to_model_white() * to_xyz * Vector3::from(rgb);
    let srgb = RgbSpace::SRGB.with_white(white).from_xyz().unwrap() * adapted;
    (srgb * spaces.ev.exp2()).into()
}

#[test]
fn exposed_and_balanced_light_is_that_light_on_the_usual_film() {
    let usual = FilmProcess::default().compile().unwrap();
    for input in [WorkingSpace::Srgb, WorkingSpace::Rec2020, WorkingSpace::AcesCg] {
        let spaces = tungsten(-1.5, input);
        let film = FilmProcess { spaces, ..FilmProcess::default() }.compile().unwrap();
        // The last three lie outside the sRGB primaries, where films compress.
        for rgb in [[0.4, 0.18, 0.06], [3.0, 0.1, 2.0], [0.02, 0.9, 0.1], [-0.1, 0.8, 0.3], [0.0, 0.0, 4.0]] {
            let (found, expected) = (film.develop(rgb), usual.develop(by_hand(&spaces, rgb)));
            for c in 0..3 {
                assert!((found[c] - expected[c]).abs() < 1e-9, "{input:?} {rgb:?}: {found:?} {expected:?}");
            }
        }
    }
}

#[test]
fn a_grey_card_under_the_scene_s_white_is_grey_in_every_kind_of_look() {
    let spaces = tungsten(0.0, WorkingSpace::P3);
    let card = spaces.white_rgb().unwrap().map(|v| 0.18 * v);
    assert!(card[0] > 2.0 * card[2]);
    let looks: [Process; 3] = [
        FilmProcess { spaces, ..FilmProcess::default() }.into(),
        FirstProcess { spaces, ..FirstProcess::default() }.into(),
        ToneProcess { mapping: ToneMapping::Clip, spaces }.into(),
    ];
    for process in looks {
        let mut plain = process.clone();
        plain.spaces_mut().scene_white = None;
        let (balanced, plain) = (process.look().unwrap(), plain.look().unwrap());
        let (found, expected) = (balanced.develop(card), plain.develop([0.18; 3]));
        for c in 0..3 {
            assert!((found[c] - expected[c]).abs() < 1e-9, "{}: {found:?} {expected:?}", process.name());
        }
    }
}

#[test]
fn every_form_exposes_and_balances() {
    let spaces = tungsten(1.0, WorkingSpace::Srgb);
    let look = Process::from(FilmProcess { spaces, ..FilmProcess::default() }).look().unwrap();
    let logc3 = Recipe::taking(ShaperChoice::Logc3);
    for recipe in
        [Recipe::of(Form::Direct), Recipe { size: 24, ..Recipe::of(Form::Structured) }, Recipe::cube(33), logc3]
    {
        let baked = look.baked(&recipe).unwrap();
        for rgb in [[0.18, 0.08, 0.03], [0.05, 0.03, 0.01], [0.5, 0.4, 0.1], [0.9, 0.4, 0.1]] {
            let (found, exact) = (baked.apply(rgb.map(|v: f64| v as f32)), look.develop(rgb));
            for c in 0..3 {
                let miss = (f64::from(found[c]) - exact[c]).abs();
                assert!(miss < 0.01, "{}: {found:?} {exact:?}", baked.describe());
            }
        }
    }
}

#[test]
fn both_are_keys_of_look_toml() {
    let spaces = tungsten(0.5, WorkingSpace::Srgb);
    let look = Process::from(FilmProcess { spaces, ..FilmProcess::default() });
    let text = look.to_toml();
    assert!(text.contains("ev = 0.5") && text.contains("scene_white = \"3200,-12\""), "{text}");
    assert_eq!(Process::from_toml("look.toml", &text).unwrap(), look);
    let message =
        |line: &str| Process::from_toml("look.toml", &format!("version = 2\n{line}\n")).unwrap_err().to_string();
    assert!(message("scene_white = \"warm\"").contains("3200 or 5600,10"), "{}", message("scene_white = \"warm\""));
    assert!(message("scene_white = \"900\"").contains("1667 to 25000 K"));
    assert!(message("ev = 30.0").contains("ev: found 30, expected -20 to 20"), "{}", message("ev = 30.0"));
    let old = Process::from_toml("look.toml", "version = 1\nev = 1.0\n").unwrap_err().to_string();
    assert!(old.contains("ev is a key of version 2"), "{old}");
    // They mean something to every approach.
    for approach in [Approach::First, Approach::Reinhard, Approach::Clip] {
        let keys = ProcessKeys { approach, ev: 1.0, scene_white: spaces.scene_white, ..ProcessKeys::default() };
        assert_eq!(keys.process().unwrap().spaces().ev, 1.0);
    }
}
