//! TOML text to a struct that holds what is written; every fault is a diagnostic with its place in the text.
//!
//! serde stops at the first unknown key. Here that key is reported and taken out, and the rest is
//! read again, so that one run names every misspelt key.

use std::ops::Range;

use serde::de::DeserializeOwned;
use toml::{
    Deserializer, Spanned,
    de::{DeTable, DeValue, Error},
};

use crate::{
    codes,
    diagnostic::{Diagnostic, Diagnostics, line_column},
    nearest::known_names,
    units::WrittenUnit,
    visible::hidden_character,
    written::{
        advice::{for_expression, for_large_integer, in_known_unit, transform_for_list},
        number_mistake::mistake_in_line,
        serde_message::in_words,
        unclosed::{Unclosed, unclosed},
    },
};

/// Parses `text`; faults go to `diagnostics`.
///
/// A value is returned as well if the only faults are unknown keys, so that the caller can
/// check the rest and report everything at once.
pub fn parse_toml<T: DeserializeOwned>(text: &str, diagnostics: &mut Diagnostics) -> Option<T> {
    let root = diagnostics.keep(parse_document(text))?;
    read_table(root, diagnostics)
}

/// The tree of a text. Names go into every output, so keys and texts have no hidden characters, written out or not.
///
/// # Errors
/// The text is no TOML, or a key or a text in it has such a character.
pub fn parse_document(text: &str) -> Result<Spanned<DeTable<'_>>, Diagnostic> {
    let root = DeTable::parse(text).map_err(|error| {
        let found = diagnostic(&error);
        match error.span() {
            Some(at) => syntax_in_words(found, text, at.start),
            None => found,
        }
    })?;
    check_all_visible(root.get_ref())?;
    Ok(root)
}

/// A fault of the syntax at its cause, in words, if it is a usual mistake of people who type numbers and rows.
fn syntax_in_words(found: Diagnostic, text: &str, at: usize) -> Diagnostic {
    if let Some(help) = for_expression(text, at) {
        return found.with_help(help);
    }
    let line_start = text.get(..at).and_then(|before| before.rfind('\n')).map_or(0, |end| end + 1);
    let line = text[line_start..].lines().next().unwrap_or_default();
    if let Some((place, mistake)) = mistake_in_line(line) {
        let start = line_start + place;
        let fault = Diagnostic::error(codes::toml::INVALID, mistake.message).with_help(mistake.help);
        return fault.at(start..start + mistake.written.len());
    }
    if let Some(fault) = missing_comma(text, line_start, line) {
        return fault;
    }
    if found.message.ends_with("expected `,`") {
        return found.with_help("a comma is missing before this key");
    }
    match unclosed(text, at) {
        Some(Unclosed { span, message }) => Diagnostic::error(codes::toml::INVALID, message).at(span),
        None => found,
    }
}

/// A comma that is missing at the end of an inline table, such as a row, where the next one begins in the line of the error.
fn missing_comma(text: &str, line_start: usize, line: &str) -> Option<Diagnostic> {
    if !line.trim_start().starts_with('{') {
        return None;
    }
    let before = text[..line_start].trim_end();
    if !before.ends_with('}') {
        return None;
    }
    let (number, _) = line_column(text, before.len() - 1);
    let message = format!("line {number} has no comma at its end");
    let fault = Diagnostic::error(codes::toml::INVALID, message).at(before.len() - 1..before.len());
    Some(fault.with_help("entries of a list are separated by commas: write }, at the end of this line"))
}

/// Whether a text is TOML by itself.
///
/// # Examples
/// ```
/// use congruent_input::toml_text::is_toml;
/// assert!(is_toml("a_m = 0.4") && is_toml("# a comment"));
/// assert!(!is_toml("move each value of a one row up"));
/// ```
pub fn is_toml(text: &str) -> bool {
    DeTable::parse(text).is_ok()
}

fn check_all_visible(table: &DeTable<'_>) -> Result<(), Diagnostic> {
    table.iter().try_for_each(|(key, value)| {
        check_visible("the key", key.get_ref(), key.span())?;
        check_value_visible(value)
    })
}

fn check_value_visible(value: &Spanned<DeValue<'_>>) -> Result<(), Diagnostic> {
    match value.get_ref() {
        DeValue::String(text) => check_visible("the text", text, value.span()),
        DeValue::Array(array) => array.iter().try_for_each(check_value_visible),
        DeValue::Table(table) => check_all_visible(table),
        _ => Ok(()),
    }
}

fn check_visible(what: &str, text: &str, at: Range<usize>) -> Result<(), Diagnostic> {
    let Some(hidden) = hidden_character(text) else { return Ok(()) };
    let message = format!("{what} \"{text}\" has an invisible character: {hidden}");
    Err(Diagnostic::error(codes::toml::HIDDEN_CHARACTER, message).at(at).with_help("remove this character"))
}

/// The same for a table that is parsed already.
pub fn read_table<T: DeserializeOwned>(
    table: Spanned<DeTable<'_>>,
    diagnostics: &mut Diagnostics,
) -> Option<T> {
    each_fault(table, |error, root| {
        let found = with_advice(diagnostic(error), error, root);
        // A key that is missing because it is misspelt is one fault, not two.
        if !follows_from_misspelt(&found, diagnostics) {
            diagnostics.push(found);
        }
    })
}

/// Whether a key is missing in a table in which another one was meant to be it.
fn follows_from_misspelt(found: &Diagnostic, diagnostics: &Diagnostics) -> bool {
    let missing = found.message.split('"').nth(1).filter(|_| found.code == codes::toml::MISSING_KEY);
    // Reading ends at a missing key: what was found behind the beginning of its table is in this table.
    let start = |of: &Diagnostic| of.span.as_ref().map_or(0, |span| span.start);
    missing.is_some_and(|key| diagnostics.any(|other| other.is_misspelt(key) && start(other) >= start(found)))
}

/// The finding with the help that needs the value that is written.
fn with_advice(found: Diagnostic, error: &Error, root: &DeTable<'_>) -> Diagnostic {
    let Some(at) = error.span() else { return found };
    let text = error.message();
    if text.starts_with(UNKNOWN_KEY) {
        let mut names = text.split('`').skip(1).step_by(2);
        let unknown = names.next().unwrap_or_default();
        return match in_known_unit(unknown, names, root, &at) {
            Some(help) => found.with_help(help),
            None => found,
        };
    }
    if let Some((message, help)) = for_large_integer(text, root, &at) {
        return Diagnostic { message, help, ..found };
    }
    match transform_for_list(root, &at) {
        Some(help) => {
            Diagnostic { message: "must be a table of keys and values, not a list".to_owned(), ..found }
                .with_help(help)
        }
        None => found,
    }
}

/// Reads a table and passes each fault to the callback: an unknown key is removed, and the rest is read again, since serde
/// stops at the first one.
fn each_fault<T: DeserializeOwned>(
    table: Spanned<DeTable<'_>>,
    mut report: impl FnMut(&Error, &DeTable<'_>),
) -> Option<T> {
    let (span, mut root) = (table.span(), table.into_inner());
    for _ in 0..MOST_UNKNOWN_KEYS {
        let attempt = Spanned::new(span.clone(), root.clone());
        let error = match T::deserialize(Deserializer::from(attempt)) {
            Ok(value) => return Some(value),
            Err(error) => error,
        };
        report(&error, &root);
        let unknown = error.span().filter(|_| error.message().starts_with(UNKNOWN_KEY))?;
        if !take_out(&mut root, &unknown) {
            return None;
        }
    }
    None
}

/// A key that matches no field.
pub struct UnknownKey {
    /// The key as it is written.
    pub name: String,
    /// Byte range of the key in the text.
    pub span: Range<usize>,
    /// The keys that are allowed at its place.
    pub known: Vec<String>,
}

/// The unknown keys of a text, and the number of other faults; `None` if the text is not valid TOML.
pub fn unknown_keys<T: DeserializeOwned>(text: &str) -> Option<(Vec<UnknownKey>, usize)> {
    let (mut unknown, mut others) = (Vec::new(), 0);
    each_fault::<T>(parse_document(text).ok()?, |error, _| {
        let mut names = error.message().split('`').skip(1).step_by(2).map(str::to_owned);
        match (error.message().starts_with(UNKNOWN_KEY), names.next(), error.span()) {
            (true, Some(name), Some(span)) => unknown.push(UnknownKey { name, span, known: names.collect() }),
            _ => others += 1,
        }
    });
    Some((unknown, others))
}

/// Most unknown keys that are named in one run: each costs another pass over the text.
const MOST_UNKNOWN_KEYS: usize = 100;

/// The beginning of serde's message about an unknown key.
const UNKNOWN_KEY: &str = "unknown field ";

fn take_out(table: &mut DeTable<'_>, key: &Range<usize>) -> bool {
    if let Some(name) = table.keys().find(|name| name.span() == *key).cloned() {
        return table.remove(&name).is_some();
    }
    table.iter_mut().any(|(_, value)| take_out_of_value(value.get_mut(), key))
}

fn take_out_of_value(value: &mut DeValue<'_>, key: &Range<usize>) -> bool {
    match value {
        DeValue::Table(table) => take_out(table, key),
        DeValue::Array(array) => array.iter_mut().any(|value| take_out_of_value(value.get_mut(), key)),
        _ => false,
    }
}

/// What a word of URDF or of the literature is called in our files.
fn same_meaning(word: &str) -> Option<&'static str> {
    match word.to_lowercase().as_str() {
        // The range of a row is that of its joint in the URDF.
        "continuous" | "rotational" => Some("revolute"),
        "linear" | "translational" => Some("prismatic"),
        "craig" | "proximal" | "mdh" => Some("modified"),
        "classic" | "classical" | "distal" | "sdh" | "spong" => Some("standard"),
        _ => None,
    }
}

/// The beginning of the key of a row that data sheets and other programs call differently.
fn key_of_data_sheet(key: &str) -> Option<&'static str> {
    let quantity = WrittenUnit::split(key).map_or(key, |(quantity, _)| quantity);
    match quantity {
        "offset" | "theta_offset" | "theta0" | "theta_0" | "joint_offset" => Some("theta_"),
        "r" | "link_length" => Some("a_"),
        "twist" | "link_twist" => Some("alpha_"),
        "link_offset" => Some("d_"),
        _ => None,
    }
}

/// The help for such a key: `the offset of a data sheet is theta_deg`.
fn of_data_sheet(key: &str, beginning: &str, known: &[&str]) -> String {
    let (quantity, unit) = match WrittenUnit::split(key) {
        Some((quantity, unit)) => (quantity, Some(unit.name())),
        None => (key, None),
    };
    let meant = known.iter().filter(|known| {
        known.strip_prefix(beginning).is_some_and(|ending| unit.is_none_or(|unit| unit == ending))
    });
    let meant: Vec<&str> = meant.copied().collect();
    format!("the {} of a data sheet is {}", quantity.replace('_', " "), meant.join(" or "))
}

/// The error of the `toml` crate as a diagnostic.
pub fn diagnostic(error: &Error) -> Diagnostic {
    let text = error.message();
    // serde quotes names with backticks: the offending one first, then the expected ones.
    let mut names = text.split('`').skip(1).step_by(2);
    let first = names.next().unwrap_or_default();
    let known: Vec<&str> = names.collect();
    let known_help = |what: &str| known_names(first, what, known.iter().copied());
    let found = if text.starts_with(UNKNOWN_KEY) {
        let with_units: Vec<&str> = known
            .iter()
            .copied()
            .filter(|key| WrittenUnit::split(key).is_some_and(|(stem, _)| stem == first))
            .collect();
        let message = match with_units[..] {
            [] => format!("unknown key \"{first}\""),
            _ => format!("\"{first}\" needs a unit: {}", with_units.join(" or ")),
        };
        let found = Diagnostic::error(codes::toml::UNKNOWN_KEY, message);
        match key_of_data_sheet(first).filter(|key| known.iter().any(|known| known.starts_with(key))) {
            Some(key) if with_units.is_empty() => found.with_help(of_data_sheet(first, key, &known)),
            _ if with_units.is_empty() => found.with_help(known_help("keys")),
            _ => found,
        }
    } else if text.starts_with("unknown variant ") {
        Diagnostic::error(codes::toml::UNKNOWN_VALUE, format!("unknown value \"{first}\"")).with_help(
            match same_meaning(first).filter(|meant| known.contains(meant)) {
                Some(meant) => format!("\"{first}\" is called \"{meant}\" here; {}", known_help("values")),
                None => known_help("values"),
            },
        )
    } else if text.starts_with("missing field ") {
        let found = Diagnostic::error(codes::toml::MISSING_KEY, format!("missing key \"{first}\""));
        // The version of a format has one value, which a person cannot guess.
        if first == "schema_version" {
            found.with_help("write at the top: schema_version = 1")
        } else {
            found
        }
    } else {
        let (message, help) = in_words(&text.replace('\n', ", "));
        let found = Diagnostic::error(codes::toml::INVALID, message);
        if let Some(help) = help { found.with_help(help) } else { found }
    };
    found.at(error.span().unwrap_or(0..0))
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    use super::*;
    use crate::diagnostic::SourceFile;

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Written {
        duration: Option<f64>,
        #[serde(default)]
        row: Vec<Row>,
    }

    #[derive(Debug, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Row {
        kind: Kind,
    }

    #[derive(Debug, Deserialize, PartialEq)]
    #[serde(rename_all = "snake_case")]
    enum Kind {
        Revolute,
        Prismatic,
    }

    fn read(text: &str) -> (Option<Written>, Vec<String>) {
        let mut diagnostics = Diagnostics::default();
        let value = parse_toml(text, &mut diagnostics);
        let source = SourceFile { path: "x.toml".into(), text: text.to_owned(), is_foreign: false };
        let line = |found: Diagnostic| {
            let (line, column) = found.line_column().unwrap();
            let help = found.help.map_or(String::new(), |help| format!(" ({help})"));
            format!("{line}:{column}: {}{help}", found.message)
        };
        (value, diagnostics.in_file(&source.into()).into_iter().map(line).collect())
    }

    #[test]
    fn a_good_text_gives_the_value() {
        let (value, diagnostics) = read("duration = 2\n[[row]]\nkind = \"prismatic\"");
        let value = value.unwrap();
        assert_eq!(diagnostics, Vec::<String>::new());
        assert_eq!((value.duration, &value.row[0].kind), (Some(2.0), &Kind::Prismatic));
    }

    #[test]
    fn a_comma_that_is_missing_is_found_in_its_line() {
        let (_, found) = read(
            "row = [\n  { kind = \"revolute\" },\n  { kind = \"revolute\" }\n  { kind = \"prismatic\" },\n]\n",
        );
        assert!(found[0].starts_with("3:23: line 3 has no comma at its end"), "{found:?}");
    }

    #[test]
    fn every_unknown_key_is_named_in_one_run() {
        let (value, diagnostics) = read("durration = 2\nseed = 1\n[[row]]\nkind = \"revolute\"\nkinds = 3\n");
        assert!(value.is_some());
        assert_eq!(
            diagnostics,
            [
                "1:1: unknown key \"durration\" (did you mean \"duration\"? known keys: duration, row)",
                "2:1: unknown key \"seed\" (known keys: duration, row)",
                "5:1: unknown key \"kinds\" (did you mean \"kind\"? known keys: kind)",
            ]
        );
    }

    #[test]
    fn a_misspelt_key_is_not_missing_as_well() {
        let (value, diagnostics) = read("[[row]]\nkinde = \"revolute\"\n");
        assert!(value.is_none());
        assert_eq!(diagnostics, ["2:1: unknown key \"kinde\" (did you mean \"kind\"? known keys: kind)"]);
        let other = "[[row]]\nkinde = \"revolute\"\nkind = \"revolute\"\n[[row]]\n";
        assert_eq!(read(other).1.len(), 2, "the second row has no kind");
    }

    #[test]
    fn usual_mistakes_of_syntax_are_named_at_their_cause() {
        let first = |text: &str| read(text).1.remove(0);
        let comma = "1:12: 2,5 is not a number: use a point for decimals (write duration = 2.5)";
        assert_eq!(first("duration = 2,5\n"), comma);
        let unit = "1:12: 2 s is not a number (write 2 without s: the unit is in the key, duration_s = 2)";
        assert_eq!(first("duration = 2 s\n"), unit);
        assert_eq!(
            first("row = [\n  { kind = \"revolute\",\n  { kind = \"revolute\" },\n]\n"),
            "2:3: the row that begins in line 2 is not closed: } is missing"
        );
    }

    #[test]
    fn endless_unknown_keys_end() {
        let text = (0..1000).map(|key| format!("x{key} = 1\n")).collect::<Vec<_>>().concat();
        assert_eq!(read(&text).1.len(), MOST_UNKNOWN_KEYS);
    }

    #[test]
    fn other_faults_say_where() {
        let (_, diagnostics) = read("[[row]]\nkind = \"revolut\"");
        assert_eq!(
            diagnostics,
            ["2:8: unknown value \"revolut\" (did you mean \"revolute\"? known values: revolute, prismatic)"]
        );
        assert_eq!(read("\n[[row]]").1, ["2:1: missing key \"kind\""]);
        assert_eq!(
            read("duration = \"2\"").1,
            ["1:12: must be a number, not the text \"2\" (write it without quotes)"]
        );
        assert_eq!(read("duration = = 2").1.len(), 1);
    }

    #[test]
    fn what_is_not_shown_is_refused_at_its_place() {
        let refused = |text: &str| {
            let fault = parse_document(text).unwrap_err();
            (fault.message, fault.span.unwrap().start)
        };
        let (message, at) = refused("a = 1\nb = [{ c = \"x\\u001b[2J\" }]");
        assert_eq!(message, r#"the text "x\u{1b}[2J" has an invisible character: U+001B"#);
        assert_eq!(at, 17);
        assert_eq!(refused("\"a\\nb\" = 1").0, r#"the key "a\nb" has an invisible character: U+000A"#);
        assert_eq!(refused("a = '\u{202e}'").1, 4);
        // A comment says nothing.
        assert!(parse_document("a = 'Gelenk \u{e4}' # \u{202e}").is_ok());
    }
}
