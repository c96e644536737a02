//! Where things are: the workspace, and what the runner makes in it.

use std::path::{Path, PathBuf};
use std::{env, fs};

use anyhow::{Context, Result, anyhow, bail};

/// The top of the workspace.
///
/// # Errors
/// If neither Cargo nor the current folder leads to it.
pub(crate) fn workspace() -> Result<PathBuf> {
    found().ok_or_else(|| anyhow!("run this inside the onelight workspace"))
}

/// `target/onelight/<name>`, made if it is not there.
pub(crate) fn output(name: &str) -> Result<PathBuf> {
    let top = found().ok_or_else(|| anyhow!("run this inside the onelight workspace, or name --out"))?;
    make(&top.join("target").join("onelight").join(name))
}

fn found() -> Option<PathBuf> {
    // Cargo tells where xtask lies when it runs it; a binary by itself looks around from where it was started.
    let xtask = env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    let named = xtask.as_deref().and_then(Path::parent).filter(|folder| is_workspace(folder));
    let here = env::current_dir().unwrap_or_default();
    named.or_else(|| here.ancestors().find(|folder| is_workspace(folder))).map(Path::to_path_buf)
}

fn is_workspace(folder: &Path) -> bool {
    let manifest = || fs::read_to_string(folder.join("Cargo.toml")).unwrap_or_default();
    folder.join("xtask").is_dir() && manifest().lines().any(|line| line.trim() == "[workspace]")
}

/// A folder the user asked for, made if it is not there.
pub(crate) fn make(folder: &Path) -> Result<PathBuf> {
    if folder.exists() && !folder.is_dir() {
        bail!("{}: is a file, expected a folder", folder.display());
    }
    fs::create_dir_all(folder).with_context(|| format!("{}: the folder cannot be made", folder.display()))?;
    Ok(folder.to_path_buf())
}

/// A path as the user would write it: relative to where they are, if it lies below.
pub(crate) fn shown(path: &Path) -> String {
    let here = env::current_dir().unwrap_or_default();
    let below = path.strip_prefix(&here).or_else(|_| path.strip_prefix(".")).unwrap_or(path);
    if below.as_os_str().is_empty() { ".".to_owned() } else { below.display().to_string() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_shown_as_the_user_would_write_them() {
        let here = env::current_dir().unwrap();
        for (path, expected) in [
            (here.join("a/look.cube"), "a/look.cube"),
            (here.clone(), "."),
            (PathBuf::from("./a/look.cube"), "a/look.cube"),
            (PathBuf::from("."), "."),
            (PathBuf::from("a/look.cube"), "a/look.cube"),
            (PathBuf::from("../look.cube"), "../look.cube"),
            (PathBuf::from("/elsewhere/look.cube"), "/elsewhere/look.cube"),
        ] {
            assert_eq!(shown(&path), expected);
        }
    }

    #[test]
    fn a_workspace_has_a_manifest_that_says_so_and_this_crate() {
        let folder = tempfile::tempdir().unwrap();
        let manifest = folder.path().join("Cargo.toml");
        assert!(!is_workspace(folder.path()));
        fs::create_dir(folder.path().join("xtask")).unwrap();
        assert!(!is_workspace(folder.path()));
        fs::write(&manifest, "[package]\n# no [workspace]\n").unwrap();
        assert!(!is_workspace(folder.path()));
        fs::write(&manifest, "[workspace]\nmembers = []\n").unwrap();
        assert!(is_workspace(folder.path()));
    }
}
