//! `--set KEY=VALUE`: any value of a file in TOML, changed before the file is read.

use std::ops::Range;

use toml::{
    Spanned, Value,
    de::{DeTable, DeValue},
};

use super::{toml_literal::toml_key, toml_text};
use crate::{
    codes,
    diagnostic::Diagnostic,
    edits::{TextEdit, edited},
};

/// Characters that a value without quotes does not have: with one of these it was meant as TOML.
const NOT_IN_WORDS: [char; 9] = ['"', '\'', '[', ']', '{', '}', '=', '#', '\n'];

/// One value under another key path.
///
/// The path is the keys of the file joined by dots; an entry of a list has its number, from 1:
/// `controller.stiffness`, `check.1.position_m`, `start.joints_deg.elbow_joint`. The value is TOML; a word
/// that is not TOML is taken as a string.
///
/// # Examples
/// ```
/// use congruent_input::Override;
/// let stiffer: Override = "controller.stiffness=500".parse().expect("a key and a value");
/// assert_eq!(stiffer.to_string(), "controller.stiffness=500");
/// assert!("controller.stiffness".parse::<Override>().is_err());
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Override {
    path: Vec<String>,
    written: String,
    /// `value = ...`, as TOML.
    document: String,
    /// Whether it may replace a value that another one sets.
    replaces: bool,
}

impl std::str::FromStr for Override {
    type Err = Diagnostic;

    fn from_str(text: &str) -> Result<Self, Diagnostic> {
        let malformed = || {
            Diagnostic::error(codes::cli::SET, format!("--set \"{text}\" is not KEY=VALUE"))
                .with_help("for example --set controller.stiffness=500 or --set check.1.position_m=1e-6")
        };
        let (path, value) = text.split_once('=').ok_or_else(malformed)?;
        let path: Vec<String> = path.split('.').map(|key| key.trim().to_owned()).collect();
        if path.iter().any(String::is_empty) || value.trim().is_empty() {
            return Err(malformed());
        }
        let as_toml = format!("value = {}", value.trim());
        let document = match DeTable::parse(&as_toml) {
            Ok(table) if table.get_ref().len() == 1 => as_toml,
            _ if value.contains(NOT_IN_WORDS) => {
                let message = format!("--set \"{text}\": the value is neither TOML nor a word");
                return Err(Diagnostic::error(codes::cli::SET, message));
            }
            _ => format!("value = {}", toml::Value::String(value.trim().to_owned())),
        };
        toml_text::parse_document(&document).map_err(|fault| {
            Diagnostic::error(codes::cli::SET, format!("--set \"{text}\": {}", fault.message))
        })?;
        Ok(Self { path, written: text.to_owned(), document, replaces: false })
    }
}

impl std::fmt::Display for Override {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.written)
    }
}

impl Override {
    /// The keys of the path, the outermost first.
    pub fn path(&self) -> impl Iterator<Item = &str> {
        self.path.iter().map(String::as_str)
    }

    /// The value as a number.
    ///
    /// # Errors
    /// Why it is none.
    pub fn number(&self) -> Result<f64, String> {
        number(&self.value()?)
    }

    /// The value, if it is a whole number that is not negative, also one that is written as `7.0`.
    pub fn whole_number(&self) -> Option<u64> {
        let number = self.number().ok().filter(|number| number.fract() == 0.0)?;
        format!("{number}").parse().ok()
    }

    /// Three coordinates from a list, or those of `before` with the one that `entry` counts, from 1.
    ///
    /// # Errors
    /// Why the value, or the entry, is none.
    pub fn coordinates(&self, mut before: [f64; 3], entry: Option<&str>) -> Result<[f64; 3], String> {
        match (entry, self.value()?) {
            (Some(entry), value) => {
                let at = entry.parse::<usize>().ok().and_then(|entry| entry.checked_sub(1));
                let coordinate = at.and_then(|at| before.get_mut(at));
                *coordinate.ok_or_else(|| format!("\"{entry}\" is no entry from 1 to 3"))? = number(&value)?;
            }
            (None, Value::Array(items)) if items.len() == 3 => {
                for (coordinate, item) in before.iter_mut().zip(&items) {
                    *coordinate = number(item)?;
                }
            }
            (None, other) => return Err(format!("{other} is not a list of three numbers")),
        }
        Ok(before)
    }

    fn value(&self) -> Result<Value, String> {
        let table: toml::Table = self.document.parse().map_err(|_| "the value is not TOML".to_owned())?;
        table.into_iter().next().map(|(_, value)| value).ok_or_else(|| "there is no value".to_owned())
    }

    /// The override of a value in what the key `outer` names, if the path goes through it: `dh.row.3.d_m` of
    /// `robot.dh.row.3.d_m`.
    pub fn inside(&self, outer: &str) -> Option<Self> {
        let (first, rest) = self.path.split_first().filter(|(_, rest)| !rest.is_empty())?;
        (first == outer).then(|| Self { path: rest.to_vec(), ..self.clone() })
    }

    /// An argument of the command line.
    ///
    /// # Errors
    /// What is wrong with it, and how it is written.
    pub fn of_argument(text: &str) -> Result<Self, String> {
        text.parse().map_err(|error: Diagnostic| {
            error.help.map_or(error.message.clone(), |help| format!("{}; {help}", error.message))
        })
    }

    /// An override of the scenario's seed.
    pub fn seed(seed: u64) -> Self {
        let written = format!("seed={seed}");
        Self { path: vec!["seed".to_owned()], written, document: format!("value = {seed}"), replaces: false }
    }

    /// An override of the scenario's name, which is also that of the folder of its results.
    pub fn name(name: &str) -> Self {
        let value = toml::Value::String(name.to_owned());
        Self {
            path: vec!["name".to_owned()],
            written: format!("name={name}"),
            document: format!("value = {value}"),
            replaces: false,
        }
    }

    /// Puts the value into a document, at the place of the value that it replaces, or of the table that gets
    /// it; returns that place.
    ///
    /// # Errors
    /// The path goes through a value that is neither table nor list, or to an entry that a list does not have.
    pub fn apply<'a>(&'a self, document: &mut Spanned<DeTable<'a>>) -> Result<Range<usize>, Diagnostic> {
        let value = DeTable::parse(&self.document)
            .ok()
            .and_then(|table| table.into_inner().into_iter().next())
            .map(|(_, value)| value.into_inner())
            .ok_or_else(|| self.refused("the value is not TOML"))?;
        let place = document.span();
        self.put(document.get_mut(), &place, &self.path, value)
    }

    fn put<'a>(
        &self,
        table: &mut DeTable<'a>,
        table_place: &Range<usize>,
        path: &'a [String],
        value: DeValue<'a>,
    ) -> Result<Range<usize>, Diagnostic> {
        let (key, rest) = path.split_first().expect("a path has a key");
        let entry = table
            .entry(Spanned::new(table_place.clone(), key.as_str().into()))
            .or_insert_with(|| Spanned::new(table_place.clone(), DeValue::Table(DeTable::new())));
        self.replace(key, entry, rest, value)
    }

    /// Replaces a value or something in it.
    fn replace<'a>(
        &self,
        name: &str,
        found: &mut Spanned<DeValue<'a>>,
        path: &'a [String],
        value: DeValue<'a>,
    ) -> Result<Range<usize>, Diagnostic> {
        let place = found.span();
        let Some((number, rest)) = path.split_first() else {
            *found = Spanned::new(place.clone(), placed(value, &place));
            return Ok(place);
        };
        match found.get_mut() {
            DeValue::Table(table) if table.is_empty() && number.parse::<usize>().is_ok() => {
                Err(self.refused(&format!("\"{name}\" has no entry {number} in the file")))
            }
            DeValue::Table(table) => self.put(table, &place, path, value),
            DeValue::Array(items) => {
                let of_entries = entries(items);
                match position(items, number).and_then(|index| items.get_mut(index)) {
                    Some(item) => self.replace(name, item, rest, value),
                    None => Err(self.refused(&format!("\"{name}\" has {of_entries}"))),
                }
            }
            _ => Err(self.refused(&format!("\"{name}\" is a value, not a table"))),
        }
    }

    /// The value of a document that it replaces; `None` if a table has no such key yet.
    ///
    /// # Errors
    /// As [`Override::apply`].
    ///
    /// # Panics
    /// Never: a path has a key.
    pub fn find<'d, 'a>(
        &self,
        document: &'d Spanned<DeTable<'a>>,
    ) -> Result<Option<&'d Spanned<DeValue<'a>>>, Diagnostic> {
        let (first, rest) = self.path.split_first().expect("a path has a key");
        let Some(mut found) = document.get_ref().get(first.as_str()) else { return Ok(None) };
        let mut name = first;
        for key in rest {
            let next = match found.get_ref() {
                DeValue::Table(table) => table.get(key.as_str()),
                DeValue::Array(items) => {
                    let item = position(items, key).and_then(|index| items.get(index));
                    Some(item.ok_or_else(|| self.refused(&format!("\"{name}\" has {}", entries(items))))?)
                }
                _ => return Err(self.refused(&format!("\"{name}\" is a value, not a table"))),
            };
            let Some(next) = next else { return Ok(None) };
            (found, name) = (next, key);
        }
        Ok(Some(found))
    }

    /// A text with the value in place of the present one, or at its beginning if it has no such key.
    ///
    /// # Errors
    /// The text is not TOML, or has no place for the key.
    pub fn edit_text(&self, text: &str) -> Result<String, Diagnostic> {
        let document = toml_text::parse_document(text)?;
        let place = self.find(&document)?.map(Spanned::span);
        let value = self.document.split_once('=').map_or("", |(_, value)| value.trim());
        let edit = if let Some(span) = place {
            TextEdit { span, text: value.to_owned() }
        } else {
            let key: Vec<String> = self.path.iter().map(|key| toml_key(key)).collect();
            TextEdit { span: 0..0, text: format!("{} = {value}\n", key.join(".")) }
        };
        let with_value = edited(text, &[edit]);
        match toml_text::parse_document(&with_value) {
            Ok(_) => Ok(with_value),
            Err(_) => {
                Err(self.refused("the file has no such key; write it there with its present value first"))
            }
        }
    }

    /// The same as a value of a case, which replaces the one that all cases have.
    #[must_use]
    pub fn replacing(self) -> Self {
        Self { replaces: true, ..self }
    }

    /// Whether both could be meant for one value: of a value that all cases have and that of a case, the latter is meant.
    pub fn excludes(&self, other: &Self) -> bool {
        self.replaces == other.replaces
    }

    /// Whether both replace the same value.
    pub fn same_key(&self, other: &Self) -> bool {
        self.path == other.path
    }

    /// A refusal of this override, with how keys are written.
    pub fn refused(&self, why: &str) -> Diagnostic {
        Diagnostic::error(codes::cli::SET, format!("--set {}: {why}", self.written)).with_help(
            "KEY is the keys of the file joined by dots, entries of lists by their number from 1, or by their kind, name or joint: \
             check.agreement.position_m=1e-6, dh.row.elbow_joint.d_m=0.4",
        )
    }
}

fn number(value: &Value) -> Result<f64, String> {
    #[expect(clippy::cast_precision_loss, reason = "no length or mass has 2^53 units")]
    let number = match value {
        Value::Float(number) => *number,
        Value::Integer(number) => *number as f64,
        other => return Err(format!("{other} is not a number")),
    };
    if number.is_finite() { Ok(number) } else { Err(format!("{number} is not finite")) }
}

/// What a person calls an entry: its kind, its name, its joint.
fn labels<'a>(item: &'a Spanned<DeValue<'_>>) -> impl Iterator<Item = &'a str> {
    let table = item.get_ref().as_table();
    ["kind", "name", "joint"].into_iter().filter_map(move |key| table?.get(key)?.get_ref().as_str())
}

/// Which entry is meant: by its number from 1, or by its kind, name or joint if no other has it.
fn position(items: &[Spanned<DeValue<'_>>], word: &str) -> Option<usize> {
    if let Ok(number) = word.parse::<usize>() {
        return number.checked_sub(1);
    }
    let is_called = |item: &Spanned<DeValue<'_>>| labels(item).any(|label| label == word);
    let mut called = items.iter().enumerate().filter(|(_, item)| is_called(item));
    let (first, _) = called.next()?;
    called.next().is_none().then_some(first)
}

/// The entries of a list: `entries 1 to 2: 1 agreement, 2 clearance`.
fn entries(items: &[Spanned<DeValue<'_>>]) -> String {
    let named = |(number, item)| {
        let labels: Vec<&str> = labels(item).collect();
        (!labels.is_empty()).then(|| format!("{number} {}", labels.join(" ")))
    };
    let names: Vec<String> = (1..).zip(items).filter_map(named).collect();
    let names = if names.is_empty() { String::new() } else { format!(": {}", names.join(", ")) };
    match items.len() {
        1 => format!("one entry{names}"),
        count => format!("entries 1 to {count}{names}"),
    }
}

/// A value with all that it holds at one place: its own text is not the file's.
fn placed<'a>(value: DeValue<'a>, place: &Range<usize>) -> DeValue<'a> {
    let inner = |value: Spanned<DeValue<'a>>| Spanned::new(place.clone(), placed(value.into_inner(), place));
    match value {
        DeValue::Array(items) => DeValue::Array(items.into_iter().map(inner).collect()),
        DeValue::Table(table) => {
            let entry = |(key, value): (Spanned<std::borrow::Cow<'a, str>>, _)| {
                (Spanned::new(place.clone(), key.into_inner()), inner(value))
            };
            DeValue::Table(table.into_iter().map(entry).collect())
        }
        value => value,
    }
}
