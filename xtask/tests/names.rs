//! One public meaning for a type's name across the crates, and arguments with names instead of tuples.

mod support;

use std::collections::{BTreeMap, BTreeSet};

use support::{parts_at_commas, plain_code, program_sources};

/// Types that each command or each crate has under one name on purpose.
const ONE_IN_EACH: &[&str] = &["Arguments"];
/// Arguments that a function may have; `clippy.toml` counts a tuple as one.
const MOST_ARGUMENTS: usize = 5;

/// The types that a source declares outside of functions and traits.
fn types(text: &str) -> Vec<String> {
    let code = plain_code(text);
    let mut found = Vec::new();
    for line in code.lines().map(|line| line.strip_prefix("pub ").unwrap_or(line)) {
        let mut words = line.split(|letter: char| letter != '_' && !letter.is_alphanumeric());
        if words.next().is_some_and(|kind| ["struct", "enum", "trait", "type", "union"].contains(&kind)) {
            found.extend(words.next().map(str::to_owned));
        }
    }
    found
}

/// A reader who meets a name in a message of the compiler or in a search should not have to ask which of two it is.
#[test]
fn a_name_means_one_type() {
    let mut crates_by_name: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (name, files) in program_sources() {
        for found in files.iter().flat_map(|(_, text)| types(text)) {
            crates_by_name.entry(found).or_default().insert(name.clone());
        }
    }
    crates_by_name.retain(|name, crates| crates.len() > 1 && !ONE_IN_EACH.contains(&name.as_str()));
    assert!(
        crates_by_name.is_empty(),
        "types of two crates with one name; name each by what it is: {crates_by_name:#?}"
    );
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

/// Whether a type is a tuple of different things.
fn is_of_unlike_things(kind: &str) -> bool {
    elements(kind).is_some_and(|elements| elements.iter().any(|element| *element != elements[0]))
}

#[test]
fn arguments_are_not_packed_into_tuples() {
    let mut packed = Vec::new();
    for (file, text) in program_sources().into_values().flatten() {
        for Signature { name, parameters } in signatures(&plain_code(&text)) {
            let has_tuple = parameters.iter().any(|kind| elements(kind).is_some());
            let arguments: usize = parameters.iter().map(|kind| argument_count(kind)).sum();
            let has_unlike = parameters.iter().any(|kind| is_of_unlike_things(kind));
            if has_unlike || (has_tuple && arguments > MOST_ARGUMENTS) {
                packed.push(format!("{file}: {name}({})", parameters.join(", ")));
            }
        }
    }
    assert!(
        packed.is_empty(),
        "functions with a tuple of unlike things as a parameter, or with more than five arguments, a tuple counted by its \
         elements. Take several parameters, or a struct with named fields:\n{}",
        packed.join("\n")
    );
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
    let kinds = ["(f64, f64)", "(f64, u8)", "&(u8, u8, f64)", "f64"];
    assert_eq!(kinds.map(is_of_unlike_things), [false, true, true, false]);
}
