//! Where things are: the workspace, and what the runner makes in it.

use std::path::{Path, PathBuf};
use std::{env, fs};

use anyhow::{Context, Result};

/// The top of the workspace.
pub(crate) fn workspace() -> PathBuf {
    // Cargo tells where xtask lies when it runs it; a binary by itself works from where it was started.
    let xtask = env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    xtask.as_deref().and_then(Path::parent).map_or_else(|| PathBuf::from("."), Path::to_path_buf)
}

/// `target/onelight/<name>`, made if it is not there.
pub(crate) fn output(name: &str) -> Result<PathBuf> {
    make(&workspace().join("target").join("onelight").join(name))
}

/// A folder the user asked for, made if it is not there.
pub(crate) fn make(folder: &Path) -> Result<PathBuf> {
    fs::create_dir_all(folder).with_context(|| format!("{}: the folder cannot be made", folder.display()))?;
    Ok(folder.to_path_buf())
}

/// A path as the user would write it: relative to where they are, if it lies below.
pub(crate) fn shown(path: &Path) -> String {
    let here = env::current_dir().unwrap_or_default();
    path.strip_prefix(&here).unwrap_or(path).display().to_string()
}
