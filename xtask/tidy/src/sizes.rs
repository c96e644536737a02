//! How long files and packages may be, and what modules may not be called.

use std::path::Path;

/// Most lines of a file.
const MAX_FILE_LINES: usize = 500;
/// The runner without its tests, in lines: it reads flags, names files and shows progress; the rest belongs to libraries.
const MAX_RUNNER_LINES: usize = 7_500;
/// No package is more than one part in so many of the whole.
const SMALLEST_SHARE: usize = 5;
/// Names that say nothing about what is in a module.
const EMPTY_NAMES: [&str; 5] = ["util", "core", "common", "math", "helpers"];

/// The folder of the runner's package.
pub(super) const RUNNER: &str = "xtask";

/// Lines of Rust in one package.
#[derive(Debug, Clone, Default)]
pub(super) struct Lines {
    pub(super) folder: String,
    /// Of all its Rust files, tests, benchmarks and examples included.
    pub(super) all: usize,
    /// Of `src` without what only tests see.
    pub(super) program: usize,
}

/// Lines of a file without its tests: those before the first `#[cfg(test)]` of a module with a body; a file of tests has none.
pub(super) fn program_lines(path: &Path, text: &str) -> usize {
    let is_tests = |part: &std::ffi::OsStr| part == "tests" || part == "tests.rs";
    if path.iter().any(is_tests) {
        return 0;
    }
    let lines: Vec<&str> = text.lines().collect();
    let of_tests = |pair: &[&str]| {
        pair[0].trim() == "#[cfg(test)]"
            && pair[1].trim_start().starts_with("mod ")
            && pair[1].trim_end().ends_with('{')
    };
    lines.windows(2).position(of_tests).unwrap_or(lines.len())
}

/// Faults of one file's name and length.
pub(super) fn file(shown: &str, text: &str) -> Vec<String> {
    let mut faults = Vec::new();
    let lines = text.lines().count();
    if lines > MAX_FILE_LINES {
        faults.push(format!("{shown}: {lines} lines, expected at most {MAX_FILE_LINES}"));
    }
    for name in Path::new(shown).iter().filter_map(|part| part.to_str()) {
        let name = name.strip_suffix(".rs").unwrap_or(name);
        if EMPTY_NAMES.contains(&name) {
            faults.push(format!("{shown}: a module called {name} says nothing about what is in it"));
        }
    }
    faults
}

/// Faults of the packages' sizes.
pub(super) fn packages(packages: &[Lines]) -> Vec<String> {
    let whole: usize = packages.iter().map(|package| package.all).sum();
    let mut faults = Vec::new();
    for Lines { folder, all, program } in packages {
        if all * SMALLEST_SHARE > whole {
            let most = whole / SMALLEST_SHARE;
            faults.push(format!(
                "{folder}: {all} lines of Rust of {whole} in the workspace, expected at most a fifth, {most}"
            ));
        }
        if folder == RUNNER && *program > MAX_RUNNER_LINES {
            faults.push(format!(
                "{folder}/src: {program} lines without tests, expected at most {MAX_RUNNER_LINES}: what users need belongs to crates"
            ));
        }
    }
    faults
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(folder: &str, all: usize, program: usize) -> Lines {
        Lines { folder: folder.to_owned(), all, program }
    }

    #[test]
    fn a_package_of_more_than_a_fifth_is_a_fault() {
        let mut all: Vec<Lines> = ["a", "b", "c", "d", "e"].iter().map(|name| lines(name, 100, 50)).collect();
        assert_eq!(packages(&all), Vec::<String>::new());
        all[3].all = 101;
        assert_eq!(packages(&all), ["d: 101 lines of Rust of 501 in the workspace, expected at most a fifth, 100"]);
    }

    #[test]
    fn the_runner_has_a_limit_of_its_own() {
        let of = |program| {
            let mut all: Vec<Lines> = (0..9).map(|_| lines("crates/a", 9_000, 9_000)).collect();
            all.push(lines(RUNNER, 8_000, program));
            packages(&all).len()
        };
        assert_eq!((of(MAX_RUNNER_LINES), of(MAX_RUNNER_LINES + 1)), (0, 1));
    }

    #[test]
    fn tests_are_no_part_of_the_program() {
        let text = "fn f() {}\n\n#[cfg(test)]\nmod tests {\n    #[test]\n    fn t() {}\n}\n";
        assert_eq!(program_lines(Path::new("src/a.rs"), text), 2);
        assert_eq!(program_lines(Path::new("src/a/tests.rs"), text), 0);
        assert_eq!(program_lines(Path::new("src/a/tests/b.rs"), text), 0);
        // A declaration is not where the program ends.
        assert_eq!(program_lines(Path::new("src/a.rs"), "#[cfg(test)]\nmod tests;\n\nfn f() {}\n"), 4);
    }

    #[test]
    fn long_files_and_empty_names_are_faults() {
        assert_eq!(file("src/a.rs", &"\n".repeat(MAX_FILE_LINES)), Vec::<String>::new());
        assert_eq!(file("src/a.rs", &"\n".repeat(MAX_FILE_LINES + 1)).len(), 1);
        for name in ["src/util.rs", "src/math/mod.rs", "crates/core/src/a.rs"] {
            assert_eq!(file(name, "").len(), 1, "{name}");
        }
    }
}
