//! What one Rust file says of modules: those it declares, the names it has, and the paths it writes.

use std::collections::BTreeMap;

use proc_macro2::{TokenStream, TokenTree};
use syn::visit::{self, Visit};
use syn::{Attribute, Ident, Item, ItemMod, ItemUse, Macro, UseTree, Visibility};

/// A path as it is written, without generic arguments: `["super", "axis", "Axis"]`. That of a glob ends in `*`.
pub(super) type Path = Vec<String>;

/// A name that `use` brings into a module.
#[derive(Debug, PartialEq)]
pub(super) struct Use {
    /// As it is known here; `*` stands for all names.
    pub(super) name: String,
    pub(super) path: Path,
    /// `pub use`, of any visibility: the module passes the name on.
    pub(super) passed_on: bool,
}

/// A module as its file shows it. What only tests see is left out.
#[derive(Debug, Default)]
pub(super) struct Module {
    /// `mod name;`: modules with files of their own.
    pub(super) files: Vec<String>,
    /// `mod name { .. }`.
    pub(super) inline: BTreeMap<String, Module>,
    /// Names of the functions, types, constants, traits and macros that are defined here.
    pub(super) defined: Vec<String>,
    /// Every name that `use` brings.
    pub(super) used: Vec<Use>,
    /// Every other path of more than one segment.
    pub(super) written: Vec<Path>,
}

impl Module {
    /// Parses the text of a Rust file.
    ///
    /// # Errors
    /// Where it is not Rust.
    pub(super) fn read(text: &str) -> Result<Self, syn::Error> {
        Ok(Self::of(&syn::parse_file(text)?.items))
    }

    fn of(items: &[Item]) -> Self {
        let mut module = Self::default();
        for item in items {
            module.visit_item(item);
        }
        module
    }

    /// Every path that is written here, those of `use` among them.
    pub(super) fn paths(&self) -> impl Iterator<Item = &Path> {
        self.used.iter().map(|used| &used.path).chain(&self.written)
    }

    /// Every path that the module itself makes use of: all but those it only passes on.
    pub(super) fn imports(&self) -> impl Iterator<Item = &Path> {
        let used = self.used.iter().filter(|used| !used.passed_on);
        used.map(|used| &used.path).chain(&self.written)
    }

    fn add_used(&mut self, tree: &UseTree, before: &[String], passed_on: bool) {
        let with = |ident: &Ident| [before, &[ident.to_string()]].concat();
        let (name, path) = match tree {
            UseTree::Path(path) => return self.add_used(&path.tree, &with(&path.ident), passed_on),
            UseTree::Group(group) => {
                return group.items.iter().for_each(|tree| self.add_used(tree, before, passed_on));
            }
            UseTree::Glob(_) => ("*".to_owned(), [before, &["*".to_owned()]].concat()),
            // `a::{self}` is `a`.
            UseTree::Name(name) if name.ident == "self" => {
                (before.last().cloned().unwrap_or_default(), before.to_vec())
            }
            UseTree::Name(name) => (name.ident.to_string(), with(&name.ident)),
            UseTree::Rename(rename) if rename.ident == "self" => (rename.rename.to_string(), before.to_vec()),
            UseTree::Rename(rename) => (rename.rename.to_string(), with(&rename.ident)),
        };
        self.used.push(Use { name, path, passed_on });
    }

    /// Paths in the arguments of a macro, which are tokens to the parser.
    fn add_tokens(&mut self, tokens: TokenStream) {
        let mut path = Path::new();
        let mut colons = 0;
        for token in tokens {
            match token {
                TokenTree::Ident(ident) => {
                    if colons != 2 {
                        self.add_written(&mut path);
                    }
                    path.push(ident.to_string());
                    colons = 0;
                }
                TokenTree::Punct(punct) if punct.as_char() == ':' => colons += 1,
                other => {
                    self.add_written(&mut path);
                    colons = 0;
                    if let TokenTree::Group(group) = other {
                        self.add_tokens(group.stream());
                    }
                }
            }
        }
        self.add_written(&mut path);
    }

    fn add_written(&mut self, path: &mut Path) {
        if path.len() > 1 {
            self.written.push(std::mem::take(path));
        }
        path.clear();
    }
}

impl Visit<'_> for Module {
    fn visit_item(&mut self, item: &Item) {
        let (attributes, name): (&[Attribute], Option<&Ident>) = match item {
            Item::Const(item) => (&item.attrs, Some(&item.ident)),
            Item::Enum(item) => (&item.attrs, Some(&item.ident)),
            Item::Fn(item) => (&item.attrs, Some(&item.sig.ident)),
            Item::Impl(item) => (&item.attrs, None),
            Item::Macro(item) => (&item.attrs, item.ident.as_ref()),
            Item::Mod(item) => (&item.attrs, None),
            Item::Static(item) => (&item.attrs, Some(&item.ident)),
            Item::Struct(item) => (&item.attrs, Some(&item.ident)),
            Item::Trait(item) => (&item.attrs, Some(&item.ident)),
            Item::Type(item) => (&item.attrs, Some(&item.ident)),
            Item::Union(item) => (&item.attrs, Some(&item.ident)),
            Item::Use(item) => (&item.attrs, None),
            _ => (&[], None),
        };
        if is_of_tests(attributes) {
            return;
        }
        self.defined.extend(name.map(Ident::to_string));
        visit::visit_item(self, item);
    }

    fn visit_item_mod(&mut self, item: &ItemMod) {
        let name = item.ident.to_string();
        match &item.content {
            Some((_, items)) => drop(self.inline.insert(name, Self::of(items))),
            None => self.files.push(name),
        }
    }

    fn visit_item_use(&mut self, item: &ItemUse) {
        // `::name` is always a crate.
        if item.leading_colon.is_none() {
            self.add_used(&item.tree, &[], !matches!(item.vis, Visibility::Inherited));
        }
    }

    /// `pub(in crate::a)` imports nothing.
    fn visit_visibility(&mut self, _: &Visibility) {}

    fn visit_path(&mut self, path: &syn::Path) {
        if path.leading_colon.is_none() && path.segments.len() > 1 {
            self.written.push(path.segments.iter().map(|segment| segment.ident.to_string()).collect());
        }
        visit::visit_path(self, path);
    }

    fn visit_macro(&mut self, item: &Macro) {
        visit::visit_macro(self, item);
        self.add_tokens(item.tokens.clone());
    }
}

/// `#[test]`, `#[cfg(test)]` and `#[cfg(all(test, ..))]`.
fn is_of_tests(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        let of_cfg = || attribute.meta.require_list().is_ok_and(|list| holds_test(list.tokens.clone()));
        attribute.path().is_ident("test") || (attribute.path().is_ident("cfg") && of_cfg())
    })
}

fn holds_test(tokens: TokenStream) -> bool {
    let mut negated = false;
    tokens.into_iter().any(|token| match token {
        TokenTree::Ident(ident) => {
            negated = ident == "not";
            ident == "test"
        }
        TokenTree::Group(group) => !std::mem::take(&mut negated) && holds_test(group.stream()),
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(text: &str) -> Path {
        text.split("::").map(str::to_owned).collect()
    }

    fn used(name: &str, full: &str, passed_on: bool) -> Use {
        Use { name: name.to_owned(), path: path(full), passed_on }
    }

    #[test]
    fn paths_of_every_kind_are_found() {
        let text = r#"
            use super::{axis::{self, Axis}, text::plain as written, *};
            use ::std::fmt;
            pub(in crate::nowhere) use crate::c::C;
            mod own;
            mod within { use super::super::far; pub struct Near; }
            /// crate::not_this
            pub fn f(v: crate::a::T<super::b::U>) -> usize {
                let s = "crate::nor_this";
                println!("{s} {}", crate::c::length(&[self::d::E; 2]));
                own::g(v)
            }
            impl crate::h::Trait for Local {}
            struct Local;
        "#;
        let module = Module::read(text).unwrap();
        assert_eq!(module.files, ["own"]);
        assert_eq!(module.inline["within"].defined, ["Near"]);
        assert_eq!(module.inline["within"].used, [used("far", "super::super::far", false)]);
        assert_eq!(module.defined, ["f", "Local"]);
        let expected = [
            used("axis", "super::axis", false),
            used("Axis", "super::axis::Axis", false),
            used("written", "super::text::plain", false),
            used("*", "super::*", false),
            used("C", "crate::c::C", true),
        ];
        assert_eq!(module.used, expected);
        for expected in ["crate::a::T", "super::b::U", "crate::c::length", "self::d::E", "own::g", "crate::h::Trait"] {
            assert!(module.written.contains(&path(expected)), "{expected}: {:?}", module.written);
        }
        assert!(!format!("{module:?}").contains("this") && !format!("{module:?}").contains("nowhere"), "{module:?}");
    }

    #[test]
    fn what_only_tests_see_is_left_out() {
        let text = r#"
            #[cfg(test)] mod tests;
            #[cfg(all(test, unix))] use crate::a;
            #[test] fn t() { crate::b::c(); }
            #[cfg(not(test))] mod real;
            #[cfg(feature = "test")] mod also_real;
        "#;
        let module = Module::read(text).unwrap();
        assert_eq!(module.files, ["real", "also_real"]);
        assert!(module.used.is_empty() && module.written.is_empty() && module.defined.is_empty(), "{module:?}");
    }
}
