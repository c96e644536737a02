//! Atomic files: what a run writes is complete under its name, or is not there.

mod interrupt;
mod temporary;
#[cfg(test)]
mod tests;
mod unfinished;

use std::{
    fmt,
    fs::{self, File},
    io::{self, BufWriter},
    path::{Path, PathBuf},
};

use anyhow::{Result, anyhow, bail};

use self::temporary::{Temporary, cannot_write, folder_of};
pub(crate) use self::{interrupt::say_when_stopped, temporary::remove_leftovers};

/// Writes the file `path` through a temporary file in the same folder, which takes the name only when it is complete
/// and synced.
///
/// `write` gets a buffered file that can seek. A file that was there before keeps its contents until then, and its
/// permissions afterwards; a symbolic link is followed.
///
/// # Errors
/// One sentence that starts with `path`: the folder does not exist, the name is a folder or a device, the file is
/// write-protected, the disk is full, or what `write` says; a [`NotOfThisFile`] of `write` as it is. Nothing
/// half-written is left, also not where the run is stopped (Ctrl-C, SIGTERM); what a killed one leaves is for
/// [`remove_leftovers`].
pub(crate) fn write_atomically<T>(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> Result<T>) -> Result<T> {
    replace(path, write).map_err(|error| match error.downcast() {
        Ok(NotOfThisFile(error)) => error,
        Err(error) => anyhow!("{}: {error:#}", path.display()),
    })
}

/// An error that is not about the file being written, and keeps its own words.
#[derive(Debug)]
pub(crate) struct NotOfThisFile(pub(crate) anyhow::Error);

impl fmt::Display for NotOfThisFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:#}", self.0)
    }
}

impl std::error::Error for NotOfThisFile {}

/// Files that belong together: all are complete on disk before the first takes its name.
pub(crate) struct AtomicFiles {
    folder: PathBuf,
    files: Vec<(String, Vec<u8>)>,
}

impl AtomicFiles {
    /// No files yet, for an existing folder.
    pub(crate) fn in_folder(folder: &Path) -> Self {
        Self { folder: folder.to_owned(), files: Vec::new() }
    }

    /// Adds a file of the folder, with its contents.
    pub(crate) fn add(&mut self, name: &str, contents: Vec<u8>) {
        self.files.push((name.to_owned(), contents));
    }

    /// Writes all of them; their paths in the order they were added.
    ///
    /// # Errors
    /// As [`write_atomically`]; then no file has been replaced, unless a rename itself fails.
    pub(crate) fn write(self) -> Result<Vec<PathBuf>> {
        let mut ready = Vec::new();
        for (name, contents) in &self.files {
            let path = self.folder.join(name);
            let written = prepare(&path, |file| Ok(io::Write::write_all(file, contents)?));
            ready.push(written.map_err(|error| anyhow!("{}: {error:#}", path.display()))?.1);
        }
        ready.into_iter().map(Ready::take_its_name).collect()
    }
}

/// A complete file that has not taken its name yet; removed if it never does.
struct Ready {
    target: PathBuf,
    temporary: Temporary,
}

impl Ready {
    fn take_its_name(self) -> Result<PathBuf> {
        let target = self.target;
        self.temporary.rename(&target).map_err(|error| anyhow!("{}: {error:#}", target.display()))?;
        Ok(target)
    }
}

fn replace<T>(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> Result<T>) -> Result<T> {
    let (value, ready) = prepare(path, write)?;
    ready.temporary.rename(&ready.target)?;
    Ok(value)
}

fn prepare<T>(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> Result<T>) -> Result<(T, Ready)> {
    let target = Target::find(path)?;
    // Declared before the file so that the file is closed when the name is removed.
    let (temporary, file) = Temporary::create(&target.path, &target.folder)?;
    let mut file = BufWriter::with_capacity(1 << 16, file);
    let value = write(&mut file)?;
    let file = file.into_inner().map_err(|error| cannot_write(error.error()))?;
    if let Some(permissions) = target.permissions {
        file.set_permissions(permissions).map_err(|error| cannot_write(&error))?;
    }
    file.sync_all().map_err(|error| cannot_write(&error))?;
    Ok((value, Ready { target: target.path, temporary }))
}

/// Where the complete file goes.
struct Target {
    path: PathBuf,
    folder: PathBuf,
    permissions: Option<fs::Permissions>,
}

impl Target {
    fn find(path: &Path) -> Result<Self> {
        let existing = match fs::metadata(path) {
            Ok(existing) => existing,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Self::new_in(path),
            Err(error) => return Self::new_in(path).and(Err(cannot_write(&error))),
        };
        if existing.is_dir() {
            bail!("is a folder, expected the name of a file to write");
        }
        // A rename would replace the device itself, not write to it.
        if !existing.is_file() {
            bail!("is not a regular file, expected the name of a file to write");
        }
        if existing.permissions().readonly() {
            bail!("the file exists and is write-protected");
        }
        // A rename onto a symbolic link would replace the link.
        let real = fs::canonicalize(path).map_err(|error| cannot_write(&error))?;
        Ok(Self { permissions: Some(existing.permissions()), ..Self::new_in(&real)? })
    }

    fn new_in(path: &Path) -> Result<Self> {
        if path.file_name().is_none() || path.as_os_str().to_string_lossy().ends_with(['/', '\\']) {
            bail!("is not the name of a file to write");
        }
        let folder = folder_of(path);
        match fs::metadata(folder) {
            Ok(found) if found.is_dir() => {}
            Ok(_) => bail!("cannot be written, as {} is not a folder", folder.display()),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                bail!("cannot be written, as the folder {} does not exist (it is not made for you)", folder.display())
            }
            Err(error) => bail!("cannot be written, as the folder {} cannot be reached: {error}", folder.display()),
        }
        Ok(Self { path: path.to_owned(), folder: folder.to_owned(), permissions: None })
    }
}
