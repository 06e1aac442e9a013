//! Places of the values of a scenario in its file, if it came from one.

use std::{collections::BTreeMap, ops::Range};

use congruent_input::Diagnostic;
use toml::{
    Spanned,
    de::{DeTable, DeValue},
};

/// The place of one value, with the places of its entries.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct PlaceNode {
    span: Range<usize>,
    /// Line of its start, from 1.
    line: usize,
    keys: BTreeMap<String, KeyPlace>,
    items: Vec<PlaceNode>,
}

/// A key with its value.
#[derive(Debug, Clone, PartialEq)]
struct KeyPlace {
    key: Range<usize>,
    value: PlaceNode,
}

impl PlaceNode {
    /// The places of a whole document.
    pub(crate) fn of_document(text: &str, table: &Spanned<DeTable<'_>>) -> Self {
        let breaks = text.match_indices('\n').map(|(line_break, _)| line_break + 1);
        let line_starts: Vec<usize> = std::iter::once(0).chain(breaks).collect();
        Self::of_table(table.get_ref(), table.span(), &line_starts)
    }

    fn of_table(table: &DeTable<'_>, span: Range<usize>, line_starts: &[usize]) -> Self {
        let key = |(key, value): (&Spanned<std::borrow::Cow<'_, str>>, &Spanned<DeValue<'_>>)| {
            let value = Self::of_value(value, line_starts);
            (key.get_ref().to_string(), KeyPlace { key: key.span(), value })
        };
        Self { keys: table.iter().map(key).collect(), ..Self::at(span, line_starts) }
    }

    fn of_value(value: &Spanned<DeValue<'_>>, line_starts: &[usize]) -> Self {
        match value.get_ref() {
            DeValue::Table(table) => Self::of_table(table, value.span(), line_starts),
            DeValue::Array(items) => {
                let items = items.iter().map(|item| Self::of_value(item, line_starts)).collect();
                Self { items, ..Self::at(value.span(), line_starts) }
            }
            _ => Self::at(value.span(), line_starts),
        }
    }

    fn at(span: Range<usize>, line_starts: &[usize]) -> Self {
        let line = line_starts.partition_point(|&line_start| line_start <= span.start);
        Self { span, line, keys: BTreeMap::new(), items: Vec::new() }
    }
}

/// The place of a value of a scenario: in a file, or none if it was made in code. A key that is not
/// written has the place of the table that would hold it.
#[derive(Debug, Clone, Copy)]
pub struct FilePlace<'a>(Option<&'a PlaceNode>);

impl<'a> FilePlace<'a> {
    /// The place of a value that was made in code: none.
    pub fn nowhere() -> Self {
        Self(None)
    }

    pub(crate) fn at_node(node: Option<&'a PlaceNode>) -> Self {
        Self(node)
    }

    /// The place of the value under a key.
    #[must_use]
    pub fn key(self, key: &str) -> Self {
        Self(self.0.map(|node| node.keys.get(key).map_or(node, |place| &place.value)))
    }

    /// The place of an entry of an array, from 0.
    #[must_use]
    pub fn item(self, index: usize) -> Self {
        Self(self.0.map(|node| node.items.get(index).unwrap_or(node)))
    }

    /// Whether a key is written here.
    pub fn has(self, key: &str) -> bool {
        self.0.is_some_and(|node| node.keys.contains_key(key))
    }

    /// The span of a key that is written here.
    pub fn key_span(self, key: &str) -> Option<Range<usize>> {
        self.0?.keys.get(key).map(|place| place.key.clone())
    }

    /// The span of a key with its value.
    pub fn entry_span(self, key: &str) -> Option<Range<usize>> {
        self.0?.keys.get(key).map(|place| place.key.start..place.value.span.end)
    }

    /// Byte range of the value in the file.
    pub fn span(self) -> Option<Range<usize>> {
        self.0.map(|node| node.span.clone())
    }

    /// Line of the value in the file, from 1.
    pub fn line(self) -> Option<usize> {
        self.0.map(|node| node.line)
    }

    /// A diagnostic at this place.
    pub fn mark(self, diagnostic: Diagnostic) -> Diagnostic {
        mark(diagnostic, self.span())
    }
}

/// A diagnostic with a span, if there is one.
pub fn mark(diagnostic: Diagnostic, span: Option<Range<usize>>) -> Diagnostic {
    match span {
        Some(span) => diagnostic.at(span),
        None => diagnostic,
    }
}
