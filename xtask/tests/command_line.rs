//! The runner as a user meets it: every mistake ends with one sentence, exit status 2 and no file.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails loudly")]

use std::path::Path;
use std::process::{Command, Output};
use std::{fs, str};

fn xtask(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_xtask")).args(arguments).current_dir(folder).output().unwrap()
}

fn done(folder: &Path, arguments: &[&str]) -> String {
    let output = xtask(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", str::from_utf8(&output.stderr).unwrap());
    String::from_utf8(output.stdout).unwrap()
}

/// Runs a mistake; returns the sentence.
fn refused(folder: &Path, arguments: &[&str]) -> String {
    let before = files(folder);
    let output = xtask(folder, arguments);
    let sentence = str::from_utf8(&output.stderr).unwrap().to_owned();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {sentence}");
    assert!(sentence.starts_with("error: ") && !sentence.contains("panicked"), "{sentence}");
    assert_eq!(files(folder), before, "{arguments:?} left something behind");
    sentence
}

fn files(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// The scene, as `fixtures` writes it: something to develop.
fn with_scene() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    done(folder.path(), &["fixtures", "--out", "."]);
    folder
}

#[test]
fn pictures_that_cannot_be_developed_are_named() {
    let folder = with_scene();
    let folder = folder.path();
    let whole = fs::read(folder.join("scene.exr")).unwrap();
    fs::write(folder.join("cut.exr"), &whole[..whole.len() / 2]).unwrap();
    fs::write(folder.join("head.exr"), &whole[..60]).unwrap();
    fs::write(folder.join("empty.exr"), b"").unwrap();
    fs::write(folder.join("text.exr"), b"this is no picture").unwrap();
    for name in ["cut.exr", "head.exr", "empty.exr", "text.exr", "missing.exr", "."] {
        let sentence = refused(folder, &["develop", name, "out.png"]);
        assert!(sentence.contains(name) && sentence.trim_end().lines().count() == 1, "{sentence}");
    }
    assert!(refused(folder, &["develop", "scene.exr", "out.jpg"]).contains(".png"));
    assert!(refused(folder, &["develop", "scene.exr", "no/such/folder/out.png"]).contains("folder"));
    assert!(refused(folder, &["develop", "scene.exr", "out.png", "--ev", "much"]).contains("auto"));
}

#[test]
fn looks_that_contradict_themselves_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    assert!(refused(folder, &["bake", "--camera", "kodak-5270"]).contains("nearest"));
    assert!(refused(folder, &["bake", "--camera", "kodak-2383"]).contains("is a print film"));
    assert!(refused(folder, &["bake", "--camera", "fuji-velvia-50", "--print", "kodak-2383"]).contains("reversal"));
    assert!(refused(folder, &["bake", "--print", "none"]).contains("is a negative"));
    assert!(refused(folder, &["bake", "--look", "missing.toml"]).contains("missing.toml"));
    assert!(refused(folder, &["bake", "--size", "1"]).contains("--size"));
    let look = |text: &str| fs::write(folder.join("look.toml"), text).unwrap();
    look("version = 1\ncamrea = \"kodak-5207\"\n");
    let sentence = refused(folder, &["bake", "--look", "look.toml"]);
    assert!(sentence.contains("look.toml:2") && sentence.contains("\"camera\""), "{sentence}");
    look("version = 1\nglass = \"none\"\nred_tail = \"held\"\n");
    assert!(refused(folder, &["bake", "--look", "look.toml"]).contains("printer lights"));
    fs::write(folder.join("file"), b"").unwrap();
    assert!(refused(folder, &["bake", "--out", "file/below"]).contains("file/below"));
    assert!(refused(folder, &["stocks", "velvia"]).contains("fuji-velvia-50"));
}

#[test]
fn a_look_is_baked_saved_and_baked_again() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let first = done(
        folder,
        &["bake", "--camera", "kodak-portra-400", "--aim", "sheet", "--size", "9", "--out", "a", "--json"],
    );
    let json: serde_json::Value = serde_json::from_str(&first).unwrap();
    assert_eq!(json["process"]["camera"], "kodak-portra-400");
    assert!(json["deviation"]["max"].as_f64().unwrap() > 0.0);
    assert_eq!(files(&folder.join("a")), ["look.cube", "look.toml", "preview.png"]);
    done(folder, &["bake", "--look", "a/look.toml", "--size", "9", "--out", "b"]);
    for name in ["look.cube", "look.toml", "preview.png"] {
        assert!(
            fs::read(folder.join("a").join(name)).unwrap() == fs::read(folder.join("b").join(name)).unwrap(),
            "{name}"
        );
    }
}

#[test]
fn forms_and_formats_agree_on_the_scene() {
    let folder = with_scene();
    let folder = folder.path();
    done(folder, &["develop", "scene.exr", "plain.png", "--form", "plain", "--bits", "16"]);
    done(folder, &["develop", "scene.exr", "film.exr"]);
    done(folder, &["develop", "scene.exr", "film.png", "--ev", "0"]);
    // A developed picture is a picture: it can be developed again, its integers named as what they are.
    let again = done(folder, &["develop", "film.png", "again.png", "--input-coding", "srgb"]);
    assert!(again.contains("640x360"));
    let note = done(folder, &["develop", "scene.exr", "dark.png", "--ev", "-8"]);
    assert!(note.contains("--ev auto"), "{note}");
    let auto: serde_json::Value =
        serde_json::from_str(&done(folder, &["develop", "scene.exr", "auto.png", "--ev", "auto", "--json"])).unwrap();
    assert!(auto["ev"].as_f64().unwrap().abs() < 4.0);
    let coded = |path: &str| image::open(folder.join(path)).unwrap().to_rgb16();
    let (plain, film) = (coded("plain.png"), coded("film.png"));
    let largest = plain.iter().zip(film.iter()).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
    // 8-bit rounding of one of them is 128 of 65535; the table of 33 nodes is good to about dE 0.5.
    assert!(largest < 1200, "{largest}");
}

#[test]
fn commands_that_only_look_work() {
    let folder = tempfile::tempdir().unwrap();
    assert!(done(folder.path(), &["stocks"]).contains("kodak-kodachrome-64"));
    assert!(done(folder.path(), &["stocks", "--check"]).contains("59 processes"));
    let velvia: serde_json::Value =
        serde_json::from_str(&done(folder.path(), &["stocks", "fuji-velvia-50", "--json"])).unwrap();
    assert_eq!(velvia["kind"], "reversal");
    for command in ["bake", "develop", "stocks", "fixtures", "tidy"] {
        assert!(done(folder.path(), &[command, "--help"]).contains("Usage"));
    }
}

#[test]
fn the_workspace_is_tidy() {
    done(Path::new(env!("CARGO_MANIFEST_DIR")), &["tidy"]);
}
