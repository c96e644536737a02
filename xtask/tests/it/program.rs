//! The program under test, and something to develop.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::{fs, str};

/// The built program.
pub(crate) fn program() -> Command {
    Command::new(env!("CARGO_BIN_EXE_xtask"))
}

/// Names in a folder, sorted.
pub(crate) fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// The files that the repository holds for tests.
pub(crate) fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures")
}

/// A folder with `scene.exr`, the copy of the fixture scene that the repository holds: 160x90.
pub(crate) fn with_scene() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::copy(fixtures().join("scene/scene.exr"), folder.path().join("scene.exr")).unwrap();
    folder
}

/// Most memory that a running process was seen to hold so far, in KiB; 0 where it has ended.
#[cfg(target_os = "linux")]
pub(crate) fn peak_kib(child: &std::process::Child) -> u64 {
    let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
    let held = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    held.and_then(|line| line.trim().trim_end_matches(" kB").parse().ok()).unwrap_or(0)
}

/// The table of scene-linear light that `bake` writes.
pub(crate) const SCENE_CUBE: &str = "look.scene-linear.resolve.cube";

fn xtask(folder: &Path, arguments: &[&str]) -> Output {
    program().args(arguments).current_dir(folder).output().unwrap()
}

/// Runs a command that succeeds; returns what it prints.
pub(crate) fn done(folder: &Path, arguments: &[&str]) -> String {
    let output = xtask(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", str::from_utf8(&output.stderr).unwrap());
    String::from_utf8(output.stdout).unwrap()
}

/// Runs a mistake; returns the sentence.
pub(crate) fn refused(folder: &Path, arguments: &[&str]) -> String {
    let before = names(folder);
    let output = xtask(folder, arguments);
    let sentence = str::from_utf8(&output.stderr).unwrap().to_owned();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {sentence}");
    assert!(sentence.starts_with("error: ") && !sentence.contains("panicked"), "{sentence}");
    let clauses: Vec<&str> = sentence.trim_end().split(": ").collect();
    let once = (1..clauses.len()).all(|i| !clauses[..i].contains(&clauses[i]));
    assert!(once, "says something twice: {sentence}");
    assert_eq!(names(folder), before, "{arguments:?} left something behind");
    sentence
}
