//! Compares the encoding that an XML file declares with the encoding of its text.

use std::sync::Arc;

use congruent_input::{Diagnostic, SourceFile};

use crate::codes;

/// Prefixes of the names of encodings that write ASCII text with the same bytes as UTF-8.
const EXTENDED_ASCII: [&str; 9] =
    ["ascii", "us-ascii", "iso-8859", "iso8859", "latin", "windows-", "cp12", "koi8", "macroman"];

/// A warning if the declared encoding is not that of the text, which was read as UTF-8: readers that follow the declaration
/// refuse the file, or read other names.
pub fn declared_encoding(source: &Arc<SourceFile>) -> Option<Diagnostic> {
    let (declared, at) = declaration(&source.text)?;
    let name = declared.to_ascii_lowercase();
    let is_same = ["utf-8", "utf8"].contains(&name.as_str())
        // ASCII text is the same in all of these.
        || (source.text.is_ascii() && EXTENDED_ASCII.iter().any(|known| name.starts_with(known)));
    if is_same {
        return None;
    }
    let message = format!("the file declares the encoding \"{declared}\", but its text is UTF-8");
    let warning = Diagnostic::warning(codes::xml::ENCODING, message).at(at..at + declared.len());
    Some(warning.with_help("write encoding=\"UTF-8\", or leave it out").in_file(source))
}

/// The encoding that the XML declaration names, with its byte offset in the text.
fn declaration(text: &str) -> Option<(&str, usize)> {
    let inside = text.strip_prefix("<?xml")?.split_once("?>")?.0;
    let (_, value) = inside.split_once("encoding")?;
    let value = value.trim_start().strip_prefix('=')?.trim_start();
    let quote = value.chars().next().filter(|quote| ['"', '\''].contains(quote))?;
    let name = value[1..].split_once(quote)?.0;
    // The name is a slice of the text, so the distance of the pointers is its place.
    Some((name, name.as_ptr().addr() - text.as_ptr().addr()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_encoding_that_is_not_that_of_the_text_is_reported() {
        let findings = |text: &str| {
            let source =
                Arc::new(SourceFile { path: "r.urdf".into(), text: text.to_owned(), is_foreign: false });
            declared_encoding(&source).and_then(|found| Some(text.get(found.span?)?.to_owned()))
        };
        for same in [
            "<robot name='r'/>",
            "<?xml version='1.0'?><robot name='r'/>",
            "<?xml version='1.0' encoding='utf-8'?><robot name='\u{e9}'/>",
            "<?xml version='1.0' encoding = \"ISO-8859-1\"?><robot name='r'/>",
        ] {
            assert_eq!(findings(same), None, "{same}");
        }
        for other in ["ISO-8859-1", "utf-16", "EBCDIC-CP-US", "foo-8"] {
            let text = format!("<?xml version='1.0' encoding='{other}'?><robot name='\u{e9}'/>");
            assert_eq!(findings(&text).as_deref(), Some(other));
        }
    }
}
