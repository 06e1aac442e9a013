//! The encoding that an XML file declares, against the one that it has.

use std::sync::Arc;

use crate::diagnostic::{Diagnostic, SourceFile};

/// Beginnings of names of encodings in which ASCII is as in UTF-8.
const EXTENDED_ASCII: [&str; 9] =
    ["ascii", "us-ascii", "iso-8859", "iso8859", "latin", "windows-", "cp12", "koi8", "macroman"];

/// An encoding that is declared and is not that of the text, which was read as UTF-8: readers that go by the declaration
/// refuse the file, or read other names.
pub fn declared_encoding(source: &Arc<SourceFile>) -> Option<Diagnostic> {
    let (declared, at) = declaration(&source.text)?;
    let name = declared.to_ascii_lowercase();
    let is_same = ["utf-8", "utf8"].contains(&name.as_str())
        || (source.text.is_ascii() && EXTENDED_ASCII.iter().any(|known| name.starts_with(known)));
    if is_same {
        return None;
    }
    let message = format!("the file declares the encoding \"{declared}\", and is UTF-8");
    let warning = Diagnostic::warning("xml::encoding", message).at(at..at + declared.len());
    Some(warning.with_help("write encoding=\"UTF-8\", or leave it out").in_file(source))
}

/// The encoding of the XML declaration, and where it stands.
fn declaration(text: &str) -> Option<(&str, usize)> {
    let inside = text.strip_prefix("<?xml")?.split_once("?>")?.0;
    let (_, value) = inside.split_once("encoding")?;
    let value = value.trim_start().strip_prefix('=')?.trim_start();
    let quote = value.chars().next().filter(|quote| ['"', '\''].contains(quote))?;
    let name = value[1..].split_once(quote)?.0;
    Some((name, name.as_ptr().addr() - text.as_ptr().addr()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_encoding_is_told_that_is_not_that_of_the_text() {
        let told = |text: &str| {
            let source = Arc::new(SourceFile { path: "r.urdf".into(), text: text.to_owned() });
            declared_encoding(&source).and_then(|found| Some(text.get(found.span?)?.to_owned()))
        };
        for same in [
            "<robot name='r'/>",
            "<?xml version='1.0'?><robot name='r'/>",
            "<?xml version='1.0' encoding='utf-8'?><robot name='\u{e9}'/>",
            "<?xml version='1.0' encoding = \"ISO-8859-1\"?><robot name='r'/>",
        ] {
            assert_eq!(told(same), None, "{same}");
        }
        for other in ["ISO-8859-1", "utf-16", "EBCDIC-CP-US", "foo-8"] {
            let text = format!("<?xml version='1.0' encoding='{other}'?><robot name='\u{e9}'/>");
            assert_eq!(told(&text).as_deref(), Some(other));
        }
    }
}
