use std::io::Write;

use super::*;

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn a_file_appears_complete() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    let seen_while_writing = write_atomically(&path, |file| {
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
    let error = write_atomically(&path, |file| -> Result<()> {
        file.write_all(&[0; 100_000])?;
        bail!("the film tore")
    })
    .unwrap_err();
    assert_eq!(error.to_string(), format!("{}: the film tore", path.display()));
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(names(folder.path()), ["a.txt"]);
}

#[test]
fn files_appear_together_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("c")).unwrap();
    let set = |last: &str| {
        let mut set = AtomicFiles::in_folder(folder.path());
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
        write_atomically(&path, |_| -> Result<()> { std::panic::resume_unwind(Box::new(())) })
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
        let error = write_atomically(&path, |_| Ok(())).unwrap_err().to_string();
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
    write_atomically(&link, |file| Ok(file.write_all(b"new")?)).unwrap();
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(fs::read(&real).unwrap(), b"new");
    assert_eq!(fs::metadata(&real).unwrap().permissions().mode() & 0o777, 0o640);

    fs::set_permissions(&real, fs::Permissions::from_mode(0o440)).unwrap();
    let error = write_atomically(&real, |_| Ok(())).unwrap_err().to_string();
    assert!(error.contains("write-protected"), "{error}");
    let error = write_atomically(Path::new("/dev/null"), |_| Ok(())).unwrap_err().to_string();
    assert!(error.contains("not a regular file"), "{error}");
}

/// What a killed run leaves goes, what a running one holds stays, and so does what belongs to another name.
#[test]
fn leftovers_go_and_running_files_stay() {
    let folder = tempfile::tempdir().unwrap();
    let [a, b] = ["a.png", "b.png"].map(|name| folder.path().join(name));
    // A name as it was left: the file is there and no one holds it.
    let left = |path: &Path| {
        let before = names(folder.path());
        let (temporary, file) = Temporary::create(path, folder.path()).unwrap();
        let name = names(folder.path()).into_iter().find(|name| !before.contains(name)).unwrap();
        drop((temporary, file));
        fs::write(folder.path().join(&name), "half").unwrap();
        name
    };
    let (of_a, of_b) = (left(&a), left(&b));
    assert!(of_a != of_b && of_a.starts_with(".onelight-") && of_a.ends_with(".part"));
    fs::write(folder.path().join(".onelight-a.png.part"), "another's").unwrap();
    write_atomically(&a, |_| {
        remove_leftovers([a.as_path(), &folder.path().join("no/such/a.png")]);
        assert!(!folder.path().join(&of_a).exists() && folder.path().join(&of_b).exists());
        Ok(())
    })
    .unwrap();
    assert_eq!(names(folder.path()).len(), 3, "{:?}", names(folder.path()));
    assert!(a.exists() && folder.path().join(&of_b).exists());
}

/// The name that is wanted may be as long as names can be.
#[test]
fn long_names_are_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("n".repeat(255));
    write_atomically(&path, |file| Ok(file.write_all(b"one")?)).unwrap();
    remove_leftovers([path.as_path()]);
    assert_eq!(fs::read(&path).unwrap(), b"one");
}
