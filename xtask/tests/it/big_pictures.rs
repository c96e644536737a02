//! Pictures of many bands as a user meets them: memory that stays flat, runs that are broken off, damage half way.

use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::{fs, str, thread, time};

use exr::prelude::{
    Compression, Encoding, Image, ImageAttributes, Layer, LayerAttributes, SpecificChannels, Vec2, WritableImage,
};
use half::f16;

#[cfg(target_os = "linux")]
use crate::program::peak_kib;
use crate::program::{names, program};

/// Writes an EXR of half-float grey.
fn write(path: &Path, size: [usize; 2], compression: Compression, grey: impl Fn(usize, usize) -> f32 + Sync) {
    let pixel = |Vec2(x, y): Vec2<usize>| {
        let value = f16::from_f32(grey(x, y));
        (value, value, value)
    };
    let encoding = Encoding { compression, ..Encoding::SMALL_LOSSLESS };
    let channels = SpecificChannels::rgb(pixel);
    let layer = Layer::new((size[0], size[1]), LayerAttributes::default(), encoding, channels);
    Image::new(ImageAttributes::with_size((size[0], size[1])), layer).write().to_file(path).unwrap();
}

fn develop(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = program();
    command.arg("develop").args(arguments).current_dir(folder).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn done(mut command: Command) -> Output {
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", str::from_utf8(&output.stderr).unwrap());
    output
}

/// Width and height of a picture that is 288 MB as `f32` RGB.
const SIZE: [usize; 2] = [6000, 4000];

fn with_big_picture() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    // Rows of one value pack to nothing.
    write(&folder.path().join("big.exr"), SIZE, Compression::RLE, |_, y| y as f32 / 4000.0);
    folder
}

/// Waits until the process ends; the most memory it was seen to hold, in KiB.
#[cfg(target_os = "linux")]
fn peak(child: &mut Child) -> u64 {
    let mut peak = 0;
    while child.try_wait().unwrap().is_none() {
        peak = peak.max(peak_kib(child));
        thread::sleep(time::Duration::from_millis(3));
    }
    peak
}

#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_the_picture() {
    let folder = with_big_picture();
    let whole = (SIZE[0] * SIZE[1] * size_of::<[f32; 3]>() / 1024) as u64;
    let mut child = develop(folder.path(), &["big.exr", "out.png", "--form", "plain"]).spawn().unwrap();
    let peak = peak(&mut child);
    assert!(child.wait().unwrap().success());
    // Three bands, what they are unpacked from and packed to, and the table: 80 MiB. The kernel must have reported a peak.
    assert!(peak > 10_000 && peak < whole / 2, "{peak} KiB, of {whole} KiB in the picture");
}

#[cfg(unix)]
#[test]
fn a_run_that_is_broken_off_leaves_nothing() {
    let folder = with_big_picture();
    let mut child: Child = develop(folder.path(), &["big.exr", "out.png"]).spawn().unwrap();
    let start = time::Instant::now();
    while names(folder.path()).len() < 2 {
        assert!(start.elapsed().as_secs() < 60 && child.try_wait().unwrap().is_none(), "nothing was begun");
        thread::sleep(time::Duration::from_millis(2));
    }
    assert!(names(folder.path())[0].ends_with(".part"));
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(names(folder.path()), ["big.exr"]);
}

#[test]
fn auto_exposure_sees_all_bands_and_no_threads() {
    let folder = tempfile::tempdir().unwrap();
    // Two bands, of which the second is brighter, by less than what the meter leaves out.
    let size = [1100, 1500];
    let grey = |x: usize, y: usize| (1 + x % 7) as f32 * if y < 1000 { 0.1 } else { 0.5 };
    write(&folder.path().join("a.exr"), size, Compression::RLE, grey);
    let logs = (0..size[0] * size[1]).map(|i| f16::from_f32(grey(i % size[0], i / size[0])).to_f64().log2());
    let expected = 0.18_f64.log2() - logs.sum::<f64>() / (size[0] * size[1]) as f64;
    let run = |threads: &str, output: &str| {
        let mut command = develop(folder.path(), &["a.exr", output, "--form", "plain", "--ev", "auto", "--json"]);
        let json: serde_json::Value = serde_json::from_slice(
            &done({
                command.env("RAYON_NUM_THREADS", threads);
                command
            })
            .stdout,
        )
        .unwrap();
        (json["ev"].as_f64().unwrap(), fs::read(folder.path().join(output)).unwrap())
    };
    let (one, three) = (run("1", "one.png"), run("3", "three.png"));
    // The meter counts in steps of 1/256 stop.
    assert!((one.0 - expected).abs() < 1.0 / 256.0, "{} instead of {expected}", one.0);
    assert!(one.0.to_bits() == three.0.to_bits() && one.1 == three.1);
}

#[test]
fn damage_half_way_is_the_inputs_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    write(&path, [1100, 1500], Compression::ZIP16, |x, y| (x * 31 % 97) as f32 + y as f32);
    let mut bytes = fs::read(&path).unwrap();
    let end = bytes.len();
    bytes[end - 400..].fill(0x5a);
    fs::write(&path, bytes).unwrap();
    fs::write(folder.path().join("out.png"), "old").unwrap();
    for (output, ev) in [("out.png", "0"), ("out.exr", "0"), ("out.png", "auto")] {
        let output = develop(folder.path(), &["a.exr", output, "--form", "plain", "--ev", ev]).output().unwrap();
        let sentence = str::from_utf8(&output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{sentence}");
        assert!(sentence.starts_with("error: a.exr: the pixels are damaged"), "{sentence}");
        assert!(!sentence.contains("out.") && sentence.trim_end().lines().count() == 1, "{sentence}");
        assert_eq!(names(folder.path()), ["a.exr", "out.png"]);
        assert_eq!(fs::read(folder.path().join("out.png")).unwrap(), b"old");
    }
}
