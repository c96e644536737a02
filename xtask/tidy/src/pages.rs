//! Pages of the repository: the files that they name are there.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

/// Where pages are, beside the folders of the packages.
const FOLDERS: [&str; 2] = ["", "docs"];
/// What a run writes is named before it is there.
const WRITTEN: &str = "target/";

/// Faults of the pages at the top, in `docs`, and in the folders of the packages.
pub(super) fn pages(top: &Path, members: &[String]) -> Result<Vec<String>> {
    let mut faults = Vec::new();
    for folder in FOLDERS.into_iter().chain(members.iter().map(String::as_str)) {
        for page in in_folder(&top.join(folder))? {
            let text = fs::read_to_string(&page).with_context(|| format!("{}: cannot be read", page.display()))?;
            let shown = page.strip_prefix(top).unwrap_or(&page).display().to_string();
            faults.extend(page_faults(top, &shown, &text));
        }
    }
    Ok(faults)
}

fn in_folder(folder: &Path) -> Result<Vec<PathBuf>> {
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let entries = fs::read_dir(folder).with_context(|| format!("{}: cannot be read", folder.display()))?;
    let mut pages = entries.map(|entry| Ok(entry?.path())).collect::<Result<Vec<_>>>()?;
    pages.retain(|path| path.extension().is_some_and(|extension| extension == "md"));
    pages.sort();
    Ok(pages)
}

/// Faults of one page: `shown` is its path from the top of the workspace. Blocks of code are left out.
fn page_faults(top: &Path, shown: &str, text: &str) -> Vec<String> {
    let folder = Path::new(shown).parent().unwrap_or(Path::new(""));
    let mut faults = Vec::new();
    let mut in_block = false;
    for (number, line) in (1..).zip(text.lines()) {
        if line.starts_with("```") {
            in_block = !in_block;
        } else if !in_block {
            let paths = in_backticks(line).filter(|path| !top.join(path).exists());
            faults.extend(paths.map(|path| format!("{shown}:{number}: names `{path}`, which is not there")));
            let links = linked(line).filter(|link| !top.join(folder).join(link).exists());
            faults.extend(links.map(|link| format!("{shown}:{number}: links to {link}, which is not there")));
        }
    }
    faults
}

/// What stands between backticks and is the path of a file from the top: a folder and an extension, and no wildcard.
fn in_backticks(line: &str) -> impl Iterator<Item = &str> {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./".contains(c);
    line.split('`').skip(1).step_by(2).filter(move |word| {
        let extension =
            word.rsplit_once('/').and_then(|(_, name)| name.rsplit_once('.')).map(|(_, extension)| extension);
        let names_a_file = extension.is_some_and(|extension| extension.starts_with(|c: char| c.is_ascii_alphabetic()));
        names_a_file && word.chars().all(is_plain) && !word.starts_with(WRITTEN)
    })
}

/// Targets of links within the repository, without the part of the page.
fn linked(line: &str) -> impl Iterator<Item = &str> {
    let targets = line.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(target, _)| target);
    let files = targets.filter(|target| !target.contains("://")).filter_map(|target| target.split('#').next());
    files.filter(|file| !file.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_is_not_there_is_a_fault_with_its_line() {
        let top = tempfile::tempdir().unwrap();
        fs::create_dir_all(top.path().join("docs/images")).unwrap();
        fs::write(top.path().join("docs/here.md"), "").unwrap();
        let text = "In `docs/here.md`, [here](here.md#part) and [there](https://example.org/a.md).\n\
                    `docs/gone.md` and [gone](images/gone.svg), see [below](#below)\n\
                    ```sh\ncat docs/gone.md `docs/gone.md`\n```\n\
                    `a/b`, `*/x.rs`, `1.0/1.5`, `target/a.png`, `look.toml` are no files of the repository; `a/b.rs` is one.\n";
        fs::write(top.path().join("docs/page.md"), text).unwrap();
        let expected = [
            "docs/page.md:2: names `docs/gone.md`, which is not there",
            "docs/page.md:2: links to images/gone.svg, which is not there",
            "docs/page.md:6: names `a/b.rs`, which is not there",
        ];
        assert_eq!(pages(top.path(), &["crates/none".to_owned()]).unwrap(), expected);
    }
}
