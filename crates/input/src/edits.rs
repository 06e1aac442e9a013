//! Corrections of a file as changes of its text; the rest of each line is kept.

use std::{fmt, ops::Range};

use schemars::JsonSchema;
use serde::Serialize;

use crate::diagnostic::line_column;

/// The replacement of a part of a text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextEdit {
    /// Byte range; empty if text is added.
    pub span: Range<usize>,
    /// The text that replaces the range.
    pub text: String,
}

/// Whole lines of a file, and the lines that take their place.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct ChangedLines {
    /// The first line that is replaced, from 1.
    pub from_line: usize,
    /// The last line that is replaced, from 1.
    pub to_line: usize,
    /// The lines that replace them, without the final line break.
    pub text: String,
}

/// New lines of a file, and the place where they belong; they read as the lines with the place as a comment.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PastedLines {
    /// The lines.
    pub text: String,
    /// The place: `line 13`, `below line 12`, with the file if it is not that of the fault.
    pub place: String,
}

impl fmt::Display for PastedLines {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}  # {}", self.text, self.place)
    }
}

/// Lines to paste as a part of a sentence; `None` if there are none.
///
/// # Examples
/// ```
/// use congruent_input::{PastedLines, lines_in_words};
/// let row = PastedLines { text: "  { joint = \"j\", d_mm = 302 },".to_owned(), place: "line 13".to_owned() };
/// let key = PastedLines { text: "sign = -1".to_owned(), place: "below line 8".to_owned() };
/// let words = "write in line 13: { joint = \"j\", d_mm = 302 }; write below line 8: sign = -1";
/// assert_eq!(lines_in_words(&[row, key]).as_deref(), Some(words));
/// ```
pub fn lines_in_words(pasted: &[PastedLines]) -> Option<String> {
    let in_words = |PastedLines { text, place }: &PastedLines| {
        let text = text.lines().map(str::trim).collect::<Vec<_>>().join(" ");
        // The comma belongs to the list in the file, not to the sentence.
        let text = text.strip_suffix(',').unwrap_or(&text);
        let in_line = if place.starts_with("line") { "in " } else { "" };
        format!("write {in_line}{place}: {text}")
    };
    let all: Vec<String> = pasted.iter().map(in_words).collect();
    (!all.is_empty()).then(|| all.join("; "))
}

/// The lines that edits change, each with all edits in it; in the order of the file. Of edits that overlap, such as two of
/// one value, the first counts.
pub fn changed_lines(text: &str, edits: &[TextEdit]) -> Vec<ChangedLines> {
    let mut edits: Vec<&TextEdit> = edits.iter().collect();
    edits.sort_by_key(|edit| (edit.span.start, edit.span.end));
    let mut changed: Vec<(Range<usize>, String)> = Vec::new();
    let mut written_to = 0;
    for TextEdit { span, text: new } in edits {
        if span.start < written_to {
            continue;
        }
        let start = text[..span.start].rfind('\n').map_or(0, |at| at + 1);
        match changed.last_mut() {
            Some((lines, so_far)) if start < lines.end => {
                so_far.push_str(&text[written_to..span.start]);
                // One beyond its end, so that an empty line contains its own start.
                lines.end = lines.end.max(line_end(text, span.end) + 1);
            }
            _ => {
                if let Some((lines, so_far)) = changed.last_mut() {
                    so_far.push_str(&text[written_to..lines.end - 1]);
                }
                let lines = start..line_end(text, span.end) + 1;
                changed.push((lines, text[start..span.start].to_owned()));
            }
        }
        if let Some((_, so_far)) = changed.last_mut() {
            so_far.push_str(new);
        }
        written_to = span.end;
    }
    if let Some((lines, so_far)) = changed.last_mut() {
        so_far.push_str(&text[written_to..lines.end - 1]);
    }
    let line = |at: usize| line_column(text, at).0;
    changed
        .into_iter()
        .map(|(lines, new)| ChangedLines {
            from_line: line(lines.start),
            to_line: line(lines.end - 1),
            text: new,
        })
        .collect()
}

/// The text after edits; of edits that overlap the first counts.
pub fn edited(text: &str, edits: &[TextEdit]) -> String {
    let mut edits: Vec<&TextEdit> = edits.iter().collect();
    edits.sort_by_key(|edit| (edit.span.start, edit.span.end));
    let (mut edited, mut at) = (String::with_capacity(text.len()), 0);
    for edit in edits {
        if edit.span.start >= at {
            edited += &text[at..edit.span.start];
            edited += &edit.text;
            at = edit.span.end;
        }
    }
    edited + &text[at..]
}

/// Byte offset of the end of the line that contains `from`, before its line break.
pub fn line_end(text: &str, from: usize) -> usize {
    let rest = &text[from..];
    let end = rest.find('\n').unwrap_or(rest.len());
    from + rest[..end].trim_end_matches('\r').len()
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "mass = 1\nlength = 20\n";

    fn edit(span: Range<usize>, text: &str) -> TextEdit {
        TextEdit { span, text: text.to_owned() }
    }

    fn lines(edits: &[TextEdit]) -> Vec<(usize, usize, String)> {
        let changed = changed_lines(TEXT, edits).into_iter();
        changed.map(|lines| (lines.from_line, lines.to_line, lines.text)).collect()
    }

    #[test]
    fn of_two_edits_of_one_value_the_first_counts() {
        let twice =
            [edit(7..8, "2"), edit(7..8, "2"), edit(18..20, "30"), edit(19..20, "5"), edit(20..20, ".5")];
        let expected = [(1, 1, "mass = 2".to_owned()), (2, 2, "length = 30.5".to_owned())];
        assert_eq!(lines(&twice), expected);
    }

    #[test]
    fn an_edit_across_lines_takes_in_what_it_covers() {
        let across = [edit(5..14, "+"), edit(7..8, "2"), edit(18..20, "30")];
        assert_eq!(lines(&across), [(1, 2, "mass +h = 30".to_owned())]);
    }
}
