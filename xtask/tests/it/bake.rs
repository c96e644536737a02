//! What `bake` writes, says and refuses.

use std::fs;

use crate::program::{SCENE_CUBE, done, names as files, refused, with_scene};

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
    assert!(json["certificate"]["max_found"].as_f64().unwrap() > 0.0);
    let names =
        ["chart.png", "look.json", "look.scene-linear.resolve.cube", "look.srgb.cube", "look.toml", "preview.png"];
    assert_eq!(files(&folder.join("a")), names);
    done(folder, &["bake", "--look", "a/look.toml", "--size", "9", "--out", "b"]);
    for name in names {
        assert!(
            fs::read(folder.join("a").join(name)).unwrap() == fs::read(folder.join("b").join(name)).unwrap(),
            "{name}"
        );
    }
}

#[test]
fn a_table_is_chosen_and_measured_on_the_users_scene() {
    let folder = with_scene();
    let folder = folder.path();
    let chosen = done(folder, &["bake", "--max-de", "1.5", "--scene", "scene.exr", "--out", "a", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&chosen).unwrap();
    assert!(json["certificate"]["max_found"].as_f64().unwrap() <= 1.5);
    assert!(json["scene"]["mean"].as_f64().unwrap() < 0.5);
    assert_eq!((&json["scene_gamut"]["gamut"], &json["scene_gamut"]["other"]), (&"compress".into(), &"clip".into()));
    assert_eq!(json["failures"].as_array().unwrap().len(), 0);
    let saved: serde_json::Value = serde_json::from_slice(&fs::read(folder.join("a/look.json")).unwrap()).unwrap();
    assert_eq!(saved["certificate"], json["certificate"]);
    let fitted = done(folder, &["bake", "--scene", "scene.exr", "--size", "17", "--out", "b"]);
    assert!(fitted.contains("on the scene given"), "{fitted}");
    assert!(fitted.contains("% of the pixels hold light outside the sRGB primaries (--gamut compress)"), "{fitted}");
    assert!(refused(folder, &["bake", "--scene", "missing.exr"]).contains("missing.exr"));
    assert!(refused(folder, &["bake", "--form", "structured", "--format", "cube"]).contains("clf"));
    assert!(refused(folder, &["bake", "--format", "hald"]).contains("--shaper srgb"));
    assert!(refused(folder, &["bake", "--shaper", "srgb", "--format", "hald", "--size", "20"]).contains("20"));
}

#[test]
fn the_direct_form_is_baked_chosen_and_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let json = |text: &str| -> serde_json::Value { serde_json::from_str(text).unwrap() };
    let baked = json(&done(folder, &["bake", "--form", "direct", "--nodes", "7,3", "--out", "a", "--json"]));
    assert_eq!(files(&folder.join("a")), ["chart.png", "look.direct.json", "look.json", "look.toml", "preview.png"]);
    assert!(baked["certificate"]["max_found"].as_f64().unwrap() < 0.4, "{}", baked["certificate"]["max_found"]);
    let file = json(&fs::read_to_string(folder.join("a/look.direct.json")).unwrap());
    assert_eq!(file["projection"].as_array().unwrap().len(), 7);
    assert_eq!(file["print"]["exposure"].as_array().unwrap().len(), 3);
    assert!(file["comments"].as_array().unwrap().iter().any(|line| line.as_str().unwrap().contains("CIEDE2000")));
    let chosen = ["bake", "--form", "direct", "--camera", "fuji-velvia-50", "--max-de", "0.5", "--out", "b", "--json"];
    let chosen = json(&done(folder, &chosen));
    assert!(chosen["certificate"]["max_found"].as_f64().unwrap() <= 0.5);
    let direct = |more: &[&str]| refused(folder, &[&["bake", "--form", "direct"], more].concat());
    assert!(direct(&["--format", "clf"]).contains("expected json"));
    assert!(direct(&["--nodes", "six"]).contains("8,4"));
    assert!(direct(&["--nodes", "40"]).contains("from 2 to 16"));
    assert!(direct(&["--camera", "fuji-velvia-50", "--max-de", "1e-6"]).contains("the nearest had"));
    assert!(refused(folder, &["bake", "--format", "json"]).contains("--form direct"));
    assert!(refused(folder, &["bake", "--nodes", "6"]).contains("--form direct"));
}

#[test]
fn a_quick_bake_is_the_same_table_and_says_what_it_lacks() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let said = done(folder, &["bake", "--quick", "--size", "9", "--out", "quick"]);
    assert!(said.contains("not certified"), "{said}");
    assert_eq!(files(&folder.join("quick")), [SCENE_CUBE, "look.srgb.cube", "look.toml"]);
    done(folder, &["bake", "--size", "9", "--out", "slow"]);
    let table = |folder_name: &str| -> Vec<String> {
        let text = fs::read_to_string(folder.join(folder_name).join(SCENE_CUBE)).unwrap();
        assert_eq!(text.contains("not certified"), folder_name == "quick");
        text.lines().filter(|line| !line.starts_with('#')).map(str::to_owned).collect()
    };
    assert_eq!(table("quick"), table("slow"));
    assert!(refused(folder, &["bake", "--quick", "--max-de", "1"]).contains("--max-de"));
}

#[test]
fn every_program_gets_its_files_and_they_say_what_they_take() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let said = done(folder, &["bake", "--for", "all", "--quick", "--out", "all"]);
    let found = files(&folder.join("all"));
    for name in [
        SCENE_CUBE,
        "look.intermediate.cube",
        "look.logc4.cube",
        "look.srgb.cube",
        "look.scene-linear.clf",
        "look.srgb.hald.png",
        "look.srgb.unreal.png",
        "look.srgb.unity.png",
        "look.srgb.godot.png",
        "look.bevy.ktx2",
    ] {
        assert!(found.iter().any(|file| file == name), "{name} in {found:?}");
        assert!(said.contains(name), "{name} in {said}");
    }
    for program in ["resolve", "blender", "nuke", "ffmpeg", "darktable", "rawtherapee", "bevy", "godot", "three"] {
        assert!(said.contains(&format!("\n  {program}: ")), "{program} in {said}");
    }
    let text = |name: &str| fs::read_to_string(folder.join("all").join(name)).unwrap();
    let camera = text("look.logc4.cube");
    assert!(camera.starts_with("TITLE \"kodak-5207_kodak-2383, takes ARRI LogC4\"\n"), "{}", &camera[..200]);
    assert!(camera.contains("# input: ARRI LogC4, ARRI Wide Gamut 4 primaries, 18 % grey at 0.2784"));
    assert!(camera.contains("# output: display srgb primaries, gamma24 coding"));
    let clf = text("look.scene-linear.clf");
    assert!(clf.contains("<InputDescriptor>scene-linear light, srgb primaries, 18 % grey at 0.18"), "{}", &clf[..900]);
    assert!(clf.contains("<OutputDescriptor>display srgb primaries, srgb coding"));
    // A description names a coding, if only the default's: it is kept, and said where programs usually have another.
    let told = |more: &[&str]| done(folder, &[&["bake", "--for", "resolve", "--quick", "--out", "r"], more].concat());
    assert!(told(&[]).contains("coded gamma24 for its programs, not srgb"));
    let of_file = told(&["--look", "r/look.toml"]);
    assert!(
        of_file.contains("coded srgb as the look says, where gamma24 is usual for resolve (--output-coding gamma24)"),
        "{of_file}"
    );
    assert!(!told(&["--look", "r/look.toml", "--output-coding", "srgb"]).contains("usual for"));
    // Bevy takes light, whatever is said of the display.
    let tables = [&[][..], &["--output-coding", "srgb"], &["--look", "b0/look.toml"]].map(|more| {
        done(folder, &[&["bake", "--for", "bevy", "--quick", "--out", "b0"], more].concat());
        fs::read(folder.join("b0/look.bevy.ktx2")).unwrap()
    });
    assert!(tables[0] == tables[1] && tables[0] == tables[2]);
    let other = done(folder, &["bake", "--for", "camera", "--shaper", "slog3", "--quick", "--out", "b"]);
    assert!(other.contains("look.slog3.cube") && files(&folder.join("b")) == ["look.slog3.cube", "look.toml"]);
    let named = done(folder, &["bake", "--for", "camera", "--output-coding", "srgb", "--quick", "--out", "c"]);
    assert!(!named.contains("gamma24"), "{named}");
}

#[test]
fn coded_tables_stay_in_range_and_are_measured_where_their_input_is() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let entries = |name: &str| -> Vec<f32> {
        let text = fs::read_to_string(folder.join(name).join("look.srgb.cube")).unwrap();
        let lines = text.lines().filter(|line| !line.starts_with(|c: char| c == '#' || c.is_alphabetic()));
        lines.flat_map(str::split_ascii_whitespace).map(|word| word.parse().unwrap()).collect()
    };
    let said = done(folder, &["bake", "--shaper", "srgb", "--size", "33", "--out", "cut", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&said).unwrap();
    assert_eq!(json["failures"].as_array().unwrap().len(), 0, "{}", json["failures"]);
    // 1.0 is 2.47 stops over mid grey.
    assert_eq!(json["certificate"]["law"]["stops"], serde_json::json!([-10.0, 2.375]));
    assert!(entries("cut").iter().all(|v| (0.0..=1.0).contains(v)));
    done(folder, &["bake", "--shaper", "srgb", "--size", "33", "--unclamped", "--quick", "--out", "whole"]);
    assert!(entries("whole").iter().any(|v| *v < -0.1));
}

#[test]
fn options_of_bake_that_would_do_nothing_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let message = |arguments: &str| {
        let arguments: Vec<&str> = arguments.split(' ').collect();
        refused(folder.path(), &[&["bake"], &arguments[..]].concat())
    };
    for (arguments, says) in [
        ("--form structured --shaper srgb", "--shaper changes nothing in the structured form, expected --form plain"),
        ("--form structured --stops 6", "--stops changes nothing in the structured form"),
        ("--form direct --size 9", "--size changes nothing in the direct form"),
        ("--form direct --storage f16", "--storage changes nothing in the direct form"),
        ("--form direct --entries fitted", "--entries changes nothing in the direct form"),
        ("--coding display", "--coding changes nothing in the plain form, expected --form structured"),
        ("--shaper logc4 --stops 6", "--stops changes nothing with --shaper logc4"),
        ("--shaper logc4 --entries fitted", "--entries changes nothing with --shaper logc4"),
        ("--unclamped --size 9", "--unclamped changes nothing with --shaper log2"),
        ("--for ffmpeg --shaper logc4", "expected a coding with --for camera"),
        ("--for ffmpeg --size 9", "--size"),
        ("--for toaster", "toaster"),
    ] {
        let sentence = message(arguments);
        assert!(sentence.contains(says), "{arguments}: {sentence}");
    }
}

#[test]
fn several_films_are_views_of_one_configuration() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let films = "kodak-5207,fuji-velvia-50";
    done(folder, &["bake", "--for", "blender,ocio", "--camera", films, "--quick", "--out", "a"]);
    let names = ["fuji-velvia-50", "kodak-5207_kodak-2383"];
    let clf = names.map(|name| format!("{name}.scene-linear.clf"));
    let toml = names.map(|name| format!("{name}.toml"));
    assert_eq!(files(&folder.join("a")), [&clf[0], &toml[0], &clf[1], &toml[1], "look.ocio"]);
    let config = fs::read_to_string(folder.join("a/look.ocio")).unwrap();
    for name in names {
        assert!(config.contains(&format!("- !<View> {{name: \"{name}\", colorspace: \"{name}\"}}")), "{config}");
        assert!(config.contains(&format!("src: \"{name}.scene-linear.clf\"")), "{config}");
    }
    assert!(refused(folder, &["bake", "--camera", films]).contains("--for ocio"));
    assert!(refused(folder, &["bake", "--for", "ocio,ffmpeg", "--camera", films]).contains("--for ocio"));
    assert!(refused(folder, &["bake", "--for", "ocio", "--camera", "kodak-5207,"]).contains("error: "));
}
