//! The codes of all crates against the sources of the workspace.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::{Path, PathBuf},
};

use congruent::input::Code;
use regex_lite::Regex;

use super::all_codes as all;

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a readable folder") {
        let path = entry.expect("a readable entry").path();
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default().to_owned();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|it| it == "rs" || it == "py") && !name.ends_with("tests.rs") {
            found.push(path);
        }
    }
}

/// What a pattern finds in the sources of all crates outside of tests and comments, each with a file that has it.
fn found(pattern: &str) -> BTreeMap<String, PathBuf> {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut files = Vec::new();
    for entry in fs::read_dir(crates).expect("the workspace") {
        let path = entry.expect("a crate").path();
        // The package has messages of its own in Python.
        for source in [path.join("src"), path.join("python/congruent")].iter().filter(|it| it.is_dir()) {
            sources(source, &mut files);
        }
    }
    let pattern = Regex::new(pattern).expect("a pattern");
    let mut found = BTreeMap::new();
    for file in files {
        let text = fs::read_to_string(&file).expect("a source");
        let before_tests = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
        for line in before_tests.lines().filter(|line| !line.trim_start().starts_with("//")) {
            found.extend(pattern.captures_iter(line).map(|each| (each[1].to_owned(), file.clone())));
        }
    }
    found
}

#[test]
fn every_code_that_is_used_is_in_the_list_and_the_list_has_no_other() {
    let used = found(r"codes::([a-z_0-9]+::[A-Z_0-9]+)\b");
    assert!(used.len() > 200, "{} codes are found: the search has broken", used.len());
    let known: BTreeSet<String> = all().iter().map(|code| code.name.to_owned()).collect();
    let in_python = found(r#""(python::[a-z_]+)""#);
    let used = used.into_iter().chain(in_python).map(|(path, file)| (path.to_lowercase(), file));
    let (used, missing): (Vec<_>, Vec<_>) = used.partition(|(name, _)| known.contains(name));
    assert!(
        missing.is_empty(),
        "the list of a crate is not in `all_codes`, or no name is its path: {missing:#?}"
    );
    let used: BTreeSet<String> = used.into_iter().map(|(name, _)| name).collect();
    let unused: Vec<_> = known.difference(&used).collect();
    assert!(unused.is_empty(), "no source uses {unused:?}; its number must not be given again");
}

#[test]
fn every_declared_number_is_in_the_list() {
    let known: BTreeSet<&str> = all().iter().filter_map(|code| code.id).collect();
    let declared = found(r#""(CGR-[A-Z]+-[0-9]+)""#);
    let missing: Vec<_> = declared.iter().filter(|(id, _)| !known.contains(id.as_str())).collect();
    assert!(missing.is_empty(), "not in `all_codes`: {missing:#?}");
}

/// What a program does must not depend on the text of a code, which the compiler cannot compare with the declaration.
#[test]
fn no_source_has_a_code_as_text() {
    let mut written = found(r#"^[^#]*"([a-z_]+::[a-z_0-9]*)""#);
    written.retain(|_, file| !file.ends_with("src/codes.rs") && !file.ends_with("codes/mod.rs"));
    // The words before the name of a cause, which is its code.
    written.remove("check::");
    assert!(written.is_empty(), "compare with the declared code: {written:#?}");
}

#[test]
fn no_number_and_no_name_is_given_twice() {
    let form = Regex::new("^CGR-[A-Z]+-[0-9]{3}$").expect("a pattern");
    let ids: BTreeSet<&str> = all().iter().filter_map(|code| code.id).collect();
    let (mut seen, mut names) = (BTreeSet::new(), BTreeSet::new());
    for Code { id, name, about, .. } in all() {
        let id = id.expect("a number");
        assert!(form.is_match(id), "{id}: not of the form CGR-AREA-000");
        let last =
            ids.iter().rfind(|known| known.rsplit_once('-').unwrap().0 == id.rsplit_once('-').unwrap().0);
        assert!(seen.insert(id), "{id} is given twice; the last number of its area is {last:?}");
        assert!(names.insert(name), "{name} is declared twice");
        assert!(about.len() > 15 && about.contains('.'), "{id}: {about}");
    }
}
