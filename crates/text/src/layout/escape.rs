//! The last step before a terminal or the log of a CI host: nothing that comes from files moves the cursor, hides text,
//! or gives the host a command. What is escaped stays readable.

use std::{borrow::Cow, ops::Range, path::Path, sync::Arc};

use congruent_input::{Diagnostic, SourceFile, is_hidden, visible, visible_lines};

/// Whether the colours of a text are kept or escaped.
#[derive(Debug, Clone, Copy)]
pub enum Colours {
    /// Kept: a terminal shows them.
    Kept,
    /// Escaped like all other control characters.
    Escaped,
}

/// Text for people. Of control characters only line breaks are left, and colours where they are the program's own.
///
/// # Examples
/// ```
/// use congruent_text::layout::{Colours, for_people};
///
/// assert_eq!(for_people("a\u{7}b\n", Colours::Escaped), "a\\u{7}b\n");
/// ```
pub fn for_people(text: &str, colours: Colours) -> String {
    let mut written = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let line = without_commands(line);
        match colours {
            Colours::Kept => coloured(&mut written, &line),
            Colours::Escaped => written += &visible_lines(&line),
        }
    }
    written
}

/// A path in one line.
pub fn visible_path(path: &Path) -> String {
    visible(&path.to_string_lossy()).into_owned()
}

/// A line that no CI host takes for a command: GitHub takes those that begin with `::` and those with `##[` anywhere,
/// Azure `##vso[`, another one `##teamcity[`.
fn without_commands(line: &str) -> Cow<'_, str> {
    let words = line.trim_start();
    let (indent, words) = match words.strip_prefix("::") {
        Some(rest) => (&line[..line.len() - words.len()], Some(rest)),
        None => ("", None),
    };
    let line = words.map_or(Cow::Borrowed(line), |rest| Cow::Owned(format!(r"{indent}\u{{3a}}:{rest}")));
    if !line.contains("##") {
        return line;
    }
    let mut written = String::with_capacity(line.len());
    let mut rest = &*line;
    while let Some(at) = rest.find("##") {
        let is_command =
            rest[at + 2..].trim_start_matches(|c: char| c.is_ascii_alphanumeric()).starts_with('[');
        written += &rest[..=at];
        written += if is_command { r"\u{23}" } else { "" };
        rest = &rest[at + 1 + usize::from(is_command)..];
    }
    Cow::Owned(written + rest)
}

/// A line with escaped characters but colours: those that say how text looks and neither hide it nor move the cursor.
fn coloured(written: &mut String, line: &str) {
    let mut rest = line;
    while let Some(at) = rest.find('\u{1b}') {
        *written += &visible_lines(&rest[..at]);
        let length = colour(&rest[at..]).unwrap_or(0);
        *written += &rest[at..at + length];
        rest = &rest[at + length..];
        if length == 0 {
            *written += r"\u{1b}";
            rest = &rest[1..];
        }
    }
    *written += &visible_lines(rest);
}

/// Length of the colour that a text begins with, `ESC [ numbers m`.
fn colour(text: &str) -> Option<usize> {
    let numbers = text.strip_prefix("\u{1b}[")?;
    let end = numbers.find(|c: char| !(c.is_ascii_digit() || c == ';'))?;
    let is_look = |number: &str| !matches!(number.trim_start_matches('0'), "7" | "8");
    (numbers[end..].starts_with('m') && numbers[..end].split(';').all(is_look)).then_some(end + 3)
}

/// The finding with the lines of its snippet escaped, so that its span marks the same characters.
pub(crate) fn with_visible_lines(mut finding: Diagnostic) -> Diagnostic {
    let (Some(source), Some(span)) = (&finding.source, &finding.span) else { return finding };
    let shown = lines_around(&source.text, span);
    let is_obeyed = |c: char| is_hidden(c) && c != '\n' && c != '\t';
    let related = finding.kind.related.as_ref().and_then(|related| related.span.as_ref());
    let is_related_plain =
        related.is_none_or(|span| !source.text[lines_around(&source.text, span)].contains(is_obeyed));
    let is_plain = !source.text[shown.clone()].contains(is_obeyed);
    if !(is_plain && is_related_plain) {
        // The message names its line.
        finding.kind.related = None;
    }
    if is_plain {
        return finding;
    }
    let before = source.text[..shown.start].matches('\n').count();
    // Lines before the snippet only count.
    let mut text = "\n".repeat(before);
    let place = |at: usize, from: usize, text: &mut String| {
        let (from, at) = (source.text.floor_char_boundary(from), source.text.floor_char_boundary(at));
        escape_lines(&source.text[from..at], text);
        text.len()
    };
    let start = place(span.start, shown.start, &mut text);
    let end = place(span.end.max(span.start), span.start, &mut text);
    place(shown.end, span.end.max(span.start), &mut text);
    finding.source =
        Some(Arc::new(SourceFile { path: source.path.clone(), text, is_foreign: source.is_foreign }));
    finding.span = Some(start..end);
    finding
}

fn escape_lines(text: &str, written: &mut String) {
    for line in text.split_inclusive('\n') {
        let (line, end) = match line.strip_suffix('\n') {
            Some(line) => (line.strip_suffix('\r').unwrap_or(line), "\n"),
            None => (line, ""),
        };
        for (index, part) in line.split('\t').enumerate() {
            // The renderer expands tabs.
            written.push_str(if index > 0 { "\t" } else { "" });
            *written += &visible(part);
        }
        *written += end;
    }
}

/// The lines of a span with one before and one after it, as the renderer shows them.
fn lines_around(text: &str, span: &Range<usize>) -> Range<usize> {
    let bytes = text.as_bytes();
    let (first, last) = (span.start.min(bytes.len()), span.end.max(span.start).min(bytes.len()));
    let is_break = |&byte: &u8| byte == b'\n';
    let line_start = |at: usize| bytes[..at].iter().rposition(is_break).map_or(0, |at| at + 1);
    let line_end =
        |at: usize| bytes[at..].iter().position(is_break).map_or(bytes.len(), |more| at + more + 1);
    let start = line_start(line_start(first).saturating_sub(1));
    start..line_end(line_end(last))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, expected: &str) {
        assert_eq!(for_people(text, Colours::Escaped), expected);
    }

    #[test]
    fn lines_stay_and_nothing_else_is_obeyed() {
        check("a\n  b\n", "a\n  b\n");
        check("a\u{1b}[2Jb\u{7}\r\n", "a\\u{1b}[2Jb\\u{7}\\r\n");
        check("\u{202e}x\ty", "\\u{202e}x\\ty");
    }

    #[test]
    fn no_line_is_a_command() {
        check("::error::x\n", "\\u{3a}:error::x\n");
        check("  ::error::x", "  \\u{3a}:error::x");
        check("a::b: pass\n", "a::b: pass\n");
        check("x ##[error]y ###vso[z]", "x #\\u{23}[error]y ##\\u{23}vso[z]");
        check("## Heading", "## Heading");
    }

    #[test]
    fn colours_are_kept_but_hide_nothing() {
        let text = "\u{1b}[31mred\u{1b}[0m \u{1b}[38;2;1;2;3m \u{1b}[8mgone\u{1b}[1;08m\u{1b}[2J\u{1b}";
        assert_eq!(
            for_people(text, Colours::Kept),
            "\u{1b}[31mred\u{1b}[0m \u{1b}[38;2;1;2;3m \\u{1b}[8mgone\\u{1b}[1;08m\\u{1b}[2J\\u{1b}"
        );
        assert!(!for_people(text, Colours::Escaped).contains('\u{1b}'));
    }

    #[test]
    fn a_span_marks_the_same_characters() {
        let text = "a = 1\nb\u{202e} = \u{1b}[2J\t'bad'\r\nc = 3\n";
        let start = text.find("'bad'").unwrap();
        let source = Arc::new(SourceFile { path: "x.toml".into(), text: text.to_owned(), is_foreign: false });
        let found = Diagnostic::error(congruent_starter::codes::new::SHAPE, "wrong")
            .at(start..start + 5)
            .in_file(&source);
        let escaped_finding = with_visible_lines(found);
        let (source, span) = (escaped_finding.source.clone().unwrap(), escaped_finding.span.clone().unwrap());
        assert_eq!(source.text, "a = 1\nb\\u{202e} = \\u{1b}[2J\t'bad'\nc = 3\n");
        assert_eq!(&source.text[span], "'bad'");
        assert_eq!(escaped_finding.line_column().map(|(line, _)| line), Some(2));
    }

    #[test]
    fn a_span_anywhere_is_no_panic() {
        for text in ["", "\u{7}", "\u{7}\n\u{7}\u{e4}\n", "\n\n\u{1b}"] {
            for start in 0..=text.len() + 2 {
                for end in 0..=text.len() + 2 {
                    let source =
                        Arc::new(SourceFile { path: "x".into(), text: text.to_owned(), is_foreign: false });
                    let found = Diagnostic::error(congruent_starter::codes::new::SHAPE, "wrong")
                        .at(start..end)
                        .in_file(&source);
                    let escaped_finding = with_visible_lines(found);
                    assert!(
                        !escaped_finding.source.unwrap().text.contains('\u{7}') || text.lines().count() > 1
                    );
                }
            }
        }
    }
}
