//! Whether the workspace keeps the rules of ARCHITECTURE.md.

mod circles;
mod layers;
mod pages;
mod sizes;
mod source;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::{Context, Result, bail};
use serde_json::json;

use self::layers::Layer;
use self::sizes::Lines;
use self::source::Module;

/// Folders of a package that hold Rust files.
const SOURCES: [&str; 4] = ["src", "tests", "benches", "examples"];

/// Prints what was looked at; 2 and a list of the faults where there are any. `--json` prints one JSON object.
fn main() -> ExitCode {
    let as_json = std::env::args().any(|argument| argument == "--json");
    match run(as_json) {
        Ok(text) => {
            println!("{}", text.trim_end());
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(2)
        }
    }
}

/// The top of the workspace, two folders above this package.
fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn run(as_json: bool) -> Result<String> {
    let found = check(&workspace())?;
    if !found.faults.is_empty() {
        bail!("{} faults\n{}", found.faults.len(), found.faults.join("\n"));
    }
    let Found { files, packages, .. } = &found;
    let whole: usize = packages.iter().map(|package| package.all).sum();
    let mut text = format!("{files} files in {} packages keep the rules of ARCHITECTURE.md\n", packages.len());
    for Lines { folder, all, .. } in packages {
        let share = 100.0 * *all as f64 / whole.max(1) as f64;
        text.push_str(&format!("  {folder:16} {all:>6} lines of Rust, {share:>4.1} %\n"));
    }
    let sizes: serde_json::Map<String, serde_json::Value> =
        packages.iter().map(|package| (package.folder.clone(), package.all.into())).collect();
    let json = json!({ "files": files, "crates": packages.len(), "lines": sizes });
    Ok(if as_json { format!("{json:#}") } else { text })
}

/// What was looked at, and what is wrong with it.
struct Found {
    files: usize,
    packages: Vec<Lines>,
    faults: Vec<String>,
}

fn check(top: &Path) -> Result<Found> {
    let mut found = Found { files: 0, packages: Vec::new(), faults: Vec::new() };
    let members = members(top)?;
    for folder in &members {
        let Some(layer) = Layer::of(folder) else {
            found.faults.push(format!("{folder}: has no layer, expected one of those in ARCHITECTURE.md"));
            continue;
        };
        let manifest = top.join(folder).join("Cargo.toml");
        let table: toml::Table = toml::from_str(&read(&manifest)?).with_context(|| format!("{folder}/Cargo.toml"))?;
        found.faults.extend(layer.dependencies(&table));
        found.package(top, folder, layer)?;
    }
    found.faults.extend(sizes::packages(&found.packages));
    found.faults.extend(pages::pages(top, &members)?);
    Ok(found)
}

impl Found {
    fn package(&mut self, top: &Path, folder: &str, layer: &Layer) -> Result<()> {
        let mut lines = Lines { folder: folder.to_owned(), ..Lines::default() };
        for source in SOURCES {
            let at = top.join(folder).join(source);
            if !at.is_dir() {
                continue;
            }
            for file in rust_files(&at)? {
                let text = read(&file)?;
                let below = file.strip_prefix(top).unwrap_or(&file);
                let shown = below.display().to_string();
                self.files += 1;
                self.faults.extend(sizes::file(&shown, &text));
                lines.all += text.lines().count();
                if source == "src" {
                    lines.program += sizes::program_lines(below, &text);
                    let module = Module::read(&text).with_context(|| format!("{shown}: is not Rust"))?;
                    if !below.iter().any(|part| part == "tests" || part == "tests.rs") {
                        self.faults.extend(layer.source(&shown, &text, &module));
                    }
                }
            }
        }
        for root in roots(&top.join(folder).join("src")) {
            let below = root.strip_prefix(top).unwrap_or(&root);
            let read = |file: &Path| {
                let file = top.join(file);
                if file.is_file() { read(&file).map(Some) } else { Ok(None) }
            };
            let circles = circles::circles(below, &read)?;
            self.faults
                .extend(circles.into_iter().map(|circle| format!("{folder}: modules import each other\n  {circle}")));
        }
        self.packages.push(lines);
        Ok(())
    }
}

/// The folders of the workspace's packages.
fn members(top: &Path) -> Result<Vec<String>> {
    let table: toml::Table = toml::from_str(&read(&top.join("Cargo.toml"))?).context("Cargo.toml")?;
    let members = table.get("workspace").and_then(|workspace| workspace.get("members")?.as_array());
    let members = members.context("Cargo.toml: has no list of members")?;
    Ok(members.iter().filter_map(toml::Value::as_str).map(str::to_owned).collect())
}

/// The files that a package's library and programs begin with.
fn roots(src: &Path) -> Vec<PathBuf> {
    let programs = fs::read_dir(src.join("bin")).into_iter().flatten().flatten().map(|entry| entry.path());
    let programs = programs.map(|path| if path.is_dir() { path.join("main.rs") } else { path });
    let mut roots: Vec<PathBuf> =
        ["lib.rs", "main.rs"].map(|name| src.join(name)).into_iter().chain(programs).collect();
    roots.retain(|root| root.is_file());
    roots.sort();
    roots
}

fn read(file: &Path) -> Result<String> {
    fs::read_to_string(file).with_context(|| format!("{}: cannot be read", file.display()))
}

fn rust_files(folder: &Path) -> Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).with_context(|| format!("{}: cannot be read", folder.display()))? {
        let path = entry?.path();
        if path.is_dir() {
            found.extend(rust_files(&path)?);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn this_workspace_is_tidy() {
        let faults = check(&workspace()).unwrap().faults;
        assert!(faults.is_empty(), "{faults:#?}");
    }

    /// A workspace of two packages; `film` says what the second one is made of.
    fn made_up(film: &[(&str, &str)]) -> tempfile::TempDir {
        let top = tempfile::tempdir().unwrap();
        let fixed = [
            ("Cargo.toml", "[workspace]\nmembers = [\"crates/spectra\", \"crates/film\"]"),
            ("crates/spectra/Cargo.toml", "[package]\nname = \"onelight-spectra\""),
            ("crates/spectra/src/lib.rs", "//! Light.\n"),
        ];
        for (name, text) in fixed.iter().chain(film) {
            let file = top.path().join(name);
            fs::create_dir_all(file.parent().unwrap()).unwrap();
            fs::write(file, text).unwrap();
        }
        top
    }

    #[test]
    fn faults_of_every_kind_name_their_files() {
        let film = [
            ("crates/film/Cargo.toml", "[dependencies]\nonelight-printing = {}"),
            ("crates/film/src/lib.rs", "mod curve;\nmod dye;\nuse std::fs;"),
            ("crates/film/src/curve.rs", "use crate::dye::Dye;\npub struct Curve;"),
            ("crates/film/src/dye.rs", "use crate::curve::Curve;\npub struct Dye;\nfn f(printer: u8) {}"),
            ("crates/film/src/helpers.rs", ""),
            ("crates/film/src/bin/one.rs", "fn main() {}"),
        ];
        let faults = check(made_up(&film).path()).unwrap().faults;
        let expected = [
            "crates/film/Cargo.toml: depends on onelight-printing, expected only onelight-spectra",
            "crates/film/src/dye.rs:3: the word \"printer\", which crates/film does not know",
            "crates/film/src/helpers.rs: a module called helpers says nothing about what is in it",
            "crates/film/src/lib.rs: uses std::fs in a library, expected text, readers and writers",
            "crates/film: modules import each other\n  crates/film/src/curve.rs -> crates/film/src/dye.rs: Dye\n  \
             crates/film/src/dye.rs -> crates/film/src/curve.rs: Curve",
        ];
        for expected in expected {
            assert!(faults.iter().any(|fault| fault == expected), "{expected}: {faults:#?}");
        }
        // Of two packages one is always more than a fifth.
        let sizes = faults.iter().filter(|fault| fault.contains("lines of Rust")).count();
        assert_eq!(faults.len(), expected.len() + sizes, "{faults:#?}");
    }

    #[test]
    fn a_member_without_a_layer_is_a_fault() {
        let top = made_up(&[("crates/film/Cargo.toml", ""), ("crates/film/src/lib.rs", "")]);
        fs::write(top.path().join("Cargo.toml"), "[workspace]\nmembers = [\"crates/other\"]").unwrap();
        let faults = check(top.path()).unwrap().faults;
        assert_eq!(faults, ["crates/other: has no layer, expected one of those in ARCHITECTURE.md"]);
    }
}
