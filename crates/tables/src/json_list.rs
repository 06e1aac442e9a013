//! Lists of entries in JSON; every fault names the number of its entry, from 1, and its line.

use std::{fmt, ops::Range, sync::Arc};

use congruent_input::{Code, Diagnostic, Findings, InputFile, SourceFile, TextLines, serde_in_words};
use serde::{
    Deserializer as _,
    de::{DeserializeOwned, Error, SeqAccess, Visitor},
};
use serde_json::{Deserializer, value::RawValue};

/// Most entries of an array where lines are read, too. Kind: choice; an array is in memory as a whole.
const MOST_IN_ARRAY: usize = 100_000;
/// Most faults that are reported; if there are more, the last message gives the number of the others.
const MOST_FAULTS: usize = 100;

/// A kind of list, as diagnostics name it.
#[derive(Debug, Clone, Copy)]
pub struct JsonList {
    /// The word for an entry in messages, such as `configuration`.
    pub entry: &'static str,
    /// Code of the error about a text that is not such a list.
    pub code: &'static Code,
    /// Help for such a text: what was expected.
    pub help: &'static str,
}

impl JsonList {
    /// Reads all entries of an array; `check` is given each, with the span of its first line, and makes a value of it.
    ///
    /// # Errors
    /// The faults of the entries, or the one fault for which the text is no array.
    pub fn read<Written: DeserializeOwned, T>(
        &self,
        text: &str,
        check: impl FnMut(Written, Range<usize>) -> Result<T, Diagnostic>,
    ) -> Result<Vec<T>, Findings> {
        self.read_at_most(usize::MAX, text, check)
    }

    /// Reads an array of bounded length, or any number of lines with one entry each (JSON Lines), of which one is in memory;
    /// `check` is given each entry, and what gives the place of its first line. The file, and as much of its text as those
    /// places need.
    ///
    /// # Errors
    /// The faults of the entries, or the one fault for which the file is no such list.
    pub fn read_file<Written: DeserializeOwned>(
        &self,
        mut lines: TextLines,
        mut check: impl FnMut(Written, &mut dyn FnMut() -> Range<usize>) -> Result<(), Diagnostic>,
    ) -> Result<(InputFile, Arc<SourceFile>), Findings> {
        let has_line = lines.advance()?;
        let (file, read) = if has_line && is_entry(lines.line()) {
            let read = self.read_lines(&mut lines, check)?;
            (lines.close()?, read)
        } else {
            lines.put_back();
            let file = lines.whole()?;
            let check = |written, place: Range<usize>| check(written, &mut || place.clone());
            let read = self.read_at_most(MOST_IN_ARRAY, &file.1.text, check);
            (file, read.map(drop))
        };
        read.map_err(|faults| faults.into_iter().map(|fault| fault.in_file(&file.1)).collect::<Findings>())?;
        Ok(file)
    }

    /// The entry in the line that was read last, which has this number from 1.
    ///
    /// # Errors
    /// The line is no entry.
    pub fn read_line<Written: DeserializeOwned, T>(
        &self,
        lines: &mut TextLines,
        number: usize,
        check: impl FnOnce(Written) -> Result<T, Diagnostic>,
    ) -> Result<T, Diagnostic> {
        let read = match serde_json::from_str(lines.line().trim_end()) {
            Ok(written) => check(written).map_err(|fault| fault.at(lines.keep())),
            Err(error) => {
                let at = lines.keep().start + offset_of(lines.line().trim_end(), &error);
                Err(self.not_read(&error).at(at..at))
            }
        };
        read.map_err(|fault| self.of_entry(number, fault).in_file(&lines.kept()))
    }

    /// The faults of the entries; the outer error is one of the file.
    fn read_lines<Written: DeserializeOwned>(
        &self,
        lines: &mut TextLines,
        mut check: impl FnMut(Written, &mut dyn FnMut() -> Range<usize>) -> Result<(), Diagnostic>,
    ) -> Result<Result<(), Findings>, Diagnostic> {
        let (mut faults, mut number) = (EntryFaults::default(), 1);
        loop {
            // Without its end, so that an object that is cut off is a fault of this line.
            match serde_json::from_str(lines.line().trim_end()) {
                Ok(written) => {
                    if let Err(fault) = check(written, &mut || lines.keep()) {
                        faults.add(|| self.of_entry(number, fault.at(lines.keep())));
                    }
                }
                Err(error) => {
                    let offset = offset_of(lines.line().trim_end(), &error);
                    faults.add(|| {
                        let at = lines.keep().start + offset;
                        self.of_entry(number, self.not_read(&error).at(at..at))
                    });
                    // What follows a line that is not JSON is hardly one entry a line.
                    if !error.is_data() {
                        break;
                    }
                }
            }
            if !lines.advance()? {
                break;
            }
            number += 1;
        }
        Ok(faults.end(self.code))
    }

    fn read_at_most<Written: DeserializeOwned, T>(
        &self,
        most: usize,
        text: &str,
        mut check: impl FnMut(Written, Range<usize>) -> Result<T, Diagnostic>,
    ) -> Result<Vec<T>, Findings> {
        let (mut parser, mut entries) = (Deserializer::from_str(text), Vec::new());
        let end = parser.deserialize_seq(Entries { most, entries: &mut entries }).and_then(|()| parser.end());
        end.map_err(|error| {
            let fault = self.malformed(text, 0, &error);
            if entries.len() <= most {
                return fault;
            }
            fault.with_help(format!("write one {} per line (JSON Lines)", self.entry))
        })?;
        let (mut read, mut faults) = (Vec::with_capacity(entries.len()), EntryFaults::default());
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
                Err(fault) => faults.add(|| self.of_entry(index + 1, fault)),
            }
        }
        faults.end(self.code).map(|()| read)
    }

    /// The fault with the number of its entry, from 1.
    fn of_entry(&self, number: usize, mut fault: Diagnostic) -> Diagnostic {
        fault.message = format!("{} {number}: {}", self.entry, fault.message);
        fault
    }

    fn malformed(&self, text: &str, start: usize, error: &serde_json::Error) -> Diagnostic {
        let offset = start + offset_of(&text[start..], error);
        self.not_read(error).at(offset..offset)
    }

    /// The error of the parser without its line and column, which count from the beginning of the entry.
    fn not_read(&self, error: &serde_json::Error) -> Diagnostic {
        let said = error.to_string();
        let said = said.rsplit_once(" at line ").map_or(said.as_str(), |(said, _)| said);
        Diagnostic::error(self.code, serde_in_words(said).0).with_help(self.help)
    }
}

/// Whether a line begins an entry, so that the list is one of lines.
pub fn is_entry(line: &str) -> bool {
    line.trim_start().starts_with('{')
}

/// The place that an error means in the text that was parsed.
fn offset_of(text: &str, error: &serde_json::Error) -> usize {
    let before: usize = text.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum();
    (before + error.column().saturating_sub(1)).min(text.len())
}

/// Collects the entries of an array unread; an error beyond the limit.
struct Entries<'a, 'de> {
    most: usize,
    entries: &'a mut Vec<&'de RawValue>,
}

impl<'de> Visitor<'de> for Entries<'_, 'de> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a sequence")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        while let Some(entry) = list.next_element()? {
            self.entries.push(entry);
            if self.entries.len() > self.most {
                let message = format!("the array has more than {} entries, which is the limit", self.most);
                return Err(A::Error::custom(message));
            }
        }
        Ok(())
    }
}

/// The faults of the entries of a list, of which as many are kept as are reported.
#[derive(Default)]
struct EntryFaults {
    listed: Vec<Diagnostic>,
    count: usize,
}

impl EntryFaults {
    fn add(&mut self, fault: impl FnOnce() -> Diagnostic) {
        self.count += 1;
        if self.listed.len() < MOST_FAULTS {
            self.listed.push(fault());
        }
    }

    fn end(mut self, code: &'static Code) -> Result<(), Findings> {
        if self.count > MOST_FAULTS {
            self.listed.truncate(MOST_FAULTS - 1);
            let more = format!("{} more entries of the list have errors", self.count - self.listed.len());
            self.listed.push(
                Diagnostic::error(code, more).with_help("correct the first ones and run the command again"),
            );
        }
        if self.listed.is_empty() { Ok(()) } else { Err(self.listed.into()) }
    }
}

#[cfg(test)]
mod tests {
    use serde::Deserialize;

    use super::*;

    const LIST: JsonList =
        JsonList { entry: "entry", code: congruent_input::codes::xml::MALFORMED, help: "expected a list" };

    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Written {
        a: f64,
    }

    fn read(text: &str) -> Result<Vec<f64>, Findings> {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), text).unwrap();
        let mut read = Vec::new();
        let check = |written: Written, _: &mut dyn FnMut() -> Range<usize>| {
            if written.a < 0.0 {
                return Err(Diagnostic::error(congruent_input::codes::xml::MALFORMED, "is negative"));
            }
            read.push(written.a);
            Ok(())
        };
        LIST.read_file(TextLines::open(file.path(), 1 << 24)?, check)?;
        Ok(read)
    }

    #[test]
    fn a_list_is_an_array_or_lines() {
        for text in [
            "[{\"a\": 1}, {\"a\": 2}]",
            "\u{feff}\n [{\"a\":\n1},\n\n{\"a\": 2}\n]\n",
            "{\"a\": 1}\n{\"a\": 2}",
            "\u{feff}\n{\"a\": 1}\r\n\r\n {\"a\": 2} \n\n",
        ] {
            assert_eq!(read(text).unwrap(), [1.0, 2.0], "{text}");
        }
        assert_eq!(read("[]").unwrap(), [0.0; 0]);
    }

    #[test]
    fn faults_have_the_numbers_of_their_entries_and_their_places() {
        let found = |text: &str| -> Vec<_> {
            let faults = read(text).unwrap_err();
            faults.iter().map(|fault| (fault.message.clone(), fault.line_column().unwrap())).collect()
        };
        let negative = |number, line, column| (format!("entry {number}: is negative"), (line, column));
        assert_eq!(
            found("[{\"a\": 1},\n {\"a\": -1}, {\"a\": -1}]"),
            [negative(2, 2, 2), negative(3, 2, 13)]
        );
        assert_eq!(found("{\"a\": 1}\n\n{\"a\": -1}\n{\"a\": -1}"), [negative(2, 3, 1), negative(3, 4, 1)]);
        let unknown = "unknown field `b`, expected `a`";
        let expected = [(format!("entry 2: {unknown}"), (2, 4)), negative(3, 3, 1)];
        assert_eq!(found("{\"a\": 1}\n{\"b\": 1}\n{\"a\": -1}\n"), expected);
        // Not one entry a line: the first fault is enough.
        assert_eq!(found("{\n\"a\": 1\n}\n").len(), 1);
        assert_eq!(found("{\"a\": 1} {\"a\": 1}\n"), [("entry 1: trailing characters".to_owned(), (1, 10))]);
        assert_eq!(found("{\"a\": 1}\n{\"a\": }\n")[0].1, (2, 7));
        for (text, place) in
            [("[", (1, 1)), ("[{\"a\":1},]", (1, 10)), ("[{\"a\":1}] x", (1, 11)), (" ", (1, 1))]
        {
            assert_eq!(found(text)[0].1, place, "{text}");
        }
    }

    #[test]
    fn arrays_are_limited_and_lines_are_not() {
        let many = |separator: &str| vec!["{\"a\": 1}"; MOST_IN_ARRAY + 1].join(separator);
        assert_eq!(read(&many("\n")).unwrap().len(), MOST_IN_ARRAY + 1);
        let faults = read(&format!("[{}]", many(","))).unwrap_err();
        assert_eq!(faults[0].message, "the array has more than 100000 entries, which is the limit");
        assert_eq!(faults[0].help.as_deref(), Some("write one entry per line (JSON Lines)"));
    }

    #[test]
    fn of_many_faults_the_last_is_their_number() {
        for text in ["{\"b\": 1}\n".repeat(20_000), format!("[{}1]", "1,".repeat(19_999))] {
            let faults = read(&text).unwrap_err();
            let last = &faults[faults.len() - 1];
            let expected = (100, "19901 more entries of the list have errors");
            assert_eq!((faults.len(), last.message.as_str()), expected);
        }
    }
}
