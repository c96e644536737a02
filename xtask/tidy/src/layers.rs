//! What each package of the workspace may depend on, and the words it does not know.

use super::source::{Module, Path};

/// A package and its place in the layers.
pub(super) struct Layer {
    /// Folder, from the top of the workspace.
    pub(super) folder: &'static str,
    /// Packages of ours that it may depend on; development dependencies may reach for data to test with.
    allowed: &'static [&'static str],
    /// Words that its code (not its comments and strings) does not use.
    foreign: &'static [&'static str],
    /// Whether it may depend on wgpu: always, only as an option, or never.
    wgpu: Wgpu,
    /// A library takes text, readers and writers; the others may open paths.
    is_library: bool,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Wgpu {
    Never,
    Optional,
    Always,
}

const LIBRARY: Layer = Layer { folder: "", allowed: &[], foreign: &[], wgpu: Wgpu::Never, is_library: true };
const PROGRAM: Layer = Layer { is_library: false, ..LIBRARY };

/// Every package. What is below is never above: the order is that of ARCHITECTURE.md.
const LAYERS: [Layer; 18] = [
    Layer {
        folder: "crates/spectra",
        foreign: &["film", "emulsion", "printer", "stock", "negative_stock", "halide"],
        ..LIBRARY
    },
    Layer {
        folder: "crates/film",
        allowed: &["onelight-spectra"],
        foreign: &["printer", "lut", "projector", "screen", "transfercurve"],
        ..LIBRARY
    },
    Layer {
        folder: "crates/printing",
        allowed: &["onelight-spectra", "onelight-film"],
        foreign: &["lut", "kodak", "fuji", "agfa"],
        ..LIBRARY
    },
    Layer {
        folder: "crates/lut",
        foreign: &["ciede", "xyz", "cielab", "chromaticity", "illuminant", "observer", "spectrum", "spectral"],
        ..LIBRARY
    },
    Layer { folder: "crates/formats", allowed: &["onelight-lut"], ..LIBRARY },
    Layer { folder: "crates/picture", foreign: &["film", "emulsion", "stock", "printer"], ..LIBRARY },
    Layer {
        folder: "crates/spatial",
        allowed: &["onelight-spectra", "onelight-film"],
        foreign: &["wgpu", "lut", "printer", "projector", "kodak", "fuji"],
        ..LIBRARY
    },
    Layer {
        folder: "crates/charts",
        allowed: &["onelight-film"],
        foreign: &["wgpu", "lut", "kodak", "fuji"],
        ..LIBRARY
    },
    Layer { folder: "crates/gpu", allowed: &["onelight-lut", "onelight-spatial"], wgpu: Wgpu::Always, ..LIBRARY },
    Layer { folder: "stocks", ..LIBRARY },
    Layer {
        folder: "crates/onelight",
        allowed: &[
            "onelight-spectra",
            "onelight-film",
            "onelight-printing",
            "onelight-lut",
            "onelight-formats",
            "onelight-gpu",
            "onelight-picture",
            "onelight-spatial",
            "onelight-stocks",
        ],
        ..LIBRARY
    },
    Layer { folder: "crates/web", allowed: &["onelight", "onelight-picture"], ..LIBRARY },
    Layer {
        folder: "examples/gpu",
        allowed: &["onelight", "onelight-lut", "onelight-gpu"],
        wgpu: Wgpu::Always,
        ..PROGRAM
    },
    Layer { folder: "fixtures", allowed: &["onelight"], ..LIBRARY },
    Layer {
        folder: "benches",
        allowed: &["onelight", "onelight-lut", "onelight-gpu", "onelight-fixtures", "onelight-stocks"],
        wgpu: Wgpu::Optional,
        ..PROGRAM
    },
    Layer {
        folder: "xtask",
        allowed: &[
            "onelight",
            "onelight-lut",
            "onelight-gpu",
            "onelight-formats",
            "onelight-charts",
            "onelight-picture",
            "onelight-fixtures",
            "onelight-benches",
        ],
        ..PROGRAM
    },
    Layer {
        folder: "xtask/darkroom",
        allowed: &["onelight", "onelight-web", "onelight-picture", "onelight-fixtures"],
        ..PROGRAM
    },
    Layer { folder: "xtask/tidy", ..PROGRAM },
];

/// The packages that may hand errors on without a type of their own.
const ANYHOW: [&str; 3] = ["xtask", "xtask/darkroom", "xtask/tidy"];

impl Layer {
    /// The layer of a member of the workspace.
    pub(super) fn of(folder: &str) -> Option<&'static Self> {
        LAYERS.iter().find(|layer| layer.folder == folder)
    }

    /// Faults of the package's `Cargo.toml`.
    pub(super) fn dependencies(&self, manifest: &toml::Table) -> Vec<String> {
        let folder = self.folder;
        let mut faults = Vec::new();
        for (name, how) in normal_dependencies(manifest) {
            let is_ours = name == "xtask" || name.starts_with("onelight");
            if is_ours && !self.allowed.contains(&name) {
                let allowed = if self.allowed.is_empty() { "none of ours".to_owned() } else { self.allowed.join(", ") };
                faults.push(format!("{folder}/Cargo.toml: depends on {name}, expected only {allowed}"));
            }
            let is_optional = how.get("optional").and_then(toml::Value::as_bool) == Some(true);
            let may = self.wgpu == Wgpu::Always || (self.wgpu == Wgpu::Optional && is_optional);
            if name == "wgpu" && !may {
                faults.push(format!("{folder}/Cargo.toml: depends on wgpu, which only crates/gpu knows"));
            }
            if name == "onelight-gpu" && !may && !is_optional {
                faults.push(format!("{folder}/Cargo.toml: depends on onelight-gpu always, expected a feature"));
            }
            if name == "anyhow" && !ANYHOW.contains(&folder) {
                faults.push(format!("{folder}/Cargo.toml: depends on anyhow, expected an error type of its own"));
            }
        }
        faults
    }

    /// Faults of a file of the package's sources: words, and the file system.
    pub(super) fn source(&self, shown: &str, text: &str, module: &Module) -> Vec<String> {
        let mut faults = Vec::new();
        for (number, line) in (1..).zip(code(text)) {
            let lower = line.to_lowercase();
            for word in self.foreign.iter().filter(|word| holds(&lower, word)) {
                faults.push(format!("{shown}:{number}: the word {word:?}, which {} does not know", self.folder));
            }
        }
        if self.is_library {
            for path in opened(module) {
                let path = path.join("::");
                faults.push(format!("{shown}: uses {path} in a library, expected text, readers and writers"));
            }
        }
        faults
    }
}

fn normal_dependencies(manifest: &toml::Table) -> impl Iterator<Item = (&str, &toml::Value)> {
    let targets = manifest.get("target").and_then(toml::Value::as_table).into_iter().flat_map(toml::Table::values);
    let tables = std::iter::once(manifest).chain(targets.filter_map(toml::Value::as_table));
    let dependencies = tables.filter_map(|table| table.get("dependencies")?.as_table()).flatten();
    dependencies.map(|(name, how)| (name.as_str(), how))
}

/// The paths of a module, and of those within it, that reach the file system.
fn opened(module: &Module) -> Vec<&Path> {
    let reaches = |path: &&Path| {
        let second = path.get(1).map(String::as_str);
        path.first().is_some_and(|first| first == "std") && matches!(second, Some("fs" | "path"))
    };
    module.paths().filter(reaches).chain(module.inline.values().flat_map(opened)).collect()
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

#[cfg(test)]
mod tests {
    use super::*;

    fn faults_of(folder: &str, manifest: &str) -> Vec<String> {
        Layer::of(folder).unwrap().dependencies(&toml::from_str(manifest).unwrap())
    }

    fn faults_in(folder: &str, text: &str) -> Vec<String> {
        Layer::of(folder).unwrap().source("a.rs", text, &Module::read(text).unwrap())
    }

    #[test]
    fn a_package_depends_on_what_lies_below_it() {
        let above = "[dependencies]\nonelight-film.workspace = true\nonelight-spectra.workspace = true";
        assert_eq!(faults_of("crates/printing", above), Vec::<String>::new());
        assert_eq!(
            faults_of("crates/film", above),
            ["crates/film/Cargo.toml: depends on onelight-film, expected only onelight-spectra"]
        );
        let for_one_system = "[target.'cfg(unix)'.dependencies]\nonelight = {}\n[dev-dependencies]\nonelight-film = {}";
        assert_eq!(faults_of("crates/lut", for_one_system).len(), 1);
    }

    #[test]
    fn wgpu_is_known_where_it_belongs() {
        let (always, optional) = ("[dependencies]\nwgpu = {}", "[dependencies]\nwgpu = { optional = true }");
        assert!(faults_of("crates/gpu", always).is_empty() && faults_of("benches", optional).is_empty());
        assert!(!faults_of("benches", always).is_empty() && !faults_of("crates/onelight", optional).is_empty());
        assert_eq!(faults_of("xtask", "[dependencies]\nonelight-gpu = {}").len(), 1);
    }

    #[test]
    fn only_the_runner_takes_errors_of_any_type() {
        assert!(faults_of("xtask", "[dependencies]\nanyhow = {}").is_empty());
        assert_eq!(faults_of("fixtures", "[dependencies]\nanyhow = {}").len(), 1);
    }

    #[test]
    fn foreign_words_are_found_in_code_alone() {
        let text = "//! A film.\nfn f() { let s = \"film\"; } // film\n#[cfg(test)] mod tests { fn film() {} }";
        assert_eq!(faults_in("crates/spectra", text), Vec::<String>::new());
        assert_eq!(faults_in("crates/spectra", "fn a() {}\nstruct B { film_speed: u8 }").len(), 1);
        assert_eq!(faults_in("crates/spectra", "struct Filmic;"), Vec::<String>::new());
    }

    #[test]
    fn a_library_opens_nothing() {
        for text in ["use std::{fmt, fs};", "fn f() { std::fs::read(\"a\"); }", "mod m { use std::path::Path; }"] {
            assert_eq!(faults_in("crates/lut", text).len(), 1, "{text}");
            assert!(faults_in("xtask", text).is_empty());
        }
        let only_tests = "use std::io; #[cfg(test)] mod tests { use std::fs; }";
        assert_eq!(faults_in("crates/lut", only_tests), Vec::<String>::new());
    }
}
