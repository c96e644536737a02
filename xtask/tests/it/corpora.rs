//! The fuzz targets over their corpora: what `fuzz/` does with random bytes, on files that say something.

use std::{fs, panic};

use fuzz::{Met, OneIn};

use crate::program::fixtures;

#[path = "../../../fuzz/src/lib.rs"]
#[allow(dead_code, unreachable_pub, reason = "a library where libFuzzer uses it")]
mod fuzz;

/// Runs a target over its corpus; what is not called `refused-` or `found-` must be read.
fn over(target: &str, check: impl Fn(&[u8]) -> Met + panic::RefUnwindSafe) {
    let folder = fixtures().join("corpus").join(target);
    let mut faults = Vec::new();
    let mut met = 0;
    for entry in fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let bytes = fs::read(&path).unwrap();
        let outcome = panic::catch_unwind(|| check(&bytes)).unwrap_or_else(|_| panic!("{target}/{name}: see above"));
        if !name.starts_with("found-") {
            let expected = if name.starts_with("refused-") { Met::Refused } else { Met::Read };
            if outcome != expected {
                faults.push(format!("{name}: {outcome:?}"));
            }
        }
        met += 1;
    }
    assert!(faults.is_empty(), "{target}: {faults:?}");
    assert!(met > 3, "{met} files in {}", folder.display());
}

#[test]
fn stocks() {
    over("stock", |bytes| fuzz::stock::check(bytes, OneIn(1)));
}

#[test]
fn looks() {
    over("look", |bytes| fuzz::look::check(bytes, OneIn(1)));
}

#[test]
fn tables() {
    over("cube", fuzz::lut::cube);
    over("clf", fuzz::lut::clf);
    over("spi3d", fuzz::lut::spi3d);
    over("direct_json", fuzz::lut::direct_form);
    over("ktx2", fuzz::lut::ktx2);
}

#[test]
fn pictures() {
    over("exr", fuzz::picture::check);
    over("tiff", fuzz::picture::check);
    over("jpeg", fuzz::picture::check);
    over("hdr", fuzz::picture::check);
    over("png", fuzz::picture::check_png);
}
