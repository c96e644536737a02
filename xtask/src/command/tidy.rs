use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use clap::Args;
use serde_json::json;

use crate::{Report, folders};

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Print the result as one JSON object
    #[arg(long)]
    json: bool,
}

/// A crate of the workspace and the crates of ours that it may depend on.
const LAYERS: [(&str, &[&str]); 10] = [
    ("crates/spectra", &[]),
    ("crates/film", &["onelight-spectra"]),
    ("crates/printing", &["onelight-spectra", "onelight-film"]),
    ("crates/lut", &[]),
    ("crates/gpu", &["onelight-lut"]),
    (
        "crates/onelight",
        &["onelight-spectra", "onelight-film", "onelight-printing", "onelight-lut", "onelight-gpu", "onelight-stocks"],
    ),
    ("crates/picture", &[]),
    ("stocks", &[]),
    ("benches", &["onelight", "onelight-lut"]),
    ("xtask", &["onelight", "onelight-lut", "onelight-gpu", "onelight-picture"]),
];
/// Names that say nothing about what is in a module.
const EMPTY_NAMES: [&str; 5] = ["util", "core", "common", "math", "helpers"];
/// Words that a crate's code (not its comments) does not use.
const FOREIGN_WORDS: [(&str, &[&str]); 4] = [
    ("crates/spectra", &["film", "emulsion", "negative_stock", "printer", "stock"]),
    ("crates/film", &["printer", "lut", "projector", "screen"]),
    ("crates/printing", &["lut", "kodak", "fuji"]),
    ("crates/picture", &["film", "printer", "stock", "lut"]),
];
/// Longest file, in lines.
const MAX_LINES: usize = 500;

pub(crate) fn run(arguments: &Arguments) -> Result<Report> {
    let top = folders::workspace()?;
    let mut faults = Vec::new();
    let mut files = 0;
    for (folder, allowed) in LAYERS {
        dependencies(&top, folder, allowed, &mut faults)?;
        for file in rust_files(&top.join(folder).join("src"))? {
            files += 1;
            let text = fs::read_to_string(&file).with_context(|| format!("{}: cannot be read", file.display()))?;
            source(folder, file.strip_prefix(&top).unwrap_or(&file), &text, &mut faults);
        }
    }
    if !faults.is_empty() {
        bail!("{} faults\n{}", faults.len(), faults.join("\n"));
    }
    let text = format!("{files} files in {} crates keep to the layers\n", LAYERS.len());
    Ok(Report { text, json: json!({ "files": files, "crates": LAYERS.len() }), as_json: arguments.json })
}

fn dependencies(top: &Path, folder: &str, allowed: &[&str], faults: &mut Vec<String>) -> Result<()> {
    let manifest = top.join(folder).join("Cargo.toml");
    let text = fs::read_to_string(&manifest).with_context(|| format!("{}: cannot be read", manifest.display()))?;
    let table: toml::Table = toml::from_str(&text).with_context(|| format!("{folder}/Cargo.toml"))?;
    // Development dependencies may reach for data to test with.
    let names = table.get("dependencies").and_then(toml::Value::as_table).into_iter().flat_map(toml::Table::keys);
    for name in names {
        if name.starts_with("onelight") && !allowed.contains(&name.as_str()) {
            faults.push(format!("{folder}/Cargo.toml: depends on {name}, expected only {}", allowed.join(", ")));
        }
        if name == "wgpu" && folder != "crates/gpu" {
            faults.push(format!("{folder}/Cargo.toml: depends on wgpu, which only crates/gpu knows"));
        }
    }
    Ok(())
}

fn source(folder: &str, file: &Path, text: &str, faults: &mut Vec<String>) {
    let shown = file.display();
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    if EMPTY_NAMES.contains(&stem.as_ref()) {
        faults.push(format!("{shown}: a module called {stem} says nothing about what is in it"));
    }
    let lines = text.lines().count();
    if lines > MAX_LINES {
        faults.push(format!("{shown}: {lines} lines, expected at most {MAX_LINES}"));
    }
    let library = folder != "xtask" && folder != "benches";
    let words = FOREIGN_WORDS.iter().find(|(name, _)| *name == folder).map_or(&[][..], |(_, words)| words);
    for (number, line) in (1..).zip(code(text)) {
        if library && (line.contains("std::fs") || line.contains("std::path")) {
            faults.push(format!("{shown}:{number}: a library that touches files, expected text, readers and writers"));
        }
        let lower = line.to_lowercase();
        for word in words.iter().filter(|word| holds(&lower, word)) {
            faults.push(format!("{shown}:{number}: the word {word:?}, which {folder} does not know"));
        }
    }
}

/// The lines before the tests, without comments and string literals.
fn code(text: &str) -> impl Iterator<Item = String> {
    let until = text.find("#[cfg(test)]").unwrap_or(text.len());
    text[..until].lines().map(|line| {
        let line = line.split("//").next().unwrap_or_default();
        line.split('"').step_by(2).collect()
    })
}

/// Whether `line` holds `word` between characters that are no letters.
fn holds(line: &str, word: &str) -> bool {
    line.match_indices(word).any(|(at, _)| {
        let letter = |c: Option<char>| c.is_some_and(char::is_alphabetic);
        !letter(line[..at].chars().next_back()) && !letter(line[at + word.len()..].chars().next())
    })
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
