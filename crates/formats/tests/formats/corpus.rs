//! The small files of `fixtures/corpus`: what was written once is written the same today, byte for byte.

use std::fs;
use std::path::{Path, PathBuf};

use onelight_formats::{ClfProcess, CubeFile, PngDepth, StripGreen, direct_json, hald, spi3d, strip};

fn fixture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures").join(name)
}

fn bytes(name: &str) -> Vec<u8> {
    fs::read(fixture(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn files_of_ours_are_written_the_same_again() {
    for name in ["curve", "table", "both"] {
        let file = bytes(&format!("corpus/cube/{name}.cube"));
        let mut again = Vec::new();
        CubeFile::read(file.as_slice()).unwrap().write(&mut again).unwrap();
        assert!(again == file, "{name}.cube");
    }
    for name in ["plain", "structured"] {
        let file = bytes(&format!("corpus/clf/{name}.clf"));
        let mut again = Vec::new();
        ClfProcess::read(file.as_slice()).unwrap().write(&mut again).unwrap();
        assert!(again == file, "{name}.clf");
    }
    for name in ["two", "three"] {
        let file = bytes(&format!("corpus/spi3d/{name}.spi3d"));
        let mut again = Vec::new();
        spi3d::write(&mut again, &spi3d::read(file.as_slice()).unwrap()).unwrap();
        assert!(again == file, "{name}.spi3d");
    }
    for (name, depth) in [("8", PngDepth::Eight), ("16", PngDepth::Sixteen)] {
        let file = bytes(&format!("corpus/png/hald-{name}.png"));
        let mut again = Vec::new();
        hald::write(&mut again, &hald::read(file.as_slice()).unwrap(), depth, ["hald"]).unwrap();
        assert!(again == file, "hald-{name}.png");
        let file = bytes(&format!("corpus/png/strip-{name}.png"));
        let mut again = Vec::new();
        let table = strip::read(file.as_slice(), StripGreen::Up).unwrap();
        strip::write(&mut again, &table, depth, StripGreen::Up, [""; 0]).unwrap();
        assert!(again == file, "strip-{name}.png");
    }
}

#[test]
fn every_seed_is_read_or_refused_in_one_short_line() {
    let mut read = 0;
    for (folder, refusal) in [
        ("cube", (|bytes| CubeFile::read(bytes).err()) as fn(&[u8]) -> Option<onelight_formats::Error>),
        ("clf", |bytes| ClfProcess::read(bytes).err()),
        ("spi3d", |bytes| spi3d::read(bytes).err()),
        ("direct_json", |bytes| direct_json::read(bytes).err()),
    ] {
        for entry in fs::read_dir(fixture("corpus").join(folder)).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            let error = refusal(&fs::read(&path).unwrap());
            // What was found by fuzzing may be either.
            if !name.starts_with("found-") {
                assert_eq!(error.is_some(), name.starts_with("refused-"), "{folder}/{name}: {error:?}");
            }
            if let Some(error) = error {
                let sentence = error.to_string();
                assert!(!sentence.contains(char::is_control) && sentence.len() < 500, "{sentence}");
            }
            read += 1;
        }
    }
    assert!(read > 30, "{read} files");
}
