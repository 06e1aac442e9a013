//! What the tests of the repository share: its folders, its files, and the code of a source without its tests.

#![allow(dead_code, unreachable_pub, unused_imports, reason = "each test file uses its own part")]

mod arrows;

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

pub use arrows::ARROWS;

/// The root of the workspace.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize().expect("the workspace exists")
}

/// The text of a file.
pub fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// A path from the root, with `/`.
pub fn name_of(path: &Path) -> String {
    path.strip_prefix(root()).expect("below the root").display().to_string()
}

/// All files below a folder whose name has this extension, in order.
pub fn files_below(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut open = vec![folder.to_owned()];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(&folder).expect("a folder of the workspace").flatten() {
            let path = entry.path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|other| other == extension) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// All sources of the crates and of the tests, named relative to the root.
pub fn all_sources() -> Vec<(String, String)> {
    let root = root();
    let folders = ["crates", "tests", "xtask"].into_iter();
    let files = folders.flat_map(|folder| files_below(&root.join(folder), "rs"));
    files.map(|path| (name_of(&path), read(&path))).collect()
}

/// The folders in `crates/`, in order.
pub fn crate_names() -> Vec<String> {
    let folders = fs::read_dir(root().join("crates")).expect("the folder of crates").flatten();
    let mut names: Vec<String> = folders.map(|entry| entry.file_name().display().to_string()).collect();
    names.sort();
    names
}

/// Whether a source below `src` is compiled for tests alone.
pub fn is_test_source(name: &str) -> bool {
    let file = name.rsplit('/').next().unwrap_or_default();
    file == "tests.rs" || file.ends_with("_tests.rs") || name.contains("/tests/")
}

/// The sources of the programs, without those of tests: all below `crates/*/src`, by crate.
pub fn program_sources() -> BTreeMap<String, Vec<(String, String)>> {
    let mut sources = BTreeMap::new();
    for name in crate_names() {
        let files = files_below(&root().join("crates").join(&name).join("src"), "rs");
        let files: Vec<(String, String)> =
            files.into_iter().map(|path| (name_of(&path), read(&path))).collect();
        let of_tests = modules_of_tests(&files);
        let is_program = |(name, _): &(String, String)| {
            !is_test_source(name) && !of_tests.iter().any(|module| name.strip_suffix(".rs") == Some(module))
        };
        sources.insert(name, files.into_iter().filter(is_program).collect());
    }
    sources
}

/// The modules that are declared for tests alone, as paths without `.rs`.
fn modules_of_tests(files: &[(String, String)]) -> Vec<String> {
    let mut found = Vec::new();
    for (name, text) in files {
        let folder = name.rsplit_once('/').map_or("", |(folder, _)| folder);
        for after in text.split("#[cfg(test)]\nmod ").skip(1) {
            let module: String =
                after.chars().take_while(|&letter| letter == '_' || letter.is_alphanumeric()).collect();
            if after[module.len()..].starts_with(';') {
                found.push(format!("{folder}/{module}"));
            }
        }
    }
    found
}

/// The lines of code of a source: before its tests, neither blank nor comment.
pub fn code_lines(text: &str) -> impl Iterator<Item = &str> {
    let before_tests = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    before_tests.lines().filter(|line| {
        let line = line.trim_start();
        !line.is_empty() && !line.starts_with("//")
    })
}

/// The code of a source: [`code_lines`] with neither comments behind the code nor the scope of `pub(...)`.
pub fn plain_code(text: &str) -> String {
    let lines = code_lines(text).map(|line| line.split("// ").next().unwrap_or_default());
    let mut plain = lines.collect::<Vec<_>>().join("\n");
    while let Some(start) = plain.find("pub(") {
        let end = plain[start..].find(')').map_or(plain.len(), |length| start + length + 1);
        plain.replace_range(start..end, "pub");
    }
    plain
}

/// The parts of a list at its outermost commas: those within brackets of any kind do not part.
pub fn parts_at_commas(text: &str) -> Vec<String> {
    let (mut depth, mut parts, mut before) = (0_i32, vec![String::new()], ' ');
    for letter in text.chars() {
        match letter {
            '{' | '(' | '[' | '<' => depth += 1,
            // An arrow `->` is no bracket.
            '>' if before == '-' => {}
            '}' | ')' | ']' | '>' => depth -= 1,
            _ => {}
        }
        if letter == ',' && depth == 0 {
            parts.push(String::new());
        } else {
            parts.last_mut().expect("a part is begun").push(letter);
        }
        before = letter;
    }
    let parts = parts.into_iter().map(|part| part.trim().to_owned());
    parts.filter(|part| !part.is_empty()).collect()
}
