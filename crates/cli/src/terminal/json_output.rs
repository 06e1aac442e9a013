//! Results as JSON, written while they are serialised: the text of a long one is never in memory.

use std::{
    borrow::Cow,
    fmt::Write as _,
    io::{self, Write},
};

use congruent::input::is_hidden;
use serde::Serialize;
use serde_json::{
    Serializer,
    ser::{CharEscape, CompactFormatter, Formatter},
};

/// Writes a document in one line, which no terminal and no CI host obeys.
pub(crate) fn write_json<T: Serialize>(document: &T, out: &mut impl Write) -> io::Result<()> {
    document.serialize(&mut Serializer::with_formatter(&mut *out, ForPrograms::default()))?;
    out.write_all(b"\n")
}

/// Characters of strings as [`for_programs`] writes them. A string may come in several fragments.
#[derive(Default)]
struct ForPrograms {
    is_after_hash: bool,
}

impl Formatter for ForPrograms {
    fn begin_string<W: Write + ?Sized>(&mut self, writer: &mut W) -> io::Result<()> {
        self.is_after_hash = false;
        CompactFormatter.begin_string(writer)
    }

    fn write_string_fragment<W: Write + ?Sized>(&mut self, writer: &mut W, fragment: &str) -> io::Result<()> {
        let mut rest = fragment;
        if let Some(after) = fragment.strip_prefix('#').filter(|_| self.is_after_hash) {
            writer.write_all(b"\\u0023")?;
            rest = after;
        }
        let written = for_programs(rest);
        if !fragment.is_empty() {
            self.is_after_hash = written.ends_with('#');
        }
        writer.write_all(written.as_bytes())
    }

    fn write_char_escape<W: Write + ?Sized>(&mut self, writer: &mut W, escape: CharEscape) -> io::Result<()> {
        self.is_after_hash = false;
        CompactFormatter.write_char_escape(writer, escape)
    }
}

/// A JSON document that no terminal and no CI host obeys. These characters are in strings alone: it stays the same
/// document.
fn for_programs(json: &str) -> Cow<'_, str> {
    // Nearly every string is a name of printable ASCII.
    if json.bytes().all(|byte| matches!(byte, b' '..=b'"' | b'$'..=b'~')) {
        return Cow::Borrowed(json);
    }
    let is_obeyed = |c: char| is_hidden(c) && c != '\n';
    if !json.contains(is_obeyed) && !json.contains("##") {
        return Cow::Borrowed(json);
    }
    let mut written = String::with_capacity(json.len());
    let mut units = [0; 2];
    for c in json.chars() {
        if is_obeyed(c) || (c == '#' && written.ends_with('#')) {
            for unit in c.encode_utf16(&mut units) {
                let _ = write!(written, "\\u{unit:04x}");
            }
        } else {
            written.push(c);
        }
    }
    Cow::Owned(written)
}

#[cfg(test)]
mod tests {
    use std::{cell::Cell, fmt};

    use serde_json::json;

    use super::*;

    /// A text in pieces, each of which is a fragment.
    struct Pieces(&'static [&'static str]);

    impl fmt::Display for Pieces {
        fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            self.0.iter().try_for_each(|piece| f.write_str(piece))
        }
    }

    impl Serialize for Pieces {
        fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            serializer.collect_str(self)
        }
    }

    #[track_caller]
    fn check(document: &impl Serialize) {
        let mut written = Vec::new();
        write_json(document, &mut written).unwrap();
        let whole = serde_json::to_string(document).unwrap() + "\n";
        assert_eq!(String::from_utf8(written).unwrap(), for_programs(&whole));
    }

    #[test]
    fn what_is_written_piece_by_piece_is_the_whole_document() {
        check(
            &json!({"##a": ["#", "#", "###\u{9b}#", "#\n#", "\u{7f}\u{202e}\"##\""], "b": [1.5e-9, null, true]}),
        );
        check(&Pieces(&["a#", "", "##", "#b#", "#", "\u{85}#", "#"]));
        check(&Pieces(&["#", "\n", "#", "\"", "##"]));
    }

    /// Each entry of a long document is written before the next one is made.
    #[test]
    fn a_long_document_is_never_in_memory() {
        const ENTRIES: usize = 10_000;
        struct Counted<'a>(&'a Cell<usize>);
        impl Write for Counted<'_> {
            fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
                self.0.set(self.0.get() + bytes.len());
                Ok(bytes.len())
            }
            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }
        struct Long<'a>(&'a Cell<usize>);
        impl Serialize for Long<'_> {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                let entry = |index| {
                    assert!(self.0.get() >= index, "{} bytes before entry {index}", self.0.get());
                    index
                };
                serializer.collect_seq((0..ENTRIES).map(entry))
            }
        }
        let written = Cell::new(0);
        write_json(&Long(&written), &mut Counted(&written)).unwrap();
        assert!(written.get() > ENTRIES);
    }

    /// A fault of the output keeps its kind: a closed pipe is not a failure of the command.
    #[test]
    fn a_fault_of_the_output_keeps_its_kind() {
        struct Closed;
        impl Write for Closed {
            fn write(&mut self, _: &[u8]) -> io::Result<usize> {
                Err(io::ErrorKind::BrokenPipe.into())
            }
            fn flush(&mut self) -> io::Result<()> {
                Ok(())
            }
        }
        assert_eq!(write_json(&[1, 2], &mut Closed).unwrap_err().kind(), io::ErrorKind::BrokenPipe);
    }

    #[test]
    fn a_document_stays_the_same() {
        let document = serde_json::json!({"name": "\u{202e}##[x]\u{e0041}\u{85}\u{1b}\n"});
        let written = for_programs(&document.to_string()).into_owned();
        assert!(!written.contains(is_hidden) && !written.contains("##"), "{written}");
        assert_eq!(serde_json::from_str::<serde_json::Value>(&written).unwrap(), document);
    }
}
