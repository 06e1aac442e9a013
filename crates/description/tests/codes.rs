//! The table of codes against the sources of the workspace.

use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::{Path, PathBuf},
};

use congruent_input::Code;

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a readable folder") {
        let path = entry.expect("a readable entry").path();
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default().to_owned();
        if path.is_dir() {
            // Tests make codes up; the table itself uses none.
            if !name.ends_with("tests") && name != "codes" {
                sources(&path, found);
            }
        } else if path.extension().is_some_and(|it| it == "rs") && !name.ends_with("tests.rs") {
            found.push(path);
        }
    }
}

/// Codes as the sources write them, each with a file that does.
fn used() -> BTreeMap<String, PathBuf> {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut files = Vec::new();
    for entry in fs::read_dir(crates).expect("the workspace") {
        let source = entry.expect("a crate").path().join("src");
        if source.is_dir() {
            sources(&source, &mut files);
        }
    }
    let literal = regex_lite::Regex::new(r#""([a-z_]+::[a-z_0-9]+)""#).expect("a pattern");
    let mut used = BTreeMap::new();
    for file in files {
        let text = fs::read_to_string(&file).expect("a source");
        let before_tests = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
        // The paths of functions in attributes of serde have the same form.
        let lines = before_tests
            .lines()
            .filter(|line| !line.contains("serde(") && !line.contains("skip_serializing"));
        for line in lines {
            for found in literal.captures_iter(line) {
                used.insert(found[1].to_owned(), file.clone());
            }
        }
    }
    used
}

#[test]
fn every_code_is_in_the_table_and_the_table_has_no_other() {
    let used = used();
    assert!(used.len() > 200, "{} codes are found: the search has broken", used.len());
    let known: BTreeSet<&str> = Code::all().map(|code| code.name).collect();
    let missing: Vec<_> = used.iter().filter(|(code, _)| !known.contains(code.as_str())).collect();
    assert!(missing.is_empty(), "give each a new number in input/src/codes: {missing:#?}");
    let unused: Vec<_> = known.iter().filter(|name| !used.contains_key(**name)).collect();
    assert!(unused.is_empty(), "no source uses {unused:?}; its number must not be given again");
}

#[test]
fn no_number_and_no_name_is_given_twice() {
    let (mut numbers, mut names) = (BTreeSet::new(), BTreeSet::new());
    for code in Code::all() {
        assert!(numbers.insert(code.to_string()), "{code} is given twice");
        assert!(names.insert(code.name), "{} is in the table twice", code.name);
        let form = regex_lite::Regex::new("^CGR-[A-Z]+-[0-9]{3}$").unwrap();
        assert!(form.is_match(&code.to_string()), "{code}");
        assert!(code.about.len() > 15 && code.about.contains('.'), "{code}: {}", code.about);
    }
}
