//! Whole files or none: what a run writes is complete under its name, or is not there.

use std::{
    collections::BTreeSet,
    fmt,
    fs::{self, File, OpenOptions},
    io::{self, BufWriter},
    path::{Path, PathBuf},
    sync::{
        Mutex, MutexGuard, Once, PoisonError,
        atomic::{AtomicU32, Ordering},
    },
};

use anyhow::{Result, anyhow, bail};

/// How many names are tried for the temporary file before giving up.
const NAMES_TRIED: u32 = 64;

/// Writes the file `path` through a temporary file in the same folder, which takes the name only when it is complete
/// and synced.
///
/// `write` gets a buffered file that can seek. A file that was there before keeps its contents until then, and its
/// permissions afterwards; a symbolic link is followed.
///
/// # Errors
/// One sentence that starts with `path`: the folder does not exist, the name is a folder or a device, the file is
/// write-protected, the disk is full, or what `write` says; a [`NotOfThisFile`] of `write` as it is. Nothing
/// half-written is left, also not where the run is interrupted (Ctrl-C).
pub(crate) fn write_whole<T>(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> Result<T>) -> Result<T> {
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
pub(crate) struct WholeSet {
    folder: PathBuf,
    files: Vec<(String, Vec<u8>)>,
}

impl WholeSet {
    /// No files yet, for an existing folder.
    pub(crate) fn in_folder(folder: &Path) -> Self {
        Self { folder: folder.to_owned(), files: Vec::new() }
    }

    /// Adds a file.
    pub(crate) fn add(&mut self, name: &str, contents: Vec<u8>) {
        self.files.push((name.to_owned(), contents));
    }

    /// Writes all of them; their paths in the order they were added.
    ///
    /// # Errors
    /// As [`write_whole`]; then no file has been replaced, unless a rename itself fails.
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
    let (temporary, file) = Temporary::create(&target.folder)?;
    let mut file = BufWriter::with_capacity(1 << 16, file);
    let value = write(&mut file)?;
    let file = file.into_inner().map_err(|error| cannot_write(error.error()))?;
    if let Some(permissions) = target.permissions {
        file.set_permissions(permissions).map_err(|error| cannot_write(&error))?;
    }
    file.sync_all().map_err(|error| cannot_write(&error))?;
    Ok((value, Ready { target: target.path, temporary }))
}

/// Where the finished file goes.
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
        let folder = match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
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

/// The temporary files that exist, to be removed where the run is interrupted.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn unfinished() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What a shell reports for a program that Ctrl-C ended.
const INTERRUPTED: i32 = 130;

/// Makes an interruption remove what is unfinished. Without it, files stay: nothing else is lost.
fn remove_when_interrupted() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let _ = ctrlc::set_handler(|| {
            // Kept locked, so that no file is made or named any more.
            let paths = unfinished();
            for path in paths.iter() {
                let _ = fs::remove_file(path);
            }
            std::process::exit(INTERRUPTED);
        });
    });
}

/// The name of a file that is removed unless it is renamed.
struct Temporary {
    path: Option<PathBuf>,
}

impl Temporary {
    fn create(folder: &Path) -> Result<(Self, File)> {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        remove_when_interrupted();
        let mut unfinished = unfinished();
        for _ in 0..NAMES_TRIED {
            let number = NUMBER.fetch_add(1, Ordering::Relaxed);
            let path = folder.join(format!(".onelight-{}-{number}.part", std::process::id()));
            // `read`, because some writers seek back and read what they wrote.
            match OpenOptions::new().read(true).write(true).create_new(true).open(&path) {
                Ok(file) => {
                    unfinished.insert(path.clone());
                    return Ok((Self { path: Some(path) }, file));
                }
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => {
                    bail!("cannot be written, as no file can be made in the folder {}: {error}", folder.display())
                }
            }
        }
        bail!("cannot be written, as the folder {} is full of old .onelight-*.part files", folder.display())
    }

    fn rename(mut self, target: &Path) -> Result<()> {
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
            // Nothing more can be done: the error that led here is the one to report.
            let _ = fs::remove_file(path);
        }
    }
}

fn cannot_write(error: &io::Error) -> anyhow::Error {
    anyhow!("cannot be written: {error}")
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_appears_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        let seen_while_writing = write_whole(&path, |file| {
            file.write_all(b"one")?;
            Ok(path.exists())
        })
        .unwrap();
        assert!(!seen_while_writing);
        assert_eq!(fs::read(&path).unwrap(), b"one");
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn a_failure_leaves_the_old_file_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        fs::write(&path, b"old").unwrap();
        let error = write_whole(&path, |file| -> Result<()> {
            file.write_all(&[0; 100_000])?;
            bail!("the film tore")
        })
        .unwrap_err();
        assert_eq!(error.to_string(), format!("{}: the film tore", path.display()));
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn a_set_appears_whole_or_not_at_all() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("c")).unwrap();
        let set = |last: &str| {
            let mut set = WholeSet::in_folder(folder.path());
            ["a", "b", last].into_iter().for_each(|name| set.add(name, name.as_bytes().to_vec()));
            set.write()
        };
        assert!(set("c").unwrap_err().to_string().contains("is a folder"));
        assert_eq!(names(folder.path()), ["c"]);
        assert_eq!(set("d").unwrap().len(), 3);
        assert_eq!(names(folder.path()), ["a", "b", "c", "d"]);
    }

    #[test]
    fn a_panic_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        let outcome = std::panic::catch_unwind(|| {
            write_whole(&path, |_| -> Result<()> { std::panic::resume_unwind(Box::new(())) })
        });
        assert!(outcome.is_err());
        assert!(names(folder.path()).is_empty());
    }

    #[test]
    fn wrong_places_are_named_in_one_sentence() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("file");
        fs::write(&file, b"x").unwrap();
        for (path, expected) in [
            (folder.path().to_owned(), "is a folder"),
            (folder.path().join("no/such/a.png"), "does not exist"),
            (file.join("a.png"), "is not a folder"),
            (PathBuf::from("/"), "is a folder"),
            (PathBuf::from(""), "is not the name of a file"),
            (folder.path().join("new/"), "is not the name of a file"),
        ] {
            let error = write_whole(&path, |_| Ok(())).unwrap_err().to_string();
            assert!(error.contains(expected), "{error}");
            assert!(!error.contains('\n'));
        }
        assert_eq!(names(folder.path()), ["file"]);
    }

    #[cfg(unix)]
    #[test]
    fn links_permissions_and_devices_are_respected() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().unwrap();
        let (real, link) = (folder.path().join("real"), folder.path().join("link"));
        fs::write(&real, b"old").unwrap();
        fs::set_permissions(&real, fs::Permissions::from_mode(0o640)).unwrap();
        symlink(&real, &link).unwrap();
        write_whole(&link, |file| Ok(file.write_all(b"new")?)).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&real).unwrap(), b"new");
        assert_eq!(fs::metadata(&real).unwrap().permissions().mode() & 0o777, 0o640);

        fs::set_permissions(&real, fs::Permissions::from_mode(0o440)).unwrap();
        let error = write_whole(&real, |_| Ok(())).unwrap_err().to_string();
        assert!(error.contains("write-protected"), "{error}");
        let error = write_whole(Path::new("/dev/null"), |_| Ok(())).unwrap_err().to_string();
        assert!(error.contains("not a regular file"), "{error}");
    }
}
