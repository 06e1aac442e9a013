//! One public meaning for a type's name across the crates, and arguments with names instead of tuples.

mod support;

use std::collections::{BTreeMap, BTreeSet};

use support::{code_lines, parts_at_commas, plain_code, program_sources};

/// Names of types that two crates declare today, at least one of them for itself. The goal is an empty list: a reader
/// who meets a name in a message of the compiler or in a search should not have to ask which of the two it is. No
/// name is *public* in two crates, and none may be: that list is empty already.
const DOUBLE_NAMES: &[&str] = &[
    "Area",
    "Arm",
    "Batch",
    "Block",
    "ByJoint",
    "Camera",
    "Chart",
    "Count",
    "Curve",
    "Distances",
    "Explanation",
    "ExplanationRank",
    "FaultPlace",
    "Frames",
    "Instant",
    "JointParts",
    "JointQuantity",
    "JointSweep",
    "Lanes",
    "Loss",
    "Measure",
    "MimicFollower",
    "Motion",
    "MovingBody",
    "Observed",
    "Outcome",
    "Progress",
    "Results",
    "Rows",
    "Sampling",
    "Shape",
    "Solution",
    "ThinnedPath",
    "Trajectory",
];
/// Types that each command or each crate has under one name on purpose.
const ONE_IN_EACH: &[&str] = &["Arguments"];

/// Most functions with a tuple among their parameters. The goal is the few that take a pair of like values.
const MOST_WITH_TUPLES: usize = 185;
/// Most functions with more than five arguments, a tuple counted by its elements. The goal is none.
const MOST_WITH_MANY: usize = 15;
/// Most functions with a parameter that is a tuple of more than [`UNLIKE`] values of different types. The goal is none.
const MOST_WITH_UNLIKE: usize = 12;
/// Values of different types that a tuple parameter may have.
const UNLIKE: usize = 2;
/// Arguments that a function may have; `clippy.toml` counts a tuple as one.
const MOST_ARGUMENTS: usize = 5;

/// The types that a source declares outside of functions and traits, those with this beginning alone.
fn types(text: &str, beginning: &str) -> Vec<String> {
    let code = plain_code(text);
    let mut found = Vec::new();
    for line in code.lines().filter_map(|line| line.strip_prefix(beginning)) {
        let mut words = line.split(|letter: char| letter != '_' && !letter.is_alphanumeric());
        if words.next().is_some_and(|kind| ["struct", "enum", "trait", "type", "union"].contains(&kind)) {
            found.extend(words.next().map(str::to_owned));
        }
    }
    found
}

/// The names that two crates declare or more, with those crates.
fn doubles(types_of: impl Fn(&str) -> Vec<String>) -> BTreeMap<String, BTreeSet<String>> {
    let mut crates_by_name: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (name, files) in program_sources() {
        for found in files.iter().flat_map(|(_, text)| types_of(text)) {
            crates_by_name.entry(found).or_default().insert(name.clone());
        }
    }
    crates_by_name.retain(|name, crates| crates.len() > 1 && !ONE_IN_EACH.contains(&name.as_str()));
    crates_by_name
}

#[test]
fn a_public_name_means_one_type() {
    let is_public = |line: &&str| line.starts_with("pub ");
    let public = |text: &str| {
        let lines: Vec<&str> = code_lines(text).filter(is_public).collect();
        types(&lines.join("\n"), "pub ")
    };
    let found = doubles(public);
    assert!(
        found.is_empty(),
        "public types of two crates with one name; name each by what it is: {found:#?}"
    );
}

#[test]
fn a_name_means_one_type() {
    let found = doubles(|text| [types(text, ""), types(text, "pub ")].concat());
    let new: Vec<_> = found.iter().filter(|(name, _)| !DOUBLE_NAMES.contains(&name.as_str())).collect();
    assert!(new.is_empty(), "types of two crates with one name; name the new one by what it is: {new:#?}");
    let gone: Vec<_> = DOUBLE_NAMES.iter().filter(|&&name| !found.contains_key(name)).collect();
    assert!(gone.is_empty(), "no doubles any more, take them off DOUBLE_NAMES: {gone:?}");
}

/// A function and the types of its parameters, `self` not counted.
struct Signature {
    name: String,
    parameters: Vec<String>,
}

/// The text up to the bracket that closes the one just opened.
fn up_to_closing(text: &str, [open, close]: [char; 2]) -> &str {
    let (mut depth, mut before) = (1, ' ');
    for (at, letter) in text.char_indices() {
        if letter == open {
            depth += 1;
        } else if letter == close && before != '-' {
            depth -= 1;
        }
        if depth == 0 {
            return &text[..at];
        }
        before = letter;
    }
    text
}

fn signatures(code: &str) -> Vec<Signature> {
    let mut found = Vec::new();
    for after in code.split(" fn ").skip(1).chain(code.split("\nfn ").skip(1)) {
        let name: String =
            after.chars().take_while(|&letter| letter == '_' || letter.is_alphanumeric()).collect();
        let mut rest = &after[name.len()..];
        if let Some(generics) = rest.strip_prefix('<') {
            rest = &generics[up_to_closing(generics, ['<', '>']).len() + 1..];
        }
        let Some(list) = rest.strip_prefix('(') else { continue };
        let parameters = parts_at_commas(up_to_closing(list, ['(', ')']));
        let types = parameters.iter().filter_map(|parameter| type_of(parameter));
        found.push(Signature { name, parameters: types.collect() });
    }
    found
}

/// The type of a parameter, behind the colon that follows its pattern; `None` for `self`.
fn type_of(parameter: &str) -> Option<String> {
    let plain = parameter.replace("::", "\u{1}");
    let (pattern, kind) = plain.split_once(": ")?;
    // A pattern with fields has colons of its own.
    let kind = if pattern.contains('{') { plain.rsplit_once(": ")?.1 } else { kind };
    Some(kind.replace('\u{1}', "::").split_whitespace().collect::<Vec<_>>().join(" "))
}

/// The elements of a tuple, also behind a reference; `None` if the type is none.
fn elements(kind: &str) -> Option<Vec<String>> {
    let inner = kind.trim_start_matches('&').trim_start_matches("mut ");
    let tuple = inner.strip_prefix('(')?.strip_suffix(')')?;
    Some(parts_at_commas(tuple)).filter(|elements| elements.len() > 1)
}

/// How many arguments a parameter is: the elements of a tuple one by one, those of inner tuples, too.
fn argument_count(kind: &str) -> usize {
    elements(kind).map_or(1, |elements| elements.iter().map(|element| argument_count(element)).sum())
}

/// The elements of a tuple whose types differ; 0 for other types and for tuples of like values.
fn unlike_count(kind: &str) -> usize {
    let Some(elements) = elements(kind) else { return 0 };
    let is_unlike = elements.iter().any(|element| *element != elements[0]);
    if is_unlike { argument_count(kind) } else { 0 }
}

#[test]
fn arguments_are_not_packed_into_tuples() {
    let (mut with_tuples, mut with_many, mut unlike) = (Vec::new(), Vec::new(), Vec::new());
    for (file, text) in program_sources().into_values().flatten() {
        for Signature { name, parameters } in signatures(&plain_code(&text)) {
            let place = format!("{file}: {name}({})", parameters.join(", "));
            let tuples = parameters.iter().filter(|kind| elements(kind).is_some()).count();
            let arguments: usize = parameters.iter().map(|kind| argument_count(kind)).sum();
            if tuples > 0 && arguments > MOST_ARGUMENTS {
                with_many.push(format!("{arguments} {place}"));
            }
            if parameters.iter().any(|kind| unlike_count(kind) > UNLIKE) {
                unlike.push(place.clone());
            }
            if tuples > 0 {
                with_tuples.push(place);
            }
        }
    }
    for (found, most, what) in [
        (with_many, MOST_WITH_MANY, "have more than five arguments, a tuple counted by its elements"),
        (unlike, MOST_WITH_UNLIKE, "have a tuple of three or more unlike things"),
        (with_tuples, MOST_WITH_TUPLES, "have a tuple among their parameters"),
    ] {
        assert!(
            found.len() <= most,
            "{} functions {what}, {most} are allowed. Take a struct with named fields, or several parameters:\n{}",
            found.len(),
            found.join("\n")
        );
    }
}

#[test]
fn tuples_are_counted_by_their_elements() {
    let code = "\nfn plain(a: f64, b: &str) {}\n    pub fn packed<F: Fn(f64) -> f64>(\n        &self,\n        \
                (a, b): (f64, &[(u8, u8)]),\n        pair: &(f64, (f64, F)),\n        of: impl Fn((f64, f64)) -> f64,\n    ) {}";
    let found: Vec<(String, Vec<usize>)> = signatures(code)
        .into_iter()
        .map(|found| (found.name, found.parameters.iter().map(|kind| argument_count(kind)).collect()))
        .collect();
    let expected = [("packed".to_owned(), vec![2, 3, 1]), ("plain".to_owned(), vec![1, 1])];
    assert_eq!(found, expected);
    assert_eq!(["(f64, f64)", "(f64, u8)", "&(u8, u8, f64)", "f64"].map(unlike_count), [0, 2, 3, 0]);
}
