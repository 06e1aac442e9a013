//! Lines of a file: the marked ones with their neighbours, and lines to write instead.

use congruent_input::{ChangedLines, Diagnostic, SourceFile, portable_path};
use maud::{Markup, html};

/// Lines before and after the marked ones.
const AROUND: usize = 2;
/// Most marked lines that are shown.
const MOST_LINES: usize = 20;
/// Longest line that is shown, in characters.
const LONGEST: usize = 400;

/// The lines of a finding in its file, with the file and the number of the first; nothing if its place is not known.
pub(crate) fn marked(finding: &Diagnostic) -> Markup {
    let (Some(source), Some(span), Some((first, _))) =
        (&finding.source, &finding.span, finding.line_column())
    else {
        return html! {};
    };
    // A finding may end with the line break before the next line, which is not meant.
    let marked = source.text.get(span.clone()).map_or(1, |text| text.trim_end().lines().count().max(1));
    let last = first + marked.min(MOST_LINES) - 1;
    let shown = (first.saturating_sub(AROUND).max(1))..=(last + AROUND);
    html! {
        p.place { code { (portable_path(&source.path).display()) ":" (first) } }
        pre.file {
            @for (number, line) in (1..).zip(quotable(source).lines()).filter(|(number, _)| shown.contains(number)) {
                @if (first..=last).contains(&number) {
                    mark { (row(number, line)) }
                } @else {
                    span { (row(number, line)) }
                }
            }
        }
    }
}

/// The text of a file; none of one outside of the project.
fn quotable(source: &SourceFile) -> &str {
    if source.is_foreign { "" } else { &source.text }
}

fn row(number: usize, line: &str) -> Markup {
    let line: String = line.chars().take(LONGEST).collect();
    html! { b { (format!("{number:>4}")) } "  " (line) "\n" }
}

/// Lines that a file should have instead.
pub(crate) fn changed(changes: &[ChangedLines]) -> Markup {
    html! {
        @for change in changes {
            p.place {
                "write instead of "
                @if change.from_line == change.to_line { "line " (change.from_line) }
                @else { "lines " (change.from_line) " to " (change.to_line) }
                ":"
            }
            pre.file.new {
                @for (number, line) in (change.from_line..).zip(change.text.lines()) {
                    ins { (row(number, line)) }
                }
            }
        }
    }
}
