//! Sharpness, halation and grain on whole files.

use std::fs;
use std::io::Cursor;
use std::path::Path;

use onelight_picture::{Limits, Picture, Source, Windows};
use serde_json::Value;

use crate::program::{done, names, program, refused, with_scene};

const EFFECTS: [&str; 6] = ["--film-format", "super16", "--halation", "on", "--antihalation", "none"];

fn read(folder: &Path, name: &str) -> Picture {
    Picture::read(fs::File::open(folder.join(name)).unwrap(), name, Limits::default()).unwrap()
}

fn write(folder: &Path, name: &str, picture: &Picture) {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_exr(&mut bytes, &[]).unwrap();
    fs::write(folder.join(name), bytes.into_inner()).unwrap();
}

fn grey(size: [usize; 2]) -> Picture {
    Picture::opaque(size[0], size[1], vec![[0.18; 3]; size[0] * size[1]], Source::Exr)
}

fn notes(folder: &Path, arguments: &[&str]) -> Vec<String> {
    let json: Value = serde_json::from_str(&done(folder, &[arguments, &["--json"]].concat())).unwrap();
    json["notes"].as_array().unwrap().iter().map(|note| note.as_str().unwrap().to_owned()).collect()
}

#[test]
fn each_effect_gives_its_reason() {
    let folder = with_scene();
    let folder = folder.path();
    let develop = |options: &[&str]| notes(folder, &[&["develop", "scene.exr", "a.png"], options].concat());
    let found = develop(&EFFECTS);
    for start in [
        "halation: kodak-5207 without its antihalation layer: 58.40 % of the light",
        "grain: ",
        "sharpness: ",
        "halation: on, as asked",
    ] {
        assert!(found.iter().any(|note| note.starts_with(start)), "{start}: {found:?}");
    }
    let without = fs::read(folder.join("a.png")).unwrap();
    let plain = develop(&[]);
    assert!(!plain.iter().any(|note| note.starts_with("grain") || note.starts_with("sharpness")));
    assert!(fs::read(folder.join("a.png")).unwrap() != without);
    // Settings of a description, and of the command line beside it.
    let text = "version = 2\nfilm_format = \"still36\"\ngrain = \"off\"\nsharpness = \"on\"\n";
    fs::write(folder.join("look.toml"), text).unwrap();
    let found = develop(&["--look", "look.toml"]);
    assert!(found.contains(&"sharpness: on, as asked".to_owned()), "{found:?}");
    assert!(!found.iter().any(|note| note.starts_with("grain")), "{found:?}");
    let found = develop(&["--look", "look.toml", "--sharpness", "off", "--grain", "on"]);
    assert!(found.contains(&"grain: on, as asked".to_owned()), "{found:?}");
}

#[test]
fn mistakes_are_one_sentence() {
    let folder = with_scene();
    let message = |options: &[&str]| refused(folder.path(), &[&["develop", "scene.exr", "a.png"], options].concat());
    for (options, sentence) in [
        (&["--grain", "on"][..], "expected film_format beside it"),
        (&["--film-format", "super9"], "expected super35, academy"),
        (&["--film-format", "0.5mm"], "expected 1 to 500 mm"),
        (&["--film-format", "1mm", "--frame-width", "100000"], "scene.exr: size of a pixel on film: found 0.01 um"),
        (&["--film-format", "super8", "--form", "plain"], "--film-format: a plain table knows no dye"),
        (&["--film-format", "super8", "--antihalation", "none"], "halation is off: antihalation changes nothing"),
        (&["--film-format", "super8", "--approach", "reinhard"], "film_format changes nothing"),
        (&["--frame-offset", "3,4"], "--frame-offset changes nothing without --film-format"),
        (
            &["--film-format", "super8", "--grain", "on", "--camera", "kodak-portra-400"],
            "repeats the points of Kodak Vision3 250D 5207",
        ),
    ] {
        let found = message(options);
        assert!(found.contains(sentence), "{options:?}: {found}");
    }
}

#[test]
fn threads_give_the_same_file() {
    let folder = with_scene();
    let folder = folder.path();
    for (name, threads) in [("a.png", "1"), ("b.png", "3")] {
        let mut command = program();
        command.args(["develop", "scene.exr", name]).args(EFFECTS).env("RAYON_NUM_THREADS", threads);
        assert!(command.current_dir(folder).output().unwrap().status.success());
    }
    assert!(fs::read(folder.join("a.png")).unwrap() == fs::read(folder.join("b.png")).unwrap());
}

/// As a data window of an EXR, and as a file of its own that says where it was.
#[test]
fn the_grain_of_a_crop_is_the_crop_of_the_grain() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let ([width, height], [x, y], [w, h]) = ([300, 80], [120, 31], [90, 40]);
    write(folder, "whole.exr", &grey([width, height]));
    let crop = grey([w, h]);
    write(folder, "crop.exr", &crop);
    let windows = Windows { data_origin: [x as i32, y as i32], ..Windows::of_size(width, height) };
    write(folder, "window.exr", &Picture { windows, ..crop });
    let options = ["--film-format", "super8", "--sharpness", "off", "--seed", "9"];
    let develop = |name: &str, to: &str, more: &[&str]| {
        done(folder, &[&["develop", name, to], &options[..], more].concat());
        read(folder, to)
    };
    let whole = develop("whole.exr", "whole.out.exr", &[]);
    let place = format!("{x},{y}");
    let alone = develop("crop.exr", "crop.out.exr", &["--frame-width", "300", "--frame-offset", &place]);
    let window = develop("window.exr", "window.out.exr", &[]);
    assert_eq!((alone.width, alone.height, window.width, window.height), (w, h, w, h));
    for row in 0..h {
        let of_whole = &whole.rgb[(y + row) * width + x..][..w];
        assert!(&alone.rgb[row * w..][..w] == of_whole && &window.rgb[row * w..][..w] == of_whole, "row {row}");
    }
    assert!(whole.rgb.iter().any(|rgb| (rgb[1] - whole.rgb[0][1]).abs() > 0.01));
}

/// Alpha is as it was; what it does not cover meets the film as the light that is stored there.
#[test]
fn alpha_stays_and_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let alpha: Vec<f32> = (0..64 * 20).map(|i| if i % 64 < 32 { 0.5 } else { 0.0 }).collect();
    write(folder, "a.exr", &Picture { alpha: Some(alpha.clone()), ..grey([64, 20]) });
    let options =
        ["develop", "a.exr", "b.exr", "--film-format", "super16", "--frame-width", "2048", "--background", "none"];
    let found = notes(folder, &options);
    assert!(found.iter().any(|note| note.starts_with("the picture keeps its alpha")), "{found:?}");
    let with = read(folder, "b.exr");
    assert_eq!(with.alpha.unwrap(), alpha);
    write(folder, "a.exr", &Picture { alpha: Some(vec![1.0; 64 * 20]), ..grey([64, 20]) });
    let found = notes(folder, &options);
    assert!(!found.iter().any(|note| note.starts_with("the picture keeps its alpha")), "{found:?}");
}

#[test]
fn frames_have_grain_of_their_own_and_settings_are_part_of_the_digest() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for number in [1, 2] {
        write(folder, &format!("shot.{number:04}.exr"), &grey([64, 20]));
    }
    let run = |seed: &str| {
        let options = [
            "develop",
            "shot.####.exr",
            "out.####.png",
            "--film-format",
            "super16",
            "--frame-width",
            "2048",
            "--seed",
            seed,
            "--json",
        ];
        let json: Value = serde_json::from_str(&done(folder, &options)).unwrap();
        ["developed", "already_done"].map(|key| json[key].as_u64().unwrap())
    };
    assert_eq!(run("0"), [2, 0]);
    let first = read(folder, "out.0001.png").rgb;
    assert!(first != read(folder, "out.0002.png").rgb, "two frames of one grey");
    assert_eq!(run("0"), [0, 2]);
    assert_eq!(run("1"), [2, 0]);
    assert!(first != read(folder, "out.0001.png").rgb, "another seed");
}

#[test]
fn a_table_says_that_it_has_none_of_it() {
    let folder = tempfile::tempdir().unwrap();
    let text = done(folder.path(), &["bake", "--quick", "--film-format", "65mm", "--out", "look"]);
    assert!(
        text.contains("film_format 65mm: sharpness, halation and grain") && text.contains("are in no LUT"),
        "{text}"
    );
    assert!(names(&folder.path().join("look")).len() > 1);
}
