//! Lists of entries in JSON that are too long for the memory: each entry is read, checked and forgotten.

use std::{
    cell::RefCell,
    fmt,
    io::{self, Read},
    ops::Range,
    sync::Arc,
};

use congruent_input::{Diagnostic, Findings, InputFile, SourceFile, TextStream};
use serde::{
    Deserializer as _,
    de::{DeserializeOwned, SeqAccess, Visitor},
};
use serde_json::{Deserializer, value::RawValue};

use super::json_list::{JsonList, offset_of};

/// Most faults that are reported; if there are more, the last message gives the number of the others.
const MOST_FAULTS: usize = 100;

/// The first line of an entry, as a byte range of the file.
pub(super) struct EntryPlace<'a> {
    text: &'a RefCell<TextStream>,
    first_line: Range<usize>,
}

impl EntryPlace<'_> {
    /// Keeps the line among the excerpts. Returns its range there.
    pub(super) fn keep(&self) -> Range<usize> {
        self.text.borrow_mut().keep(self.first_line.clone())
    }
}

impl JsonList {
    /// Reads all entries; `check` is given each, with the place of its first line. The file, and as much of its text as
    /// those places need.
    ///
    /// # Errors
    /// The faults of the entries, or the one fault for which the text is no list.
    pub(super) fn read_stream<Written: DeserializeOwned>(
        &self,
        text: TextStream,
        mut check: impl FnMut(Written, &EntryPlace<'_>) -> Result<(), Diagnostic>,
    ) -> Result<(InputFile, Arc<SourceFile>), Findings> {
        let text = RefCell::new(text);
        let (mut number, mut faults, mut count) = (0, Vec::new(), 0);
        let entry = |entry: &str, start: usize| {
            number += 1;
            let first_line = start..start + entry.find('\n').unwrap_or(entry.len());
            let place = EntryPlace { text: &text, first_line };
            let found = match serde_json::from_str(entry) {
                Ok(written) => check(written, &place).map_err(|fault| (fault, place.first_line.clone())),
                Err(error) => {
                    let offset = start + offset_of(entry, &error);
                    Err((self.not_read(&error), offset..offset))
                }
            };
            let Err((fault, at)) = found else { return };
            count += 1;
            if faults.len() < MOST_FAULTS {
                faults.push(self.of_entry(number, fault.at(text.borrow_mut().keep(at))));
            }
        };
        let mut parser = Deserializer::from_reader(Shared(&text));
        let list = parser.deserialize_seq(Entries { text: &text, entry }).and_then(|()| parser.end());
        if let Err(error) = list {
            let mut text = text.borrow_mut();
            let offset = text.offset_of(error.line(), error.column());
            faults = vec![self.not_read(&error).at(text.keep(offset..offset))];
            count = 1;
        }
        drop(parser);
        if number == 0 {
            // A caller that refuses an empty list points at the beginning of the text.
            text.borrow_mut().keep(0..0);
        }
        // Faults of the file as a whole, such as another encoding, come first: they may be the cause of the faults in it.
        let (input, source) = text.into_inner().close()?;
        if count > MOST_FAULTS {
            faults.truncate(MOST_FAULTS - 1);
            let more = format!("{} more entries of the list have errors", count - faults.len());
            faults.push(
                Diagnostic::error(self.code, more)
                    .with_help("correct the first ones and run the command again"),
            );
        }
        if faults.is_empty() {
            return Ok((input, source));
        }
        Err(faults.into_iter().map(|fault| fault.in_file(&source)).collect())
    }
}

/// The reader of the parser. It is shared with the visitor, which needs the byte offset of each entry.
struct Shared<'a>(&'a RefCell<TextStream>);

impl Read for Shared<'_> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        self.0.borrow_mut().read(bytes)
    }
}

/// Hands on each entry with its place.
struct Entries<'a, F> {
    text: &'a RefCell<TextStream>,
    entry: F,
}

impl<'de, F: FnMut(&str, usize)> Visitor<'de> for Entries<'_, F> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a sequence")
    }

    fn visit_seq<A: SeqAccess<'de>>(mut self, mut entries: A) -> Result<(), A::Error> {
        loop {
            self.text.borrow_mut().forget();
            let Some(entry) = entries.next_element::<Box<RawValue>>()? else { return Ok(()) };
            let entry = entry.get();
            // A number has no closing character, so the parser has read one byte beyond its end.
            let (read, last) = (self.text.borrow().offset(), self.text.borrow().last());
            let end = read - usize::from(last != entry.bytes().last());
            (self.entry)(entry, end - entry.len());
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use serde::Deserialize;

    use super::*;
    use congruent_input::read_text;

    const MOST_BYTES: u64 = 1 << 20;
    const LIST: JsonList = JsonList { entry: "entry", code: "some::json", help: "expected a list" };

    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Written {
        a: f64,
    }

    fn positive(value: f64) -> Result<f64, Diagnostic> {
        if value < 0.0 { Err(Diagnostic::error("some::sign", "is negative")) } else { Ok(value) }
    }

    type Outcome = Result<Vec<f64>, Findings>;

    /// The list as the reader of whole texts reads it, whose faults have the whole text.
    fn whole(path: &Path) -> Outcome {
        let source = read_text(path, MOST_BYTES)?;
        let found = LIST.read(&source.text, |written: Written, _| positive(written.a));
        found.map_err(|faults| faults.into_iter().map(|fault| fault.in_file(&source)).collect())
    }

    fn streamed(path: &Path) -> Outcome {
        let mut read = Vec::new();
        let entry = |written: Written, _: &EntryPlace<'_>| positive(written.a).map(|value| read.push(value));
        LIST.read_stream(TextStream::open(path, MOST_BYTES)?, entry)?;
        Ok(read)
    }

    /// What a fault says, where, and the lines that a snippet shows of it.
    fn summary(fault: &Diagnostic) -> (String, Option<String>, Option<(usize, usize)>, String) {
        let source = fault.source.as_ref().unwrap();
        let span = fault.span.clone().unwrap();
        let line = source.text[..span.start].rfind('\n').map_or(0, |at| at + 1);
        // Longer lines are not shown.
        let shown = if span.start - line < 500 { &source.text[line..span.end] } else { "" };
        (fault.message.clone(), fault.help.clone(), fault.line_column(), shown.to_owned())
    }

    #[track_caller]
    fn check(bytes: &[u8]) {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), bytes).unwrap();
        let [expected, found] = [whole(file.path()), streamed(file.path())]
            .map(|outcome| outcome.map_err(|faults| faults.iter().map(summary).collect::<Vec<_>>()));
        let start = String::from_utf8_lossy(&bytes[..bytes.len().min(60)]).into_owned();
        assert_eq!(found, expected, "{start} ... ({} bytes)", bytes.len());
    }

    /// Entries in lines, some of more than one line, and in a single one.
    fn long(separator: &str) -> String {
        let entry = |at: u32| {
            let gap = if at.is_multiple_of(7) { "\n  " } else { " " };
            format!("{{\"a\":{gap}{at}.5}}")
        };
        format!("[{}]", (0..20_000).map(entry).collect::<Vec<_>>().join(separator))
    }

    #[test]
    fn a_stream_is_read_as_a_whole_text() {
        let lines = long(",\n");
        for text in [&lines, &long(", "), &long(",\r\n"), "[]", " [ {\"a\": 1} ] \n", "\u{feff}[{\"a\":1}]"] {
            check(text.as_bytes());
        }
    }

    #[test]
    fn faults_of_a_stream_are_those_of_a_whole_text() {
        for text in
            ["", "\u{feff}", "\u{feff}[{\"a\":-1}]", "[", "[{\"a\":1}", "[{\"a\":1},]", "[{\"a\":1}] x"]
        {
            check(text.as_bytes());
        }
        for entry in [
            "1",
            "1.5e3",
            "-2",
            "\"é\"",
            "null",
            "[1]",
            "{}",
            "{\"b\":\n 1}",
            "{\"a\":\n\"é\"}",
            "{\"a\":-1}",
        ] {
            check(format!("[{{\"a\": 1}},\n {entry},\n {{\"a\": 2}} , {entry}\n]").as_bytes());
        }
    }

    #[test]
    fn faults_far_into_a_stream_have_their_places() {
        for text in [long(",\n"), long(", "), long(",\n\n")] {
            for (from, to) in [
                ("19000.5", "-3"),
                ("19000.5", "\"é\""),
                ("{\"a\": 19000.5}", "17"),
                ("{\"a\": 19000.5}", "{\"b\": \"é\", \"a\": 1}"),
                ("19000.5}", "19000.5"),
                ("19000.5", "1\0"),
            ] {
                check(text.replace(from, to).as_bytes());
            }
            let several =
                text.replace("19000.5", "-1").replace("19001.5", "-1").replace("\"a\": 3.5", "\"é\": 1");
            check(several.as_bytes());
            let mut bytes = several.into_bytes();
            let far = bytes.len() - 1000;
            bytes[far] = 0xE9;
            check(&bytes);
            bytes.truncate(far + 1);
            check(&bytes);
        }
    }

    #[test]
    fn of_many_faults_the_last_is_their_number() {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), long(",\n").replace("\"a\"", "\"b\"")).unwrap();
        let faults = streamed(file.path()).unwrap_err();
        let last = &faults[faults.len() - 1];
        assert_eq!(
            (faults.len(), last.message.as_str()),
            (100, "19901 more entries of the list have errors")
        );
    }
}
