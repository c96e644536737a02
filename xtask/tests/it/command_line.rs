//! The runner as a user meets it: every mistake ends with one sentence, exit status 2 and no file.

use std::path::Path;
use std::process::Stdio;
use std::{fs, str};

use crate::program::{SCENE_CUBE, done, names as files, program, refused, with_scene};

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
    assert!(refused(folder, &["develop", "scene.exr", "out.gif"]).contains(".png"));
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
    look("version = 2\ncamrea = \"kodak-5207\"\n");
    let sentence = refused(folder, &["bake", "--look", "look.toml"]);
    assert!(sentence.contains("look.toml:2") && sentence.contains("\"camera\""), "{sentence}");
    look("version = 2\nglass = \"none\"\nred_tail = \"held\"\n");
    assert!(refused(folder, &["bake", "--look", "look.toml"]).contains("printer lights"));
    fs::write(folder.join("file"), b"").unwrap();
    assert!(refused(folder, &["bake", "--out", "file/below"]).contains("file/below"));
    assert!(refused(folder, &["bake", "--out", "file"]).contains("error: file: is a file, expected a folder"));
    assert!(refused(folder, &["bake", "--look", "."]).contains("error: .: is a folder, expected a look.toml"));
    assert!(refused(folder, &["bake", "--print", "NONE"]).contains("did you mean \"none\"?"));
    let far = refused(folder, &["stocks", &"?".repeat(9999)]);
    assert!(far.contains("`cargo xtask stocks` lists all") && !far.contains("nearest") && far.len() < 200, "{far}");
}

/// A part of a name is enough where it fits one stock; files hold the id.
#[test]
fn films_are_named_by_a_part_of_their_names() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let named = ["bake", "--camera", "Portra 400", "--print", "2393", "--quick", "--out", "a"];
    let output = program().args(named).current_dir(folder).output().unwrap();
    let told = str::from_utf8(&output.stderr).unwrap();
    assert!(told.contains("note: --camera Portra 400: taken for kodak-portra-400"), "{told}");
    assert!(told.contains("note: --print 2393: taken for kodak-2393"), "{told}");
    let look = fs::read_to_string(folder.join("a/look.toml")).unwrap();
    assert!(look.contains("camera = \"kodak-portra-400\"") && look.contains("print = \"kodak-2393\""), "{look}");
    assert!(done(folder, &["stocks", "velvia", "--out", "."]).contains("fuji-velvia-50.svg"));
    let both = refused(folder, &["bake", "--camera", "pro-160"]);
    assert!(both.contains("--camera: \"pro-160\" fits fuji-pro-160c and fuji-pro-160s"), "{both}");
    fs::write(folder.join("part.toml"), "version = 2\ncamera = \"velvia\"\n").unwrap();
    assert!(refused(folder, &["bake", "--look", "part.toml"]).contains("the nearest is fuji-velvia-50"));
}

/// An EXR for a display of absolute light says how bright its white is.
#[test]
fn white_luminance_goes_out_and_is_told() {
    let folder = with_scene();
    let folder = folder.path();
    let hdr = ["--output-coding", "pq", "--output-space", "p3", "--white-luminance", "100"];
    done(folder, &[&["develop", "scene.exr", "hdr.exr"][..], &hdr].concat());
    let told = done(folder, &["develop", "hdr.exr", "out.exr", "--approach", "clip"]);
    assert!(told.contains("the file says that (1, 1, 1) is 100 cd/m2"), "{told}");
    let told = done(folder, &["develop", "out.exr", "again.png", "--approach", "clip"]);
    assert!(!told.contains("cd/m2"), "{told}");
}

/// The scene, as `fixtures` writes it: something to develop.
#[test]
fn the_fixture_scene_is_written_and_developed() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let said = done(folder, &["fixtures", "--out", "."]);
    assert!(said.contains("640x360"), "{said}");
    done(folder, &["develop", "scene.exr", "plain.png", "--form", "plain", "--bits", "16"]);
    let again = done(folder, &["develop", "plain.png", "again.png", "--form", "plain", "--input-coding", "srgb"]);
    assert!(again.contains("640x360"), "{again}");
}

#[test]
fn forms_and_formats_agree_on_the_scene() {
    let folder = with_scene();
    let folder = folder.path();
    // A plain table of scene light begins at 0: it clips light outside the primaries, whatever the look says, and says how far that is.
    let told = done(folder, &["develop", "scene.exr", "far.png", "--form", "plain"]);
    assert!(told.contains("plain form is within") && told.contains("hold light outside the sRGB primaries"), "{told}");
    for form in ["plain", "structured", "direct"] {
        let output = format!("{form}.png");
        done(folder, &["develop", "scene.exr", &output, "--form", form, "--bits", "16", "--gamut", "clip"]);
    }
    done(folder, &["develop", "scene.exr", "film.exr"]);
    let told = done(
        folder,
        &["develop", "scene.exr", "film.png", "--form", "reference", "--gamut", "clip", "--dither", "none"],
    );
    assert!(!told.contains("is within"), "{told}");
    // A developed picture is a picture: it can be developed again, its integers named as what they are.
    let again = done(folder, &["develop", "film.png", "again.png", "--input-coding", "srgb"]);
    assert!(again.contains("160x90"));
    let note = done(folder, &["develop", "scene.exr", "dark.png", "--ev", "-8"]);
    assert!(note.contains("--ev auto"), "{note}");
    let auto: serde_json::Value =
        serde_json::from_str(&done(folder, &["develop", "scene.exr", "auto.png", "--ev", "auto", "--json"])).unwrap();
    assert!(auto["ev"].as_f64().unwrap().abs() < 4.0);
    let coded = |path: &str| image::open(folder.join(path)).unwrap().to_rgb16();
    let film = coded("film.png");
    let largest = |path: &str| coded(path).iter().zip(film.iter()).map(|(a, b)| a.abs_diff(*b)).max().unwrap();
    // 8-bit rounding of the film is 128 of 65535; the forms add what their certificates say, dE 0.1, 0.3 and 1.2 at most, which
    // is most codes in a channel that hardly counts, such as the blue of orange.
    let (direct, structured, plain) = (largest("direct.png"), largest("structured.png"), largest("plain.png"));
    assert!(direct < 500 && structured < 500 && plain < 2000, "{direct} {structured} {plain}");
}

#[test]
fn the_talk_is_shown() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let text = done(folder, &["compare", "--sheets", "infrared,banding", "--out", "sheets"]);
    assert!(text.contains("infrared off") && text.contains("float 7e3, grey at 0.72"), "{text}");
    assert_eq!(
        files(&folder.join("sheets")),
        ["banding.png", "colorchecker_infrared.png", "index.html", "scene_infrared.png"]
    );
    assert!(!fs::read_to_string(folder.join("sheets/index.html")).unwrap().contains("http"));
    assert!(refused(folder, &["compare", "--sheets", "none"]).contains("infrared"));
    assert!(refused(folder, &["compare", "missing.exr"]).contains("missing.exr"));
    let light: serde_json::Value =
        serde_json::from_str(&done(folder, &["light", "--lux", "1000", "--kelvin", "3200", "--json"])).unwrap();
    let published = [8.230, 4.500, 1.610];
    for (found, published) in light["rgb_w_per_m2"].as_array().unwrap().iter().zip(published) {
        assert!((found.as_f64().unwrap() - published).abs() < 1e-3, "{light}");
    }
    assert!(refused(folder, &["light", "--lux", "1e99"]).contains("1e12"));
}

#[test]
fn every_approach_is_baked_and_developed() {
    let folder = with_scene();
    let folder = folder.path();
    for approach in ["first", "reinhard", "reinhard-luminance", "clip"] {
        done(folder, &["develop", "scene.exr", "exact.png", "--approach", approach, "--bits", "16"]);
        done(folder, &["develop", "scene.exr", "table.png", "--approach", approach, "--form", "plain", "--bits", "16"]);
        let coded = |path: &str| image::open(folder.join(path)).unwrap().to_rgb16();
        let (exact, table) = (coded("exact.png"), coded("table.png"));
        let mean = exact.iter().zip(table.iter()).map(|(a, b)| f64::from(a.abs_diff(*b))).sum::<f64>()
            / exact.as_raw().len() as f64;
        assert!(mean < 150.0, "{approach}: {mean} of 65535");
    }
    done(folder, &["bake", "--approach", "first", "--saturation", "0.9", "--size", "9", "--out", "a"]);
    let look = fs::read_to_string(folder.join("a/look.toml")).unwrap();
    assert!(look.contains("approach = \"first\"") && look.contains("saturation = 0.9"), "{look}");
    done(folder, &["bake", "--look", "a/look.toml", "--size", "9", "--out", "b"]);
    assert!(
        fs::read(folder.join("a").join(SCENE_CUBE)).unwrap() == fs::read(folder.join("b").join(SCENE_CUBE)).unwrap()
    );
    let sentence = refused(folder, &["bake", "--approach", "clip", "--form", "structured"]);
    assert!(sentence.contains("expected approach second"), "{sentence}");
}

#[test]
fn cameras_and_buffers_come_before_the_film() {
    let folder = with_scene();
    let folder = folder.path();
    let bytes = |output: &str, arguments: &[&str]| {
        done(folder, &[&["develop", "scene.exr", output, "--form", "plain"], arguments].concat());
        fs::read(folder.join(output)).unwrap()
    };
    let plain = bytes("plain.png", &[]);
    assert!(plain != bytes("banded.png", &["--buffer", "unorm8", "--buffer-scale", "0.25"]));
    let camera = ["--shutter", "1/60", "--f-number", "2.8", "--iso", "400"];
    let lux = bytes("lux.png", &[&["--unit", "lux"], &camera[..]].concat());
    let brighter = bytes("iso.png", &["--unit", "lux", "--shutter", "1/60", "--f-number", "2.8", "--iso", "800"]);
    assert!(lux != plain && lux != brighter);
    let sentence = refused(folder, &["develop", "scene.exr", "a.png", "--shutter", "1/60"]);
    assert!(sentence.contains("--unit"), "{sentence}");
    let auto = [&["develop", "scene.exr", "a.png", "--ev", "auto", "--unit", "lux"], &camera[..]].concat();
    assert!(refused(folder, &auto).contains("one or the other"));
}

#[test]
fn switches_that_change_nothing_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let message = |arguments: &[&str]| refused(folder.path(), &[&["bake"], arguments].concat());
    assert!(message(&["--camera", "fuji-velvia-50", "--points", "1,0,0"]).contains("points changes nothing"));
    assert!(message(&["--contrast", "1.5"]).contains("approach first"));
    assert!(message(&["--approach", "reinhard", "--aim", "sheet"]).contains("aim changes nothing"));
    assert!(message(&["--approach", "first", "--glass", "none"]).contains("glass changes nothing"));
    assert!(message(&["--aim", "sheet", "--neutral-density", "1"]).contains("neutral_density changes nothing"));
    assert!(message(&["--light", "white", "--filters", "70,2b"]).contains("separation filters"));
    assert!(message(&["--glass", "none", "--red-tail", "held"]).contains("printer lights"));
    assert!(message(&["--filters", "none"]).contains("two printer lights do the same"));
    assert!(message(&["--neutral-density", "9"]).contains("expected 0.05 to 3"));
    assert!(message(&["--points", "99,0,0"]).contains("points: found 99, expected -50 to 50"));
}

#[test]
fn commands_that_only_look_work() {
    let folder = tempfile::tempdir().unwrap();
    assert!(done(folder.path(), &["stocks"]).contains("kodak-kodachrome-64"));
    let checked = done(folder.path(), &["stocks", "--check"]);
    assert!(checked.contains(&format!("{} stocks read", onelight::stock_ids().count())), "{checked}");
    let velvia: serde_json::Value =
        serde_json::from_str(&done(folder.path(), &["stocks", "fuji-velvia-50", "--json"])).unwrap();
    assert_eq!(velvia["kind"], "reversal");
    let fidelity = done(folder.path(), &["stocks", "--fidelity"]);
    assert!(fidelity.contains("kodak-portra-400"));
    assert_eq!(done(folder.path(), &["stocks", "--likeness"]), fidelity, "the name of before");
    for command in ["bake", "compare", "develop", "light", "stability", "stocks", "fixtures", "tidy"] {
        assert!(done(folder.path(), &[command, "--help"]).contains("Usage"));
    }
}

#[test]
fn hard_inputs_break_no_limit() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let text = done(folder, &["stability", "--camera", "fuji-velvia-50", "--out", "a", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!((&json["looks"], &json["broken"]), (&1.into(), &0.into()), "{}", json["worst"]);
    assert_eq!(files(&folder.join("a")), ["stability.json", "stability.md"]);
    let page = fs::read_to_string(folder.join("a/stability.md")).unwrap();
    assert_eq!(page.matches("\n| fuji-velvia-50, neutral aim | ").count(), json["rows"].as_array().unwrap().len());
    assert!(refused(folder, &["stability", "--all", "--camera", "kodak-5207"]).contains("--all"));
}

#[test]
fn certificates_are_printed() {
    let folder = tempfile::tempdir().unwrap();
    let text = done(folder.path(), &["certify", "--camera", "fuji-velvia-50", "--colours", "1024"]);
    for form in
        ["the talk's 32^3", "plain 33^3", "structured 16^3", "structured 32^3", "direct 10 + 5", "direct, as it is"]
    {
        assert!(text.contains(form), "{text}");
    }
    assert!(done(folder.path(), &["certify", "--buffers"]).contains("7e3"));
    assert!(refused(folder.path(), &["certify", "--colours", "3"]).contains("256"));
}

#[test]
fn a_picture_knows_its_primaries_better_than_a_look() {
    let folder = with_scene();
    let folder = folder.path();
    // An EXR that says it holds Rec.2020.
    done(folder, &["develop", "scene.exr", "wide.exr", "--output-space", "rec2020"]);
    let bytes = |output: &str, arguments: &[&str]| {
        done(folder, &[&["develop", "wide.exr", output, "--form", "plain"], arguments].concat());
        fs::read(folder.join(output)).unwrap()
    };
    fs::write(folder.join("look.toml"), "version = 2\ninput_space = \"srgb\"\n").unwrap();
    let own = bytes("a.png", &[]);
    assert!(own == bytes("b.png", &["--look", "look.toml"]));
    assert!(own != bytes("c.png", &["--input-space", "srgb"]));
}

#[test]
fn output_that_nobody_reads_is_no_crash() {
    let folder = tempfile::tempdir().unwrap();
    let run = |stdout: Stdio| {
        let mut command = program();
        command
            .args(["stocks", "--json"])
            .current_dir(folder.path())
            .stdout(stdout)
            .stderr(Stdio::piped())
            .spawn()
            .unwrap()
    };
    let mut closed = run(Stdio::piped());
    drop(closed.stdout.take());
    assert_eq!(closed.wait().unwrap().code(), Some(0));
    if let Ok(full) = fs::OpenOptions::new().write(true).open("/dev/full") {
        let output = run(full.into()).wait_with_output().unwrap();
        let sentence = str::from_utf8(&output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{sentence}");
        assert!(sentence.starts_with("error: ") && sentence.trim_end().lines().count() == 1, "{sentence}");
    }
}

#[test]
fn a_picture_is_not_replaced_by_its_own_development() {
    let folder = with_scene();
    assert!(refused(folder.path(), &["develop", "scene.exr", "scene.exr"]).contains("another name"));
    assert!(refused(folder.path(), &["develop", "scene.exr", "./scene.exr"]).contains("another name"));
}

/// A folder with the data sheet of a built-in stock under another id.
fn own_sheet(folder: &Path, from: &str, id: &str) {
    let (own, built_in) = (folder.join(id), Path::new(env!("CARGO_MANIFEST_DIR")).join("../stocks").join(from));
    fs::create_dir(&own).unwrap();
    for name in ["stock.toml", "sensitivity.csv", "characteristic.csv", "dye_density.csv"] {
        let text = fs::read_to_string(built_in.join(name)).unwrap();
        fs::write(own.join(name), text.replace(&format!("id = \"{from}\""), &format!("id = \"{id}\""))).unwrap();
    }
}

/// A small bake without a certificate, with more options.
fn quickly<'a>(more: &[&'a str]) -> Vec<&'a str> {
    [&["bake", "--quick", "--size", "9"], more].concat()
}

#[test]
fn a_data_sheet_of_ones_own_is_a_film_like_any_other() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    own_sheet(folder, "kodak-5207", "mine");
    own_sheet(folder, "kodak-2383", "my-print");
    done(folder, &quickly(&["--out", "built-in"]));
    let said = done(folder, &quickly(&["--camera", "./mine", "--print", "my-print", "--out", "looks/own"]));
    assert!(said.contains("mine_my-print"), "{said}");
    // The same film under another name.
    let table = |name: &str| {
        let text = fs::read_to_string(folder.join(name).join(SCENE_CUBE)).unwrap();
        text.lines().filter(|line| !line.starts_with(['#', 'T'])).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(table("looks/own"), table("built-in"));
    // Found again from where the description is.
    let look = fs::read_to_string(folder.join("looks/own/look.toml")).unwrap();
    assert!(look.contains("camera = \"mine\"\ncamera_sheet = \"../../mine\"\ncamera_sha256 = \""), "{look}");
    assert!(look.contains("print_sheet = \"../../my-print\""), "{look}");
    done(folder, &quickly(&["--look", "looks/own/look.toml", "--out", "looks/again"]));
    assert_eq!(look, fs::read_to_string(folder.join("looks/again/look.toml")).unwrap());
    assert_eq!(table("looks/again"), table("looks/own"));
    // Every form.
    for form in ["structured", "direct"] {
        done(folder, &["bake", "--quick", "--camera", "mine", "--form", form, "--out", form]);
    }
    // Measured as any other.
    let talk = done(folder, &["compare", "--camera", "mine", "--sheets", "calibration", "--out", "compare"]);
    assert!(talk.contains("sheet: mine_kodak-2383"), "{talk}");
    let hard = done(folder, &["stability", "--camera", "mine", "--print", "my-print", "--out", "stability"]);
    assert!(hard.contains("mine_my-print"), "{hard}");
    // A changed sheet is refused, and taken where it is asked for.
    let sheet = folder.join("mine/stock.toml");
    fs::write(&sheet, fs::read_to_string(&sheet).unwrap() + "# changed\n").unwrap();
    let changed = quickly(&["--look", "looks/own/look.toml", "--out", "looks/changed"]);
    let sentence = refused(folder, &changed);
    assert!(sentence.contains("has changed since") && sentence.contains("--camera"), "{sentence}");
    done(folder, &[&changed[..], &["--camera", "mine"]].concat());
}

#[test]
fn data_sheets_that_cannot_be_used_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    own_sheet(folder, "kodak-5207", "mine");
    own_sheet(folder, "kodak-2383", "my-print");
    own_sheet(folder, "fuji-velvia-50", "my-slide");
    fs::create_dir(folder.join("empty")).unwrap();
    let message = |arguments: &[&str]| refused(folder, &[&["bake", "--quick"], arguments].concat());
    assert!(message(&["--camera", "./gone"]).contains("no such folder"));
    assert!(message(&["--camera", "empty"]).contains("no stock.toml in it"));
    assert!(message(&["--camera", "my-print"]).contains("is a print film"));
    assert!(message(&["--camera", "my-slide", "--print", "my-print"]).contains("is a reversal film"));
    assert!(message(&["--print", "mine"]).contains("is a camera film"));
    assert!(message(&["--camera", "my-slide", "--points", "1,0,0"]).contains("points changes nothing"));
    assert!(message(&["--camera", "mine", "--approach", "reinhard"]).contains("knows no film"));
    fs::write(folder.join("mine/characteristic.csv"), "log10_exposure,red\n0,none\n").unwrap();
    assert!(message(&["--camera", "mine"]).contains("mine/characteristic.csv"));
    fs::remove_file(folder.join("mine/dye_density.csv")).unwrap();
    assert!(message(&["--camera", "mine"]).contains("dye_density.csv: cannot be read"));
}

#[test]
fn a_map_says_what_a_look_is_uncertain_by() {
    let folder = with_scene();
    let folder = folder.path();
    let told = done(folder, &["develop", "scene.exr", "film.png", "--uncertainty", "map.exr"]);
    assert!(told.contains("map.exr: what the look is uncertain by"), "{told}");
    let map = std::io::Cursor::new(fs::read(folder.join("map.exr")).unwrap());
    let map = onelight_picture::Picture::read(map, "map.exr", Default::default()).unwrap();
    for [all, sheets, inter_image] in &map.rgb {
        assert!((all - sheets.hypot(*inter_image)).abs() < 1e-4 * all.max(1.0));
    }
    let most = map.rgb.iter().fold(0.0, |most: f32, rgb| most.max(rgb[0]));
    assert!((0.5..40.0).contains(&most), "{most}");
    for (arguments, says) in [
        (&["--uncertainty", "map.png"][..], "ends in .exr"),
        (&["--uncertainty", "scene.exr"], "the picture itself"),
        (&["--uncertainty", "map.exr", "--approach", "reinhard"], "expected approach second"),
    ] {
        let sentence = refused(folder, &[&["develop", "scene.exr", "film.png"], arguments].concat());
        assert!(sentence.contains(says), "{sentence}");
    }
}
