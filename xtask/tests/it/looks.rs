//! Looks that people ask for: camera logs that come in.

use std::fs;
use std::io::Cursor;
use std::path::Path;

use onelight_picture::{Limits, Picture, Source};

use crate::program::{done, refused};

/// Writes an EXR of six equal pixels.
fn flat(folder: &Path, name: &str, rgb: [f32; 3]) {
    let mut bytes = Cursor::new(Vec::new());
    Picture::opaque(3, 2, vec![rgb; 6], Source::Exr).write_exr(&mut bytes, &[]).unwrap();
    fs::write(folder.join(name), bytes.into_inner()).unwrap();
}

fn first_pixel(folder: &Path, name: &str) -> [f32; 3] {
    Picture::read(fs::File::open(folder.join(name)).unwrap(), name, Limits::default()).unwrap().rgb[0]
}

/// Codes of sRGB light (0.4, 0.2, 0.1) as colour-science 0.4.7 gives them: curves and primaries.
#[test]
fn camera_logs_become_light() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (coding, codes) in [
        ("logc3", [0.44927, 0.39671, 0.35018]),
        ("vlog", [0.47756, 0.43661, 0.38174]),
        ("clog2", [0.44943, 0.40895, 0.36816]),
        ("log3g10", [0.37935, 0.34272, 0.31422]),
        ("dlog", [0.45785, 0.40721, 0.36074]),
        ("apple-log", [0.55691, 0.50788, 0.43521]),
        ("nlog", [0.43849, 0.38367, 0.31445]),
    ] {
        flat(folder, "log.exr", codes);
        let said = done(
            folder,
            &[
                "develop",
                "log.exr",
                "light.exr",
                "--approach",
                "clip",
                "--input-coding",
                coding,
                "--input-white",
                "absolute",
            ],
        );
        assert!(said.contains("read as ") && said.contains("full range"), "{said}");
        let light = first_pixel(folder, "light.exr");
        // Codes have five digits.
        for (found, expected) in light.into_iter().zip([0.4, 0.2, 0.1]) {
            assert!((found - expected).abs() < 1e-3, "{coding}: {light:?}");
        }
    }
    // The primaries of --input-space come first.
    flat(folder, "grey.exr", [0.391_007; 3]);
    let line = ["develop", "grey.exr", "light.exr", "--approach", "clip", "--input-coding", "logc3"];
    done(folder, &[&line[..], &["--input-space", "rec2020"]].concat());
    assert!((first_pixel(folder, "light.exr")[1] - 0.18).abs() < 1e-5);
}

/// `bake --ev` and `--scene-white` are in its look.toml, and develop with it does the same; its own --ev takes the place of the look's.
#[test]
fn a_look_s_exposure_and_white_are_developed() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    flat(folder, "card.exr", [0.3, 0.17, 0.06]);
    let look = ["--ev", "1", "--scene-white", "3200,5"];
    let quick = ["bake", "--form", "direct", "--quick", "--out", "look"];
    done(folder, &[&quick[..], &look[..]].concat());
    let said = done(folder, &["develop", "card.exr", "a.exr", "--look", "look/look.toml"]);
    assert!(said.contains("+1.00 EV"), "{said}");
    let a = first_pixel(folder, "a.exr");
    done(folder, &["develop", "card.exr", "b.exr", "--ev", "1", "--scene-white", "3200,5"]);
    let b = first_pixel(folder, "b.exr");
    assert!((0..3).all(|c| (a[c] - b[c]).abs() < 1e-5), "{a:?} {b:?}");
    let said = done(folder, &["develop", "card.exr", "c.exr", "--look", "look/look.toml", "--ev", "0"]);
    assert!(said.contains("+0.00 EV") && first_pixel(folder, "c.exr")[1] < a[1], "{said}");
    assert!(refused(folder, &["bake", "--quick", "--scene-white", "200"]).contains("1667 to 25000 K"));
    assert!(refused(folder, &["bake", "--quick", "--ev", "40"]).contains("ev: found 40"));
}

/// A print of Cineon codes: the table that `bake` writes and what `develop` makes of a scan are the same, and the LAD's grey is at the aim.
#[test]
fn a_scan_is_printed_alone() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let said = done(folder, &["bake", "--camera", "none", "--input-coding", "cineon", "--quick", "--out", "look"]);
    assert!(said.contains("look.cineon.cube") && said.contains("grey of the digital LAD at 445"), "{said}");
    let cube = fs::read_to_string(folder.join("look/look.cineon.cube")).unwrap();
    assert!(cube.contains("LUT_3D_SIZE 65") && !cube.contains("LUT_1D_SIZE"), "{}", &cube[..200]);
    let look = fs::read_to_string(folder.join("look/look.toml")).unwrap();
    assert!(look.contains("camera = \"none\"") && look.contains("print = \"kodak-2383\""), "{look}");
    flat(folder, "lad.exr", [445.0 / 1023.0; 3]);
    for form in ["reference", "plain"] {
        let said = done(folder, &["develop", "lad.exr", "out.exr", "--look", "look/look.toml", "--form", form]);
        assert!(said.contains("read as Cineon codes, full range"), "{said}");
        let grey = first_pixel(folder, "out.exr");
        assert!(grey.iter().all(|v| (v - 0.199_526).abs() < 1e-3), "{form}: {grey:?}");
    }
    for (arguments, expected) in [
        (&["bake", "--camera", "none", "--overexposure", "1"][..], "overexposure changes nothing"),
        (&["bake", "--camera", "none", "--interimage", "none"], "interimage changes nothing"),
        (&["bake", "--camera", "none", "--filters", "70,99"], "filters changes nothing"),
        (&["bake", "--camera", "none", "--scene-white", "3200"], "scene_white changes nothing"),
        (&["bake", "--camera", "none", "--ev", "1"], "ev changes nothing"),
        (&["bake", "--camera", "none", "--input-space", "p3"], "input_space changes nothing"),
        (&["bake", "--camera", "none", "--shaper", "logc4"], "expected shaper cineon instead of logc4"),
        (&["bake", "--camera", "none", "--form", "structured"], "expected form plain"),
        (&["bake", "--camera", "none", "--print", "none"], "such as kodak-2383"),
        (&["bake", "--camera", "none", "--print", "fuji-velvia-50"], "expected a print film"),
        (&["bake", "--camera", "none", "--approach", "first"], "expected approach second"),
        (&["bake", "--camera", "none", "--for", "ffmpeg"], "expected --for resolve"),
        (&["bake", "--shaper", "cineon"], "expected camera none"),
        (&["develop", "lad.exr", "a.png", "--camera", "none", "--ev", "1"], "--points changes the print"),
        (
            &["develop", "lad.exr", "a.png", "--camera", "none", "--input-coding", "logc3"],
            "expected --input-coding cineon",
        ),
        (&["develop", "lad.exr", "a.png", "--input-coding", "cineon"], "expected --camera none with it"),
        (&["certify", "--camera", "none"], "expected a film in the camera"),
    ] {
        let sentence = refused(folder, arguments);
        assert!(sentence.contains(expected), "{arguments:?}: {sentence}");
    }
}

/// PQ and HLG go out as PNG of 16 bits that say so, and PQ comes back as the light it was.
#[test]
fn absolute_light_goes_out() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    flat(folder, "in.exr", [0.4, 0.2, 0.1]);
    let wide = ["--output-space", "rec2020"];
    let develop = |out: &str, coding: &str| {
        done(folder, &[&["develop", "in.exr", out, "--output-coding", coding][..], &wide].concat())
    };
    develop("linear.exr", "linear");
    let said = develop("same.exr", "pq");
    assert!(said.contains("an EXR holds linear light") && said.contains("(1, 1, 1) is 203 cd/m2"), "{said}");
    assert_eq!(first_pixel(folder, "linear.exr"), first_pixel(folder, "same.exr"));
    for (coding, transfer) in [("pq", 16), ("hlg", 18)] {
        develop("out.png", coding);
        let png = fs::read(folder.join("out.png")).unwrap();
        let chunk = png.windows(4).position(|bytes| bytes == b"cICP").unwrap();
        assert_eq!(png[chunk + 4..chunk + 8], [9, transfer, 0, 1]);
        assert!(!png.windows(4).any(|bytes| bytes == b"gAMA") && png[24] == 16);
    }
    develop("pq.png", "pq");
    let back = ["develop", "pq.png", "back.exr", "--approach", "clip", "--input-space", "rec2020"];
    done(folder, &[&back[..], &wide].concat());
    let (back, light) = (first_pixel(folder, "back.exr"), first_pixel(folder, "linear.exr"));
    assert!((0..3).all(|c| (back[c] - light[c]).abs() < 1e-4), "{back:?} {light:?}");
    for (out, more, expected) in [
        ("a.png", &["--bits", "8"][..], "expected --bits 16"),
        ("a.jpg", &[], "only a PNG of 16 bits"),
        ("a.tif", &[], "only a PNG of 16 bits"),
        ("a.png", &["--white-luminance", "0"], "white_luminance: found 0"),
        ("a.png", &["--output-space", "adobe-rgb"], "expected output_space rec2020 or p3"),
    ] {
        let space: &[&str] = if more.contains(&"adobe-rgb") { &[] } else { &wide };
        let sentence = refused(folder, &[&["develop", "in.exr", out, "--output-coding", "pq"], space, more].concat());
        assert!(sentence.contains(expected), "{out} {more:?}: {sentence}");
    }
    let bake = [&["bake", "--quick", "--output-coding", "pq", "--out", "look"][..], &wide].concat();
    let said = done(folder, &[&bake[..], &["--shaper", "logc3", "--size", "17"]].concat());
    assert!(said.contains("look.logc3.cube"), "{said}");
    let cube = fs::read_to_string(folder.join("look/look.logc3.cube")).unwrap();
    assert!(cube.contains("pq coding, 0 to 1 (full range), (1, 1, 1) at 203 cd/m2"), "{}", &cube[..400]);
    assert!(refused(folder, &[&bake[..], &["--form", "direct"]].concat()).contains("codes by a power and not by pq"));
    done(folder, &[&bake[..], &["--form", "structured", "--size", "9"]].concat());
}

/// Options that would change nothing, each refused by its name.
#[test]
fn idle_options_of_bake_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (line, option) in [
        ("--form structured --shaper logc4", "--shaper"),
        ("--form direct --shaper srgb", "--shaper"),
        ("--form direct --size 17", "--size"),
        ("--form direct --storage f16", "--storage"),
        ("--form direct --entries fitted", "--entries"),
        ("--form structured --stops 8", "--stops"),
        ("--shaper logc3 --stops 8", "--stops"),
        ("--shaper vlog --entries fitted", "--entries"),
        ("--form plain --coding display", "--coding"),
        ("--form structured --nodes 8", "--nodes"),
        ("--form structured --unclamped", "--unclamped"),
        ("--approach reinhard --aim sheet", "aim"),
        ("--approach clip --gamut clip", "gamut"),
        ("--approach reinhard --projector xenon", "projector"),
        ("--beam-density 0,0,0", "--beam-density"),
        ("--camera fuji-velvia-50 --points 1,0,0", "points"),
        ("--white-luminance 100", "white_luminance"),
    ] {
        let arguments: Vec<&str> = ["bake", "--quick"].into_iter().chain(line.split(' ')).collect();
        let sentence = refused(folder, &arguments);
        assert!(sentence.contains(option) && sentence.contains("changes nothing"), "{line}: {sentence}");
    }
}
