//! XML trees of bounded depth and without entities, for URDF, SRDF and COLLADA.
//!
//! A pass over the tokens comes first: thousands of nested elements overflow the stack of a tree
//! builder, which nothing can catch, and entities multiply.

use roxmltree::Document;
use xmlparser::{ElementEnd, Token, Tokenizer};

use crate::diagnostic::Diagnostic;

/// The code of an element whose prefix is not declared.
pub(crate) const UNKNOWN_PREFIX: &str = "xml::prefix";

/// URDF needs six levels, vendor blocks a few more, COLLADA one for each node of a limb.
const DEEPEST: usize = 64;

/// The tree builder compares each attribute of an element with all others: a hundred thousand take a minute.
const MOST_ATTRIBUTES: usize = 1000;

/// An element that is not closed yet.
struct OpenElement<'a> {
    tag: &'a str,
    name: Option<&'a str>,
    start: usize,
    attributes: usize,
}

/// The tree of a text.
pub(crate) fn parse(text: &str) -> Result<Document<'_>, Diagnostic> {
    check(text)?;
    Document::parse(text).map_err(|error| unbuilt(&error, text))
}

/// The tree builder's error as a diagnostic.
fn unbuilt(error: &roxmltree::Error, text: &str) -> Diagnostic {
    use roxmltree::Error;
    let position = error.pos();
    let at = offset(text, position.row, position.col);
    let (code, message) = match error {
        Error::DuplicatedAttribute(name, _) => {
            ("xml::malformed", format!("attribute \"{name}\" is given twice"))
        }
        Error::UnknownNamespace(prefix, _) => {
            (UNKNOWN_PREFIX, format!("the prefix \"{prefix}:\" is not declared"))
        }
        Error::NoRootNode => ("xml::malformed", "the file holds no XML element".to_owned()),
        _ => ("xml::malformed", format!("XML is not well-formed: {error}")),
    };
    Diagnostic::error(code, message).at(at..at)
}

/// Refuses DTDs, too deep nesting and text that ends early.
fn check(text: &str) -> Result<(), Diagnostic> {
    let mut open: Vec<OpenElement<'_>> = Vec::new();
    for token in Tokenizer::from(text) {
        let token = token.map_err(|error| malformed(&error, text, &open))?;
        match token {
            Token::DtdStart { span, .. } | Token::EmptyDtd { span, .. } => {
                let message = "DTD (<!DOCTYPE ...>) and entity declarations are refused";
                return Err(Diagnostic::error("xml::dtd", message)
                    .at(span.range())
                    .with_help("write the values out; no entity is ever expanded or fetched"));
            }
            Token::ElementStart { span, local, .. } => {
                open.push(OpenElement {
                    tag: local.as_str(),
                    name: None,
                    start: span.start(),
                    attributes: 0,
                });
                if open.len() > DEEPEST {
                    let message = format!("XML is nested deeper than {DEEPEST} elements");
                    return Err(Diagnostic::error("xml::depth", message).at(span.range()));
                }
            }
            Token::Attribute { local, value, span, .. } => {
                if let Some(element) = open.last_mut() {
                    element.attributes += 1;
                    if element.attributes > MOST_ATTRIBUTES {
                        let message = format!("<{}> has more than {MOST_ATTRIBUTES} attributes", element.tag);
                        return Err(Diagnostic::error("xml::attributes", message).at(span.range()));
                    }
                    if local.as_str() == "name" {
                        element.name = Some(value.as_str());
                    }
                }
            }
            Token::ElementEnd { end: ElementEnd::Empty | ElementEnd::Close(..), .. } => {
                open.pop();
            }
            _ => {}
        }
    }
    if open.is_empty() { Ok(()) } else { Err(unclosed(&open)) }
}

fn malformed(error: &xmlparser::Error, text: &str, open: &[OpenElement<'_>]) -> Diagnostic {
    let at = offset(text, error.pos().row, error.pos().col);
    if !open.is_empty() && !text[at..].contains('>') {
        return unclosed(open);
    }
    // The library's text ends in a position of its own, which the span already gives.
    let what = error.to_string();
    Diagnostic::error("xml::malformed", format!("XML is not well-formed: {what}")).at(at..at)
}

/// What is open at the end, innermost last: the innermost element that has a name is what a
/// person looks for.
fn unclosed(open: &[OpenElement<'_>]) -> Diagnostic {
    let last = &open[open.len() - 1];
    let owner = open.iter().rev().find_map(|element| Some((element.tag, element.name?)));
    let inside = match owner {
        Some((tag, name)) if last.name.is_none() => format!(" in {tag} \"{name}\""),
        Some((_, name)) => format!(" \"{name}\""),
        None => String::new(),
    };
    let message = format!("unexpected end of file: <{}>{inside} is not closed", last.tag);
    Diagnostic::error("xml::truncated", message)
        .at(last.start..last.start + 1 + last.tag.len())
        .with_help("the file is cut off or a closing tag is missing")
}

/// Byte offset of a row and a column in characters, both from 1.
fn offset(text: &str, row: u32, column: u32) -> usize {
    let line_start = match row {
        0 | 1 => 0,
        _ => text.match_indices('\n').nth(row as usize - 2).map_or(text.len(), |(newline, _)| newline + 1),
    };
    let line = &text[line_start..];
    let column = column.saturating_sub(1) as usize;
    line_start + line.char_indices().nth(column).map_or(line.len(), |(at, _)| at)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn refused(text: &str, code: &str, message: &str) {
        let fault = check(text).unwrap_err();
        assert_eq!(fault.code, code);
        assert!(fault.message.contains(message), "{}", fault.message);
        assert!(fault.span.is_some());
    }

    #[test]
    fn depth_and_entities_are_bounded() {
        let nested = |depth| "<a>".repeat(depth) + &"</a>".repeat(depth);
        assert_eq!(check(&nested(DEEPEST)), Ok(()));
        refused(&nested(100_000), "xml::depth", "deeper than 64");
        refused("<!DOCTYPE r [<!ENTITY x SYSTEM \"f\">]><r>&x;</r>", "xml::dtd", "entity");
        refused("<!DOCTYPE r><r/>", "xml::dtd", "DTD");
    }

    #[test]
    fn attributes_are_bounded() {
        let attributes = |count| (0..count).map(|at| format!("k{at}='1'")).collect::<Vec<_>>().join(" ");
        let element = |count| format!("<a {}/>", attributes(count));
        assert_eq!(check(&element(MOST_ATTRIBUTES)), Ok(()));
        refused(&element(100_000), "xml::attributes", "<a> has more than 1000 attributes");
    }

    #[test]
    fn an_early_end_names_what_is_open() {
        refused(
            "<r><joint name=\"j\"><limit a=\"1",
            "xml::truncated",
            "<limit> in joint \"j\" is not closed",
        );
        refused("<r><joint name=\"j\">\n", "xml::truncated", "<joint> \"j\" is not closed");
        refused("<r>", "xml::truncated", "<r> is not closed");
        refused("<r><a b=></a></r>", "xml::malformed", "invalid attribute");
    }

    #[test]
    fn rows_and_columns_are_offsets() {
        let text = "ab\néd\n";
        assert_eq!(offset(text, 1, 1), 0);
        assert_eq!(offset(text, 2, 2), 5);
        assert_eq!(offset(text, 9, 9), text.len());
    }
}
