//! Circles of modules: files of one crate that import each other.
//!
//! A file imports another where it names something that is defined there, in a `use` or in any other path. A name that was passed on
//! (`pub use`) is followed to the file that defines it; to pass a name on, or to declare `mod name;`, is to import nothing.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path as FilePath, PathBuf};

use anyhow::{Context, Result};

use super::source::{Module, Path};

/// How many `pub use` are followed to a definition: more than any crate has, so that two that name each other end.
const MOST_HOPS: usize = 32;

/// Imports between the files of one crate: from, to, the names.
type Imports = BTreeMap<(PathBuf, PathBuf), BTreeSet<String>>;

/// A module in the tree of its crate.
struct Node {
    file: PathBuf,
    parent: Option<usize>,
    children: BTreeMap<String, usize>,
    module: Module,
}

/// The modules of a crate, the root first.
struct Tree {
    nodes: Vec<Node>,
}

/// The circles of the crate whose root is `root`; each as one text of lines `file -> file: names`, files as `read` knows them.
///
/// # Errors
/// What `read` says, and where a file is not Rust.
pub(super) fn circles(root: &FilePath, read: &dyn Fn(&FilePath) -> Result<Option<String>>) -> Result<Vec<String>> {
    let imports = Tree::read(root, read)?.imports();
    let files: BTreeSet<&PathBuf> = imports.keys().flat_map(|(from, to)| [from, to]).collect();
    let reached: BTreeMap<&PathBuf, BTreeSet<&PathBuf>> =
        files.iter().map(|&file| (file, reached_from(file, &imports))).collect();
    let mut circles = Vec::new();
    let mut seen = BTreeSet::new();
    for &file in &files {
        if !reached[file].contains(file) || !seen.insert(file) {
            continue;
        }
        let circle: BTreeSet<&PathBuf> =
            reached[file].iter().copied().filter(|&other| reached[other].contains(file)).collect();
        seen.extend(&circle);
        let within = imports.iter().filter(|((from, to), _)| circle.contains(from) && circle.contains(to));
        let lines = within.map(|((from, to), names)| {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            format!("{} -> {}: {}", from.display(), to.display(), names.join(", "))
        });
        circles.push(lines.collect::<Vec<_>>().join("\n  "));
    }
    Ok(circles)
}

fn reached_from<'a>(file: &PathBuf, imports: &'a Imports) -> BTreeSet<&'a PathBuf> {
    let next = |from: &PathBuf| {
        let from = from.clone();
        imports.keys().filter(move |(other, _)| *other == from).map(|(_, to)| to)
    };
    let mut reached = BTreeSet::new();
    let mut waiting: Vec<&PathBuf> = next(file).collect();
    while let Some(file) = waiting.pop() {
        if reached.insert(file) {
            waiting.extend(next(file));
        }
    }
    reached
}

impl Tree {
    fn read(root: &FilePath, read: &dyn Fn(&FilePath) -> Result<Option<String>>) -> Result<Self> {
        let text = read(root)?.with_context(|| format!("{}: is missing", root.display()))?;
        let mut tree = Self { nodes: Vec::new() };
        let folder = root.parent().unwrap_or(FilePath::new("")).to_path_buf();
        tree.add(root, &folder, None, &text, read)?;
        Ok(tree)
    }

    /// Adds the module of a file, whose own modules lie in `folder`.
    fn add(
        &mut self,
        file: &FilePath,
        folder: &FilePath,
        parent: Option<usize>,
        text: &str,
        read: &dyn Fn(&FilePath) -> Result<Option<String>>,
    ) -> Result<usize> {
        let module = Module::read(text).with_context(|| format!("{}: is not Rust", file.display()))?;
        self.add_module(file, folder, parent, module, read)
    }

    fn add_module(
        &mut self,
        file: &FilePath,
        folder: &FilePath,
        parent: Option<usize>,
        mut module: Module,
        read: &dyn Fn(&FilePath) -> Result<Option<String>>,
    ) -> Result<usize> {
        let (files, inline) = (std::mem::take(&mut module.files), std::mem::take(&mut module.inline));
        let here = self.nodes.len();
        self.nodes.push(Node { file: file.to_path_buf(), parent, children: BTreeMap::new(), module });
        for (name, module) in inline {
            let child = self.add_module(file, &folder.join(&name), Some(here), module, read)?;
            self.nodes[here].children.insert(name, child);
        }
        for name in files {
            let below = folder.join(&name);
            for file in [folder.join(format!("{name}.rs")), below.join("mod.rs")] {
                if let Some(text) = read(&file)? {
                    let child = self.add(&file, &below, Some(here), &text, read)?;
                    self.nodes[here].children.insert(name.clone(), child);
                    break;
                }
            }
        }
        Ok(here)
    }

    fn imports(&self) -> Imports {
        let mut imports = Imports::new();
        for (here, node) in self.nodes.iter().enumerate() {
            for path in node.module.imports() {
                let Some(to) = self.definition(here, path, MOST_HOPS) else { continue };
                let (from, to) = (&node.file, &self.nodes[to].file);
                if from != to {
                    let name = path.last().cloned().unwrap_or_default();
                    imports.entry((from.clone(), to.clone())).or_default().insert(name);
                }
            }
        }
        imports
    }

    /// The module that defines what a path names, where that is in this crate.
    fn definition(&self, from: usize, path: &[String], hops: usize) -> Option<usize> {
        let hops = hops.checked_sub(1)?;
        let (first, mut rest) = path.split_first()?;
        let mut here = match first.as_str() {
            "crate" => 0,
            "self" => from,
            "super" => self.nodes[from].parent?,
            name => *self.nodes[from].children.get(name)?,
        };
        while let Some((name, after)) = rest.split_first() {
            let node = &self.nodes[here];
            rest = after;
            if name == "super" {
                here = node.parent?;
            } else if let Some(&child) = node.children.get(name) {
                here = child;
            } else if name == "*" || node.module.defined.contains(name) {
                return Some(here);
            } else {
                return self.passed_on(here, name, after, hops).or(Some(here));
            }
        }
        Some(here)
    }

    /// The module that defines what `here` passes on under a name.
    fn passed_on(&self, here: usize, name: &str, after: &[String], hops: usize) -> Option<usize> {
        let used = &self.nodes[here].module.used;
        let follow = |path: &Path, name: Option<&str>| {
            let path: Path = path
                .iter()
                .map(String::as_str)
                .chain(name)
                .chain(after.iter().map(String::as_str))
                .map(str::to_owned)
                .collect();
            self.definition(here, &path, hops)
        };
        if let Some(used) = used.iter().find(|used| used.name == name) {
            return follow(&used.path, None);
        }
        let globs = used.iter().filter(|used| used.name == "*").map(|used| &used.path);
        globs
            .filter_map(|path| {
                let module: Path = path[..path.len() - 1].to_vec();
                let target = self.definition(here, &module, hops)?;
                let node = &self.nodes[target];
                let has = node.module.defined.iter().any(|defined| defined == name) || node.children.contains_key(name);
                has.then(|| follow(&module, Some(name))).flatten()
            })
            .next()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(files: &[(&str, &str)]) -> Vec<String> {
        let read = |file: &FilePath| {
            let text = files.iter().find(|(name, _)| FilePath::new(name) == file).map(|(_, text)| (*text).to_owned());
            Ok(text)
        };
        circles(FilePath::new("src/lib.rs"), &read).unwrap()
    }

    #[test]
    fn two_files_that_import_each_other_are_a_circle() {
        let files = [
            ("src/lib.rs", "mod a; mod b; mod c; pub use a::A;"),
            ("src/a.rs", "use crate::b::{B, C}; pub struct A;"),
            ("src/b.rs", "use super::a; use crate::c::D; pub struct B; pub struct C; fn f(_: a::A) {}"),
            ("src/c.rs", "pub struct D;"),
        ];
        assert_eq!(found(&files), ["src/a.rs -> src/b.rs: B, C\n  src/b.rs -> src/a.rs: a"]);
    }

    #[test]
    fn a_long_circle_is_one() {
        let files = [
            ("src/lib.rs", "mod a; mod b; mod c;"),
            ("src/a.rs", "fn f() { crate::b::g() }"),
            ("src/b/mod.rs", "mod d; pub use d::g;"),
            ("src/b/d.rs", "pub fn g() { println!(\"{}\", crate::c::H) }"),
            ("src/c.rs", "pub const H: u8 = 0; impl crate::a::T for u8 {}"),
        ];
        let expected = "src/a.rs -> src/b/d.rs: g\n  src/b/d.rs -> src/c.rs: H\n  src/c.rs -> src/a.rs: T";
        assert_eq!(found(&files), [expected]);
    }

    #[test]
    fn a_module_and_what_it_is_made_of_may_be_a_circle() {
        let files = [
            ("src/lib.rs", "mod a;"),
            ("src/a/mod.rs", "mod b; pub struct A; pub fn f() { b::g() }"),
            ("src/a/b.rs", "use super::A; pub fn g() {}"),
        ];
        assert_eq!(found(&files), ["src/a/b.rs -> src/a/mod.rs: A\n  src/a/mod.rs -> src/a/b.rs: g"]);
    }

    #[test]
    fn names_that_are_passed_on_belong_to_the_file_that_defines_them() {
        let files = [
            ("src/lib.rs", "mod a; mod b; pub use a::A; pub use b::*;"),
            ("src/a.rs", "pub struct A;"),
            ("src/b.rs", "use crate::A; pub struct B;"),
        ];
        assert_eq!(found(&files), Vec::<String>::new());
        // To pass on is not to import.
        let files = [("src/lib.rs", "mod a; pub use a::A; pub struct B;"), ("src/a.rs", "use crate::B; pub struct A;")];
        assert_eq!(found(&files), Vec::<String>::new());
        // Through a glob too.
        let files = [
            ("src/lib.rs", "mod a; mod b; pub use a::A; pub use b::*;"),
            ("src/a.rs", "use crate::B; pub struct A;"),
            ("src/b.rs", "use crate::A; pub struct B;"),
        ];
        assert_eq!(found(&files), ["src/a.rs -> src/b.rs: B\n  src/b.rs -> src/a.rs: A"]);
    }

    #[test]
    fn tests_inline_modules_and_other_crates_make_no_circle() {
        let files = [
            ("src/lib.rs", "mod a; #[cfg(test)] mod tests; mod within { use super::a::A; pub struct B; }"),
            (
                "src/a.rs",
                "use a::b::C; use std::fmt; pub struct A; #[cfg(test)] mod tests { use super::super::within::B; }",
            ),
            ("src/tests.rs", "use super::*; use crate::a::A;"),
        ];
        assert_eq!(found(&files), Vec::<String>::new());
    }

    #[test]
    fn two_that_pass_on_each_others_names_end() {
        let files = [
            ("src/lib.rs", "mod a; mod b;"),
            ("src/a.rs", "pub use crate::b::X;"),
            ("src/b.rs", "pub use crate::a::X;"),
        ];
        assert!(found(&files).len() <= 1);
    }
}
