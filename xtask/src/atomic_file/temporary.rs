//! Files under a name of their own until they are complete.
//!
//! The name begins with a digest of the name that is wanted, so that a later run finds what a killed one left. A
//! running one holds a lock on its file, which ends with the process: only what no one holds is removed.

use std::{
    collections::{BTreeMap, BTreeSet},
    ffi::OsStr,
    fs::{self, File, OpenOptions, TryLockError},
    io,
    path::{Path, PathBuf},
    sync::atomic::{AtomicU32, Ordering},
};

use anyhow::{Result, anyhow, bail};
use sha2::{Digest, Sha256};

use super::interrupt;
use super::unfinished::{remove_if_left, unfinished};

/// How many names are tried for the temporary file before giving up.
const NAMES_TRIED: u32 = 64;

/// Removes the temporary files that killed runs have left where `outputs` go. Those of running ones stay, and all of
/// them where the folder's file system has no locks.
pub(crate) fn remove_leftovers<'a>(outputs: impl IntoIterator<Item = &'a Path>) {
    let mut wanted: BTreeMap<&Path, BTreeSet<String>> = BTreeMap::new();
    for output in outputs {
        wanted.entry(folder_of(output)).or_default().insert(stem(output));
    }
    for (folder, stems) in wanted {
        // A folder that cannot be read cannot be written either, which the first file will say.
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            let name = entry.file_name();
            if stem_of(&name).is_some_and(|stem| stems.contains(stem)) {
                remove_if_left(&entry.path());
            }
        }
    }
}

/// The folder of a file, as the system takes it.
pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// The name of a file that is removed unless it is renamed.
pub(super) struct Temporary {
    path: Option<PathBuf>,
    /// Holds the lock until the file has its name.
    lock: Option<File>,
}

impl Temporary {
    /// A new file in `folder` that will become `target`.
    pub(super) fn create(target: &Path, folder: &Path) -> Result<(Self, File)> {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        interrupt::watch();
        let stem = stem(target);
        let mut unfinished = unfinished();
        for _ in 0..NAMES_TRIED {
            let number = NUMBER.fetch_add(1, Ordering::Relaxed);
            let path = folder.join(format!("{stem}{}-{number}{ENDING}", std::process::id()));
            // `read`, because some writers seek back and read what they wrote.
            match OpenOptions::new().read(true).write(true).create_new(true).open(&path) {
                // Another run may have taken it for a leftover before it was locked.
                Ok(file) if matches!(file.try_lock(), Err(TryLockError::WouldBlock)) || !path.exists() => {}
                Ok(file) => {
                    unfinished.insert(path.clone());
                    let lock = file.try_clone().ok();
                    return Ok((Self { path: Some(path), lock }, file));
                }
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => {
                    bail!("cannot be written, as no file can be made in the folder {}: {error}", folder.display())
                }
            }
        }
        bail!("cannot be written, as the folder {} is full of old {BEGINNING}*{ENDING} files", folder.display())
    }

    /// Gives the file its name.
    pub(super) fn rename(mut self, target: &Path) -> Result<()> {
        if let Some(path) = &self.path {
            let mut unfinished = unfinished();
            fs::rename(path, target).map_err(|error| cannot_write(&error))?;
            unfinished.remove(path);
        }
        self.path = None;
        Ok(())
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(path) = &self.path {
            let mut unfinished = unfinished();
            unfinished.remove(path);
            self.lock = None;
            // Nothing more can be done: the error that led here is the one to report.
            let _ = fs::remove_file(path);
        }
    }
}

const BEGINNING: &str = ".onelight-";
const ENDING: &str = ".part";
/// Bytes of the digest that stands for a name: a name itself may be as long as a name can be.
const STEM_BYTES: usize = 8;

/// What all temporary files for one name begin with.
fn stem(target: &Path) -> String {
    let name = target.file_name().unwrap_or_default();
    let digest = Sha256::digest(name.as_encoded_bytes());
    let digest: String = digest.iter().take(STEM_BYTES).map(|byte| format!("{byte:02x}")).collect();
    format!("{BEGINNING}{digest}-")
}

/// That beginning of a name of ours.
fn stem_of(name: &OsStr) -> Option<&str> {
    let name = name.to_str()?;
    let rest = name.strip_suffix(ENDING)?;
    rest.get(..BEGINNING.len() + 2 * STEM_BYTES + 1)
}

pub(super) fn cannot_write(error: &io::Error) -> anyhow::Error {
    anyhow!("cannot be written: {error}")
}
