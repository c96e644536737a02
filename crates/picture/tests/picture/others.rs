//! What other libraries read is what we read: OpenEXR, and OpenImageIO for the other formats, over the whole corpus.
//!
//! Where they are not installed the test says so and passes; `ONELIGHT_REQUIRE_CLIENTS=1` makes that a failure.
//! `ONELIGHT_PYTHON` names a Python that has `OpenEXR`, `OpenImageIO` and `numpy`.

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::Command,
};

use super::*;

/// How far values may lie apart, by the beginning of a file's name: of the value itself where that is above 1.
const TOLERANCES: [(&str, f32); 4] = [
    // Inverse transforms may be rounded in several ways (ITU-T T.83 lets two codes pass), chroma is drawn out by filters.
    ("jpeg-", 6.0 / 255.0),
    // Half floats of a lossy block, whose last bit depends on the order of its sums.
    ("exr-dwa", 2e-3),
    ("exr-chroma-dwa", 2e-3),
    // Single precision in three steps, here against double.
    ("exr-chroma", 2e-5),
];
const TOLERANCE: f32 = 1e-6;

/// What of the corpus others are known not to read, or to read by another convention.
const LEFT_OUT: [(&str, &str); 3] = [
    ("hdr-exposed.hdr", "OpenImageIO leaves EXPOSURE to the caller"),
    ("hdr-xyz.hdr", "OpenImageIO reads no XYZE"),
    ("tiff-zstd-float.tif", "the wheel's libtiff has no Zstandard: compared with tifffile in `tiff`"),
];

fn corpus() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures/corpus");
    let files = ["exr", "tiff", "png", "jpeg", "hdr"].into_iter().flat_map(|kind| {
        let entries = fs::read_dir(folder.join(kind)).unwrap();
        entries.map(|entry| entry.unwrap().path())
    });
    let name = |path: &Path| path.file_name().unwrap().to_string_lossy().into_owned();
    let mut files: Vec<PathBuf> =
        files.filter(|path| !name(path).starts_with("refused-") && !name(path).starts_with("found-")).collect();
    files.sort();
    files
}

#[test]
fn others_read_the_same_pictures() {
    let python = env::var("ONELIGHT_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    let has = Command::new(&python).args(["-c", "import OpenEXR, OpenImageIO, numpy"]).output();
    if !has.is_ok_and(|output| output.status.success()) {
        assert!(env::var_os("ONELIGHT_REQUIRE_CLIENTS").is_none(), "{python} has no OpenEXR, OpenImageIO and numpy");
        eprintln!("not compared: {python} has no OpenEXR, OpenImageIO and numpy");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/picture/others.py");
    let read = Command::new(&python).arg(script).arg(folder.path()).args(corpus()).output().unwrap();
    assert!(read.status.success(), "{}", String::from_utf8_lossy(&read.stderr));
    let (mut faults, mut compared) = (Vec::new(), 0);
    for path in corpus() {
        let kind = path.parent().unwrap().file_name().unwrap().to_string_lossy();
        let name = format!("{kind}-{}", path.file_name().unwrap().to_string_lossy());
        if LEFT_OUT.iter().any(|(left_out, _)| *left_out == name) {
            continue;
        }
        let Ok(theirs) = fs::read(folder.path().join(format!("{name}.f32"))) else {
            faults.push(format!("{name}: others do not read it"));
            continue;
        };
        let theirs: Vec<f32> = theirs.as_chunks().0.iter().map(|word| f32::from_le_bytes(*word)).collect();
        let ours = read_bytes(&fs::read(&path).unwrap()).unwrap_or_else(|error| panic!("{name}: {error}"));
        let ours = ours.rgb.as_flattened();
        if ours.len() != theirs.len() {
            faults.push(format!("{name}: {} values, others have {}", ours.len(), theirs.len()));
            continue;
        }
        let tolerance =
            TOLERANCES.iter().find(|(start, _)| name.starts_with(start)).map_or(TOLERANCE, |(_, most)| *most);
        let apart = |(a, b): (&f32, &f32)| {
            if a == b || a.is_nan() && b.is_nan() { 0.0 } else { (a - b).abs() / b.abs().max(1.0) }
        };
        let most = ours.iter().zip(&theirs).map(apart).fold(0.0, f32::max);
        if most.is_nan() || most > tolerance {
            faults.push(format!("{name}: {most:e} apart, expected at most {tolerance:e}"));
        }
        compared += 1;
    }
    assert!(faults.is_empty() && compared > 100, "{compared} files, {}", faults.join("\n"));
}
