//! Findings as a compiler shows them: the message, the line of the file with the place marked, and what to do.

use std::fmt::Write as _;

use miette::{GraphicalReportHandler, GraphicalTheme};

use super::{
    layout::{visible_path, with_visible_lines},
    options::TextOptions,
};
use congruent_input::{Diagnostic, Finding, SourceFile, serde_name};

/// Most findings that are shown; the others appear once these are corrected.
pub const MOST_FINDINGS: usize = 100;
/// Longest message or help that is shown to people, in bytes.
const MOST_SHOWN: usize = 2000;
/// Columns of a finding, unless the terminal has less.
const WIDEST_FINDING: usize = 100;
/// Longest snippet in bytes: a longer line fills the terminal and hides the marked place.
const LONGEST_SNIPPET: usize = 500;

/// The first [`MOST_FINDINGS`] findings, each as `show` writes it, and the number of the others; all if the options say so.
pub fn listed_findings<'a>(
    mut findings: impl ExactSizeIterator<Item = &'a Diagnostic>,
    options: &TextOptions,
    show: impl Fn(&Diagnostic) -> String,
) -> String {
    let most = if options.is_in_full { usize::MAX } else { MOST_FINDINGS };
    let mut text: String = findings.by_ref().take(most).map(show).collect();
    if findings.len() > 0 {
        let _ = writeln!(text, "and {} more; --verbose shows all", findings.len());
    }
    text
}

/// A finding with the line it is about, as a compiler shows it.
///
/// # Examples
/// ```
/// use congruent_input::Diagnostic;
/// use congruent_text::{TextOptions, finding_text};
///
/// let found = Diagnostic::error(congruent_description::codes::urdf::TREE, "link \"tool\" has no parent");
/// assert!(finding_text(&found, &TextOptions::default()).contains("error: link \"tool\" has no parent"));
/// ```
pub fn finding_text(finding: &Diagnostic, options: &TextOptions) -> String {
    let theme =
        if options.is_coloured { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
    let handler = GraphicalReportHandler::new_themed(theme)
        .with_width(options.columns.map_or(WIDEST_FINDING, |columns| columns.min(WIDEST_FINDING)))
        .with_links(false);
    let mut text = String::new();
    let finding = &with_visible_lines(shortened(finding, options));
    // Without a place in a text there is no snippet with the file's name.
    if let (None, Some(source)) = (&finding.span, &finding.source) {
        let _ = writeln!(text, "{}:", visible_path(&source.path));
    }
    if handler.render_report(&mut text, finding).is_err() {
        // The renderer rejects spans outside the text; the message is still printed.
        let _ = writeln!(text, "{}: {finding}", finding.code.name);
    }
    text.push('\n');
    text
}

/// A finding in one line: `warning CGR-URDF-018 urdf::axis: arm.urdf:12: ...`, with what to do behind it.
///
/// # Examples
/// ```
/// use congruent_input::Diagnostic;
/// use congruent_text::finding_line;
///
/// let found = Diagnostic::warning(congruent_description::codes::urdf::TREE, "link \"tool\" has no parent");
/// assert!(finding_line(&found).ends_with(" urdf::tree: link \"tool\" has no parent"));
/// ```
pub fn finding_line(finding: &Diagnostic) -> String {
    let line = Finding { message: message_with_use(finding), ..Finding::from(finding) }.to_string();
    let text = line.lines().map(str::trim).collect::<Vec<_>>().join(" ");
    let severity = serde_name(&finding.severity);
    match finding.code.id {
        Some(id) => format!("{severity} {id} {}: {text}", finding.code.name),
        None => format!("{severity} {}: {text}", finding.code.name),
    }
}

/// What is wrong, and the use that it is needed for, if that is not every one.
fn message_with_use(finding: &Diagnostic) -> String {
    match finding.stops {
        Some(stopped) => format!("{} (needed only for {})", finding.message, serde_name(&stopped)),
        None => finding.message.clone(),
    }
}

/// The finding without what would fill the terminal: no snippet if its lines are long, and long messages
/// are cut.
fn shortened(finding: &Diagnostic, options: &TextOptions) -> Diagnostic {
    let mut shortened = finding.clone();
    // Beside the sign, which not everybody sees or knows.
    shortened.message = format!("{}: {}", serde_name(&finding.severity), message_with_use(finding));
    if options.is_in_full && finding.source.as_ref().is_none_or(|source| !source.is_foreign) {
        return shortened;
    }
    clip(&mut shortened.message);
    shortened.help.as_mut().map(clip);
    let is_related_long = |source: &SourceFile| {
        let span = shortened.kind.related.as_ref().and_then(|related| related.span.as_ref());
        span.is_some_and(|span| snippet_bytes(&source.text, span) > LONGEST_SNIPPET)
    };
    if finding.source.as_deref().is_some_and(is_related_long) {
        shortened.kind.related = None;
    }
    if let (Some(source), Some(span), Some((line, column))) =
        (&finding.source, &finding.span, finding.line_column())
        && (source.is_foreign || snippet_bytes(&source.text, span) > LONGEST_SNIPPET)
    {
        let _ = write!(shortened.message, " ({}:{line}:{column})", visible_path(&source.path));
        (shortened.source, shortened.span) = (None, None);
    }
    shortened
}

/// Length of the lines that a snippet would show.
fn snippet_bytes(text: &str, span: &std::ops::Range<usize>) -> usize {
    let bytes = text.as_bytes();
    let is_break = |&byte: &u8| byte == b'\n';
    let (start, end) = (span.start.min(bytes.len()), span.end.min(bytes.len()));
    let before = bytes[..start].iter().rev().position(is_break).unwrap_or(start);
    let after = bytes[end..].iter().position(is_break).unwrap_or(bytes.len() - end);
    before + end.saturating_sub(start) + after
}

fn clip(text: &mut String) {
    if text.len() > MOST_SHOWN {
        // Cut between characters, or the rest would not be text.
        let end = (0..=MOST_SHOWN).rev().find(|&end| text.is_char_boundary(end)).unwrap_or(0);
        text.truncate(end);
        text.push_str("...");
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;

    fn finding(text: &str, span: std::ops::Range<usize>) -> Diagnostic {
        let source =
            Arc::new(SourceFile { path: "some.toml".into(), text: text.to_owned(), is_foreign: false });
        Diagnostic::error(congruent_starter::codes::new::SHAPE, "this is wrong").at(span).in_file(&source)
    }

    #[test]
    fn a_finding_shows_its_line() {
        let text = finding_text(&finding("a = 1\nb = 2\n", 6..7), &TextOptions::default());
        assert!(text.contains("some.toml:2:1") && text.contains("b = 2"), "{text}");
    }

    #[test]
    fn a_long_line_is_not_shown_but_its_place_is() {
        let long = format!("a = 1\nb = \"{}\"\n", "x".repeat(1_000_000));
        let text = finding_text(&finding(&long, 6..7), &TextOptions::default());
        assert!(text.contains("some.toml:2:1") && text.len() < 1000, "{} bytes", text.len());
    }

    #[test]
    fn long_words_end() {
        let mut long = finding("a", 0..1);
        long.message = "\u{e9}".repeat(1_000_000);
        let long = long.clone().with_help(long.message);
        assert!(finding_text(&long, &TextOptions::default()).len() < 10 * MOST_SHOWN);
    }
}
