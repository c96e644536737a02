//! Picture files under their paths: read with the path at the start of every message, written completely or not at all.

use std::{
    fs::{self, File},
    io::ErrorKind,
    path::Path,
};

use anyhow::{Result, anyhow, bail};
use onelight_picture::{BandSink, Description, Limits, Picture, PictureReader, Selection, readable_formats};

use crate::atomic_file::write_atomically;

/// Opens the picture in the file `path`.
///
/// # Errors
/// One sentence that starts with `path`: no such file, a folder, or what [`onelight_picture::open`] says.
pub(crate) fn open(path: &Path, limits: &Limits) -> Result<PictureReader<'static>> {
    open_selected(path, limits, &Selection::default())
}

/// Opens one picture of a file that may hold several.
///
/// # Errors
/// As [`open`], and what is asked for and is not there.
pub(crate) fn open_selected(path: &Path, limits: &Limits, selection: &Selection) -> Result<PictureReader<'static>> {
    let file = open_file(path).map_err(|error| anyhow!("{}: {error}", path.display()))?;
    Ok(onelight_picture::open_selected(file, &path.display().to_string(), *limits, selection)?)
}

/// Writes `picture` as [`onelight_picture::write_exr`] does.
///
/// # Errors
/// One sentence that starts with `path`: see [`write_atomically`], and what does not fit the format.
pub(crate) fn write_exr(path: &Path, picture: &Picture, texts: &[(&str, &str)]) -> Result<()> {
    write_atomically(path, |file| Ok(picture.write_exr(file, texts)?))
}

/// Writes as [`onelight_picture::write_exr`] what `fill` hands over, band by band; what `fill` returns.
///
/// # Errors
/// As [`write_exr`], and what `fill` says, which is not given a path unless it is about this file.
pub(crate) fn write_exr_bands<T>(
    path: &Path,
    picture: &Description,
    texts: &[(&str, &str)],
    fill: impl FnOnce(&mut dyn BandSink) -> Result<T>,
) -> Result<T> {
    write_atomically(path, |file| onelight_picture::write_exr(file, picture, texts, fill))
}

/// The text `key` of the picture file `path`, if it is there and complete: see [`onelight_picture::text_of_complete_picture`].
pub(crate) fn text_of_complete_picture(path: &Path, key: &str) -> Option<String> {
    let file = File::open(path).ok()?;
    file.metadata().ok()?.is_file().then(|| onelight_picture::text_of_complete_picture(file, key))?
}

fn open_file(path: &Path) -> Result<File> {
    let cannot_read = |error: std::io::Error| match error.kind() {
        ErrorKind::NotFound => anyhow!("there is no such file, expected {}", readable_formats()),
        _ => anyhow!("cannot be read: {error}"),
    };
    let found = fs::metadata(path).map_err(cannot_read)?;
    if found.is_dir() {
        bail!("is a folder, expected {}", readable_formats());
    }
    // A pipe has no length to check claims against, and cannot seek.
    if !found.is_file() {
        bail!("is not a regular file, expected {}", readable_formats());
    }
    File::open(path).map_err(cannot_read)
}

#[cfg(test)]
mod tests {
    use onelight_picture::{BandView, Channels, PngSettings, Source, write_png};

    use super::*;

    fn sample(width: usize, height: usize) -> Picture {
        Picture::opaque(width, height, vec![[0.5, 2.0, -1.0]; width * height], Source::Exr)
    }

    #[test]
    fn messages_begin_with_the_path() {
        let folder = tempfile::tempdir().unwrap();
        for (name, contents, expected) in [
            ("none.exr", None, "there is no such file, expected an OpenEXR, PNG, TIFF, JPEG or Radiance picture"),
            (".", None, "is a folder, expected an OpenEXR, PNG, TIFF, JPEG or Radiance picture"),
            (
                "empty.exr",
                Some(&b""[..]),
                "the file is empty, expected an OpenEXR, PNG, TIFF, JPEG or Radiance picture",
            ),
            ("b.png", Some(b"\x89PNG\r\n\x1a\n"), "the file ends too early (is it truncated?)"),
        ] {
            let path = folder.path().join(name);
            if let Some(contents) = contents {
                fs::write(&path, contents).unwrap();
            }
            let sentence = format!("{:#}", open(&path, &Limits::default()).unwrap_err());
            assert_eq!(sentence, format!("{}: {expected}", path.display()));
        }
    }

    #[test]
    fn what_is_written_under_a_path_is_what_the_library_writes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.exr");
        let picture = Picture { alpha: Some(vec![0.25; 20]), ..sample(5, 4) };
        write_exr(&path, &picture, &[("job", "a1")]).unwrap();
        let mut bytes = std::io::Cursor::new(Vec::new());
        picture.write_exr(&mut bytes, &[("job", "a1")]).unwrap();
        assert!(fs::read(&path).unwrap() == bytes.into_inner());
        assert_eq!(text_of_complete_picture(&path, "job").as_deref(), Some("a1"));
        assert_eq!(text_of_complete_picture(folder.path(), "job"), None);
        assert_eq!(text_of_complete_picture(&folder.path().join("none.exr"), "job"), None);
    }

    #[test]
    fn a_picture_that_contradicts_itself_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let description = Description::new(3, 2, Channels::Rgb, Source::Exr);
        let write_png = |rgb: &[[f32; 3]], texts: &[(&str, &str)]| {
            let view = BandView { top: 0, width: 3, rgb, alpha: None };
            let fill = |sink: &mut dyn BandSink| Ok(sink.write(view)?);
            write_atomically(&path, |file| write_png(file, &description, PngSettings::default(), texts, fill))
        };
        let (wrong, right) = ([[0.0; 3]; 5], [[0.0; 3]; 6]);
        let sentence = write_png(&wrong, &[]).unwrap_err().to_string();
        assert!(sentence.starts_with(&path.display().to_string()), "{sentence}");
        assert!(write_png(&right, &[("", "empty key")]).is_err());
        let short = Picture { alpha: Some(vec![1.0; 3]), ..sample(2, 2) };
        assert!(write_exr(&path, &short, &[]).is_err());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
        write_png(&right, &[]).unwrap();
    }
}
