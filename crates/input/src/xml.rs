//! XML trees of bounded depth and without entities, for URDF, SRDF and COLLADA.
//!
//! A pass over the tokens comes first: thousands of nested elements overflow the stack of a tree
//! builder, which nothing can catch, and entities multiply.

use std::ops::Range;

use roxmltree::Document;
use xmlparser::{ElementEnd, Token, Tokenizer};

use crate::{
    codes,
    diagnostic::{Diagnostic, line_column},
};

/// The beginning of a Git LFS pointer, the small file that takes the place of a large one.
pub const LFS_POINTER: &str = "version https://git-lfs";

/// URDF needs six levels, vendor blocks a few more, COLLADA one for each node of a limb.
const DEEPEST: usize = 64;

/// The tree builder compares each attribute of an element with all others: 16 MB of elements with 64 each take some seconds.
/// URDF, SRDF and COLLADA have at most ten.
const MOST_ATTRIBUTES: usize = 64;

/// Most elements of a file, and attributes of all of them together: a tree of `urdf-rs` needs 800 bytes for each element and 200 for
/// each attribute. 10,000 links and joints with all their parts have 200,000 elements.
const MOST_ELEMENTS: usize = 300_000;
const MOST_ATTRIBUTES_IN_ALL: usize = 1_000_000;

/// An element that is not closed yet.
struct OpenElement<'a> {
    tag: &'a str,
    name: Option<&'a str>,
    start: usize,
    attributes: usize,
}

impl OpenElement<'_> {
    /// The opening of its tag.
    fn opening(&self) -> Range<usize> {
        self.start..self.start + 1 + self.tag.len()
    }
}

/// The number of elements and attributes so far.
#[derive(Default)]
struct DocumentSize {
    elements: usize,
    attributes: usize,
}

impl DocumentSize {
    fn add_element(&mut self, at: Range<usize>) -> Result<(), Diagnostic> {
        self.elements += 1;
        at_most(self.elements, MOST_ELEMENTS, "elements", at)
    }

    fn add_attribute(&mut self, at: Range<usize>) -> Result<(), Diagnostic> {
        self.attributes += 1;
        at_most(self.attributes, MOST_ATTRIBUTES_IN_ALL, "attributes", at)
    }
}

fn at_most(count: usize, most: usize, what: &str, at: Range<usize>) -> Result<(), Diagnostic> {
    if count <= most {
        return Ok(());
    }
    let message = format!("the file has more than {most} {what}, the most that are read");
    Err(Diagnostic::error(codes::xml::ELEMENTS, message).at(at))
}

/// The XML tree of a text.
///
/// # Errors
/// It is not well-formed XML, or nests too deeply.
pub fn parse(text: &str) -> Result<Document<'_>, Diagnostic> {
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
            (codes::xml::MALFORMED, format!("attribute \"{name}\" is given twice"))
        }
        Error::UnknownNamespace(prefix, _) => {
            (codes::xml::PREFIX, format!("the prefix \"{prefix}:\" is not declared"))
        }
        Error::NoRootNode => (codes::xml::MALFORMED, "the file holds no XML element".to_owned()),
        _ => (codes::xml::MALFORMED, format!("XML is not well-formed: {error}")),
    };
    let found = Diagnostic::error(code, message).at(at..at);
    match error {
        Error::UnknownNamespace(prefix, _) => found.with_help(format!(
            "declare it in the first element, as xmlns:{prefix}=\"urn:{prefix}\": some readers of URDFs do without, those of XML do not"
        )),
        _ => found,
    }
}

/// Refuses DTDs, too deep nesting and text that ends early.
fn check(text: &str) -> Result<(), Diagnostic> {
    no_xml(text)?;
    let mut open: Vec<OpenElement<'_>> = Vec::new();
    let mut has_root = false;
    let mut size = DocumentSize::default();
    for token in Tokenizer::from(text) {
        let token = token.map_err(|error| {
            if has_root && open.is_empty() {
                after_root(&error, text)
            } else {
                malformed(&error, text, &open)
            }
        })?;
        match token {
            Token::DtdStart { span, .. } | Token::EmptyDtd { span, .. } => {
                let message = "DTD (<!DOCTYPE ...>) and entity declarations are refused";
                return Err(Diagnostic::error(codes::xml::DTD, message)
                    .at(span.range())
                    .with_help("write the values out; no entity is ever expanded or fetched"));
            }
            Token::ElementStart { span, local, .. } => {
                has_root = true;
                size.add_element(span.range())?;
                open.push(OpenElement {
                    tag: local.as_str(),
                    name: None,
                    start: span.start(),
                    attributes: 0,
                });
                if open.len() > DEEPEST {
                    let message = format!("XML is nested deeper than {DEEPEST} elements");
                    return Err(Diagnostic::error(codes::xml::DEPTH, message).at(span.range()));
                }
            }
            Token::Attribute { local, value, span, .. } => {
                if let Some(element) = open.last_mut() {
                    size.add_attribute(span.range())?;
                    element.attributes += 1;
                    if element.attributes > MOST_ATTRIBUTES {
                        let message = format!("<{}> has more than {MOST_ATTRIBUTES} attributes", element.tag);
                        return Err(Diagnostic::error(codes::xml::ATTRIBUTES, message).at(span.range()));
                    }
                    if local.as_str() == "name" {
                        element.name = Some(value.as_str());
                    }
                }
            }
            Token::ElementEnd { end: ElementEnd::Empty, .. } => {
                open.pop();
            }
            Token::ElementEnd { end: ElementEnd::Close(_, local), span } => match open.pop() {
                Some(element) if element.tag != local.as_str() => {
                    return Err(not_closed(&element, local.as_str(), text).at(span.range()));
                }
                _ => {}
            },
            _ => {}
        }
    }
    if open.is_empty() { Ok(()) } else { Err(unclosed(&open, text)) }
}

/// Refuses files that are not XML at all, by their beginning: Git LFS pointers, web pages, other text.
fn no_xml(text: &str) -> Result<(), Diagnostic> {
    let begin = text.trim_start_matches('\u{feff}').trim_start();
    let at = text.len() - begin.len();
    if begin.starts_with(LFS_POINTER) {
        return Err(Diagnostic::error(
            codes::xml::MALFORMED,
            "the file is a Git LFS pointer, not the file itself",
        )
        .at(at..at)
        .with_help("`git lfs pull` fetches it"));
    }
    let starts_with =
        |word: &str| begin.get(..word.len()).is_some_and(|head| head.eq_ignore_ascii_case(word));
    if starts_with("<!doctype html") || starts_with("<html") {
        return Err(Diagnostic::error(codes::xml::MALFORMED, "the file is a web page (HTML)")
            .at(at..at)
            .with_help("a page of results is for the browser; code hosts show a file inside a page, which has a link to the raw file"));
    }
    if begin.is_empty() || begin.starts_with('<') {
        return Ok(());
    }
    let first: String = begin.lines().next().unwrap_or_default().chars().take(40).collect();
    let message = format!("the file is not XML: it begins with \"{first}\"");
    Err(Diagnostic::error(codes::xml::MALFORMED, message).at(at..at))
}

/// The fault of content after the root element.
fn after_root(error: &xmlparser::Error, text: &str) -> Diagnostic {
    let at = offset(text, error.pos().row, error.pos().col);
    let rest = text[at..].trim_start();
    let at = text.len() - rest.len();
    let message = if rest.starts_with("</") {
        "a closing tag after the end of the root element: no element is open there"
    } else if rest.starts_with('<') {
        "a second root element after the end of the first: a file has only one"
    } else {
        "text after the end of the root element"
    };
    Diagnostic::error(codes::xml::MALFORMED, message)
        .at(at..at)
        .with_help("remove what follows the closing tag of the first element, or put a second robot in a file of its own")
}

/// The fault of a file with merge conflict markers, at the first of them; `None` if there are none.
fn conflict(text: &str) -> Option<Diagnostic> {
    let marker = "<<<<<<< ";
    let at = if text.starts_with(marker) { 0 } else { text.find(&format!("\n{marker}"))? + 1 };
    let message = "the file has the marks of a merge conflict: it contains both versions";
    Some(
        Diagnostic::error(codes::xml::MALFORMED, message)
            .at(at..at + marker.len() - 1)
            .with_help("resolve the conflict, and remove the lines <<<<<<<, ======= and >>>>>>>"),
    )
}

fn malformed(error: &xmlparser::Error, text: &str, open: &[OpenElement<'_>]) -> Diagnostic {
    if let Some(conflict) = conflict(text) {
        return conflict;
    }
    let at = offset(text, error.pos().row, error.pos().col);
    if text[at..].starts_with("<?xml") {
        let message = "the XML declaration <?xml ...?> is not the first thing in the file";
        return Diagnostic::error(codes::xml::MALFORMED, message)
            .at(at..at)
            .with_help("remove everything before it, also an empty line");
    }
    if !open.is_empty() && !text[at..].contains('>') {
        return unclosed(open, text);
    }
    // The library's text ends in a position of its own, which the span already gives.
    let what = error.to_string();
    Diagnostic::error(codes::xml::MALFORMED, format!("XML is not well-formed: {what}")).at(at..at)
}

/// The fault of a closing tag that does not match the innermost open element.
fn not_closed(element: &OpenElement<'_>, found: &str, text: &str) -> Diagnostic {
    let named = element.name.map_or_else(String::new, |name| format!(" \"{name}\""));
    let (tag, line) = (element.tag, line_column(text, element.start).0);
    let message =
        format!("</{found}> where </{tag}> is expected: <{tag}>{named} of line {line} is not closed");
    Diagnostic::error(codes::xml::MALFORMED, message)
        .related_to(element.opening(), format!("<{tag}> is opened here"))
        .with_help(format!("close <{tag}> before, or correct the name of one of the two tags"))
}

/// The fault of a text that ends while elements are open (innermost last). The message gives the innermost element with a
/// name, since a person searches for a link or joint by its name.
fn unclosed(open: &[OpenElement<'_>], text: &str) -> Diagnostic {
    let last = &open[open.len() - 1];
    let owner = open.iter().rev().find_map(|element| Some((element.tag, element.name?)));
    let inside = match owner {
        Some((tag, name)) if last.name.is_none() => format!(" in {tag} \"{name}\""),
        Some((_, name)) => format!(" \"{name}\""),
        None => String::new(),
    };
    let (tag, line) = (last.tag, line_column(text, last.start).0);
    let message = format!("unexpected end of file: <{tag}>{inside}, opened in line {line}, is not closed");
    let end = text.trim_end().len();
    Diagnostic::error(codes::xml::TRUNCATED, message)
        .at(end..end)
        .related_to(last.opening(), format!("<{tag}> is opened here"))
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
        assert_eq!(fault.code.name, code);
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
        refused("<!DOCTYPE HTML><html></html>", "xml::malformed", "web page");
        refused("\n<html></html>", "xml::malformed", "web page");
    }

    #[test]
    fn attributes_are_bounded() {
        let attributes = |count| (0..count).map(|at| format!("k{at}='1'")).collect::<Vec<_>>().join(" ");
        let element = |count| format!("<a {}/>", attributes(count));
        assert_eq!(check(&element(MOST_ATTRIBUTES)), Ok(()));
        refused(&element(100_000), "xml::attributes", "<a> has more than 64 attributes");
        let many = format!("<r>{}</r>", format!("<b {}/>", attributes(50)).repeat(20_001));
        refused(&many, "xml::elements", "more than 1000000 attributes");
    }

    /// 15 MB of such elements took 2.4 GB.
    #[test]
    fn elements_are_bounded() {
        let elements = |count| format!("<r>{}</r>", "<b/>x".repeat(count));
        assert_eq!(check(&elements(MOST_ELEMENTS - 1)), Ok(()));
        refused(&elements(MOST_ELEMENTS), "xml::elements", "more than 300000 elements");
    }

    #[test]
    fn an_early_end_names_what_is_open() {
        refused(
            "<r><joint name=\"j\"><limit a=\"1",
            "xml::truncated",
            "<limit> in joint \"j\", opened in line 1, is not closed",
        );
        refused(
            "<r><joint name=\"j\">\n",
            "xml::truncated",
            "<joint> \"j\", opened in line 1, is not closed",
        );
        refused("<r>", "xml::truncated", "<r>, opened in line 1, is not closed");
        refused("<r>\n<a></r>", "xml::malformed", "</r> where </a> is expected: <a> of line 2 is not closed");
        refused("<r><a b=></a></r>", "xml::malformed", "invalid attribute");
    }

    #[test]
    fn an_element_that_is_open_is_reported_at_both_of_its_ends() {
        for (text, at, opened) in
            [("<r>\n<link name='l'>\n<a/>\n", 24, 4..9), ("<r>\n<link>\n<a/>\n</r>", 16, 4..9)]
        {
            let fault = check(text).unwrap_err();
            assert_eq!(fault.span.map(|span| span.start), Some(at), "{text}");
            assert_eq!(fault.kind.related.and_then(|related| related.span), Some(opened), "{text}");
        }
    }

    #[test]
    fn what_else_is_in_the_file_is_named() {
        refused("<r/>\n<r/>", "xml::malformed", "a second root element");
        refused("<r></r></r>", "xml::malformed", "a closing tag after the end");
        refused("<r/> words", "xml::malformed", "text after the end");
        refused("version https://git-lfs.github.com/spec/v1", "xml::malformed", "Git LFS pointer");
        refused("\n<?xml version='1.0'?><r/>", "xml::malformed", "not the first thing");
        refused("robot: x", "xml::malformed", "begins with \"robot: x\"");
        refused("<r>\n<<<<<<< HEAD\n<a/>\n=======\n>>>>>>> x\n</r>", "xml::malformed", "merge conflict");
    }

    #[test]
    fn rows_and_columns_are_offsets() {
        let text = "ab\néd\n";
        assert_eq!(offset(text, 1, 1), 0);
        assert_eq!(offset(text, 2, 2), 5);
        assert_eq!(offset(text, 9, 9), text.len());
    }
}
