//! Lines of a file: the marked ones with their neighbours, and lines to write instead.

use std::ops::Range;

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
                    mark { (row(number, &html! { (emphasised(line, within(source, span, number).as_slice())) })) }
                } @else {
                    span { (row(number, &html! { (shortened(line)) })) }
                }
            }
        }
    }
}

/// The text of a file; none of one outside of the project.
fn quotable(source: &SourceFile) -> &str {
    if source.is_foreign { "" } else { &source.text }
}

fn row(number: usize, line: &Markup) -> Markup {
    html! { b { (format!("{number:>4}")) } "  " (line) "\n" }
}

/// The first characters of a line.
fn shortened(line: &str) -> String {
    line.chars().take(LONGEST).collect()
}

/// The part of a finding's place that is in the line of this number; `None` if the place is the whole line or more.
fn within(source: &SourceFile, span: &Range<usize>, number: usize) -> Option<Range<usize>> {
    let start: usize = source.text.split_inclusive('\n').take(number - 1).map(str::len).sum();
    let length = source.text[start..].lines().next()?.len();
    let part = span.start.checked_sub(start)?..span.end.checked_sub(start)?;
    (part.end <= length && part.len() < length && !part.is_empty()).then_some(part)
}

/// A line with parts of it emphasised: in a row in one line, the value is otherwise not to be found.
fn emphasised(line: &str, parts: &[Range<usize>]) -> Markup {
    if line.len() > LONGEST {
        return html! { (shortened(line)) };
    }
    let mut end = 0;
    html! {
        @for part in parts {
            (line.get(end..part.start).unwrap_or_default())
            em { (line.get(part.clone()).unwrap_or_default()) }
            ({ end = part.end; "" })
        }
        (line.get(end..).unwrap_or_default())
    }
}

/// The keys and values of a new line that the old one lacks; those that follow each other are one part.
fn differing(old: &str, new: &str) -> Vec<Range<usize>> {
    // A line that is cut is not compared, which keeps the table of common words small.
    if old.len().max(new.len()) > LONGEST {
        return Vec::new();
    }
    let (old_words, new_words) = (words(old), words(new));
    let is_same = |i: usize, j: usize| old[old_words[i].clone()] == new[new_words[j].clone()];
    // Length of the longest common subsequence of the words from `i` and `j` on.
    let mut common = vec![vec![0_usize; new_words.len() + 1]; old_words.len() + 1];
    for i in (0..old_words.len()).rev() {
        for j in (0..new_words.len()).rev() {
            common[i][j] =
                if is_same(i, j) { common[i + 1][j + 1] + 1 } else { common[i + 1][j].max(common[i][j + 1]) };
        }
    }
    let (mut parts, mut follows, mut i) = (Vec::<Range<usize>>::new(), false, 0);
    for (j, word) in new_words.iter().enumerate() {
        while i < old_words.len() && !is_same(i, j) && common[i + 1][j] >= common[i][j + 1] {
            i += 1;
        }
        if i < old_words.len() && is_same(i, j) {
            (i, follows) = (i + 1, false);
            continue;
        }
        match parts.last_mut().filter(|_| follows) {
            Some(last) => last.end = word.end,
            None => parts.push(word.clone()),
        }
        follows = true;
    }
    parts
}

/// Where the keys, values and names of a line are, in TOML and in XML.
fn words(line: &str) -> Vec<Range<usize>> {
    let is_between = |c: char| c.is_whitespace() || ",={}[]<>\"'".contains(c);
    let mut words = Vec::new();
    let mut at = 0;
    for part in line.split_inclusive(is_between) {
        let word = part.trim_end_matches(is_between);
        if !word.is_empty() {
            words.push(at..at + word.len());
        }
        at += part.len();
    }
    words
}

/// Lines that a file should have instead, with what is new in them if the text of the file is known.
pub(crate) fn changed(changes: &[ChangedLines], source: Option<&SourceFile>) -> Markup {
    html! { @for change in changes { (changed_lines(change, source.map_or("", quotable))) } }
}

fn changed_lines(change: &ChangedLines, text: &str) -> Markup {
    let ChangedLines { from_line, to_line, text: new } = change;
    let old: Vec<&str> = text.lines().skip(from_line - 1).take(to_line + 1 - from_line).collect();
    // Of lines that stay and get others below them, these alone.
    let added = new.strip_prefix(&old.join("\n")).filter(|_| !old.is_empty());
    if let Some(added) = added.and_then(|rest| rest.strip_prefix('\n')) {
        return html! {
            p.place { "write below line " (to_line) ":" }
            pre.file.new {
                @for (number, line) in (to_line + 1..).zip(added.lines()) {
                    ins { (row(number, &html! { (shortened(line)) })) }
                }
            }
        };
    }
    let line = |at: usize, line: &str| {
        emphasised(line, &old.get(at).map_or_else(Vec::new, |old| differing(old, line)))
    };
    html! {
        p.place {
            "write instead of "
            @if from_line == to_line { "line " (from_line) }
            @else { "lines " (from_line) " to " (to_line) }
            ":"
        }
        pre.file.new {
            @for (at, new) in new.lines().enumerate() { ins { (row(from_line + at, &line(at, new))) } }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::ops::RangeInclusive;

    use super::*;

    const OLD: &str = "a = 1\nrow = { d_mm = 300, alpha_deg = 90 }\n";

    #[track_caller]
    fn check(text: &str, lines: RangeInclusive<usize>, expected: &str) {
        let (from_line, to_line) = lines.into_inner();
        let change = ChangedLines { from_line, to_line, text: text.to_owned() };
        let shown = changed_lines(&change, OLD).into_string();
        assert!(shown.contains(expected), "{shown}");
    }

    #[test]
    fn what_is_new_in_a_line_is_emphasised() {
        check("row = { d_mm = 310, alpha_deg = 90 }", 2..=2, "d_mm = <em>310</em>, alpha");
        check("row = { d_mm = 310, alpha_deg = 90 }", 2..=2, "write instead of line 2:");
    }

    #[test]
    fn an_inserted_key_is_emphasised_with_its_value_and_nothing_between_two_changes() {
        let parts = |old: &str, new: &str| -> Vec<String> {
            differing(old, new).into_iter().map(|part| new[part].to_owned()).collect()
        };
        let old = "{ joint = \"a\", d_mm = 300, alpha_deg = 90 }";
        let new = "{ joint = \"a\", d_mm = -310, sign = -1, alpha_deg = -90 }";
        assert_eq!(parts(old, new), ["-310, sign = -1", "-90"]);
        let new = "{ joint = \"a\", d_mm = 300, alpha_deg = 90, sign = -1 }";
        assert_eq!(parts(old, new), ["sign = -1"]);
        assert_eq!(parts("<origin xyz=\"0 0 0.3\"/>", "<origin xyz=\"0 0.1 0.3\"/>"), ["0.1"]);
        assert_eq!(parts(old, old), Vec::<String>::new());
    }

    #[test]
    fn lines_that_are_added_are_below_the_line_that_stays() {
        check("a = 1\nb = 2", 1..=1, "write below line 1:");
        check("a = 1\nb = 2", 1..=1, "<ins><b>   2</b>  b = 2");
    }
}
