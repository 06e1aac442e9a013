//! No file of a crate imports itself through others. Re-exports are followed to the file that defines the name,
//! so that a folder's `mod.rs` may gather what its files offer.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::Path,
};

/// A module's path in its crate.
type Module = Vec<String>;
/// The sources of a crate without tests, comments and visibilities, by module.
type Sources = BTreeMap<Module, String>;

fn read_sources(folder: &Path, module: &Module, sources: &mut Sources) {
    for entry in fs::read_dir(folder).expect("a folder of sources").flatten() {
        let (path, name) = (entry.path(), entry.file_name().display().to_string());
        let stem = name.strip_suffix(".rs");
        let mut inner = module.clone();
        if path.is_dir() {
            inner.push(name.clone());
            read_sources(&path, &inner, sources);
        } else if let Some(stem) = stem.filter(|&stem| stem != "tests") {
            if !["mod", "lib", "main"].contains(&stem) {
                inner.push(stem.to_owned());
            }
            sources.insert(inner, without_tests(&fs::read_to_string(path).expect("a source")));
        }
    }
}

fn without_tests(text: &str) -> String {
    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    let lines = code.lines().map(|line| line.split("//").next().unwrap_or_default());
    let mut plain = lines.collect::<Vec<_>>().join("\n");
    while let Some(start) = plain.find("pub(") {
        let end = plain[start..].find(')').map_or(plain.len(), |length| start + length + 1);
        plain.replace_range(start..end, "pub");
    }
    plain
}

/// The statements `use …;` of a source, those that begin with `keyword`, each path on its own.
fn imports(text: &str, keyword: &str) -> Vec<Vec<String>> {
    let starts = text.match_indices(keyword).map(|(at, _)| at);
    let is_line_start = |&at: &usize| text[..at].lines().last().is_none_or(|line| line.trim().is_empty());
    let statements =
        starts.filter(is_line_start).filter_map(|at| text[at + keyword.len()..].split(';').next());
    statements.flat_map(|tree| paths(&tree.split_whitespace().collect::<Vec<_>>().join(" "))).collect()
}

/// The paths of a tree of imports such as `a::{b, c::{d, e}}`.
fn paths(tree: &str) -> Vec<Vec<String>> {
    let tree = tree.trim();
    let Some((prefix, rest)) = tree.split_once('{') else {
        let path = tree.split(" as ").next().unwrap_or_default();
        return vec![path.split("::").map(str::to_owned).collect()];
    };
    let inner = rest.rsplit_once('}').map_or(rest, |(inner, _)| inner);
    let (mut depth, mut parts) = (0_usize, vec![String::new()]);
    for letter in inner.chars() {
        match letter {
            '{' => depth += 1,
            '}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if letter == ',' && depth == 0 {
            parts.push(String::new());
        } else {
            parts.last_mut().expect("a part is begun").push(letter);
        }
    }
    let parts = parts.iter().map(|part| part.trim()).filter(|part| !part.is_empty());
    parts.flat_map(|part| paths(&format!("{prefix}{part}"))).collect()
}

/// The module that a path leads to, from a module of the crate; `None` if it leaves the crate.
fn target(sources: &Sources, from: &Module, path: &[String]) -> Option<Module> {
    let mut base = from.clone();
    let mut rest = path;
    match path.first().map(String::as_str)? {
        "crate" => (base, rest) = (Module::new(), &path[1..]),
        "self" => rest = &path[1..],
        "super" => {}
        child => {
            let mut inner = from.clone();
            inner.push(child.to_owned());
            sources.get(&inner)?;
        }
    }
    while rest.first().is_some_and(|step| step == "super") {
        base.pop();
        rest = &rest[1..];
    }
    while let Some((step, further)) = rest.split_first() {
        let mut inner = base.clone();
        inner.push(step.clone());
        if !sources.contains_key(&inner) {
            return Some(defining(sources, &base, step).unwrap_or(base));
        }
        (base, rest) = (inner, further);
    }
    Some(base)
}

/// The module from which `module` re-exports `name`; a prelude, which re-exports by the whole path, defines nothing.
fn defining(sources: &Sources, module: &Module, name: &str) -> Option<Module> {
    let exports = imports(sources.get(module)?, "pub use ");
    let is_export = |path: &&Vec<String>| path[0] != "crate" && path.last().is_some_and(|last| last == name);
    target(sources, module, exports.iter().find(is_export)?)
}

/// A circle of modules, if a walk along the imports comes back to one that it is still in.
fn circle(
    imported: &BTreeMap<&Module, BTreeSet<Module>>,
    walk: &mut Vec<Module>,
    done: &mut BTreeSet<Module>,
) -> Option<Vec<Module>> {
    let last = walk.last().expect("a walk has begun").clone();
    for next in imported.get(&last).into_iter().flatten() {
        if let Some(start) = walk.iter().position(|module| module == next) {
            return Some(walk[start..].to_vec());
        }
        if !done.contains(next) {
            walk.push(next.clone());
            if let Some(found) = circle(imported, walk, done) {
                return Some(found);
            }
            walk.pop();
        }
    }
    done.insert(last);
    None
}

fn circle_of(sources: &Sources) -> Option<Vec<Module>> {
    let targets = |(module, text): (&'_ Module, &String)| -> BTreeSet<Module> {
        let paths = ["use ", "pub use "].into_iter().flat_map(|keyword| imports(text, keyword));
        paths.filter_map(|path| target(sources, module, &path)).filter(|to| to != module).collect()
    };
    let imported = sources.iter().map(|(module, text)| (module, targets((module, text)))).collect();
    let mut done = BTreeSet::new();
    sources.keys().find_map(|module| circle(&imported, &mut vec![module.clone()], &mut done))
}

#[test]
fn files_do_not_import_each_other_in_circles() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    for entry in fs::read_dir(crates).expect("the folder of crates").flatten() {
        let mut sources = Sources::new();
        read_sources(&entry.path().join("src"), &Module::new(), &mut sources);
        let found = circle_of(&sources)
            .map(|circle| circle.iter().map(|module| module.join("::")).collect::<Vec<_>>());
        assert!(found.is_none(), "{}: {found:?} import each other", entry.file_name().display());
    }
}

#[test]
fn a_circle_is_found_through_a_re_export() {
    let module = |path: &str| path.split("::").map(str::to_owned).collect::<Module>();
    let mut sources = Sources::new();
    sources.insert(Module::new(), "pub mod a;\npub mod b;".to_owned());
    sources.insert(module("a"), "use crate::b::{Deep, Other};".to_owned());
    sources.insert(module("b"), "pub use deep::{Deep, Other};".to_owned());
    sources.insert(module("b::deep"), "pub struct Deep;".to_owned());
    assert_eq!(circle_of(&sources), None);
    sources.insert(module("b::deep"), "use crate::a::{\n    Thing,\n};".to_owned());
    assert_eq!(circle_of(&sources).map(|circle| circle.len()), Some(2));
}
