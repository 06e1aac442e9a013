//! Lists of entries in JSON; every fault names the number of its entry, from 1, and its line.

use std::ops::Range;

use congruent_input::{Diagnostic, Findings};
use serde::de::DeserializeOwned;
use serde_json::value::RawValue;

/// A kind of list, as diagnostics name it.
#[derive(Debug, Clone, Copy)]
pub struct JsonList {
    /// The word for an entry in messages, such as `configuration`.
    pub entry: &'static str,
    /// Code of the error about a text that is not such a list.
    pub code: &'static str,
    /// Help for such a text: what was expected.
    pub help: &'static str,
}

impl JsonList {
    /// Reads all entries; `check` is given each, with the span of its first line, and makes a value of it.
    ///
    /// # Errors
    /// The faults of all entries, or the one fault for which the text is no list.
    pub fn read<Written: DeserializeOwned, T>(
        &self,
        text: &str,
        mut check: impl FnMut(Written, Range<usize>) -> Result<T, Diagnostic>,
    ) -> Result<Vec<T>, Findings> {
        let entries: Vec<&RawValue> =
            serde_json::from_str(text).map_err(|error| self.malformed(text, 0, &error))?;
        let (mut read, mut faults) = (Vec::with_capacity(entries.len()), Vec::new());
        for (index, entry) in entries.iter().map(|entry| entry.get()).enumerate() {
            // The entry borrows from the text, so the difference of the addresses is its place.
            let start = entry.as_ptr().addr() - text.as_ptr().addr();
            let first_line = start..start + entry.find('\n').unwrap_or(entry.len());
            let found = serde_json::from_str(entry)
                .map_err(|error| self.malformed(text, start, &error))
                .and_then(|written| {
                    check(written, first_line.clone())
                        .map_err(|fault| if fault.span.is_none() { fault.at(first_line) } else { fault })
                });
            match found {
                Ok(found) => read.push(found),
                Err(fault) => faults.push(self.of_entry(index + 1, fault)),
            }
        }
        if faults.is_empty() { Ok(read) } else { Err(faults.into()) }
    }

    /// The fault with the number of its entry, from 1.
    pub(super) fn of_entry(&self, number: usize, mut fault: Diagnostic) -> Diagnostic {
        fault.message = format!("{} {number}: {}", self.entry, fault.message);
        fault
    }

    fn malformed(&self, text: &str, start: usize, error: &serde_json::Error) -> Diagnostic {
        let offset = start + offset_of(&text[start..], error);
        self.not_read(error).at(offset..offset)
    }

    /// The error of the parser without its line and column, which count from the beginning of the entry.
    pub(super) fn not_read(&self, error: &serde_json::Error) -> Diagnostic {
        let said = error.to_string();
        let said = said.rsplit_once(" at line ").map_or(said.as_str(), |(said, _)| said);
        Diagnostic::error(self.code, said).with_help(self.help)
    }
}

/// The place that an error means in the text that was parsed.
pub(super) fn offset_of(text: &str, error: &serde_json::Error) -> usize {
    let before: usize = text.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum();
    (before + error.column().saturating_sub(1)).min(text.len())
}
