//! Pictures as people have them: what a file says is used, and what was chosen is told.

use std::fs;
use std::io::Cursor;
use std::path::Path;

use onelight_picture::{Chromaticities, Limits, Picture, Source, Transfer};

use crate::program::{fixtures, program, with_scene};

/// Develops exactly; returns what was said.
fn developed(folder: &Path, arguments: &[&str]) -> String {
    let output =
        program().args(["develop", "--form", "reference"]).args(arguments).current_dir(folder).output().unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn read(folder: &Path, name: &str) -> Picture {
    Picture::read(fs::File::open(folder.join(name)).unwrap(), name, Limits::default()).unwrap()
}

/// Writes an EXR whose every pixel is the same.
fn flat(folder: &Path, name: &str, rgb: [f32; 3], alpha: Option<f32>, primaries: Option<Chromaticities>) {
    let picture = Picture {
        alpha: alpha.map(|alpha| vec![alpha; 6]),
        primaries,
        ..Picture::opaque(3, 2, vec![rgb; 6], Source::Exr)
    };
    let mut bytes = Cursor::new(Vec::new());
    picture.write_exr(&mut bytes, &[]).unwrap();
    fs::write(folder.join(name), bytes.into_inner()).unwrap();
}

const SPACES: [&str; 9] = ["srgb", "p3", "rec2020", "adobe-rgb", "prophoto", "dci-p3", "acescg", "aces2065-1", "xyz"];

/// A developed picture that is developed again without a film is what it was, to one code of 65535. Where the curve is
/// infinitely steep, at black, the rounding of 32-bit floats is more than a code: there the light differs by less than 1e-7.
#[test]
fn our_own_pictures_come_back() {
    let folder = with_scene();
    let folder = folder.path();
    for space in SPACES {
        for coding in ["srgb", "gamma24", "linear"] {
            let options = ["--approach", "clip", "--bits", "16", "--output-space", space, "--output-coding", coding];
            developed(folder, &[&["scene.exr", "a.png", "--ev", "1"], &options[..]].concat());
            let said = developed(folder, &[&["a.png", "b.png"], &options[..]].concat());
            assert!(said.contains("note: read as ") && !said.contains("taken for sRGB"), "{said}");
            let [a, b] = ["a.png", "b.png"].map(|name| read(folder, name));
            let transfer = a.transfer.clone().unwrap();
            for (a, b) in a.rgb.iter().zip(&b.rgb) {
                let light = [a, b].map(|rgb| transfer.light(*rgb));
                for channel in 0..3 {
                    let codes = (a[channel] - b[channel]).abs() * 65_535.0;
                    let apart = (light[0][channel] - light[1][channel]).abs();
                    assert!(codes < 1.5 || apart < 1e-7, "{space}, {coding}: {a:?} {b:?}");
                }
            }
            assert_eq!(a.primaries, b.primaries);
        }
    }
}

/// The same for the other kinds of file. Profiles hold the primaries in 16 bits after the point, which moves light by up to 6e-5 of
/// white; where a curve is steep, that is more in values.
#[test]
fn our_own_tiffs_and_jpegs_come_back() {
    let folder = with_scene();
    let folder = folder.path();
    const LIGHT: f32 = 6e-5;
    for (first, second, most, codings, more) in [
        ("a.tif", "b.tif", 1.5 / 65_535.0, &["srgb", "gamma24"][..], &[][..]),
        ("c.tif", "d.tif", 1.5 / 255.0, &["srgb", "gamma24"], &["--bits", "8", "--dither", "none"]),
        ("e.tif", "f.tif", 1e-5, &["linear"], &["--bits", "float"]),
        ("a.exr", "b.exr", 1e-5, &["linear"], &[]),
        ("a.jpg", "b.jpg", 5.0 / 255.0, &["srgb", "gamma24"], &["--quality", "100"]),
        ("e.png", "f.png", 0.5 / 255.0, &["srgb", "gamma24"], &["--dither", "none"]),
    ] {
        for (space, coding) in SPACES.iter().flat_map(|space| codings.iter().map(move |coding| (space, coding))) {
            let options = [&["--approach", "clip", "--output-space", space, "--output-coding", coding], more].concat();
            developed(folder, &[&["scene.exr", first, "--ev", "-1"], &options[..]].concat());
            let said = developed(folder, &[&[first, second], &options[..]].concat());
            assert!(!said.contains("taken for"), "{said}");
            let [a, b] = [first, second].map(|name| read(folder, name));
            assert!(a.primaries.unwrap().is_near(&b.primaries.unwrap()));
            let transfer = a.transfer.clone().unwrap_or(Transfer::Linear);
            for (a, b) in a.rgb.iter().zip(&b.rgb) {
                let light = [a, b].map(|rgb| transfer.light(*rgb));
                let far = |channel: usize| {
                    (a[channel] - b[channel]).abs() > most && (light[0][channel] - light[1][channel]).abs() > LIGHT
                };
                assert!(!(0..3).any(far), "{first}, {space}, {coding}: {a:?} {b:?}");
            }
        }
    }
}

#[test]
fn what_a_file_says_of_its_colours_is_used_and_told() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (file, expected) in [
        ("jpeg/display-p3.jpg", "read as Display P3 primaries, sRGB-coded, by the ICC profile `Display P3`"),
        ("jpeg/baseline.jpg", "taken for sRGB"),
        ("tiff/linear-rec2020.tif", "read as BT.2020 primaries, linear, by the ICC profile `Linear Rec2020`"),
        ("png/cicp-pq-16.png", "read as BT.2020 primaries, PQ-coded, white at 203 cd/m2, by the PNG's cICP"),
        ("png/gama-linear-16.png", "read as linear, by the PNG's gAMA"),
        ("tiff/rawtherapee-without-profile.tif", "read as sRGB primaries, sRGB-coded, by its writer, RawTherapee"),
        (
            "tiff/exif-adobe-rgb.tif",
            "read as Adobe RGB primaries, coded by a power of 1/2.1992, by the EXIF colour space",
        ),
        ("tiff/exif-beside-floats.tif", "does not say what its floats are: taken for linear light"),
        ("exr/chroma-zip.exr", "made red, green and blue of luminance and chroma"),
        ("exr/lone-channel.exr", "read the only channel, `V`, as grey"),
        ("hdr/xyz.hdr", "the file's values are the light's CIE XYZ"),
    ] {
        let path = fixtures().join("corpus").join(file);
        let said = developed(folder, &[path.to_str().unwrap(), "out.png", "--approach", "clip"]);
        assert!(said.contains(expected), "{said}");
    }
    let jpeg = fixtures().join("corpus/jpeg/display-p3.jpg");
    let said = developed(folder, &[jpeg.to_str().unwrap(), "out.png"]);
    assert!(said.contains("a JPEG is a finished picture") && !said.contains("film on film"), "{said}");
    assert!(developed(folder, &["out.png", "again.png"]).contains("developed already: this is film on film"));
    // The command line comes first.
    let path = fixtures().join("corpus/png/gama-linear-16.png");
    let path = path.to_str().unwrap();
    let said = developed(folder, &[path, "out.png", "--approach", "clip", "--input-coding", "srgb"]);
    assert!(said.contains("the file's own coding gives way to --input-coding srgb"), "{said}");
}

/// One light in several spaces is one colour where white is taken absolutely.
#[test]
fn white_is_relative_or_absolute() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    // D65 light of luminance 0.5, in XYZ and in ACEScg.
    let (x, y) = (0.3127_f32, 0.3290_f32);
    let xyz = [0.5 * x / y, 0.5, 0.5 * (1.0 - x - y) / y];
    flat(folder, "xyz.exr", xyz, None, Some(Chromaticities::XYZ));
    flat(folder, "srgb.exr", [0.5; 3], None, Some(Chromaticities::BT709));
    flat(folder, "acescg.exr", [0.5; 3], None, Some(Chromaticities::AP1));
    let out = |name: &str, white: &str| {
        developed(folder, &[name, "out.exr", "--approach", "clip", "--input-white", white]);
        read(folder, "out.exr").rgb[0]
    };
    let near = |a: [f32; 3], b: [f32; 3]| (0..3).all(|channel| (a[channel] - b[channel]).abs() < 1e-4);
    assert!(near(out("srgb.exr", "absolute"), [0.5; 3]));
    assert!(near(out("xyz.exr", "absolute"), [0.5; 3]), "{:?}", out("xyz.exr", "absolute"));
    assert!(near(out("acescg.exr", "relative"), [0.5; 3]));
    // ACES white is warmer and greener than D65.
    let [red, green, blue] = out("acescg.exr", "absolute");
    assert!(red > blue + 0.005 && green > blue + 0.005, "{red} {green} {blue}");
}

#[test]
fn alpha_that_is_0_over_colour_counts_as_opaque() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    flat(folder, "a.exr", [0.18; 3], Some(0.0), None);
    let said = developed(folder, &["a.exr", "a.png", "--approach", "clip", "--ev", "auto"]);
    assert!(said.contains("the alpha is 0 everywhere, over colour: the picture counts as opaque"), "{said}");
    assert!(said.contains("0.00 EV"), "{said}");
    let picture = read(folder, "a.png");
    assert!(picture.alpha.is_none() && picture.rgb[0][0] > 0.4);
    let kept = developed(folder, &["a.exr", "a.png", "--approach", "clip", "--background", "none"]);
    assert!(!kept.contains("opaque") && read(folder, "a.png").alpha.unwrap()[0] == 0.0);
}

#[test]
fn light_without_coverage_is_developed_over_what_lies_behind() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    // Two thirds are covered by half; in the last third only light is.
    let picture = Picture {
        alpha: Some(vec![0.5, 0.5, 0.0]),
        ..Picture::opaque(3, 1, vec![[0.4; 3], [0.4; 3], [0.25; 3]], Source::Exr)
    };
    let mut bytes = Cursor::new(Vec::new());
    picture.write_exr(&mut bytes, &[]).unwrap();
    fs::write(folder.join("glow.exr"), bytes.into_inner()).unwrap();
    let linear = |arguments: &[&str]| {
        let said = developed(folder, &[&["glow.exr", "out.exr", "--approach", "clip"], arguments].concat());
        (said, read(folder, "out.exr"))
    };
    let near = |picture: &Picture, expected: [f32; 3]| {
        picture.rgb.iter().zip(expected).for_each(|(rgb, v)| assert!((rgb[1] - v).abs() < 1e-5, "{rgb:?} {v}"));
    };
    let (said, black) = linear(&[]);
    assert!(said.contains("1 of 3 pixels are light without coverage") && black.alpha.is_none(), "{said}");
    near(&black, [0.2, 0.2, 0.25]);
    let (_, grey) = linear(&["--background", "0.1,0.1,0.1"]);
    near(&grey, [0.25, 0.25, 0.35]);
    let (_, kept) = linear(&["--background", "none"]);
    near(&kept, [0.4, 0.4, 0.25]);
    assert_eq!(kept.alpha.unwrap(), [0.5, 0.5, 0.0]);
}

#[test]
fn layers_are_chosen_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let path = fixtures().join("corpus/exr/parts.exr");
    let path = path.to_str().unwrap();
    let said = developed(folder, &[path, "out.png", "--approach", "clip"]);
    assert!(
        said.contains("note: read ") && said.contains("the file names no primaries: taken for those of srgb"),
        "{said}"
    );
    let said = developed(folder, &[path, "out.png", "--approach", "clip", "--input-space", "rec2020"]);
    assert!(!said.contains("names no primaries"), "{said}");
    let layers = fixtures().join("corpus/exr/layers-of-blender.exr");
    let said = developed(folder, &[layers.to_str().unwrap(), "out.png", "--approach", "clip"]);
    assert!(said.contains("read the layer `ViewLayer.Combined`; there are also `ViewLayer.AO`"), "{said}");
    assert!(said.contains("(--layer or --part chooses another)"), "{said}");
    let output =
        program().args(["develop", path, "out.png", "--layer", "no such"]).current_dir(folder).output().unwrap();
    let sentence = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.code() == Some(2) && sentence.contains("there is no layer `no such`"), "{sentence}");
}

#[test]
fn pictures_outside_of_their_frame_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let mut picture = Picture::opaque(3, 2, vec![[0.5; 3]; 6], Source::Exr);
    picture.windows.data_origin = [10, 0];
    let mut bytes = Cursor::new(Vec::new());
    picture.write_exr(&mut bytes, &[]).unwrap();
    fs::write(folder.join("a.exr"), bytes.into_inner()).unwrap();
    let said = developed(folder, &["a.exr", "a.png", "--approach", "clip"]);
    assert!(said.contains("outside of its display window"), "{said}");
    flat(folder, "b.exr", [0.18; 3], Some(f32::NAN), None);
    let said = developed(folder, &["b.exr", "b.png", "--approach", "clip"]);
    assert!(said.contains("the alpha of 6 pixels is NaN or infinite"), "{said}");
}

#[test]
fn exif_and_attributes_are_kept_unless_they_are_not_wanted() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let corpus = |name: &str| fixtures().join("corpus").join(name).to_str().unwrap().to_owned();
    let has = |name: &str, text: &str| {
        fs::read(folder.join(name)).unwrap().windows(text.len()).any(|window| window == text.as_bytes())
    };
    for (from, to, text) in [
        ("jpeg/phone.jpg", "a.jpg", "Phone 1"),
        ("jpeg/phone.jpg", "a.png", "2026:01:02 03:04:05"),
        ("jpeg/phone.jpg", "a.tif", "a walk"),
        ("exr/attributes.exr", "a.exr", "RenderTime"),
    ] {
        let from = corpus(from);
        developed(folder, &[&from, to, "--approach", "clip"]);
        assert!(has(to, text) && has(to, "onelight look"), "{to}");
        developed(folder, &[&from, to, "--approach", "clip", "--metadata", "none"]);
        assert!(!has(to, text) && has(to, "onelight look"), "{to}");
    }
    // What was turned is not turned again.
    let said = developed(folder, &[&corpus("jpeg/phone.jpg"), "b.jpg", "--approach", "clip"]);
    assert!(said.contains("turned the picture upright"), "{said}");
    let said = developed(folder, &["b.jpg", "c.jpg", "--approach", "clip"]);
    assert!(!said.contains("upright"), "{said}");
}

/// Each refusal names what was typed, and what to type instead.
#[test]
fn refusals_name_the_way_out() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let none = Chromaticities { red: [0.0; 2], green: [0.0; 2], blue: [0.0; 2], white: [0.0; 2] };
    flat(folder, "a.exr", [0.18; 3], None, Some(none));
    for (options, expected) in [
        (&[][..], "expected --input-space with the space that is meant"),
        (&["--max-pixels", "5"], "(--max-pixels allows more)"),
        (&["--contrast", "1.5"], "contrast: a control of approach first"),
        (&["--temperature", "5000", "--saturation", "2"], "temperature, saturation: a control of approach first"),
        (&["--curve=-2:0.2,0:0.5"], "curve: a control of approach first"),
    ] {
        let output = program().args(["develop", "a.exr", "a.png"]).args(options).current_dir(folder).output().unwrap();
        let sentence = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(2) && sentence.contains(expected), "{options:?}: {sentence}");
    }
    developed(folder, &["a.exr", "a.png", "--approach", "clip", "--input-space", "srgb"]);
}
