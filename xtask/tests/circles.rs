//! No file of a crate imports itself through others, and no folder below `src` does. Re-exports are followed to the file
//! that defines the name, so that a folder's `mod.rs` may gather what its files offer.

mod support;

use std::collections::{BTreeMap, BTreeSet};

use support::{parts_at_commas, plain_code, program_sources};

/// A module's path in its crate.
type Module = Vec<String>;
/// The sources of a crate without tests, comments and visibilities, by module.
type Sources = BTreeMap<Module, String>;

/// The sources of each crate. A library and its program have one root.
fn sources_of_crates() -> BTreeMap<String, Sources> {
    let by_module = |files: Vec<(String, String)>| {
        let mut sources = Sources::new();
        for (name, text) in files {
            *sources.entry(module_of(&name)).or_default() += &plain_code(&text);
        }
        sources
    };
    program_sources().into_iter().map(|(name, files)| (name, by_module(files))).collect()
}

/// The module of a file below `crates/<name>/src`.
fn module_of(name: &str) -> Module {
    let path = name.split_once("/src/").map_or(name, |(_, path)| path).trim_end_matches(".rs");
    let mut steps: Module = path.split('/').map(str::to_owned).collect();
    if steps.last().is_some_and(|stem| ["mod", "lib", "main"].contains(&stem.as_str())) {
        steps.pop();
    }
    steps
}

/// The statements `use …;` of a source, those that begin with `keyword`, each path on its own.
fn imports(text: &str, keyword: &str) -> Vec<Vec<String>> {
    let starts = text.match_indices(keyword).map(|(at, _)| at);
    let is_line_start =
        |&at: &usize| text[..at].rsplit('\n').next().is_none_or(|line| line.trim().is_empty());
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
    parts_at_commas(inner).iter().flat_map(|part| paths(&format!("{prefix}{part}"))).collect()
}

/// The paths in the code that begin with `crate` or `super`, outside of imports.
fn named_paths(text: &str) -> Vec<Vec<String>> {
    let is_of_path = |letter: char| letter == '_' || letter == ':' || letter.is_alphanumeric();
    let mut found = Vec::new();
    for statement in text.split_inclusive(';').filter(|statement| !is_import(statement)) {
        for word in statement.split(|letter| !is_of_path(letter)) {
            if word.starts_with("crate::") || word.starts_with("super::") {
                found.push(word.trim_end_matches(':').split("::").map(str::to_owned).collect());
            }
        }
    }
    found
}

fn is_import(statement: &str) -> bool {
    let statement = statement.trim_start();
    statement.starts_with("use ") || statement.starts_with("pub use ")
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

/// All imports of the crate's own modules: from which module to which, by which path.
fn all_imports(sources: &Sources) -> Vec<(Module, Module, String)> {
    let mut found = Vec::new();
    for (module, text) in sources {
        let imported = ["use ", "pub use "].into_iter().flat_map(|keyword| imports(text, keyword));
        for path in imported.chain(named_paths(text)) {
            let to = target(sources, module, &path).filter(|to| to != module);
            found.extend(to.map(|to| (module.clone(), to, path.join("::"))));
        }
    }
    found
}

fn circle_of(sources: &Sources) -> Option<Vec<Module>> {
    let mut imported: BTreeMap<&Module, BTreeSet<Module>> = BTreeMap::new();
    let all = all_imports(sources);
    // The root of a crate re-exports what its folders offer.
    for (from, to, _) in all.iter().filter(|(from, to, _)| !from.is_empty() && !to.is_empty()) {
        imported.entry(from).or_default().insert(to.clone());
    }
    let mut done = BTreeSet::new();
    sources.keys().find_map(|module| circle(&imported, &mut vec![module.clone()], &mut done))
}

/// Circles of folders of today: the crate, and two folders that import each other. Who breaks one takes it off;
/// none is added.
const KNOWN_CIRCLES: &[(&str, [&str; 2])] = &[
    // `view` runs a scenario, whose arguments know the formats of recordings.
    ("cli", ["recording", "run"]),
    // The setup resolves the faults of a scenario, and an injected fault reads the setup.
    ("twin", ["fault", "setup"]),
];

/// The imports between the folders of a crate, each as it is to be read in a message, by importer and imported folder.
type FolderImports = BTreeMap<(String, String), Vec<String>>;

/// The imports between the modules directly below `src`, a folder's files taken together. The crate's root and a
/// prelude gather names from everywhere and do not count.
fn folder_imports(sources: &Sources) -> FolderImports {
    let folder = |module: &Module| module.first().filter(|&name| name != "prelude").cloned();
    let mut found = FolderImports::new();
    for (from, to, path) in all_imports(sources) {
        let Some(ends) = folder(&from).zip(folder(&to)) else { continue };
        if ends.0 != ends.1 {
            let line = format!("{} takes {path} of {}", from.join("/"), to.join("/"));
            found.entry(ends).or_default().push(line);
        }
    }
    found
}

/// The folders that are reached from one by imports.
fn reached(imports: &FolderImports, start: &str) -> BTreeSet<String> {
    let (mut found, mut open) = (BTreeSet::new(), vec![start.to_owned()]);
    while let Some(folder) = open.pop() {
        for (_, to) in imports.keys().filter(|(from, _)| *from == folder) {
            if found.insert(to.clone()) {
                open.push(to.clone());
            }
        }
    }
    found
}

/// Pairs of folders each of which reaches the other, with the imports that lead from one to the next of its circle.
fn folder_circles(imports: &FolderImports) -> BTreeMap<(String, String), Vec<String>> {
    let folders: BTreeSet<&String> = imports.keys().flat_map(|(from, to)| [from, to]).collect();
    let reach: BTreeMap<&String, BTreeSet<String>> =
        folders.iter().map(|&folder| (folder, reached(imports, folder))).collect();
    let is_in_circle = |a: &String, b: &String| reach[a].contains(b) && reach[b].contains(a);
    let mut circles = BTreeMap::new();
    for ((from, to), lines) in imports.iter().filter(|((from, to), _)| is_in_circle(from, to)) {
        circles.insert((from.clone(), to.clone()), lines.clone());
    }
    circles
}

#[test]
fn files_do_not_import_each_other_in_circles() {
    for (name, sources) in sources_of_crates() {
        let found = circle_of(&sources)
            .map(|circle| circle.iter().map(|module| module.join("::")).collect::<Vec<_>>());
        assert!(
            found.is_none(),
            "{name}: {found:?} import each other: move what they share into a file that imports none of them"
        );
    }
}

#[test]
fn folders_do_not_import_each_other_in_circles() {
    let (mut found, mut known, mut count) = (Vec::new(), BTreeSet::new(), 0);
    for (name, sources) in sources_of_crates() {
        let imports = folder_imports(&sources);
        count += imports.len();
        for ((from, to), lines) in folder_circles(&imports) {
            let is_known = |(of, pair): &&(&str, [&str; 2])| {
                *of == name && pair.contains(&from.as_str()) && pair.contains(&to.as_str())
            };
            match KNOWN_CIRCLES.iter().find(is_known) {
                Some(circle) => _ = known.insert(circle),
                None => found.push(format!("{name}: {from} -> {to}\n    {}", lines.join("\n    "))),
            }
        }
    }
    assert!(count > 200, "{count} pairs of folders were found");
    assert!(
        found.is_empty(),
        "folders import each other in circles; move the name or the file to the folder it belongs to:\n{}",
        found.join("\n")
    );
    let gone: Vec<_> = KNOWN_CIRCLES.iter().filter(|circle| !known.contains(circle)).collect();
    assert!(gone.is_empty(), "no circles any more, take them off KNOWN_CIRCLES: {gone:?}");
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

#[test]
fn a_circle_of_folders_is_found() {
    let module = |path: &str| path.split("::").map(str::to_owned).collect::<Module>();
    let mut sources = Sources::new();
    sources.insert(Module::new(), "pub use a::First;\npub use b::Third;".to_owned());
    sources.insert(module("a"), "pub use first::First;".to_owned());
    sources.insert(module("a::first"), "use crate::b::Third;".to_owned());
    sources.insert(module("a::second"), "pub struct Second;".to_owned());
    sources.insert(module("b"), "pub use third::Third;".to_owned());
    sources.insert(module("b::third"), "pub struct Third;".to_owned());
    assert_eq!(folder_circles(&folder_imports(&sources)).len(), 0);
    // No circle of files, but one of folders.
    sources.insert(module("b::fourth"), "use crate::a::second::Second;".to_owned());
    assert_eq!(circle_of(&sources), None);
    assert_eq!(folder_circles(&folder_imports(&sources)).len(), 2);
}
