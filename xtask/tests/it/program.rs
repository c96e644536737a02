//! The program under test, and something to develop.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

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
