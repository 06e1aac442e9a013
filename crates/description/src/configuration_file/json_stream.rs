//! Lists of entries in JSON that are too long for the memory: each entry is read, checked and forgotten.

use std::{
    cell::RefCell,
    fmt,
    io::{self, Read},
    ops::Range,
    sync::Arc,
};

use serde::{
    Deserializer as _,
    de::{DeserializeOwned, SeqAccess, Visitor},
};
use serde_json::{Deserializer, value::RawValue};

use super::json_list::{JsonList, offset_of};
use crate::{
    diagnostic::{Diagnostic, SourceFile},
    files::{InputFile, TextStream},
};

/// Most faults that are told; of more, the last one is their number.
const MOST_FAULTS: usize = 100;

/// The first line of an entry.
pub(super) struct EntryPlace<'a> {
    text: &'a RefCell<TextStream>,
    first_line: Range<usize>,
}

impl EntryPlace<'_> {
    /// Where it is in the text that comes with the file.
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
    ) -> Result<(InputFile, Arc<SourceFile>), Vec<Diagnostic>> {
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
        // Whatever is wrong with the file as a whole comes before what is wrong in it.
        let (input, source) = text.into_inner().close()?;
        if count > MOST_FAULTS {
            faults.truncate(MOST_FAULTS - 1);
            let more = format!("{} more {}s cannot be read", count - faults.len(), self.entry);
            faults.push(Diagnostic::error(self.code, more).with_help("correct the first ones and try again"));
        }
        if faults.is_empty() {
            return Ok((input, source));
        }
        Err(faults.into_iter().map(|fault| fault.in_file(&source)).collect())
    }
}

/// The parser's end of a text whose place its visitor asks for.
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
            // The parser sees where a number ends only after its end.
            let (read, last) = (self.text.borrow().offset(), self.text.borrow().last());
            let end = read - usize::from(last != entry.bytes().last());
            (self.entry)(entry, end - entry.len());
        }
    }
}
