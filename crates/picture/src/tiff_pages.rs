//! Which of a TIFF's pictures is the one that is meant.

use std::io::{Read, Seek};

use crate::{
    error::{Error, TiffProblem},
    tiff_directory::{Directory, TiffFile},
    tiff_header::tag,
};

/// Most pictures of a file that are looked at.
const MAX_PAGES: usize = 256;

/// The picture to read, and what the user should know of the others.
pub(crate) struct Page {
    pub(crate) directory: Directory,
    pub(crate) notes: Vec<String>,
}

/// Chooses the first picture that is neither a smaller copy of another nor a mask; a camera's raw file is refused.
pub(crate) fn choose<R: Read + Seek>(file: &mut TiffFile<R>, first: u64) -> Result<Page, Error> {
    let (mut pages, mut seen, mut at) = (Vec::new(), Vec::new(), first);
    while at != 0 && !seen.contains(&at) && pages.len() < MAX_PAGES {
        seen.push(at);
        let page = match file.directory(at) {
            Ok(page) => page,
            // What comes after a whole page may be damaged, as long as it is not read.
            Err(error) if pages.is_empty() => return Err(error),
            Err(_) => break,
        };
        refuse_raw(file, &page)?;
        at = page.next;
        pages.push(page);
    }
    // Pictures under a page: a camera's raw file keeps its sensor's there, beneath a small preview.
    let mut under = Vec::new();
    for page in &pages {
        let offsets = file.numbers(page, tag::SUB_IFDS).ok().flatten().unwrap_or_default();
        for offset in offsets.into_iter().take(MAX_PAGES - under.len().min(MAX_PAGES)) {
            if !seen.contains(&offset)
                && let Ok(page) = file.directory(offset)
            {
                seen.push(offset);
                refuse_raw(file, &page)?;
                under.push(page);
            }
        }
    }
    let (count, count_under) = (pages.len(), under.len());
    let mut smaller = Vec::with_capacity(count + count_under);
    for page in pages.iter().chain(&under) {
        smaller.push(is_reduced(file, page));
    }
    let chosen = smaller.iter().position(|smaller| !smaller).unwrap_or(0);
    let mut notes = Vec::new();
    if count > 1 || chosen >= count {
        let others = match (smaller[..count].iter().filter(|smaller| **smaller).count(), chosen) {
            (0, _) => String::new(),
            (_, 0) => " (others are smaller copies or masks)".to_owned(),
            (_, _) => " (those before it are smaller copies or masks)".to_owned(),
        };
        let place = if chosen < count { "page" } else { "the sub-page" };
        let number = if chosen < count { chosen + 1 } else { chosen - count + 1 };
        let of = if chosen < count { count } else { count_under };
        notes.push(format!("read {place} {number} of {of} of the TIFF{others}"));
    }
    let directory = pages.into_iter().chain(under).nth(chosen).ok_or(TiffProblem::NoPages)?;
    Ok(Page { directory, notes })
}

/// Refuses what a camera's sensor saw: it takes a raw converter to make a picture of it.
fn refuse_raw<R: Read + Seek>(file: &mut TiffFile<R>, page: &Directory) -> Result<(), Error> {
    let photometric = file.first(page, tag::PHOTOMETRIC).ok().flatten();
    let is_sensor = matches!(photometric, Some(32_803 | 34_892));
    if is_sensor || page.has(tag::DNG_VERSION) {
        let what = if page.has(tag::DNG_VERSION) { "a DNG" } else { "a camera raw file" };
        return Err(TiffProblem::CameraRaw { what }.into());
    }
    Ok(())
}

/// Whether a page says that it is a smaller copy of another, or a mask.
fn is_reduced<R: Read + Seek>(file: &mut TiffFile<R>, page: &Directory) -> bool {
    let mut first = |tag| file.first(page, tag).ok().flatten();
    let new = first(tag::NEW_SUBFILE_TYPE).unwrap_or(0);
    new & 0b101 != 0 || first(tag::SUBFILE_TYPE) == Some(2)
}
