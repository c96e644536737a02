//! Programs that load our files give what we give: OpenColorIO, on the processor and as a shader, and ffmpeg.
//!
//! Where a program is not installed its test says so and passes; `ONELIGHT_REQUIRE_CLIENTS=1` makes that a failure.
//! `ONELIGHT_PYTHON` names a Python that has `opencolorio`, `numpy` and `moderngl`.

use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::BufReader;
use std::path::Path;
use std::process::Command;

use onelight::lut::{Interpolation, SceneSampler, Shaper};
use onelight_formats::{ClfProcess, CubeFile, spi3d};

use crate::program::program;

/// Colours that every file is tried on.
const COLOURS: usize = 10_000;

/// Files that take scene-linear light.
const SCENE_CUBE: &str = "look.scene-linear.resolve.cube";
const SCENE_CLF: &str = "look.scene-linear.clf";
/// It takes what the shaper of the configuration beside it gives.
const SPI3D: &str = "look.log2-shaper.spi3d";

fn bake(folder: &Path, arguments: &[&str]) {
    let out = folder.to_string_lossy();
    let mut command = program();
    let output = command.arg("bake").args(arguments).args(["--out", &out]).output().unwrap();
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
}

fn open(path: &Path) -> BufReader<File> {
    BufReader::new(File::open(path).unwrap())
}

/// Shadows, highlights and what lies between; black, negatives, light beyond every range.
fn colours() -> Vec<[f32; 3]> {
    let hard = [[0.0; 3], [1e-6; 3], [1e-3; 3], [50.0; 3], [1e4, 0.2, 0.0], [-0.1, 0.5, 0.5], [1e-3, 50.0, 0.18]];
    let drawn = SceneSampler::with_seed(-10.0..=10.0, 5).unwrap().take(COLOURS - hard.len());
    hard.into_iter().chain(drawn.map(|rgb| rgb.map(|v| v as f32))).collect()
}

fn required() -> bool {
    std::env::var_os("ONELIGHT_REQUIRE_CLIENTS").is_some()
}

/// What we make of a colour.
type Apply<'a> = &'a dyn Fn([f32; 3]) -> [f32; 3];

/// Writes what we make of the colours, and lets OpenColorIO try.
fn try_in_opencolorio(folder: &Path, files: &[(&str, Apply)]) {
    let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
    let mut probes = format!("# r g b {}\n", names.join(" "));
    for rgb in colours() {
        let row = std::iter::once(rgb).chain(files.iter().map(|(_, apply)| apply(rgb)));
        let numbers: Vec<String> = row.flatten().map(|v| format!("{v:e}")).collect();
        writeln!(probes, "{}", numbers.join(" ")).unwrap();
    }
    fs::write(folder.join("probes.txt"), probes).unwrap();
    let python = std::env::var("ONELIGHT_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/clients.py");
    let mut command = Command::new(&python);
    command.arg(script).arg(folder);
    if required() {
        command.arg("--require");
    }
    match command.output() {
        Ok(output) => {
            let said = String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
            println!("{said}");
            assert!(output.status.success(), "{said}");
        }
        Err(error) if required() => panic!("{python}: {error}"),
        Err(error) => println!("skipped: {python}: {error}"),
    }
}

#[test]
fn opencolorio_gives_what_we_give() {
    for camera in ["kodak-5207", "fuji-velvia-50"] {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        bake(folder, &["--camera", camera, "--for", "ocio", "--quick"]);
        let film = onelight::Process::for_camera(camera).unwrap().compile().unwrap();
        let structured = film.structured(&onelight::StructuredSettings::default()).unwrap();
        let clf = ClfProcess::read(open(&folder.join(SCENE_CLF))).unwrap();
        for rgb in colours() {
            let (ours, read) = (structured.apply(rgb), clf.apply(rgb));
            // The file holds the inter-image effect in a table of 33 nodes.
            assert!((0..3).all(|c| (ours[c] - read[c]).abs() < 2e-3), "{rgb:?}: {ours:?} and {read:?}");
        }
        try_in_opencolorio(folder, &[(SCENE_CLF, &|rgb| clf.apply(rgb)), ("look.ocio", &|rgb| clf.apply(rgb))]);

        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        bake(folder, &["--camera", camera, "--stops", "6", "--format", "cube,clf,spi3d", "--quick"]);
        let cube = CubeFile::read(open(&folder.join(SCENE_CUBE))).unwrap();
        let clf = ClfProcess::read(open(&folder.join(SCENE_CLF))).unwrap();
        let table = spi3d::read(File::open(folder.join(SPI3D)).unwrap()).unwrap();
        assert_eq!(&table, cube.lut3d().unwrap());
        let apply_cube = |rgb| cube.apply(rgb, Interpolation::Tetrahedral);
        let apply_clf = |rgb| clf.apply(rgb);
        try_in_opencolorio(
            folder,
            &[(SCENE_CUBE, &apply_cube), (SCENE_CLF, &apply_clf), ("look.scene-linear.ocio", &apply_clf)],
        );
    }
}

#[test]
fn ffmpeg_gives_what_we_give() {
    const SIZE: u32 = 100;
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    bake(folder, &["--shaper", "srgb", "--size", "33", "--quick"]);
    let cube = CubeFile::read(open(&folder.join("look.srgb.cube"))).unwrap();
    let shaper = Shaper::log2(0.02, 11.52).unwrap();
    let colours = colours();
    let code = |v: f32| (shaper.encode(f64::from(v)) * 65535.0).round() as u16;
    let input = image::ImageBuffer::from_fn(SIZE, SIZE, |x, y| image::Rgb(colours[(y * SIZE + x) as usize].map(code)));
    input.save(folder.join("in.png")).unwrap();
    // Planar 16 bit all the way: no other rounding than the filter's own.
    let arguments = [
        "-v",
        "error",
        "-i",
        "in.png",
        "-vf",
        "format=gbrp16le,lut3d=look.srgb.cube:interp=tetrahedral",
        "-pix_fmt",
        "rgb48be",
        "out.png",
    ];
    let output = match Command::new("ffmpeg").args(arguments).current_dir(folder).output() {
        Ok(output) => output,
        Err(error) if required() => panic!("ffmpeg: {error}"),
        Err(error) => return println!("skipped: ffmpeg: {error}"),
    };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let theirs = image::open(folder.join("out.png")).unwrap().to_rgb16();
    let mut largest = 0.0f32;
    for (pixel, result) in input.pixels().zip(theirs.pixels()) {
        let ours = cube.apply(pixel.0.map(|v| f32::from(v) / 65535.0), Interpolation::Tetrahedral);
        for (ours, theirs) in ours.into_iter().zip(result.0) {
            largest = largest.max((ours.clamp(0.0, 1.0) * 65535.0 - f32::from(theirs)).abs());
        }
    }
    println!("ffmpeg: largest difference {largest:.2} of 65535");
    // ffmpeg cuts off where we round: up to one code.
    assert!(largest < 1.01, "{largest} codes of 16 bit");
}

#[test]
fn every_format_is_written_where_it_fits() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (arguments, files) in [
        (&["--shaper", "srgb", "--format", "hald", "--size", "16"][..], &["look.srgb.hald.png"][..]),
        (
            &["--shaper", "srgb", "--format", "unreal,unity,godot", "--size", "16"],
            &["look.srgb.unreal.png", "look.srgb.unity.png", "look.srgb.godot.png"],
        ),
        (&["--shaper", "bevy", "--format", "ktx2", "--size", "16"], &["look.bevy.ktx2"]),
        (&["--format", "ktx2", "--size", "16"], &["look.log2-shaper.ktx2"]),
        (&["--shaper", "logc4", "--format", "3dl"], &["look.logc4.3dl"]),
        (&["--shaper", "slog3", "--format", "vlt"], &["look.slog3.vlt"]),
        (
            &["--shaper", "logc4", "--format", "cube,clf,spi3d", "--size", "9"],
            &["look.logc4.cube", "look.logc4.clf", "look.logc4.spi3d"],
        ),
        (&["--form", "structured", "--size", "9", "--storage", "unorm10", "--coding", "display"], &[SCENE_CLF]),
    ] {
        bake(folder, &[arguments, &["--quick"]].concat());
        for file in files.iter().chain(&["look.toml"]) {
            assert!(folder.join(file).is_file(), "{arguments:?}: {file}");
            fs::remove_file(folder.join(file)).unwrap();
        }
    }
    // What comes beside the files of any format.
    bake(folder, &["--shaper", "slog3", "--format", "vlt"]);
    for file in ["look.slog3.vlt", "look.json", "look.toml", "preview.png", "chart.png"] {
        assert!(folder.join(file).is_file(), "{file}");
    }
}
