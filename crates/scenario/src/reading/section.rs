//! One table of a scenario file with its place.

use std::borrow::Cow;

use congruent_input::{Diagnostic, Diagnostics, Findings, known_names, nearest, toml_text};
use serde::de::DeserializeOwned;
use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

use crate::codes;

/// A table with its place in the text.
#[derive(Debug, Clone)]
pub(super) struct Section<'a> {
    table: Spanned<DeTable<'a>>,
}

impl<'a> Section<'a> {
    /// The section of a whole document.
    pub(super) fn new(table: Spanned<DeTable<'a>>) -> Self {
        Self { table }
    }

    /// The section's place in the text.
    pub(super) fn span(&self) -> std::ops::Range<usize> {
        self.table.span()
    }

    /// Whether the section has this key.
    pub(super) fn has(&self, key: &str) -> bool {
        self.table.get_ref().contains_key(key)
    }

    /// Takes a key out of this section, and gives its place in the text.
    pub(super) fn take_span_of(&mut self, key: &str) -> Option<std::ops::Range<usize>> {
        self.table.get_mut().remove_entry(key).map(|(key, _)| key.span())
    }

    /// The key, with its place, which was probably meant to be one of the known ones, and that one.
    pub(super) fn misspelt<'k>(&self, known: &[&'k str]) -> Option<(&Spanned<Cow<'a, str>>, &'k str)> {
        self.table
            .get_ref()
            .keys()
            .find_map(|key| Some((key, nearest(key.get_ref(), known.iter().copied())?)))
    }

    /// Takes a table out of this one.
    ///
    /// # Errors
    /// A diagnostic where the key holds something else.
    pub(super) fn take_table(&mut self, key: &str) -> Result<Option<Self>, Diagnostic> {
        self.table.get_mut().remove(key).map(|value| Self::as_section(key, value)).transpose()
    }

    /// Rejects anything but a table under `key`: serde would read an array into a struct.
    ///
    /// # Errors
    /// A diagnostic where the key holds something else.
    pub(super) fn require_table(&self, key: &str) -> Result<(), Diagnostic> {
        match self.table.get_ref().get(key) {
            Some(value) if !value.get_ref().is_table() => {
                Err(wrong_type(key, "a table", value.get_ref().type_str()).at(value.span()))
            }
            _ => Ok(()),
        }
    }

    /// Takes an array of tables out of this one; empty if the key is absent.
    ///
    /// # Errors
    /// A diagnostic where the key holds something else.
    pub(super) fn take_tables(&mut self, key: &str) -> Result<Vec<Self>, Diagnostic> {
        let Some(value) = self.table.get_mut().remove(key) else { return Ok(Vec::new()) };
        let span = value.span();
        match value.into_inner() {
            DeValue::Array(items) => items.into_iter().map(|item| Self::as_section(key, item)).collect(),
            other => Err(wrong_type(key, "an array of tables", other.type_str()).at(span)),
        }
    }

    /// Takes the string under `key` out and gives the one of `known` that has this name.
    ///
    /// # Errors
    /// A diagnostic at the unknown name, or at the section if there is none.
    pub(super) fn select<'k, T>(
        &mut self,
        key: &str,
        what: &str,
        known: &'k [T],
        name: impl Fn(&T) -> &str,
    ) -> Result<&'k T, Diagnostic> {
        let names = || known.iter().map(&name).collect::<Vec<_>>();
        let Some(value) = self.table.get_mut().remove(key) else {
            return Err(Diagnostic::error(codes::scenario::NO_KIND, format!("the {what} has no `{key}`"))
                .with_help(known_names("", "ones", names()))
                .at(self.span()));
        };
        let Some(found) = value.get_ref().as_str() else {
            return Err(wrong_type(key, "a string", value.get_ref().type_str())
                .with_help(known_names("", "ones", names()))
                .at(value.span()));
        };
        known.iter().find(|known| name(known) == found).ok_or_else(|| {
            Diagnostic::error(codes::scenario::UNKNOWN_KIND, format!("unknown {what} \"{found}\""))
                .with_help(same_meaning(found) + &known_names(found, "ones", names()))
                .at(value.span())
        })
    }

    /// Reads the section into a value; unknown keys are errors if the type denies them.
    ///
    /// # Errors
    /// A diagnostic at every unknown key and at the first value that is wrong.
    pub(super) fn read<T: DeserializeOwned>(self) -> Result<T, Findings> {
        let mut findings = Diagnostics::default();
        match self.read_into(&mut findings) {
            Some(value) if !findings.has_error() => Ok(value),
            _ => Err(findings.into()),
        }
    }

    /// Like [`Section::read`], but returns a value as well if the only faults are unknown keys.
    pub(super) fn read_into<T: DeserializeOwned>(self, findings: &mut Diagnostics) -> Option<T> {
        toml_text::read_table(self.table, findings)
    }

    fn as_section(key: &str, value: Spanned<DeValue<'a>>) -> Result<Self, Diagnostic> {
        let span = value.span();
        match value.into_inner() {
            DeValue::Table(table) => Ok(Self { table: Spanned::new(span, table) }),
            other => Err(wrong_type(key, "a table", other.type_str()).at(span)),
        }
    }
}

fn wrong_type(key: &str, expected: &str, found: &str) -> Diagnostic {
    Diagnostic::error(codes::scenario::TYPE, format!("`{key}` is {expected}, found {found}"))
}

/// The kinds of checks that a word of other programs stands for.
fn same_meaning(word: &str) -> String {
    match word {
        "collision" | "collisions" => "did you mean \"clearance\" or \"contact\"? ".to_owned(),
        _ => String::new(),
    }
}
